//! Folders of files that appear whole or not at all: made beside their place and renamed into it.

use std::fs;
use std::io::{self, Write};
use std::path::Path;

use tempfile::TempDir;

use super::SaveError;

/// What the names of files and folders in the making begin with. A run that is killed may leave one.
pub const TEMPORARY: &str = ".welkin-";

/// Saves files as a folder. What `is_ours` knows by its name may be replaced: a folder with anything else in it stays as it is. The old
/// folder goes aside before the new one takes its place, and comes back if that fails.
///
/// # Errors
/// [`SaveError::NotAFolder`], [`SaveError::NotOurs`], [`SaveError::Write`]; nothing is changed then.
pub fn save_folder(
    place: &Path,
    files: &[(String, Vec<u8>)],
    is_ours: impl Fn(&str) -> bool,
) -> Result<(), SaveError> {
    let is_there = verify_folder(place, is_ours)?;
    let write = || -> io::Result<()> {
        let new = fill(place, files)?;
        if is_there {
            let old = temporary_name(0o777).tempdir_in(parent_of(place))?;
            let aside = old.path().join("old");
            fs::rename(place, &aside)?;
            if let Err(error) = fs::rename(new.path(), place) {
                fs::rename(&aside, place)?;
                return Err(error);
            }
        } else {
            fs::rename(new.path(), place)?;
        }
        // Its name is free now, and not ours to remove.
        let _ = new.keep();
        Ok(())
    };
    write().map_err(|source| cannot_write(place, source))
}

/// Whether a folder is there already; an error if something is that must not be replaced. Files in the making are no obstacle.
///
/// # Errors
/// [`SaveError::NotAFolder`], [`SaveError::NotOurs`], [`SaveError::Write`].
pub fn verify_folder(place: &Path, is_ours: impl Fn(&str) -> bool) -> Result<bool, SaveError> {
    let file = || place.display().to_string();
    match fs::symlink_metadata(place) {
        Err(_) => return Ok(false),
        Ok(metadata) if !metadata.is_dir() => return Err(SaveError::NotAFolder { file: file() }),
        Ok(_) => {}
    }
    let entries = fs::read_dir(place).map_err(|source| cannot_write(place, source))?;
    for entry in entries {
        let entry = entry.map_err(|source| cannot_write(place, source))?;
        let name = entry.file_name().to_string_lossy().into_owned();
        // A file in the making may be gone by the time it is looked at.
        let ours = name.starts_with(TEMPORARY) || is_ours(&name) && entry.path().is_file();
        if !ours {
            return Err(SaveError::NotOurs {
                file: file(),
                found: name,
            });
        }
    }
    Ok(true)
}

/// A folder beside `place` with these files, brought to the disk.
fn fill(place: &Path, files: &[(String, Vec<u8>)]) -> io::Result<TempDir> {
    let folder = temporary_name(0o777).tempdir_in(parent_of(place))?;
    for (name, bytes) in files {
        let mut file = fs::File::create_new(folder.path().join(name))?;
        file.write_all(bytes)?;
        file.sync_all()?;
    }
    Ok(folder)
}

fn cannot_write(place: &Path, source: io::Error) -> SaveError {
    SaveError::Write {
        file: place.display().to_string(),
        source,
    }
}

/// Names of files or folders in the making.
pub(super) fn temporary_name(mode: u32) -> tempfile::Builder<'static, 'static> {
    let mut builder = tempfile::Builder::new();
    builder.prefix(TEMPORARY);
    // As open as the umask allows: temporary files are private unless told otherwise.
    #[cfg(unix)]
    builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(mode));
    #[cfg(not(unix))]
    let _ = mode;
    builder
}

pub(super) fn parent_of(path: &Path) -> &Path {
    path.parent()
        .filter(|p| !p.as_os_str().is_empty())
        .unwrap_or(Path::new("."))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn files(text: &str) -> Vec<(String, Vec<u8>)> {
        ["a", "b"]
            .map(|name| (name.to_string(), text.into()))
            .into()
    }

    fn is_ours(name: &str) -> bool {
        name == "a" || name == "b" || name == "c"
    }

    fn names(folder: &Path) -> Vec<String> {
        let entries = fs::read_dir(folder).unwrap();
        let mut names: Vec<_> = entries
            .map(|e| e.unwrap().file_name().to_string_lossy().into_owned())
            .collect();
        names.sort();
        names
    }

    #[test]
    fn a_folder_is_made_and_one_of_ours_is_replaced_whole() {
        let parent = tempfile::tempdir().unwrap();
        let place = parent.path().join("sky");
        save_folder(&place, &files("old"), is_ours).unwrap();
        fs::write(place.join("c"), "older").unwrap();
        save_folder(&place, &files("new"), is_ours).unwrap();
        assert_eq!(names(&place), ["a", "b"]);
        assert_eq!(fs::read(place.join("a")).unwrap(), b"new");
        assert_eq!(names(parent.path()), ["sky"]);
    }

    #[test]
    fn an_empty_folder_is_filled() {
        let parent = tempfile::tempdir().unwrap();
        let place = parent.path().join("sky");
        fs::create_dir(&place).unwrap();
        save_folder(&place, &files("new"), is_ours).unwrap();
        assert_eq!(names(&place), ["a", "b"]);
    }

    #[test]
    fn what_is_not_ours_stays() {
        let parent = tempfile::tempdir().unwrap();
        let place = parent.path().join("sky");
        fs::create_dir(&place).unwrap();
        fs::write(place.join("letter"), "dear").unwrap();
        let error = save_folder(&place, &files("new"), is_ours).unwrap_err();
        assert!(
            error
                .to_string()
                .contains("letter in it is none of the files"),
            "{error}"
        );
        assert_eq!(names(&place), ["letter"]);
        fs::remove_file(place.join("letter")).unwrap();
        // A folder of a name of ours is none of our files.
        fs::create_dir(place.join("a")).unwrap();
        assert!(matches!(
            save_folder(&place, &files("new"), is_ours),
            Err(SaveError::NotOurs { .. })
        ));
        let file = parent.path().join("file");
        fs::write(&file, "old").unwrap();
        assert!(matches!(
            save_folder(&file, &files("new"), is_ours),
            Err(SaveError::NotAFolder { .. })
        ));
        assert_eq!(fs::read(&file).unwrap(), b"old");
        assert!(save_folder(&parent.path().join("none/sky"), &files("new"), is_ours).is_err());
        assert_eq!(names(parent.path()), ["file", "sky"]);
    }
}
