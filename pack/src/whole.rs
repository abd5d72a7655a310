//! Files and folders that appear whole or not at all: made under a temporary name beside their place, brought to the disk, read back,
//! then put there in one step. Until then an older one stays as it is; a failure removes what was begun.

mod put;
mod temporary;
#[cfg(test)]
mod tests;

use std::fs;
use std::io::{self, Write};
use std::path::{Path, PathBuf};

use crate::error::WriteError;
use crate::place::{Place, output};
use temporary::Temporary;

pub use put::{IsOurs, is_litter};
pub use temporary::{Leftover, TEMPORARY, sweep};

/// Writes a file. A file of that name is replaced, at the end of a link too; a device or a folder is not. `cancelled` is asked before the
/// last step.
///
/// # Errors
/// [`WriteError::NotAFile`], [`WriteError::Failed`], [`WriteError::Cancelled`]; nothing is changed then.
pub fn write_file(
    path: &Path,
    bytes: &[u8],
    cancelled: &dyn Fn() -> bool,
) -> Result<(), WriteError> {
    write_files(&[(path, bytes)], cancelled)
}

/// Writes files that belong together, as [`write_file`] does each: all are complete before the first is put in its place.
///
/// # Errors
/// Those of [`write_file`]. Nothing is changed then, unless the system refuses to rename another than the first.
pub fn write_files(
    files: &[(&Path, &[u8])],
    cancelled: &dyn Fn() -> bool,
) -> Result<(), WriteError> {
    let mut made = Vec::with_capacity(files.len());
    for &(path, bytes) in files {
        if fs::metadata(path).is_ok_and(|metadata| !metadata.is_file()) {
            let file = path.display().to_string();
            return Err(WriteError::NotAFile { file });
        }
        let place = output(path)?.path();
        let failed = |reason| WriteError::failed(path, reason);
        let temporary = Temporary::beside(&place).map_err(failed)?;
        fill(temporary.new_path(), bytes).map_err(failed)?;
        made.push((path, place, temporary));
    }
    if cancelled() {
        return Err(WriteError::Cancelled);
    }
    made.iter().try_for_each(|(path, place, temporary)| {
        fs::rename(temporary.new_path(), place).map_err(|reason| WriteError::failed(path, reason))
    })
}

/// A folder in the making. Dropped before [`Folder::publish`], it leaves nothing.
#[derive(Debug)]
pub struct Folder {
    /// As the user named it, for errors.
    shown: PathBuf,
    place: PathBuf,
    temporary: Temporary,
    ours: Option<IsOurs>,
    leftovers: Vec<Leftover>,
}

impl Folder {
    /// Begins a folder that will be at `path`, where there is none yet or an empty one; or, with `ours`, a folder of files of these
    /// names. The folder above must be there; what runs that were killed have left in it is removed.
    ///
    /// # Errors
    /// Those of [`verify_folder`]; [`WriteError::Failed`].
    pub fn begin(path: &Path, ours: Option<IsOurs>) -> Result<Folder, WriteError> {
        verify_folder(path, ours)?;
        let failed = |reason| WriteError::failed(path, reason);
        let place = output(path)?.path();
        let temporary = Temporary::beside(&place).map_err(failed)?;
        fs::create_dir(temporary.new_path()).map_err(failed)?;
        Ok(Folder {
            shown: path.to_path_buf(),
            leftovers: sweep_beside(path),
            place,
            temporary,
            ours,
        })
    }

    /// Adds a file, and reads it back.
    ///
    /// # Errors
    /// [`WriteError::Failed`].
    pub fn add(&self, name: &str, bytes: &[u8]) -> Result<(), WriteError> {
        fill(&self.temporary.new_path().join(name), bytes)
            .map_err(|reason| WriteError::failed(&self.shown.join(name), reason))
    }

    /// Puts the folder in its place, and tells what could not be removed afterwards.
    ///
    /// # Errors
    /// Those of [`verify_folder`], if something has come there meanwhile; [`WriteError::Failed`].
    pub fn publish(mut self) -> Result<Vec<Leftover>, WriteError> {
        put::put(&self.temporary, &self.place, &self.shown, self.ours)?;
        self.leftovers.extend(self.temporary.remove().err());
        Ok(self.leftovers)
    }
}

/// That a folder may be written at a place: there is none, an empty one, or, with `ours`, one of files of these names. What systems put
/// into folders by themselves does not count: [`is_litter`].
///
/// # Errors
/// [`WriteError::NotAFolder`], [`WriteError::Exists`], [`WriteError::NotOurs`], [`WriteError::InUse`], [`WriteError::Failed`].
pub fn verify_folder(path: &Path, ours: Option<IsOurs>) -> Result<(), WriteError> {
    let place = output(path)?;
    // Whoever stands in a folder that is replaced stands nowhere.
    let here = std::env::current_dir().and_then(|here| Place::of(&here));
    if place.is_there() && here.is_ok_and(|here| here.is_within(&place)) {
        let file = path.display().to_string();
        return Err(WriteError::InUse { file });
    }
    put::look(&place.path(), path, ours).map(|_| ())
}

/// Names of what is in a folder and is neither a file of ours nor litter, in their order.
///
/// # Errors
/// [`WriteError::NotAFolder`], [`WriteError::Failed`].
pub fn others_in(folder: &Path, ours: IsOurs) -> Result<Vec<String>, WriteError> {
    if !folder.is_dir() {
        let file = folder.display().to_string();
        return Err(WriteError::NotAFolder { file });
    }
    put::others(folder, ours).map_err(|reason| WriteError::failed(folder, reason))
}

/// Removes what runs that were killed have left beside a place, as [`sweep`] does.
pub fn sweep_beside(path: &Path) -> Vec<Leftover> {
    let place = Place::of(path).map(|place| place.path());
    let parent = place.as_deref().ok().and_then(Path::parent);
    parent.map(sweep).unwrap_or_default()
}

/// Writes a new file, brings it to the disk and reads it back.
fn fill(path: &Path, bytes: &[u8]) -> io::Result<()> {
    let mut file = fs::File::create_new(path)?;
    file.write_all(bytes)?;
    file.sync_all()?;
    if fs::read(path)? != bytes {
        return Err(io::Error::other("other bytes are read than were written"));
    }
    Ok(())
}
