//! The files that `welkin check` reads beside a pack, and the place of its page.

use std::collections::BTreeMap;
use std::fs::{self, File};
use std::io::Read;
use std::path::{Path, PathBuf};

use anyhow::{Result, anyhow, bail};

use crate::cli::CheckArgs;

/// The largest file that is read: what a bake reads too.
const MAX_BYTES: u64 = 256 << 20;

/// The key of a recipe that `--photo` stands for.
const PHOTO_KEY: &str = "clouds.photo.file";

/// Keys and files of `--photo` and `--input`.
fn named(args: &CheckArgs) -> impl Iterator<Item = (&str, &Path)> {
    let photo = args.photo.iter().map(|file| (PHOTO_KEY, file.as_path()));
    let inputs = args.input.iter();
    photo.chain(inputs.map(|(key, file)| (key.as_str(), Path::new(file))))
}

/// The bytes of the files of `--photo` and `--input`, by their keys.
pub fn given(args: &CheckArgs) -> Result<BTreeMap<String, Vec<u8>>> {
    let mut given = BTreeMap::new();
    for (key, file) in named(args) {
        if given.insert(key.to_string(), read(file)?).is_some() {
            bail!(
                "{}: a file for `{key}` was given already; give one",
                file.display()
            );
        }
    }
    Ok(given)
}

/// Reads a file of at most 256 MiB.
pub fn read(path: &Path) -> Result<Vec<u8>> {
    let shown = path.display();
    let failed = |e| anyhow!("{shown}: cannot be read: {e}; check its name");
    let mut bytes = Vec::new();
    let file = File::open(path).map_err(failed)?;
    file.take(MAX_BYTES + 1)
        .read_to_end(&mut bytes)
        .map_err(failed)?;
    if bytes.len() as u64 > MAX_BYTES {
        bail!("{shown}: is over 256 MiB, expected at most 256 MiB; save it smaller");
    }
    Ok(bytes)
}

/// The page is written over nothing that is read, by whatever path, and not into a pack.
pub fn verify_apart(html: &Path, args: &CheckArgs) -> Result<()> {
    let shown = html.display();
    let real = fs::canonicalize(html).ok();
    let place = real.clone().or_else(|| to_be(html));
    if let Some(pack) = fs::canonicalize(&args.path).ok().filter(|p| p.is_dir()) {
        let is_inside = |path: &PathBuf| path.starts_with(&pack);
        if place.iter().chain(to_be(html).iter()).any(is_inside) {
            bail!("{shown}: is inside the pack that is checked; choose a place outside of it");
        }
        let entries = fs::read_dir(&pack).into_iter().flatten().flatten();
        let mut files = entries.map(|entry| entry.path());
        if let Some(file) = files.find(|file| is_same(html, file)) {
            bail!(
                "{shown}: is a link to {}; choose another name",
                file.display()
            );
        }
    }
    let read = named(args)
        .map(|(_, file)| file)
        .chain([args.path.as_path()]);
    for file in read.filter(|file| file.is_file()) {
        if is_same(html, file) {
            bail!(
                "{shown}: is {}, which is read; choose another name",
                file.display()
            );
        }
    }
    Ok(())
}

/// Where a file that is not there yet will be.
fn to_be(path: &Path) -> Option<PathBuf> {
    let parent = path.parent().filter(|p| !p.as_os_str().is_empty());
    let parent = fs::canonicalize(parent.unwrap_or(Path::new("."))).ok()?;
    Some(parent.join(path.file_name()?))
}

/// Whether two paths lead to one file, by links too.
fn is_same(a: &Path, b: &Path) -> bool {
    let real = |path: &Path| fs::canonicalize(path).ok();
    let same_path = real(a).is_some() && real(a) == real(b);
    same_path || is_same_inode(a, b)
}

#[cfg(unix)]
fn is_same_inode(a: &Path, b: &Path) -> bool {
    use std::os::unix::fs::MetadataExt;
    let inode = |path: &Path| fs::metadata(path).ok().map(|m| (m.dev(), m.ino()));
    inode(a).is_some() && inode(a) == inode(b)
}

#[cfg(not(unix))]
fn is_same_inode(_: &Path, _: &Path) -> bool {
    false
}
