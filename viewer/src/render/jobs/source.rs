//! Where jobs come from: a file, or standard input, which another program may still be writing.

use std::collections::HashMap;
use std::fs::File;
use std::io::{self, BufRead, BufReader};
use std::path::{Path, PathBuf};
use std::sync::mpsc::{Receiver, RecvTimeoutError, TryRecvError, sync_channel};
use std::thread;
use std::time::Duration;

use anyhow::{Context, Result, bail};
use welkin_viewer::export::sequence::Shard;

use super::lines::{LineFault, Lines};
use crate::job::Job;

/// Lines of a pipe that wait to be drawn.
const WAITING: usize = 64;

/// As long a pipe is waited for before one looks whether to go on.
const PATIENCE: Duration = Duration::from_millis(100);

/// A line and its number.
type Line = (u64, String);

/// Lines of jobs.
pub enum Source {
    File(PathBuf, Lines<BufReader<File>>),
    Pipe(PathBuf, Received),
}

/// Lines of a pipe as they come.
type Received = Receiver<Result<Line, (u64, LineFault)>>;

/// Reads on while pictures are drawn.
fn pipe(reader: impl BufRead + Send + 'static) -> Received {
    let (sender, receiver) = sync_channel(WAITING);
    // It ends with what it reads, or with the program.
    thread::spawn(move || {
        let mut lines = Lines::new(reader);
        loop {
            let line = match lines.next() {
                Ok(None) => return,
                Ok(Some(text)) => Ok((lines.number(), text)),
                Err(fault) => Err((lines.number(), fault)),
            };
            let is_fault = line.is_err();
            if sender.send(line).is_err() || is_fault {
                return;
            }
        }
    });
    receiver
}

/// Where a fault is.
pub fn at(jobs: &Path, number: u64) -> String {
    match is_pipe(jobs) {
        true => format!("standard input, line {number}"),
        false => format!("{}, line {number}", jobs.display()),
    }
}

fn is_pipe(jobs: &Path) -> bool {
    jobs.as_os_str() == "-"
}

impl Source {
    /// Opens the jobs; `-` is standard input. What is no file, and can be read but once, is a pipe too.
    pub fn open(jobs: &Path) -> Result<Source> {
        let place = jobs.to_path_buf();
        if is_pipe(jobs) {
            return Ok(Source::Pipe(place, pipe(BufReader::new(io::stdin()))));
        }
        let file = open(jobs)?;
        let is_file = file.metadata().is_ok_and(|metadata| metadata.is_file());
        Ok(match is_file {
            true => Source::File(place, Lines::new(BufReader::new(file))),
            false => Source::Pipe(place, pipe(BufReader::new(file))),
        })
    }

    pub fn is_file(&self) -> bool {
        matches!(self, Source::File(..))
    }

    /// What the packs that jobs name are relative to.
    pub fn base(&self) -> PathBuf {
        match self {
            Source::File(jobs, _) => jobs.parent().map(Path::to_path_buf).unwrap_or_default(),
            Source::Pipe(..) => PathBuf::new(),
        }
    }

    /// The next line, none at the end; nothing at all if it is yet to come.
    pub fn next(&mut self, may_wait: bool) -> Result<Option<Option<Line>>> {
        match self {
            Source::File(jobs, lines) => {
                let line = lines.next();
                let line = line.with_context(|| at(jobs, lines.number()))?;
                Ok(Some(line.map(|text| (lines.number(), text))))
            }
            Source::Pipe(jobs, lines) => {
                let line = match may_wait {
                    true => match lines.recv_timeout(PATIENCE) {
                        Ok(line) => Some(line),
                        Err(RecvTimeoutError::Timeout) => return Ok(None),
                        Err(RecvTimeoutError::Disconnected) => None,
                    },
                    false => match lines.try_recv() {
                        Ok(line) => Some(line),
                        Err(TryRecvError::Empty) => return Ok(None),
                        Err(TryRecvError::Disconnected) => None,
                    },
                };
                match line {
                    Some(Err((number, fault))) => Err(fault).with_context(|| at(jobs, number)),
                    Some(Ok(line)) => Ok(Some(Some(line))),
                    None => Ok(Some(None)),
                }
            }
        }
    }
}

/// Every line of a file.
pub fn read_all(jobs: &Path, mut each: impl FnMut(u64, &str) -> Result<()>) -> Result<()> {
    let mut lines = Lines::new(BufReader::new(open(jobs)?));
    loop {
        let line = lines.next();
        let Some(text) = line.with_context(|| at(jobs, lines.number()))? else {
            return Ok(());
        };
        each(lines.number(), &text)?;
    }
}

fn open(jobs: &Path) -> Result<File> {
    let told = || {
        format!(
            "{}: cannot be read; name a file of jobs, or - for standard input",
            jobs.display()
        )
    };
    File::open(jobs).with_context(told)
}

/// Jobs of a part, each of another name.
pub struct Numbered {
    shard: Shard,
    count: u64,
    /// Names in small letters, which are one name on some systems, and their lines.
    names: HashMap<String, u64>,
}

impl Numbered {
    pub fn new(shard: Shard) -> Numbered {
        Numbered {
            shard,
            count: 0,
            names: HashMap::new(),
        }
    }

    /// The job of the next line, if it is of this part.
    pub fn job(&mut self, text: &str, number: u64) -> Result<Option<Job>> {
        let job = Job::parse(text, number)?;
        let before = self.names.insert(job.name.to_lowercase(), number);
        if let Some(before) = before {
            bail!(
                "name is \"{}\", expected another one: that of line {before} is the same, or differs in large and small letters alone",
                job.name
            );
        }
        let place = self.count % u64::from(self.shard.count);
        self.count += 1;
        Ok((place == u64::from(self.shard.index) - 1).then_some(job))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parts_have_every_job_once() {
        let names = |shard: &str| {
            let mut numbered = Numbered::new(shard.parse().unwrap());
            let jobs = (1..=7).filter_map(|n| numbered.job("{}", n).unwrap());
            jobs.map(|job| job.name).collect::<Vec<_>>()
        };
        assert_eq!(names("1/1").len(), 7);
        assert_eq!(names("2/3"), ["000002", "000005"]);
        let mut all = ["1/3", "2/3", "3/3"].map(names).concat();
        all.sort();
        assert_eq!(all, names("1/1"));
    }

    #[test]
    fn a_name_that_was_there_is_told_with_its_line_whatever_the_part() {
        for (first, second) in [("a", "a"), ("sky", "Sky"), ("000002", "")] {
            let mut numbered = Numbered::new("3/3".parse().unwrap());
            let job = |name: &str| match name {
                "" => "{}".to_string(),
                name => format!("{{\"name\": \"{name}\"}}"),
            };
            numbered.job(&job(first), 1).unwrap();
            let error = numbered.job(&job(second), 2).unwrap_err().to_string();
            assert!(error.contains("line 1"), "{error}");
        }
    }
}
