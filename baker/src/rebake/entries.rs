//! Manifests, entry by entry.

use serde_json::{Map, Value};
use welkin_pack::Manifest;
use welkin_pack::check::Finding;
use welkin_pack::manifest::MANIFEST_FILE;

use super::finding::counted;

/// What tells how files were compressed, or follows from all else.
const LEFT_OUT: [&str; 4] = ["seal", "baker", "file_bytes", "file_blake3"];

/// What follows from texels and clouds, which are compared one by one: told only if nothing else differs.
const DERIVED: [&str; 6] = [
    "texels_blake3",
    "mean",
    "spread",
    "clouds",
    "boxes",
    "sprites",
];

/// One finding: how many entries differ, and the first.
pub(super) fn compare(found: &Manifest, expected: &Manifest) -> Finding {
    let mut differences = Vec::new();
    let [found, expected] = [found, expected].map(by_role);
    walk("", Some(&found), Some(&expected), &mut differences);
    let is_derived = |d: &&Difference| {
        d.place
            .rsplit('.')
            .next()
            .is_some_and(|key| DERIVED.contains(&key))
    };
    let first = differences
        .iter()
        .find(|d| !is_derived(d))
        .or(differences.first());
    let note = first.map(|d| {
        let Difference {
            place,
            found,
            expected,
        } = d;
        format!("first at {place}: {found} in the pack, {expected} baked anew")
    });
    counted(MANIFEST_FILE, differences.len(), note)
}

/// An entry that differs.
struct Difference {
    place: String,
    found: String,
    expected: String,
}

/// The manifest as JSON, with its textures by their roles: one that is missing shifts no other.
fn by_role(manifest: &Manifest) -> Value {
    // It was JSON, or will be.
    let mut value = serde_json::to_value(manifest).unwrap_or_default();
    let entries = manifest.textures.iter().filter_map(|entry| {
        let entry_value = serde_json::to_value(entry).ok()?;
        Some((entry.role.name().to_string(), entry_value))
    });
    if let Some(textures) = value.get_mut("textures") {
        *textures = Value::Object(entries.collect::<Map<_, _>>());
    }
    value
}

fn walk(place: &str, found: Option<&Value>, expected: Option<&Value>, out: &mut Vec<Difference>) {
    match (found, expected) {
        (Some(Value::Object(a)), Some(Value::Object(b))) => {
            let new_keys = b.keys().filter(|key| !a.contains_key(*key));
            for key in a.keys().chain(new_keys) {
                if LEFT_OUT.contains(&key.as_str()) {
                    continue;
                }
                let place = match place {
                    "" => key.clone(),
                    _ => format!("{place}.{key}"),
                };
                walk(&place, a.get(key), b.get(key), out);
            }
        }
        (Some(Value::Array(a)), Some(Value::Array(b))) => {
            for index in 0..a.len().max(b.len()) {
                walk(
                    &format!("{place}[{index}]"),
                    a.get(index),
                    b.get(index),
                    out,
                );
            }
        }
        (a, b) if a == b => {}
        (a, b) => out.push(Difference {
            place: place.to_string(),
            found: told(a),
            expected: told(b),
        }),
    }
}

/// A value in few words.
fn told(value: Option<&Value>) -> String {
    const MOST: usize = 80;
    let text = match value {
        None => "nothing".to_string(),
        Some(Value::Object(_)) => "an entry".to_string(),
        Some(value) => value.to_string(),
    };
    match text.char_indices().nth(MOST) {
        Some((end, _)) => format!("{}...", &text[..end]),
        None => text,
    }
}
