//! Puts a file of a picture in its place, where nothing of anyone else's is lost.

use std::fs;
use std::path::Path;

use anyhow::{Result, bail};
use welkin_pack::whole::write_file;

use super::line::{Made, hash};

/// Writes a file into the folder. One that is there stays if it has these bytes already, and is replaced only if it may be.
///
/// # Errors
/// That another is there; the system's reason.
pub fn put(folder: &Path, file: String, bytes: &[u8], may_replace: bool) -> Result<Made> {
    let place = folder.join(&file);
    let found = fs::read(&place);
    let is_there = found.as_ref().is_ok_and(|found| found == bytes);
    if !is_there {
        if found.is_ok() && !may_replace {
            bail!(
                "{}: is there, and is not what this job makes; choose another name or folder, or add --force to replace it",
                place.display()
            );
        }
        write_file(&place, bytes, &|| false)?;
    }
    Ok(Made {
        blake3: hash(bytes),
        file,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_what_may_go_is_replaced() {
        let folder = tempfile::tempdir().unwrap();
        let place = folder.path().join("a.png");
        let write = |bytes: &[u8], force| put(folder.path(), "a.png".to_string(), bytes, force);
        write(b"one", false).unwrap();
        let made = write(b"one", false).unwrap();
        assert_eq!(made.blake3, hash(b"one"));
        let error = write(b"two", false).unwrap_err().to_string();
        assert!(
            error.contains("a.png") && error.contains("--force"),
            "{error}"
        );
        assert_eq!(fs::read(&place).unwrap(), b"one");
        write(b"two", true).unwrap();
        assert_eq!(fs::read(&place).unwrap(), b"two");
        fs::remove_file(&place).unwrap();
        fs::create_dir(&place).unwrap();
        assert!(write(b"two", true).is_err());
        assert_eq!(folder.path().read_dir().unwrap().count(), 1);
    }
}
