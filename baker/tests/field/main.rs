//! Fields of clouds: every kind, the cover that ranks promise, recipes that are refused.

#![allow(clippy::unwrap_used, reason = "a test may stop where it fails")]

mod cover;
mod kinds;
mod recipe;

use std::path::Path;

use welkin_baker::{BakeError, FieldSettings, Recipe, RecipeError, Resolved, cloud_field};
use welkin_pack::Field;

/// The folder of the recipes of fields.
fn folder() -> &'static Path {
    Path::new(concat!(
        env!("CARGO_MANIFEST_DIR"),
        "/../assets-src/recipes/fields"
    ))
}

fn resolve(text: &str) -> Result<Resolved, RecipeError> {
    Recipe::parse("sky.toml", text)?.resolve(None)
}

fn settings(text: &str) -> FieldSettings {
    resolve(text).unwrap().field.unwrap()
}

fn try_field(text: &str) -> Result<Field, BakeError> {
    let resolved = resolve(text).unwrap();
    cloud_field(&settings(text), Some(folder()), resolved.seed)
}

fn field(text: &str) -> Field {
    try_field(text).unwrap()
}

/// The field of a recipe in [`folder`].
fn recipe_field(name: &str) -> Field {
    field(&std::fs::read_to_string(folder().join(name)).unwrap())
}
