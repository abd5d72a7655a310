//! Saves a pack: it appears whole or not at all.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use crate::error::{PackError, WriteError};
use crate::limits::MAX_MANIFEST_BYTES;
use crate::manifest::{FieldEntry, MANIFEST_FILE, Manifest};
use crate::pack::Pack;
use crate::place;
use crate::read::in_folder;
use crate::role::Role;
use crate::whole::{Folder, Leftover, others_in, verify_folder};

/// What happens to a pack that is already there.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Overwrite {
    /// It is kept, and saving fails.
    Keep,
    /// It is replaced in one step. A folder that is not a pack, or has anything else in it, is kept all the same.
    Replace,
}

impl Pack {
    /// Saves the pack as a folder, and tells what could not be removed beside it.
    ///
    /// The files are written to a temporary folder beside it, brought to the disk, read back and
    /// compared; then the folder is renamed, or exchanged for the old one. A link to a pack stays, and the pack at its end is replaced.
    /// `cancelled` is asked between steps.
    ///
    /// # Errors
    /// [`PackError::Write`] with every case of [`WriteError`]; nothing is changed then, and the temporary folder is removed.
    pub fn save(
        &self,
        folder: impl AsRef<Path>,
        overwrite: Overwrite,
        cancelled: &dyn Fn() -> bool,
    ) -> Result<Vec<Leftover>, PackError> {
        let folder = folder.as_ref();
        verify_place(folder, overwrite)?;
        let place = place::output(folder)?.path();
        let parent = place.parent().unwrap_or(&place);
        let made = make_folders(parent).map_err(|reason| WriteError::failed(folder, reason))?;
        let written = self.write(folder, overwrite, cancelled);
        if written.is_err() {
            // Deepest first; a folder that someone else has used meanwhile is not empty and stays.
            made.iter()
                .rev()
                .for_each(|folder| drop(fs::remove_dir(folder)));
        }
        Ok(written?)
    }

    fn write(
        &self,
        folder: &Path,
        overwrite: Overwrite,
        cancelled: &dyn Fn() -> bool,
    ) -> Result<Vec<Leftover>, WriteError> {
        let proceed = || {
            if cancelled() {
                Err(WriteError::Cancelled)
            } else {
                Ok(())
            }
        };
        let new = Folder::begin(folder, ours(overwrite))?;
        for (name, bytes) in &self.files {
            proceed()?;
            new.add(name, bytes)?;
        }
        proceed()?;
        new.publish()
    }
}

/// That a pack may be saved at a place: there is none, an empty folder, or, with [`Overwrite::Replace`], a pack and nothing else.
///
/// # Errors
/// [`WriteError::NotAPack`], and those of [`verify_folder`].
pub fn verify_place(folder: &Path, overwrite: Overwrite) -> Result<(), WriteError> {
    let ours = ours(overwrite);
    if ours.is_some() && folder.is_dir() && !others_in(folder, |_| false)?.is_empty() {
        verify_manifest(folder).map_err(|reason| WriteError::NotAPack {
            file: folder.display().to_string(),
            reason,
        })?;
    }
    verify_folder(folder, ours)
}

fn ours(overwrite: Overwrite) -> Option<fn(&str) -> bool> {
    match overwrite {
        Overwrite::Keep => None,
        Overwrite::Replace => Some(is_pack_file),
    }
}

/// Whether a file has a name that packs give.
fn is_pack_file(name: &str) -> bool {
    [MANIFEST_FILE, FieldEntry::FILE].contains(&name) || Role::ALL.iter().any(|r| name == r.file())
}

/// A pack is known by its manifest, that of another version by its kind and version. Damaged textures do not matter here.
fn verify_manifest(folder: &Path) -> Result<(), String> {
    if !folder.join(MANIFEST_FILE).is_file() {
        return Err(format!("it has no {MANIFEST_FILE}"));
    }
    let parsed = in_folder(folder, MANIFEST_FILE, MAX_MANIFEST_BYTES)
        .and_then(|bytes| Manifest::parse(MANIFEST_FILE, &bytes));
    match parsed {
        Ok(_) | Err(PackError::Version { .. }) => Ok(()),
        Err(error) => Err(error.to_string()),
    }
}

/// Makes a folder and those above it; gives the ones that were not there, outermost first.
fn make_folders(folder: &Path) -> io::Result<Vec<PathBuf>> {
    let missing = folder.ancestors().take_while(|f| !f.exists());
    let mut missing: Vec<_> = missing.map(Path::to_path_buf).collect();
    missing.reverse();
    fs::create_dir_all(folder)?;
    Ok(missing)
}
