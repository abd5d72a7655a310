//! What a path means: the file or folder that it leads to, by whichever way.

use std::ffi::{OsStr, OsString};
use std::path::{Component, Path, PathBuf};
use std::{fs, io};

use crate::error::WriteError;

/// Links that are followed one after another, as many as Linux follows (path_resolution(7)).
const MOST_LINKS: u32 = 40;

/// Where a path leads: the nearest file or folder that is there, and the names below it that are not there yet.
#[derive(Clone, Debug)]
pub struct Place {
    /// Without links.
    there: PathBuf,
    missing: Vec<OsString>,
}

impl Place {
    /// Follows a path through links and `..`, a link to something that is not there yet too.
    ///
    /// # Errors
    /// The operating system's, for a folder that may not be looked into or links that go round in a circle.
    pub fn of(path: &Path) -> io::Result<Place> {
        follow(path, MOST_LINKS)
    }

    /// The path without links.
    pub fn path(&self) -> PathBuf {
        self.missing
            .iter()
            .fold(self.there.clone(), |path, name| path.join(name))
    }

    /// Whether something is there.
    pub fn is_there(&self) -> bool {
        self.missing.is_empty()
    }

    /// Whether both are one file or folder. Hard links to a file are that file (on Unix), and names that differ in case alone are
    /// one name where the file system says so.
    pub fn is_same(&self, other: &Place) -> bool {
        self.missing.len() == other.missing.len() && self.is_within(other)
    }

    /// Whether this is `folder` or lies in it, however deep.
    pub fn is_within(&self, folder: &Place) -> bool {
        if folder.is_there() {
            let mut ancestors = self.there.ancestors();
            return ancestors.any(|path| is_same_file(path, &folder.there));
        }
        let names = || self.missing.iter().zip(&folder.missing);
        self.missing.len() >= folder.missing.len()
            && is_same_file(&self.there, &folder.there)
            && (names().all(|(a, b)| a == b)
                || names().all(|(a, b)| lower(a) == lower(b)) && ignores_case(&self.there))
    }
}

/// That no output is an input, lies in one or holds one, and that outputs lie apart from each other. Inputs that are not there are
/// left to whoever reads them.
///
/// # Errors
/// [`WriteError::OverInput`], [`WriteError::IntoInput`], [`WriteError::Twice`], [`WriteError::Nested`]; [`WriteError::Failed`] for an
/// output that leads nowhere.
pub fn verify_apart(inputs: &[&Path], outputs: &[&Path]) -> Result<(), WriteError> {
    let shown = |path: &Path| path.display().to_string();
    let read: Vec<(String, Place)> = inputs
        .iter()
        .filter_map(|path| Some((shown(path), Place::of(path).ok()?)))
        .collect();
    let mut written: Vec<(String, Place)> = Vec::new();
    for path in outputs {
        let (file, place) = (shown(path), output(path)?);
        for (input, source) in &read {
            let (file, input) = (file.clone(), input.clone());
            if source.is_within(&place) {
                return Err(WriteError::OverInput { file, input });
            }
            if place.is_within(source) {
                return Err(WriteError::IntoInput { file, input });
            }
        }
        for (other, earlier) in &written {
            let (file, other) = (file.clone(), other.clone());
            if place.is_same(earlier) {
                return Err(WriteError::Twice { file, other });
            }
            if place.is_within(earlier) {
                return Err(WriteError::Nested { file, other });
            }
            if earlier.is_within(&place) {
                let (file, other) = (other, file);
                return Err(WriteError::Nested { file, other });
            }
        }
        written.push((file, place));
    }
    Ok(())
}

/// Where an output goes.
pub(crate) fn output(path: &Path) -> Result<Place, WriteError> {
    Place::of(path).map_err(|reason| WriteError::failed(path, reason))
}

fn follow(path: &Path, links_left: u32) -> io::Result<Place> {
    let absolute = std::path::absolute(path)?;
    let mut there = PathBuf::new();
    let mut missing = Vec::new();
    for component in absolute.components() {
        match component {
            Component::CurDir => {}
            // Links are followed already, so the folder above by name is the folder above.
            Component::ParentDir => {
                if missing.pop().is_none() {
                    there.pop();
                }
            }
            Component::Normal(name) if missing.is_empty() => {
                let next = there.join(name);
                let error = match fs::canonicalize(&next) {
                    Ok(real) => {
                        there = real;
                        continue;
                    }
                    Err(error) => error,
                };
                if let Ok(target) = fs::read_link(&next) {
                    if links_left == 0 {
                        return Err(error);
                    }
                    let beyond = follow(&there.join(target), links_left - 1)?;
                    (there, missing) = (beyond.there, beyond.missing);
                    continue;
                }
                match error.kind() {
                    io::ErrorKind::NotFound | io::ErrorKind::NotADirectory => {
                        missing.push(name.to_os_string());
                    }
                    _ => return Err(error),
                }
            }
            Component::Normal(name) => missing.push(name.to_os_string()),
            Component::Prefix(_) | Component::RootDir => there.push(component),
        }
    }
    Ok(Place { there, missing })
}

#[cfg(unix)]
fn is_same_file(a: &Path, b: &Path) -> bool {
    use std::os::unix::fs::MetadataExt;
    let number = |path: &Path| fs::metadata(path).map(|m| (m.dev(), m.ino()));
    a == b || matches!((number(a), number(b)), (Ok(a), Ok(b)) if a == b)
}

/// Both are canonical, so that a file has one path, but for hard links.
#[cfg(not(unix))]
fn is_same_file(a: &Path, b: &Path) -> bool {
    a == b
}

fn lower(name: &OsStr) -> String {
    name.to_string_lossy().to_lowercase()
}

/// Whether names that differ in case alone are one name in this folder: disks and even folders of one system differ, so a file is
/// tried. Where none can be made, names count as one: then a place is refused that might have done.
fn ignores_case(folder: &Path) -> bool {
    // Named as the lock of a temporary name is, so that it is swept if it stays.
    let tried = tempfile::Builder::new()
        .prefix(".welkin-")
        .suffix(".lock")
        .tempfile_in(folder);
    tried.map_or(true, |file| {
        let name = file.path().file_name().map(lower).unwrap_or_default();
        folder.join(name.to_uppercase()).exists()
    })
}

#[cfg(test)]
mod tests;
