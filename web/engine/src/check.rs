//! `welkin check` in the page.

use wasm_bindgen::prelude::*;
use welkin_pack::check::check_memory;
use welkin_web_glue::from_map;

/// Checks a pack from a map of file names to `Uint8Array`s: the report as `welkin check --json` prints it.
///
/// # Errors
/// If the manifest cannot be read at all.
#[wasm_bindgen]
pub fn check(place: &str, map: &js_sys::Map) -> Result<String, JsError> {
    Ok(check_memory(place, &from_map(map))?.to_json())
}
