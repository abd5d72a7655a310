//! The baker in a browser's worker: what `web/js/baker-worker.js` asks of WebAssembly. Elsewhere this library is empty.
#![cfg(target_arch = "wasm32")]

mod progress;

use wasm_bindgen::prelude::*;
use welkin_baker::{Inputs, Recipe, bake_from};
use welkin_pack::Pack;
use welkin_web_glue::from_map;

/// The built-in recipe, in TOML.
#[wasm_bindgen(js_name = defaultRecipe)]
pub fn default_recipe() -> String {
    welkin_baker::DEFAULT_RECIPE.to_string()
}

/// The name of the built-in photograph among the inputs: a recipe that names none wants it there.
#[wasm_bindgen(js_name = builtInPhoto)]
pub fn built_in_photo() -> String {
    welkin_baker::BUILT_IN_PHOTO.to_string()
}

/// Bakes a recipe, in TOML, with its seed or another: a map of the pack's file names to `Uint8Array`s, byte for byte those
/// that the program `welkin` writes.
///
/// `inputs` is a map of the files that the recipe names, by those names. `progress(step, done, total, notice)` is called before each step; and
/// with a text for `notice` where the bake has something to tell of the step.
///
/// # Errors
/// Those of the recipe and of the bake.
#[wasm_bindgen]
pub fn bake(
    recipe: &str,
    seed: Option<u64>,
    inputs: &js_sys::Map,
    progress: js_sys::Function,
) -> Result<js_sys::Map, JsError> {
    let resolved = Recipe::parse("recipe", recipe)?.resolve(seed)?;
    let inputs = from_map(inputs);
    let told = progress::told_to(progress);
    let pack = bake_from(&resolved, Inputs::Memory(&inputs), &told);
    Ok(to_map(&pack?))
}

fn to_map(pack: &Pack) -> js_sys::Map {
    let map = js_sys::Map::new();
    for (name, bytes) in pack.files() {
        map.set(&name.into(), &js_sys::Uint8Array::from(bytes.as_slice()));
    }
    map
}
