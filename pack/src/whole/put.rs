//! Puts a folder in its place, and loses nothing that has come there meanwhile.

use std::path::Path;
use std::{fs, io};

use super::temporary::{TEMPORARY, Temporary};
use crate::error::WriteError;

/// Names of the files of a folder that may be replaced.
pub type IsOurs = fn(&str) -> bool;

/// Whether a file of this name is one that systems put into folders by themselves, or one in the making: such never stand in the way.
pub fn is_litter(name: &str) -> bool {
    // Finder; Windows Explorer, whose disks do not tell case; AppleDouble, and files that NFS keeps until they are closed.
    let named = [".DS_Store", "Thumbs.db", "desktop.ini"];
    named.iter().any(|litter| name.eq_ignore_ascii_case(litter))
        || ["._", ".nfs", TEMPORARY]
            .iter()
            .any(|start| name.starts_with(start))
}

/// What is at the place of a folder.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum There {
    Nothing,
    /// A folder with nothing in it.
    Empty,
    /// A folder of files that may go.
    Ours,
}

/// What is at a place; an error if it must stay.
pub(super) fn look(place: &Path, shown: &Path, ours: Option<IsOurs>) -> Result<There, WriteError> {
    let file = || shown.display().to_string();
    let failed = |reason| WriteError::failed(shown, reason);
    match fs::symlink_metadata(place) {
        Ok(metadata) if metadata.is_dir() => {}
        Ok(_) => return Err(WriteError::NotAFolder { file: file() }),
        Err(error) if error.kind() == io::ErrorKind::PermissionDenied => return Err(failed(error)),
        Err(_) => return Ok(There::Nothing),
    }
    if fs::read_dir(place).map_err(failed)?.next().is_none() {
        return Ok(There::Empty);
    }
    let others = others(place, ours.unwrap_or(|_| false)).map_err(failed)?;
    match ours {
        _ if others.is_empty() => Ok(There::Ours),
        None => Err(WriteError::Exists { file: file() }),
        Some(_) => Err(WriteError::NotOurs {
            file: file(),
            found: listed(&others),
        }),
    }
}

/// Names of what is in a folder and is neither a file of ours nor litter.
pub(super) fn others(folder: &Path, ours: IsOurs) -> io::Result<Vec<String>> {
    let mut names = Vec::new();
    for entry in fs::read_dir(folder)? {
        let entry = entry?;
        let name = entry.file_name().to_string_lossy().into_owned();
        // Litter may be gone by the time it is looked at.
        let is_folder = entry.file_type().is_ok_and(|kind| kind.is_dir());
        let may_go = is_litter(&name) && !is_folder || ours(&name) && entry.path().is_file();
        if !may_go {
            names.push(name);
        }
    }
    names.sort();
    Ok(names)
}

/// The first names, and how many there are more.
pub(super) fn listed(names: &[String]) -> String {
    const SHOWN: usize = 5;
    let shown = names[..names.len().min(SHOWN)].join(", ");
    match names.len().saturating_sub(SHOWN) {
        0 => shown,
        more => format!("{shown} and {more} more"),
    }
}

/// Puts a folder that is complete in its place.
pub(super) fn put(
    temporary: &Temporary,
    place: &Path,
    shown: &Path,
    ours: Option<IsOurs>,
) -> Result<(), WriteError> {
    let new = temporary.new_path();
    let failed = |reason| WriteError::failed(shown, reason);
    let taken = |error: io::Error| match error.kind() {
        io::ErrorKind::AlreadyExists | io::ErrorKind::DirectoryNotEmpty => WriteError::Exists {
            file: shown.display().to_string(),
        },
        _ => failed(error),
    };
    match move_to_free(new, place) {
        Err(error) if error.kind() == io::ErrorKind::AlreadyExists => {}
        done => return done.map_err(failed),
    }
    match look(place, shown, ours)? {
        // It was there a moment ago.
        There::Nothing => move_to_free(new, place).map_err(taken),
        There::Empty => move_to_empty(new, place).map_err(taken),
        There::Ours => replace(place, temporary, &|old| look(old, shown, ours).map(|_| ()))
            .map_err(|kept| match kept {
                Kept::Others(error) => error,
                Kept::Failed(reason) => taken(reason),
            }),
    }
}

/// Why a folder was not replaced: it had come to hold something else, or the system refused.
#[derive(Debug)]
pub(super) enum Kept {
    Others(WriteError),
    Failed(io::Error),
}

impl From<io::Error> for Kept {
    fn from(reason: io::Error) -> Kept {
        Kept::Failed(reason)
    }
}

/// Looks at a folder that is out of everybody's reach: an error if something has come into it that must stay.
type Verify<'a> = &'a dyn Fn(&Path) -> Result<(), WriteError>;

/// Replaces a folder: in one step where the system can, else in two, else by copying.
fn replace(place: &Path, temporary: &Temporary, verify: Verify) -> Result<(), Kept> {
    let new = temporary.new_path();
    match exchange(new, place) {
        Ok(()) => {
            let verified = verify(new);
            if verified.is_err() && exchange(new, place).is_err() {
                // It cannot go back, so it stays where the next run tells of it.
                fs::rename(new, temporary.old_path())?;
                fs::create_dir(new)?;
            }
            return verified.map_err(Kept::Others);
        }
        Err(error) if error.kind() == io::ErrorKind::Unsupported => {
            match replace_in_two_steps(place, temporary, verify) {
                Err(Kept::Failed(error)) if error.kind() == io::ErrorKind::CrossesDevices => {}
                done => return done,
            }
        }
        Err(error) if error.kind() == io::ErrorKind::CrossesDevices => {}
        Err(error) => return Err(error.into()),
    }
    replace_by_copying(place, temporary, verify)
}

/// There is an instant between two renames at which nothing is there. A run that is killed then leaves the old folder, which the next run
/// tells of.
pub(super) fn replace_in_two_steps(
    place: &Path,
    temporary: &Temporary,
    verify: Verify,
) -> Result<(), Kept> {
    let old = temporary.old_path();
    fs::rename(place, &old)?;
    let done = verify(&old)
        .map_err(Kept::Others)
        .and_then(|()| rename_to_free(temporary.new_path(), place).map_err(Kept::Failed));
    if done.is_err() {
        rename_to_free(&old, place)?;
    }
    done
}

/// An overlay file system renames no folder of a lower layer (Linux, Documentation/filesystems/overlayfs.rst, "Renaming directories"). So the files of the old folder are copied, then removed one by one, and the new
/// folder takes the place of the empty one. A failure puts them back; a run that is killed in between leaves the copy, which the next run
/// tells of.
pub(super) fn replace_by_copying(
    place: &Path,
    temporary: &Temporary,
    verify: Verify,
) -> Result<(), Kept> {
    let (copy, old) = (temporary.copy_path(), temporary.old_path());
    fs::create_dir(&copy)?;
    let mut names = Vec::new();
    for entry in fs::read_dir(place)? {
        let entry = entry?;
        let name = entry.file_name();
        fs::copy(entry.path(), copy.join(&name))?;
        fs::File::open(copy.join(&name))?.sync_all()?;
        names.push(name);
    }
    verify(&copy).map_err(Kept::Others)?;
    move_to_free(&copy, &old)?;
    let mut removed = names.iter().map(|name| fs::remove_file(place.join(name)));
    // What has come into the folder meanwhile makes the last step fail.
    let done = removed
        .try_for_each(|removed| removed)
        .and_then(|()| move_to_empty(temporary.new_path(), place));
    if done.is_err() {
        for name in names.iter().filter(|name| !place.join(name).exists()) {
            fs::rename(old.join(name), place.join(name))?;
        }
        fs::remove_dir_all(&old)?;
    }
    Ok(done?)
}

/// Renames a folder to a name that must be free.
#[cfg(target_os = "linux")]
fn rename_to_free(from: &Path, to: &Path) -> io::Result<()> {
    match rename_with(from, to, rustix::fs::RenameFlags::NOREPLACE) {
        Err(error) if error.kind() == io::ErrorKind::Unsupported => rename_if_free(from, to),
        done => done,
    }
}

#[cfg(not(target_os = "linux"))]
fn rename_to_free(from: &Path, to: &Path) -> io::Result<()> {
    rename_if_free(from, to)
}

/// What comes there between look and rename is lost if it is an empty folder, and kept otherwise: a folder is renamed over nothing else.
fn rename_if_free(from: &Path, to: &Path) -> io::Result<()> {
    if fs::symlink_metadata(to).is_ok() {
        return Err(io::ErrorKind::AlreadyExists.into());
    }
    fs::rename(from, to)
}

/// Renames a folder to a name that must be free. Some overlays rename no folder at all: there its files are moved into a new one.
fn move_to_free(from: &Path, to: &Path) -> io::Result<()> {
    match rename_to_free(from, to) {
        Err(error) if error.kind() == io::ErrorKind::CrossesDevices => {
            fs::create_dir(to)?;
            move_files(from, to).inspect_err(|_| drop(fs::remove_dir(to)))
        }
        done => done,
    }
}

/// Puts a folder in the place of an empty one, and of no other.
fn move_to_empty(from: &Path, to: &Path) -> io::Result<()> {
    // Unix does it in one step.
    #[cfg(not(unix))]
    fs::remove_dir(to)?;
    fs::rename(from, to).or_else(|error| {
        if fs::read_dir(to)?.next().is_some() {
            return Err(io::ErrorKind::DirectoryNotEmpty.into());
        }
        // An overlay without extended attributes says EXDEV or EIO.
        move_files(from, to).map_err(|_| error)
    })
}

/// Moves the files of a folder into another, all or none, and removes the folder.
pub(super) fn move_files(from: &Path, to: &Path) -> io::Result<()> {
    let mut moved = Vec::new();
    let mut move_all = || -> io::Result<()> {
        for entry in fs::read_dir(from)? {
            let name = entry?.file_name();
            rename_to_free(&from.join(&name), &to.join(&name))?;
            moved.push(name);
        }
        fs::remove_dir(from)
    };
    let done = move_all();
    if done.is_err() {
        for name in &moved {
            fs::rename(to.join(name), from.join(name))?;
        }
    }
    done
}

/// Exchanges two folders in one step.
#[cfg(target_os = "linux")]
fn exchange(a: &Path, b: &Path) -> io::Result<()> {
    rename_with(a, b, rustix::fs::RenameFlags::EXCHANGE)
}

#[cfg(not(target_os = "linux"))]
fn exchange(_: &Path, _: &Path) -> io::Result<()> {
    Err(io::ErrorKind::Unsupported.into())
}

#[cfg(target_os = "linux")]
fn rename_with(from: &Path, to: &Path, flags: rustix::fs::RenameFlags) -> io::Result<()> {
    use rustix::fs::{CWD, renameat_with};
    use rustix::io::Errno;
    match renameat_with(CWD, from, CWD, to, flags) {
        // Of a file system that does not know the flag, and of a system that does not know the call.
        Err(Errno::INVAL | Errno::NOSYS) => Err(io::ErrorKind::Unsupported.into()),
        done => Ok(done?),
    }
}
