//! What commands read: a pack, a recipe. Ctrl-C ends them even while a pipe gives nothing.

use std::fs::File;
use std::io::Read;
use std::path::Path;

use anyhow::{Result, anyhow, bail};
use welkin_baker::Recipe;
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
    let unreadable = |e| anyhow!("{name}: cannot be read: {e}; expected a recipe in TOML");
    let mut text = String::new();
    let file = File::open(path).map_err(unreadable)?;
    file.take(MAX_RECIPE_BYTES + 1)
        .read_to_string(&mut text)
        .map_err(unreadable)?;
    if text.len() as u64 > MAX_RECIPE_BYTES {
        bail!("{name}: is larger than {MAX_RECIPE_BYTES} bytes, expected a recipe in TOML");
    }
    Ok(Recipe::parse(&name, &text)?)
}
