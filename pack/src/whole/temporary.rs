//! Temporary names, and what is left under them by runs that were killed.
//!
//! A name `.welkin-XXXXXX` belongs to whoever holds the lock of the file `.welkin-XXXXXX.lock`. The system frees it when its owner
//! ends, however that comes about, so what nobody holds can be removed. The lock is there before anything of its name and goes last.

use std::collections::BTreeSet;
use std::ffi::OsStr;
use std::fmt;
use std::fs::{self, File, TryLockError};
use std::io::{self, Write};
use std::path::{Path, PathBuf};

use tempfile::NamedTempFile;

/// What the names of files and folders in the making begin with.
pub const TEMPORARY: &str = ".welkin-";

/// What the names of locks end in.
const LOCK: &str = "lock";

/// What the names of folders end in that are replaced in two steps, and of copies of them that are not complete.
const OLD: &str = "old";
const COPY: &str = "copy";

/// Something beside a place that a run has left and that could not be removed, or must not be.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Leftover {
    /// Where it is.
    pub path: PathBuf,
    /// Why it is still there, and what to do.
    pub reason: String,
}

impl fmt::Display for Leftover {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: {}", self.path.display(), self.reason)
    }
}

/// A name beside a place. What was made under it is removed with it.
#[derive(Debug)]
pub(super) struct Temporary {
    stem: PathBuf,
    /// Removed, then freed, when it is dropped.
    lock: Option<NamedTempFile>,
}

impl Temporary {
    pub(super) fn beside(place: &Path) -> io::Result<Temporary> {
        let parent = place.parent().unwrap_or(place);
        let suffix = format!(".{LOCK}");
        let mut builder = tempfile::Builder::new();
        builder.prefix(TEMPORARY).suffix(&suffix);
        // Other users see that it is held, too.
        #[cfg(unix)]
        builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o644));
        loop {
            let mut lock = builder.tempfile_in(parent)?;
            // Where a file system knows no locks, nobody gets one, and nothing is removed there but by its owner.
            lock.as_file().lock().ok();
            // Someone who sweeps may have taken it in the instant before.
            if lock.path().exists() {
                writeln!(lock, "{}", place.display())?;
                let stem = lock.path().with_extension("");
                let lock = Some(lock);
                return Ok(Temporary { stem, lock });
            }
        }
    }

    /// Where the new file or folder is made.
    pub(super) fn new_path(&self) -> &Path {
        &self.stem
    }

    /// Where an old folder goes that cannot be exchanged in one step.
    pub(super) fn old_path(&self) -> PathBuf {
        old(&self.stem)
    }

    /// Where an old folder is copied.
    pub(super) fn copy_path(&self) -> PathBuf {
        copy(&self.stem)
    }

    /// Removes what is under the name.
    pub(super) fn remove(&self) -> Result<(), Leftover> {
        remove_all(&self.stem)
    }
}

impl Drop for Temporary {
    fn drop(&mut self) {
        if self.remove().is_err() {
            // The next run knows by it whose the rest is, and tries again.
            self.lock.take().map(NamedTempFile::keep);
        }
    }
}

fn old(stem: &Path) -> PathBuf {
    stem.with_extension(OLD)
}

fn copy(stem: &Path) -> PathBuf {
    stem.with_extension(COPY)
}

/// Removes what runs that were killed have left in a folder, and tells what it must leave there. What belongs to a run that is still at
/// work is neither touched nor told.
pub fn sweep(folder: &Path) -> Vec<Leftover> {
    let entries = fs::read_dir(folder).into_iter().flatten().flatten();
    let stems: BTreeSet<PathBuf> = entries
        .filter(|entry| is_temporary(&entry.file_name()))
        .map(|entry| entry.path().with_extension(""))
        .collect();
    stems.iter().filter_map(|s| sweep_name(s).err()).collect()
}

/// Whether a file has a name that [`Temporary`] gives.
fn is_temporary(name: &OsStr) -> bool {
    let name = name.to_string_lossy();
    let rest = name.strip_prefix(TEMPORARY).unwrap_or_default();
    let (random, extension) = rest.split_once('.').unwrap_or((rest, LOCK));
    random.len() == 6
        && random.bytes().all(|b| b.is_ascii_alphanumeric())
        && [LOCK, OLD, COPY].contains(&extension)
}

fn sweep_name(stem: &Path) -> Result<(), Leftover> {
    let left = |reason: &dyn fmt::Display| Leftover {
        path: stem.to_path_buf(),
        reason: format!("{reason}; remove it if no welkin is at work there"),
    };
    let path = stem.with_extension(LOCK);
    let mut opened = File::options().read(true).write(true).open(&path);
    if matches!(&opened, Err(e) if e.kind() == io::ErrorKind::PermissionDenied) {
        opened = File::open(&path);
    }
    let lock = match opened {
        Ok(lock) => lock,
        // Of a version that had no locks; or its owner has just removed both.
        Err(error) if error.kind() == io::ErrorKind::NotFound => {
            return match fs::symlink_metadata(stem) {
                Ok(_) => Err(left(&"was left by a run that was stopped")),
                Err(_) => Ok(()),
            };
        }
        Err(error) => return Err(left(&format!("has a lock that cannot be opened: {error}"))),
    };
    match lock.try_lock() {
        Err(TryLockError::WouldBlock) => return Ok(()),
        Err(TryLockError::Error(error)) => {
            return Err(left(&format!("has a lock that cannot be tried: {error}")));
        }
        Ok(()) => {}
    }
    remove_all(stem)?;
    match fs::remove_file(&path) {
        Err(error) if error.kind() != io::ErrorKind::NotFound => {
            Err(left(&format!("has a lock that cannot be removed: {error}")))
        }
        _ => Ok(()),
    }
}

/// Removes what is under a name, but for an old folder whose new one has not come into its place.
fn remove_all(stem: &Path) -> Result<(), Leftover> {
    let old = old(stem);
    if old.exists() && stem.exists() {
        let place = fs::read_to_string(stem.with_extension(LOCK)).unwrap_or_default();
        return Err(Leftover {
            reason: format!(
                "is what was at {} when a run that replaced it was stopped; move it back there, or remove it if that is whole",
                place.trim_end()
            ),
            path: old,
        });
    }
    for path in [stem.to_path_buf(), copy(stem), old] {
        let removed = match fs::symlink_metadata(&path) {
            Ok(metadata) if metadata.is_dir() => fs::remove_dir_all(&path),
            Ok(_) => fs::remove_file(&path),
            Err(error) => Err(error),
        };
        match removed {
            Err(error) if error.kind() != io::ErrorKind::NotFound => {
                return Err(Leftover {
                    reason: format!("is no longer used and cannot be removed: {error}; remove it"),
                    path,
                });
            }
            _ => {}
        }
    }
    Ok(())
}
