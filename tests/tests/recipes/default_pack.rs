//! The default pack: sound, small, and refused with any byte flipped.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

use std::ops::ControlFlow;

use welkin_baker::{Recipe, bake};
use welkin_pack::{Overwrite, Pack, Role, check::check};
use welkin_tests::pack::default_pack;

/// What the textures of the first method may take on disk, in bytes.
const MOST_BYTES_PACKED: usize = 1_600_000;

/// What those of the other methods may take beside them: half a byte for each of the 4 x 256 x 256 x 4 bytes of
/// noise at most, since three of its four channels are the fourth displaced, and 60 kB for the rest.
const MOST_BYTES_MORE: usize = 4 * 256 * 256 * 4 / 2 + 60_000;

/// What three layers of clouds may take: no more than their bytes, of which four thirds are all levels, since every byte
/// of a rank comes equally often and the others are hardly more predictable.
const MOST_BYTES_LAYERS: usize = 3 * 256 * 256 * 4 * 4 / 3;

/// What the table of the clear sky may take: of its 160 images of 16 x 32 half floats x 4, half. Their values are smooth.
const MOST_BYTES_SKY: usize = 160 * 16 * 32 * 4 * 2 / 2;

/// What the sheet of sprites may take: half of the bytes of its levels, since most of a cell is transparent.
const MOST_BYTES_SPRITES: usize = 512 * 512 * 4 * 4 / 3 / 2;

fn assert_sound(pack: &Pack) {
    let place = tempfile::tempdir().unwrap();
    let folder = place.path().join("pack");
    pack.save(&folder, Overwrite::Keep, &|| false).unwrap();
    let report = check(&folder).unwrap();
    let problems: Vec<String> = report.problems().map(ToString::to_string).collect();
    assert!(problems.is_empty(), "{problems:#?}");
}

#[test]
fn it_is_sound_and_small() {
    let pack = default_pack();
    assert_sound(pack);
    for (role, most) in [
        (Role::Layers, MOST_BYTES_LAYERS),
        (Role::Sky, MOST_BYTES_SKY),
        (Role::Sprites, MOST_BYTES_SPRITES),
    ] {
        let bytes = pack.manifest().texture(role).unwrap().file_bytes as usize;
        assert!(bytes < most, "{role:?}: {bytes} bytes");
    }
    let more = [Role::Octaves, Role::Fbm, Role::Flares].map(Role::file);
    let files = pack.files().iter();
    let told = [Role::Layers, Role::Sky, Role::Sprites].map(Role::file);
    let files = files.filter(|(name, _)| !told.contains(name));
    let (more, packed): (Vec<_>, Vec<_>) = files.partition(|(n, _)| more.contains(n));
    let bytes = |files: &[&(String, Vec<u8>)]| files.iter().map(|(_, b)| b.len()).sum::<usize>();
    let (more, packed) = (bytes(&more), bytes(&packed));
    assert!(packed < MOST_BYTES_PACKED, "{packed} bytes");
    assert!(more < MOST_BYTES_MORE, "{more} bytes");
}

#[test]
fn it_is_sound_with_other_seeds_sizes_and_half_floats() {
    for text in [
        "seed = 2",
        "seed = 9223372036854775807",
        "[clouds]\nformat = \"rgba16f\"",
        "[clouds]\nsize = 256\n[stars]\nsize = 512\ncount = 2000\n[galaxy]\nsize = 256",
        "[sun]\nnoon_elevation_deg = 25",
        "[clouds]\nsize = 256\n[fbm]\nsize = 64\ncells = 4\n[flares]\nsize = 64",
        "[clouds]\nsize = 256\n[fbm]\nsize = 512\noctaves = 6\n[flares]\nsize = 1024",
        "[clouds]\nsize = 256\n[fbm]\ncells = 128\noctaves = 1",
        "seed = 3\n[clouds]\nsize = 256\n[layers]\nsize = 64",
        "seed = 4\n[clouds]\nsize = 256\n[layers]\nsize = 512\n[layers.cirrus]\nrelief = 2\n[layers.cumulus]\nrelief = 0.1",
        "seed = 6\n[clouds]\nsize = 256\n[sprites]\nsize = 128\nsoftness = 3",
        "seed = 7\n[clouds]\nsize = 256\n[sprites]\nsize = 1024\ndetail = 1.5\nsoftness = 0.5\ncontrast = 2",
        "seed = 8\n[clouds]\nsize = 256\n[sprites]\nsize = 256\ndetail = 0",
        "seed = 5\n[clouds]\nsize = 256\n[layers.stratocumulus]\ncells = 32\n[layers.cirrus]\ncells = 10\noctaves = 8\ngain = 1",
    ] {
        let resolved = Recipe::parse("r.toml", text)
            .unwrap()
            .resolve(None)
            .unwrap();
        assert_sound(&bake(&resolved, None, &|_| ControlFlow::Continue(())).unwrap());
    }
}

#[test]
fn a_flipped_byte_anywhere_is_refused() {
    let files = default_pack().files().to_vec();
    let open = |files: &[(String, Vec<u8>)]| {
        Pack::from_files("p", |name, _| {
            Ok(files.iter().find(|(n, _)| n == name).unwrap().1.clone())
        })
    };
    open(&files).unwrap();
    // Every byte of a tiny pack is flipped in welkin-pack; here, places spread over the real one.
    for file in 0..files.len() {
        let length = files[file].1.len();
        for at in (0..40).map(|i| i * (length - 1) / 39) {
            let mut damaged = files.clone();
            damaged[file].1[at] ^= 0x10;
            let error = open(&damaged).unwrap_err().to_string();
            assert!(
                error.contains(&files[file].0),
                "byte {at} of {}: {error}",
                files[file].0
            );
        }
    }
}

#[test]
fn the_manifest_fits_the_published_schema() {
    let path = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../docs/pack.schema.json");
    let schema: serde_json::Value = serde_json::from_slice(&std::fs::read(path).unwrap()).unwrap();
    let (_, manifest) = default_pack().files().last().unwrap();
    let manifest: serde_json::Value = serde_json::from_slice(manifest).unwrap();
    let validator = jsonschema::validator_for(&schema).unwrap();
    let errors: Vec<String> = validator
        .iter_errors(&manifest)
        .map(|e| e.to_string())
        .collect();
    assert!(errors.is_empty(), "{errors:#?}");
    let mut broken = manifest;
    broken["textures"][0]["format"] = "srgb".into();
    assert!(!validator.is_valid(&broken));
}
