//! Files that the page fetched or was given.

use std::collections::BTreeMap;

use wasm_bindgen::JsCast;
use wasm_bindgen::prelude::*;

/// The entries of a JavaScript map from names to `Uint8Array`s; others are left out.
pub fn from_map(map: &js_sys::Map) -> BTreeMap<String, Vec<u8>> {
    let mut files = BTreeMap::new();
    map.for_each(&mut |bytes: JsValue, name: JsValue| {
        if let (Some(name), Some(bytes)) = (name.as_string(), bytes.dyn_ref::<js_sys::Uint8Array>())
        {
            files.insert(name, bytes.to_vec());
        }
    });
    files
}
