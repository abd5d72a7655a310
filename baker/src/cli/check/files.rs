//! The files that `welkin check` reads beside a pack, and the place of its page.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

use anyhow::{Result, bail};

use welkin_pack::place;

use super::args::CheckArgs;
use crate::cli::input;

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
        if given.insert(key.to_string(), input::bytes(file)?).is_some() {
            bail!(
                "{}: a file for `{key}` was given already; give one",
                file.display()
            );
        }
    }
    Ok(given)
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
