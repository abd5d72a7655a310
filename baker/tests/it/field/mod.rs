//! Fields of clouds: every kind, the cover that ranks promise, recipes that are refused.

#![allow(clippy::unwrap_used, reason = "a test may stop where it fails")]

mod cover;
mod edited;
mod kinds;
mod recipe;

use std::path::Path;

use welkin_baker::{BakeError, FieldSettings, Recipe, RecipeError, Resolved, cloud_field};
use welkin_pack::check::{Outcome, check};
use welkin_pack::{Field, Pack, PackInfo};

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

/// What the rules about fields have against one.
fn problems(field: &Field) -> Vec<String> {
    let info = PackInfo {
        name: "field".to_string(),
        seed: 1,
        baker: "test".to_string(),
        recipe: String::new(),
        inputs: Vec::new(),
        noon_elevation_rad: 1.0,
        aerosol_depths: [0.04, 0.24],
        ..PackInfo::default()
    };
    let pack = Pack::build(info, Vec::new()).unwrap();
    let pack = pack.with_field(field.clone()).unwrap();
    assert_eq!(
        pack.field(),
        Some(field),
        "what is baked is on the grid of what is stored"
    );
    let folder = tempfile::tempdir().unwrap();
    for (name, bytes) in pack.files() {
        std::fs::write(folder.path().join(name), bytes).unwrap();
    }
    let report = check(folder.path()).unwrap();
    let of_field = report
        .findings
        .iter()
        .filter(|f| f.rule.starts_with("field-"));
    assert!(of_field.clone().count() >= 10);
    let problems = of_field.filter(|f| f.outcome != Outcome::Passed);
    problems.map(ToString::to_string).collect()
}
