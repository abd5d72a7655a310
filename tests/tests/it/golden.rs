//! The bytes of packs, pinned: one recipe, one seed, one version, one set of bytes.

use std::fs;
use std::path::Path;

use welkin_pack::Pack;
use welkin_tests::pack::{catalogued, default_pack, recipe_pack};

/// If this fails and bytes were meant to change: bump the baker's version, run with WELKIN_BLESS=1, look at the
/// pictures, and say in CHANGELOG.md why.
fn assert_golden(name: &str, pack: &Pack) {
    let textures = &pack.manifest().textures;
    let mut found: String = textures
        .iter()
        .map(|entry| format!("{} {}\n", entry.texels_blake3, entry.role.name()))
        .collect();
    if let Some(field) = pack.field() {
        // Of its numbers as text: the file also names the version that wrote it.
        let hash = blake3::hash(format!("{field:?}").as_bytes());
        found += &format!("{} field\n", hash.to_hex());
    }
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("golden/{name}.txt"));
    if std::env::var_os("WELKIN_BLESS").is_some() {
        fs::write(&path, &found).expect("the golden file is written");
    }
    let golden = fs::read_to_string(&path).expect("the golden file is there");
    assert_eq!(found, golden, "texels of the {name} pack changed");
}

#[test]
fn the_default_pack_has_its_golden_bytes() {
    assert_golden("default", default_pack());
}

#[test]
fn the_pack_with_a_skybox_has_its_golden_bytes() {
    assert_golden("skybox", &recipe_pack("skybox"));
}

#[test]
fn the_pack_with_a_catalogue_has_its_golden_bytes() {
    assert_golden("winter-night", catalogued());
}
