//! The files that `welkin check` reads beside a pack, and the place of its page.

use std::collections::BTreeMap;
use std::fs::{self, File};
use std::io::Read;
use std::path::{Path, PathBuf};

use anyhow::{Result, anyhow, bail};

use welkin_pack::place;

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
    let entries = fs::read_dir(&args.path).into_iter().flatten().flatten();
    let of_pack: Vec<PathBuf> = entries.map(|entry| entry.path()).collect();
    let read = named(args).map(|(_, file)| file);
    let read = read.chain([args.path.as_path()]);
    let read: Vec<&Path> = read.chain(of_pack.iter().map(PathBuf::as_path)).collect();
    Ok(place::verify_apart(&read, &[html])?)
}
