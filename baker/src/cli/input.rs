//! What commands read: a pack, a recipe, a picture. Ctrl-C ends them even while a pipe gives nothing.

use std::fs::File;
use std::io::Read;
use std::path::Path;

use anyhow::{Result, anyhow, bail};
use welkin_baker::{MAX_FILE_BYTES, Recipe};
use welkin_pack::Pack;

use super::interrupt;

/// A recipe has some dozens of lines; what is larger is something else.
const MAX_RECIPE_BYTES: u64 = 1 << 20;

pub fn pack(folder: &Path) -> Result<Pack> {
    let folder = folder.to_path_buf();
    Ok(interrupt::unless_requested(move || Pack::open(folder))??)
}

pub fn recipe(path: &Path) -> Result<Recipe> {
    let path = path.to_path_buf();
    interrupt::unless_requested(move || read_recipe(&path))?
}

fn read_recipe(path: &Path) -> Result<Recipe> {
    let name = path.display().to_string();
    let expected = "expected a recipe in TOML";
    let bytes = read(path, MAX_RECIPE_BYTES, expected)?;
    let text = String::from_utf8(bytes)
        .map_err(|_| anyhow!("{name}: cannot be read: it is not UTF-8; {expected}"))?;
    Ok(Recipe::parse(&name, &text)?)
}

/// The bytes of a file that is no larger than what a bake reads.
pub fn bytes(path: &Path) -> Result<Vec<u8>> {
    let path = path.to_path_buf();
    interrupt::unless_requested(move || read(&path, MAX_FILE_BYTES, "check its name and size"))?
}

fn read(path: &Path, most: u64, advice: &str) -> Result<Vec<u8>> {
    let name = path.display();
    let unreadable = |e| anyhow!("{name}: cannot be read: {e}; {advice}");
    let mut bytes = Vec::new();
    let file = File::open(path).map_err(unreadable)?;
    file.take(most + 1)
        .read_to_end(&mut bytes)
        .map_err(unreadable)?;
    if bytes.len() as u64 > most {
        bail!("{name}: is larger than {most} bytes; {advice}");
    }
    Ok(bytes)
}
