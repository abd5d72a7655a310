//! Pictures with their labels in tar files, as WebDataset reads them: files of one sample follow each other, and have its name up to the first dot.
//!
//! A. Aizman, G. Maltby, T. Breuel, "High Performance I/O For Large Scale Deep Learning", IEEE Big Data 2019. Of two runs of the same jobs the bytes are the same: no
//! owner and no time is told.

use std::io;
use std::path::Path;

use anyhow::{Context, Result};
use welkin_viewer::export::sequence::Shard;

use super::groups::Group;
use super::line::{Line, Made, hash};
use super::put::put;
use super::studio::Finished;

/// The name of a tar file: each part of the jobs has its own.
pub fn tar_name(shard: Shard, number: u64) -> String {
    match shard {
        Shard { count: 1, .. } => format!("skies-{number:06}.tar"),
        Shard { index, count } => format!("skies-{index:06}-of-{count:06}-{number:06}.tar"),
    }
}

/// The pictures of the tar file in the making.
#[derive(Default)]
pub struct Archive {
    open: Vec<Finished>,
    number: u64,
}

impl Archive {
    /// Adds a picture. When its group is complete the file is written, and the lines of all its pictures come back.
    pub fn add(
        &mut self,
        (finished, group): (Finished, &Group),
        folder: &Path,
        file: String,
        force: bool,
    ) -> Result<Vec<Line>> {
        // Of a group that lacks a picture nothing is written.
        if self.number != group.number {
            self.open.clear();
        }
        self.number = group.number;
        self.open.push(finished);
        if self.open.len() < group.count {
            return Ok(Vec::new());
        }
        let mut lines = Vec::new();
        let mut archive = tar::Builder::new(Vec::new());
        for mut finished in self.open.drain(..) {
            for (kind, file, bytes) in finished.files {
                append(&mut archive, &file, &bytes).with_context(|| file.clone())?;
                let blake3 = hash(&bytes);
                finished.line.files.insert(kind, Made { file, blake3 });
            }
            let line = serde_json::to_string(&finished.line)? + "\n";
            let name = format!("{}.json", finished.line.name);
            append(&mut archive, &name, line.as_bytes()).with_context(|| name.clone())?;
            lines.push(finished.line);
        }
        let bytes = archive.into_inner()?;
        let may_replace = force || group.own.contains(&file);
        let made = put(folder, file, &bytes, may_replace)?;
        for line in &mut lines {
            line.tar = Some(made.clone());
        }
        Ok(lines)
    }
}

fn append(archive: &mut tar::Builder<Vec<u8>>, name: &str, bytes: &[u8]) -> io::Result<()> {
    let mut header = tar::Header::new_ustar();
    header.set_size(bytes.len() as u64);
    header.set_mode(0o644);
    header.set_mtime(0);
    archive.append_data(&mut header, name, bytes)
}
