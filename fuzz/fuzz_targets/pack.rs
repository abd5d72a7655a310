//! A pack of one texture, or of a field: the manifest's length, the manifest, and the file that its first entry names.
//!
//! Hashes and seal are made to fit, or nothing behind them would ever be reached.
#![no_main]

use std::collections::BTreeMap;

use serde_json::{Value, json};
use welkin_pack::check::check_memory;
use welkin_pack::manifest::MANIFEST_FILE;
use welkin_pack::{Manifest, Pack, ktx};

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| {
    let Some((length, rest)) = bytes.split_first_chunk() else {
        return;
    };
    let Some((manifest, file)) = rest.split_at_checked(u32::from_le_bytes(*length) as usize) else {
        return;
    };
    let Ok(manifest) = serde_json::from_slice::<Value>(manifest) else {
        return;
    };
    let Some((name, manifest)) = fit(manifest, file) else {
        return;
    };
    let files = BTreeMap::from([(name, file.to_vec()), (MANIFEST_FILE.to_string(), manifest)]);
    drop(Pack::from_memory("fuzz", &files));
    drop(check_memory("fuzz", &files));
});

/// The name of the file, and the manifest with its hashes and its own seal.
fn fit(mut manifest: Value, file: &[u8]) -> Option<(String, Vec<u8>)> {
    let has_texture = manifest.pointer("/textures/0").is_some();
    let entry = if has_texture { "/textures/0" } else { "/field" };
    let entry = manifest.pointer_mut(entry)?.as_object_mut()?;
    let name = entry.get("file")?.as_str()?.to_string();
    entry.insert("file_bytes".to_string(), json!(file.len()));
    let hash = |bytes: &[u8]| blake3::hash(bytes).to_hex().to_string();
    entry.insert("file_blake3".to_string(), json!(hash(file)));
    if has_texture && let Ok(texture) = ktx::decode(&name, file) {
        let texels = texture.blake3().to_hex().to_string();
        entry.insert("texels_blake3".to_string(), json!(texels));
    }
    let mut manifest: Manifest = serde_json::from_value(manifest).ok()?;
    manifest.seal = "0".repeat(64);
    let text = serde_json::to_string_pretty(&manifest).ok()?;
    let seal = hash(text.as_bytes());
    let key = "\"seal\": \"";
    let at = text.rfind(key)? + key.len();
    let text = format!("{}{seal}{}", &text[..at], text.get(at + 64..)?);
    Some((name, text.into_bytes()))
}
