//! The bytes of the default pack, pinned: one recipe, one seed, one version, one set of bytes.

use std::fs;
use std::path::Path;

use welkin_tests::pack::default_pack;

/// If this fails and bytes were meant to change: bump the baker's version, run with WELKIN_BLESS=1, look at the
/// pictures, and say in CHANGELOG.md why.
#[test]
fn the_default_pack_has_its_golden_bytes() {
    let found: String = default_pack()
        .manifest()
        .textures
        .iter()
        .map(|entry| format!("{} {}\n", entry.texels_blake3, entry.role.name()))
        .collect();
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("golden/default.txt");
    if std::env::var_os("WELKIN_BLESS").is_some() {
        fs::write(&path, &found).unwrap();
    }
    let golden = fs::read_to_string(&path).unwrap();
    assert_eq!(found, golden, "texels of the default pack changed");
}
