//! Files and folders that appear whole or not at all: made under a temporary name beside their place,
//! then renamed into it. Until then an older one stays as it is; a failure removes what was begun.

use std::fs;
use std::io::{self, Write};
use std::path::{Path, PathBuf};

use anyhow::{Result, anyhow, bail};
use tempfile::TempDir;

use super::interrupt;

/// Writes a file in one step; a file of that name is replaced, a device or a folder is not.
pub fn write_file(path: &Path, bytes: &[u8]) -> Result<()> {
    if path.exists() && !path.is_file() {
        bail!(
            "{}: is there and is not a file; choose another name",
            path.display()
        );
    }
    let write = || -> io::Result<tempfile::NamedTempFile> {
        let mut file = temporary_name(0o666).tempfile_in(parent_of(path))?;
        file.write_all(bytes)?;
        file.as_file().sync_all()?;
        Ok(file)
    };
    let file = write().map_err(|e| cannot_write(path, &e))?;
    interrupt::stop_if_requested()?;
    file.persist(path)
        .map_err(|e| cannot_write(path, &e.error))?;
    Ok(())
}

/// A folder in the making. Dropped before [`Folder::publish`], it leaves nothing.
#[derive(Debug)]
pub struct Folder {
    place: PathBuf,
    temporary: TempDir,
}

impl Folder {
    /// Begins a folder that will be at `place`, where there must be nothing yet; or, if it shall be
    /// replaced, nothing but files that `may_go` knows as our own.
    pub fn begin(place: &Path, replace: bool, may_go: fn(&Path) -> bool) -> Result<Folder> {
        if fs::symlink_metadata(place).is_ok() {
            verify_replaceable(place, replace, may_go)?;
        }
        let temporary = temporary_name(0o777).tempdir_in(parent_of(place));
        let temporary = temporary.map_err(|e| cannot_write(place, &e))?;
        Ok(Folder {
            place: place.to_path_buf(),
            temporary,
        })
    }

    /// Adds a file.
    pub fn add(&self, name: &str, bytes: &[u8]) -> Result<()> {
        interrupt::stop_if_requested()?;
        fs::write(self.temporary.path().join(name), bytes)
            .map_err(|e| cannot_write(&self.place.join(name), &e))
    }

    /// Puts the folder in its place.
    pub fn publish(self) -> Result<()> {
        let failed = |e: io::Error| cannot_write(&self.place, &e);
        if self.place.exists() {
            let old = temporary_name(0o777)
                .tempdir_in(parent_of(&self.place))
                .map_err(failed)?;
            let aside = old.path().join("old");
            fs::rename(&self.place, &aside).map_err(failed)?;
            if let Err(error) = fs::rename(self.temporary.path(), &self.place) {
                fs::rename(&aside, &self.place).map_err(failed)?;
                return Err(failed(error));
            }
        } else {
            fs::rename(self.temporary.path(), &self.place).map_err(failed)?;
        }
        // Its name is free now, and not ours to remove.
        let _ = self.temporary.keep();
        Ok(())
    }
}

fn verify_replaceable(place: &Path, replace: bool, may_go: fn(&Path) -> bool) -> Result<()> {
    let shown = place.display();
    if !replace {
        bail!("{shown}: already exists; choose another folder, or move it away");
    }
    let entries = fs::read_dir(place)
        .map_err(|e| anyhow!("{shown}: is not replaced: {e}; choose another folder"))?;
    for entry in entries {
        let path = entry.map_err(|e| cannot_write(place, &e))?.path();
        if !may_go(&path) {
            bail!(
                "{shown}: is not replaced, since {} is none of the files that would be written; \
                 choose another folder, or move it away",
                path.display()
            );
        }
    }
    Ok(())
}

fn temporary_name(mode: u32) -> tempfile::Builder<'static, 'static> {
    let mut builder = tempfile::Builder::new();
    builder.prefix(".welkin-");
    // As open as the umask allows: temporary files are private unless told otherwise.
    #[cfg(unix)]
    builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(mode));
    #[cfg(not(unix))]
    let _ = mode;
    builder
}

fn parent_of(path: &Path) -> &Path {
    path.parent()
        .filter(|p| !p.as_os_str().is_empty())
        .unwrap_or(Path::new("."))
}

fn cannot_write(path: &Path, error: &io::Error) -> anyhow::Error {
    let advice = match error.kind() {
        io::ErrorKind::NotFound => "make the folder above it first",
        io::ErrorKind::StorageFull | io::ErrorKind::FileTooLarge | io::ErrorKind::QuotaExceeded => {
            "make room there"
        }
        _ => "choose another place",
    };
    anyhow!("{}: cannot be written: {error}; {advice}", path.display())
}
