//! The field of the default pack, and one of cirrus, read by independent readers: glTF-Validator and glTF-Transform, run by Node.js.
//! And the example models, made again by their script.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use serde_json::Value;
use welkin_baker::{Recipe, cloud_field};
use welkin_pack::field::{Category, Cloud, CloudBox, Sprite};
use welkin_pack::{Field, Pack, PackInfo};

fn node(script: &Path, argument: &Path) -> Output {
    let output = Command::new("node").arg(script).arg(argument).output();
    let output = output.expect("node runs; `make tools` installs it");
    let message = String::from_utf8_lossy(&output.stderr);
    assert!(
        output.status.success(),
        "{message}; `make tools` installs what is read with"
    );
    output
}

fn assets() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../assets-src")
}

/// A pack that has only the field of a recipe.
fn field_pack(text: &str) -> Pack {
    let resolved = Recipe::parse("recipe", text)
        .unwrap()
        .resolve(None)
        .unwrap();
    let field = cloud_field(&resolved.field.unwrap(), None, resolved.seed).unwrap();
    let info = PackInfo {
        name: "field".to_string(),
        seed: resolved.seed,
        baker: "test".to_string(),
        recipe: text.to_string(),
        inputs: Vec::new(),
        noon_elevation_rad: 1.0,
        aerosol_depths: resolved.sky.aerosol_depths,
        ..PackInfo::default()
    };
    let pack = Pack::build(info, Vec::new()).unwrap();
    pack.with_field(field).unwrap()
}

fn read(pack: &Pack) -> Value {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("field.glb");
    let file = pack.files().iter().find(|(name, _)| name == "field.glb");
    std::fs::write(&path, &file.unwrap().1).unwrap();
    let script = Path::new(env!("CARGO_MANIFEST_DIR")).join("node/read_field.mjs");
    serde_json::from_slice(&node(&script, &path).stdout).unwrap()
}

/// The elements of an attribute, each a list of numbers.
fn elements(read: &Value, node: &str, attribute: &str) -> Vec<Vec<f64>> {
    let elements = &read["nodes"][node]["attributes"][attribute];
    serde_json::from_value(elements.clone()).unwrap()
}

fn assert_elements<const N: usize>(
    read: &Value,
    node: &str,
    attribute: &str,
    expected: impl Iterator<Item = [f32; N]>,
) {
    let found = elements(read, node, attribute);
    let expected: Vec<Vec<f64>> = expected.map(|e| e.map(f64::from).to_vec()).collect();
    assert!(found == expected, "{node} {attribute}");
}

fn sprites(field: &Field) -> impl Iterator<Item = (usize, &Cloud, &Sprite)> {
    let clouds = field.clouds.iter().enumerate();
    clouds.flat_map(|(i, cloud)| cloud.sprites.iter().map(move |s| (i, cloud, s)))
}

fn boxes(field: &Field) -> impl Iterator<Item = (usize, &CloudBox)> {
    let clouds = field.clouds.iter().enumerate();
    clouds.flat_map(|(i, cloud)| cloud.boxes.iter().map(move |b| (i, b)))
}

/// A vector turned by a unit quaternion.
fn turned(q: &[f64], v: [f64; 3]) -> [f64; 3] {
    let cross = |a: [f64; 3], b: [f64; 3]| {
        [
            a[1] * b[2] - a[2] * b[1],
            a[2] * b[0] - a[0] * b[2],
            a[0] * b[1] - a[1] * b[0],
        ]
    };
    let axis = [q[0], q[1], q[2]];
    let t = cross(axis, v).map(|c| 2.0 * c);
    let u = cross(axis, t);
    [0, 1, 2].map(|i| v[i] + q[3] * t[i] + u[i])
}

fn assert_rotations(read: &Value, field: &Field) {
    let rotations = elements(read, "sprites", "ROTATION");
    for ((_, cloud, sprite), q) in sprites(field).zip(&rotations) {
        let (sin, cos) = f64::from(sprite.rotation_rad).sin_cos();
        // Where width and height point: on the screen of a facing sprite, on the ground below a flat one.
        let (width, height) = if cloud.kind.is_flat() {
            ([cos, 0.0, -sin], [-sin, 0.0, -cos])
        } else {
            ([cos, sin, 0.0], [-sin, cos, 0.0])
        };
        for (v, expected) in [([1.0, 0.0, 0.0], width), ([0.0, 1.0, 0.0], height)] {
            let found = turned(q, v);
            // Steps of a 16-bit unorm, twice each.
            assert!(
                (0..3).all(|i| (found[i] - expected[i]).abs() < 3e-4),
                "{q:?} {sprite:?}"
            );
        }
    }
}

fn assert_read_alike(pack: &Pack) {
    let (field, read) = (pack.field().unwrap(), read(pack));
    assert_eq!(read["numErrors"], 0, "{}", read["messages"]);
    assert_eq!(read["numWarnings"], 0, "{}", read["messages"]);
    assert_eq!(read["nodes"]["sprites"]["corners"], 4);
    assert_eq!(read["nodes"]["boxes"]["corners"], 8);
    let cells = |of: fn(usize, &Cloud, &Sprite) -> usize| {
        sprites(field).map(move |(i, cloud, s)| [of(i, cloud, s) as f32])
    };
    assert_elements(
        &read,
        "sprites",
        "TRANSLATION",
        sprites(field).map(|s| s.2.centre_m),
    );
    let sizes = sprites(field).map(|(_, _, s)| [s.size_m[0], s.size_m[1], 1.0]);
    assert_elements(&read, "sprites", "SCALE", sizes);
    assert_elements(&read, "sprites", "_CELL", cells(|_, _, s| s.cell.into()));
    assert_elements(
        &read,
        "sprites",
        "_BOX",
        cells(|_, _, s| s.cloud_box.into()),
    );
    assert_elements(&read, "sprites", "_CLOUD", cells(|i, _, _| i));
    let groups = cells(|_, cloud, s| cloud.boxes[usize::from(s.cloud_box)].group.into());
    assert_elements(&read, "sprites", "_GROUP", groups);
    assert_elements(
        &read,
        "boxes",
        "TRANSLATION",
        boxes(field).map(|b| b.1.centre_m),
    );
    assert_elements(&read, "boxes", "SCALE", boxes(field).map(|b| b.1.size_m));
    assert_elements(&read, "boxes", "_CULL", boxes(field).map(|b| [b.1.cull_m]));
    assert_elements(
        &read,
        "boxes",
        "_GROUP",
        boxes(field).map(|b| [f32::from(b.1.group)]),
    );
    assert_elements(&read, "boxes", "_CLOUD", boxes(field).map(|b| [b.0 as f32]));
    let category = |c: Category| Category::ALL.iter().position(|a| *a == c).unwrap() as f32;
    let categories = boxes(field).map(|b| [category(b.1.category)]);
    assert_elements(&read, "boxes", "_CATEGORY", categories);
    assert_rotations(&read, field);
    let extras = &read["extras"]["welkin_field"];
    assert_eq!(extras["sections"], field.sections);
    assert_eq!(
        extras["clouds"].as_array().unwrap().len(),
        field.clouds.len()
    );
    assert_eq!(extras["clouds"][0]["kind"], field.clouds[0].kind.name());
    assert_eq!(extras["hours"].as_array().unwrap().len(), field.hours.len());
}

#[test]
fn other_readers_find_the_same_clouds_and_no_fault() {
    assert_read_alike(&field_pack(""));
    let cirrus = assets().join("recipes/fields/cirrus.toml");
    assert_read_alike(&field_pack(&std::fs::read_to_string(cirrus).unwrap()));
}

/// Records of 48 bytes: with the eight of exposure that version 7 of the format added, 45 kB more than the 350 that were allowed before.
#[test]
fn the_default_field_takes_360_kilobytes_at_most() {
    let pack = field_pack("");
    let entry = pack.manifest().field.as_ref().unwrap();
    assert!(entry.file_bytes <= 360_000, "{}", entry.file_bytes);
}

#[test]
fn the_script_makes_the_example_models() {
    let folder = tempfile::tempdir().unwrap();
    node(&assets().join("models/make.mjs"), folder.path());
    for name in ["heap.gltf", "tower.glb"] {
        let made = std::fs::read(folder.path().join(name)).unwrap();
        let kept = std::fs::read(assets().join("models").join(name)).unwrap();
        assert!(
            made == kept,
            "run `node assets-src/models/make.mjs` and look at {name}"
        );
    }
}
