//! The index of a folder of jobs: a line of JSON for each picture, added when its files are there.
//!
//! # Practice
//! A run only adds lines, so one that is killed leaves whole lines but for the last, and that one is cut off by the next run. Of several lines of one name the last holds.
//! What a line says is believed if all its files are there with its hashes. At the end lines are in the order of the jobs, after those of other jobs.

use std::collections::{HashMap, HashSet};
use std::fs::{self, File, OpenOptions, TryLockError};
use std::io::{self, Write};
use std::ops::Range;
use std::path::{Path, PathBuf};

use rayon::prelude::*;
use welkin_pack::whole::write_file;
use welkin_pack::{WriteError, shown};
use welkin_viewer::export::sequence::Shard;

use super::line::{self, BEGINNING, Line, Made, hash};

/// Why an index cannot be used.
#[derive(Debug, thiserror::Error)]
pub enum IndexError {
    /// Another run writes it.
    #[error(
        "{file}: another run is at work on it; wait for its end, or give each run a --shard of its own"
    )]
    InUse { file: String },
    /// A line is not of an index.
    #[error("{file}, line {line}: is no line of an index: {}; expected one that this program has written: move the file away", shown(.reason))]
    Foreign {
        file: String,
        line: usize,
        reason: String,
    },
    /// The system's reason.
    #[error(transparent)]
    Write(#[from] WriteError),
}

/// What is known of a picture.
#[derive(Debug)]
pub struct Known {
    /// Hash of its job.
    pub job: String,
    /// Its labels.
    pub labels: Vec<String>,
    /// Names of its files.
    pub files: Vec<String>,
    /// The tar file that they are in.
    pub tar: Option<String>,
    /// Whether all of them are there as they were written.
    pub is_whole: bool,
    bytes: Range<usize>,
}

/// The index of a folder, or of one part of its jobs.
pub struct Index {
    path: PathBuf,
    file: File,
    length: usize,
    known: HashMap<String, Known>,
    /// Names of its lines in their order, those that no longer hold too.
    written: Vec<String>,
    /// Names of this run's jobs.
    run: Vec<String>,
}

/// The index's name: each part of the jobs has its own, since only one program may write a file.
pub fn file_name(shard: Shard) -> String {
    match shard {
        Shard { count: 1, .. } => "index.jsonl".to_string(),
        Shard { index, count } => format!("index-{index:06}-of-{count:06}.jsonl"),
    }
}

impl Index {
    /// Opens the index of a folder, made if it is not there, and looks at the files that it knows.
    pub fn open(folder: &Path, shard: Shard) -> Result<Index, IndexError> {
        let path = folder.join(file_name(shard));
        let failed = |reason| failed(&path, reason);
        let mut options = OpenOptions::new();
        let file = options.read(true).append(true).create(true).open(&path);
        let file = file.map_err(failed)?;
        match file.try_lock() {
            Err(TryLockError::WouldBlock) => {
                let file = path.display().to_string();
                return Err(IndexError::InUse { file });
            }
            // Some file systems know no locks.
            Ok(()) | Err(TryLockError::Error(_)) => {}
        }
        let bytes = fs::read(&path).map_err(failed)?;
        let length = bytes.iter().rposition(|b| *b == b'\n').map_or(0, |i| i + 1);
        let (whole, cut) = bytes.split_at(length);
        let lines = read(&path, whole)?;
        if !(cut.starts_with(BEGINNING) || BEGINNING.starts_with(cut)) {
            let file = path.display().to_string();
            let reason = "it begins otherwise".to_string();
            let line = lines.len() + 1;
            return Err(IndexError::Foreign { file, line, reason });
        }
        if !cut.is_empty() {
            file.set_len(length as u64).map_err(failed)?;
        }
        let written = lines.iter().map(|(line, _)| line.name.clone()).collect();
        // A tar file has many pictures.
        let made: HashSet<&Made> = lines.iter().flat_map(|(line, _)| files(line)).collect();
        let whole = made.into_par_iter().filter(|made| is_whole(folder, made));
        let whole: HashSet<Made> = whole.cloned().collect();
        let known = lines.into_iter().map(|(line, bytes)| {
            let is_whole = files(&line).all(|made| whole.contains(made));
            let known = Known {
                is_whole,
                job: line.job,
                labels: line.labels,
                files: line.files.into_values().map(|made| made.file).collect(),
                tar: line.tar.map(|made| made.file),
                bytes,
            };
            (line.name, known)
        });
        Ok(Index {
            file,
            length,
            // The last line of a name holds.
            known: known.collect(),
            written,
            run: Vec::new(),
            path,
        })
    }

    /// What is known of a picture.
    pub fn known(&self, name: &str) -> Option<&Known> {
        self.known.get(name)
    }

    /// Adds the line of a picture whose files are there.
    pub fn add(&mut self, line: &Line) -> Result<(), IndexError> {
        let text = serde_json::to_string(line).map_err(|e| failed(&self.path, e.into()))?;
        self.append(line.name.clone(), &text)
    }

    fn append(&mut self, name: String, line: &str) -> Result<(), IndexError> {
        let line = format!("{line}\n");
        let written = self.file.write_all(line.as_bytes());
        written.map_err(|reason| failed(&self.path, reason))?;
        let bytes = self.length..self.length + line.len();
        self.length = bytes.end;
        let known = Known {
            job: String::new(),
            labels: Vec::new(),
            files: Vec::new(),
            tar: None,
            is_whole: true,
            bytes,
        };
        self.known.insert(name.clone(), known);
        self.written.push(name.clone());
        self.run.push(name);
        Ok(())
    }

    /// Keeps the line that is there.
    pub fn keep(&mut self, name: String) {
        self.run.push(name);
    }

    /// Brings it to the disk; after a whole run with its lines in the order of the jobs.
    pub fn close(self, is_whole_run: bool) -> Result<(), IndexError> {
        let failed = |reason| failed(&self.path, reason);
        self.file.sync_all().map_err(failed)?;
        if !is_whole_run {
            return Ok(());
        }
        let own: HashSet<&String> = self.run.iter().collect();
        let mut told = HashSet::new();
        let others = self.written.iter().filter(|name| !own.contains(name));
        let others = others.filter(|name| told.insert(*name));
        let ordered: Vec<&String> = others.chain(&self.run).collect();
        if ordered.iter().copied().eq(&self.written) {
            return Ok(());
        }
        let bytes = fs::read(&self.path).map_err(failed)?;
        let lines = ordered.iter().filter_map(|name| self.known.get(*name));
        let lines: Option<Vec<&[u8]>> = lines.map(|k| bytes.get(k.bytes.clone())).collect();
        let Some(lines) = lines else {
            return Err(failed(io::Error::other("it was shortened by someone else")));
        };
        drop(self.file);
        Ok(write_file(&self.path, &lines.concat(), &|| false)?)
    }
}

fn failed(path: &Path, reason: io::Error) -> IndexError {
    IndexError::Write(WriteError::Failed {
        file: path.display().to_string(),
        reason,
    })
}

/// The lines of an index, and where each is.
fn read(path: &Path, bytes: &[u8]) -> Result<Vec<(line::Known, Range<usize>)>, IndexError> {
    let mut begin = 0;
    let lines = bytes.split_inclusive(|b| *b == b'\n').enumerate();
    lines
        .map(|(number, bytes)| {
            let place = begin..begin + bytes.len();
            begin = place.end;
            let line = serde_json::from_slice(bytes).map_err(|e| IndexError::Foreign {
                file: path.display().to_string(),
                line: number + 1,
                reason: e.to_string(),
            })?;
            Ok((line, place))
        })
        .collect()
}

/// The files that a line stands for: its own, or the tar file that has them.
fn files(line: &line::Known) -> impl Iterator<Item = &Made> {
    let own = line.files.values().filter(|_| line.tar.is_none());
    own.chain(&line.tar)
}

/// Whether a file is there with the bytes that were written.
fn is_whole(folder: &Path, made: &Made) -> bool {
    // A line that names another folder's file is none of ours.
    let is_name = !made.file.contains(['/', '\\']);
    is_name && fs::read(folder.join(&made.file)).is_ok_and(|bytes| hash(&bytes) == made.blake3)
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeMap;

    use super::*;

    fn line(name: &str, file: &str, bytes: &[u8]) -> String {
        let made = Made {
            file: file.to_string(),
            blake3: hash(bytes),
        };
        let files = BTreeMap::from([("picture", made)]);
        let files = serde_json::to_string(&files).unwrap();
        format!("{{\"name\":\"{name}\",\"files\":{files},\"job\":\"j\",\"labels\":[]}}")
    }

    fn text(folder: &Path) -> String {
        fs::read_to_string(folder.join("index.jsonl")).unwrap()
    }

    #[test]
    fn lines_end_in_the_order_of_the_jobs_after_those_of_others() {
        let folder = tempfile::tempdir().unwrap();
        let folder = folder.path();
        let [a, b, c, d] = ["a", "b", "c", "d"].map(|name| line(name, name, b""));
        let mut index = Index::open(folder, Shard::WHOLE).unwrap();
        for (name, line) in [("d", &d), ("a", &a), ("c", &c)] {
            index.append(name.to_string(), line).unwrap();
        }
        index.close(true).unwrap();
        assert_eq!(text(folder), format!("{d}\n{a}\n{c}\n"));
        // b is drawn in the middle, c anew.
        let mut index = Index::open(folder, Shard::WHOLE).unwrap();
        index.keep("a".to_string());
        index.append("b".to_string(), &b).unwrap();
        let anew = c.replace("\"j\"", "\"k\"");
        index.append("c".to_string(), &anew).unwrap();
        // Of a run that ended before its jobs did, lines stay where they are.
        index.close(false).unwrap();
        assert_eq!(text(folder), format!("{d}\n{a}\n{c}\n{b}\n{anew}\n"));
        let mut index = Index::open(folder, Shard::WHOLE).unwrap();
        assert_eq!(index.known("c").unwrap().job, "k");
        for name in ["a", "b", "c"] {
            index.keep(name.to_string());
        }
        index.close(true).unwrap();
        assert_eq!(text(folder), format!("{d}\n{a}\n{b}\n{anew}\n"));
        assert_eq!(folder.read_dir().unwrap().count(), 1);
    }

    #[test]
    fn a_line_is_believed_if_its_files_are_there() {
        let folder = tempfile::tempdir().unwrap();
        let folder = folder.path();
        fs::write(folder.join("a.png"), "a").unwrap();
        fs::write(folder.join("b.png"), "not b").unwrap();
        let lines = ["a", "b", "c"].map(|name| line(name, &format!("{name}.png"), name.as_bytes()));
        let beyond = line("d", "../d.png", b"");
        let cut = &lines[0][..20];
        let whole = format!("{}\n{beyond}\n", lines.join("\n"));
        fs::write(folder.join("index.jsonl"), format!("{whole}{cut}")).unwrap();
        fs::write(folder.join("../d.png"), "").ok();
        let index = Index::open(folder, Shard::WHOLE).unwrap();
        let found = ["a", "b", "c", "d"].map(|name| index.known(name).unwrap().is_whole);
        assert_eq!(found, [true, false, false, false]);
        assert!(index.known("e").is_none());
        assert_eq!(text(folder), whole, "the last line was not whole");
        fs::remove_file(folder.join("../d.png")).ok();
    }

    #[test]
    fn what_is_no_index_stays_as_it_is() {
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join("index.jsonl");
        let known = line("a", "a.png", b"");
        for other in [
            "notes\n".to_string(),
            format!("{known}\n{{}}\nand"),
            "\n".into(),
        ] {
            fs::write(&file, &other).unwrap();
            let error = Index::open(folder.path(), Shard::WHOLE).err().unwrap();
            let told = error.to_string();
            assert!(
                told.contains("line ") && told.contains("move the file away"),
                "{told}"
            );
            assert_eq!(fs::read_to_string(&file).unwrap(), other);
        }
    }

    #[test]
    fn one_run_at_a_time_writes_an_index() {
        let folder = tempfile::tempdir().unwrap();
        let first = Index::open(folder.path(), Shard::WHOLE).unwrap();
        let second = Index::open(folder.path(), Shard::WHOLE);
        assert!(matches!(second, Err(IndexError::InUse { .. })));
        let part = Shard {
            index: 2,
            count: 16,
        };
        Index::open(folder.path(), part).unwrap();
        assert!(folder.path().join("index-000002-of-000016.jsonl").exists());
        drop(first);
        Index::open(folder.path(), Shard::WHOLE).unwrap();
    }
}
