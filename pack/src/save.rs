//! Saves a pack: it appears whole or not at all.

use std::fs;
use std::io::{self, Write};
use std::path::Path;

use crate::manifest::MANIFEST_FILE;
use crate::{Pack, PackError};

/// What happens to a pack that is already there.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Overwrite {
    /// It is kept, and saving fails.
    Keep,
    /// It is replaced in one step. A folder that is not a pack is kept all the same.
    Replace,
}

impl Pack {
    /// Saves the pack as a folder.
    ///
    /// The files are written to a temporary folder beside it, brought to the disk, read back and
    /// compared; then the folder is renamed. On Linux a pack that is replaced is exchanged in one step;
    /// elsewhere there is a moment between two renames. `cancelled` is asked between steps.
    ///
    /// # Errors
    /// [`PackError::Exists`], [`PackError::NotAPack`], [`PackError::Write`], [`PackError::Cancelled`]; nothing is
    /// changed then, and the temporary folder is removed.
    pub fn save(
        &self,
        folder: impl AsRef<Path>,
        overwrite: Overwrite,
        cancelled: &dyn Fn() -> bool,
    ) -> Result<(), PackError> {
        let folder = folder.as_ref();
        let name = folder.display().to_string();
        let failed = |source: io::Error| PackError::Write {
            file: name.clone(),
            source,
        };
        verify_place(folder, overwrite)?;
        let parent = match folder.parent() {
            Some(parent) if parent != Path::new("") => parent,
            _ => Path::new("."),
        };
        let made = make_folders(parent).map_err(failed)?;
        let written = self.write_beside(parent, cancelled).and_then(|temporary| {
            put_in_place(temporary.path(), folder, overwrite).map_err(failed)
        });
        if written.is_err() {
            // Deepest first; a folder that someone else has used meanwhile is not empty and stays.
            made.iter()
                .rev()
                .for_each(|folder| drop(fs::remove_dir(folder)));
        }
        written
    }

    fn write_beside(
        &self,
        parent: &Path,
        cancelled: &dyn Fn() -> bool,
    ) -> Result<tempfile::TempDir, PackError> {
        let failed = |path: &Path, source| PackError::Write {
            file: path.display().to_string(),
            source,
        };
        let temporary = temporary_folder(parent).map_err(|e| failed(parent, e))?;
        for (name, bytes) in &self.files {
            if cancelled() {
                return Err(PackError::Cancelled);
            }
            let path = temporary.path().join(name);
            write_file(&path, bytes).map_err(|e| failed(&path, e))?;
        }
        let read_back = Pack::open(temporary.path())?;
        if read_back != *self {
            let path = temporary.path().display().to_string();
            return Err(PackError::value(
                &path,
                "files",
                "other bytes",
                "the bytes that were written",
            ));
        }
        if cancelled() {
            return Err(PackError::Cancelled);
        }
        Ok(temporary)
    }
}

fn verify_place(folder: &Path, overwrite: Overwrite) -> Result<(), PackError> {
    let file = folder.display().to_string();
    let Ok(metadata) = fs::symlink_metadata(folder) else {
        return Ok(());
    };
    if metadata.is_dir() && fs::read_dir(folder).is_ok_and(|mut entries| entries.next().is_none()) {
        return Ok(());
    }
    match overwrite {
        Overwrite::Keep => Err(PackError::Exists { file }),
        Overwrite::Replace if metadata.is_dir() && folder.join(MANIFEST_FILE).is_file() => Ok(()),
        Overwrite::Replace => Err(PackError::NotAPack { file }),
    }
}

/// Makes a folder and those above it; gives the ones that were not there, outermost first.
fn make_folders(folder: &Path) -> io::Result<Vec<std::path::PathBuf>> {
    let mut missing: Vec<_> = folder
        .ancestors()
        .take_while(|f| *f != Path::new("") && !f.exists())
        .map(Path::to_path_buf)
        .collect();
    missing.reverse();
    fs::create_dir_all(folder)?;
    Ok(missing)
}

fn write_file(path: &Path, bytes: &[u8]) -> io::Result<()> {
    let mut file = fs::File::create_new(path)?;
    file.write_all(bytes)?;
    file.sync_all()
}

/// A temporary folder beside the pack's place. It is as open as any new folder, since it becomes the pack.
fn temporary_folder(parent: &Path) -> io::Result<tempfile::TempDir> {
    let mut builder = tempfile::Builder::new();
    builder.prefix(".welkin-");
    #[cfg(unix)]
    {
        use std::os::unix::fs::PermissionsExt;
        // The system takes away what the user's mask says.
        builder.permissions(fs::Permissions::from_mode(0o777));
    }
    builder.tempdir_in(parent)
}

#[cfg(target_os = "linux")]
fn put_in_place(temporary: &Path, folder: &Path, overwrite: Overwrite) -> io::Result<()> {
    use rustix::fs::{CWD, RenameFlags, renameat_with};
    if overwrite == Overwrite::Replace && folder.join(MANIFEST_FILE).is_file() {
        // The old pack is now the temporary folder, and goes away with it.
        let swapped = renameat_with(CWD, temporary, CWD, folder, RenameFlags::EXCHANGE);
        return match swapped {
            Err(rustix::io::Errno::INVAL | rustix::io::Errno::NOSYS) => {
                swap_in_two_steps(temporary, folder)
            }
            other => Ok(other?),
        };
    }
    // Renaming onto an empty folder replaces it, and onto any other fails.
    fs::rename(temporary, folder)
}

#[cfg(not(target_os = "linux"))]
fn put_in_place(temporary: &Path, folder: &Path, overwrite: Overwrite) -> io::Result<()> {
    if overwrite == Overwrite::Replace && folder.exists() {
        return swap_in_two_steps(temporary, folder);
    }
    if folder.exists() {
        fs::remove_dir(folder)?;
    }
    fs::rename(temporary, folder)
}

fn swap_in_two_steps(temporary: &Path, folder: &Path) -> io::Result<()> {
    let old = temporary.with_extension("old");
    fs::rename(folder, &old)?;
    if let Err(error) = fs::rename(temporary, folder) {
        fs::rename(&old, folder)?;
        return Err(error);
    }
    fs::remove_dir_all(&old)
}
