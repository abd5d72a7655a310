//! Every texture of the default pack, and a cube beside them, read by an independent reader: ktx-parse and zstddec, run by Node.js.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

use std::path::Path;
use std::process::Command;

use welkin_pack::{Overwrite, Pack, Role, Shape};
use welkin_tests::pack::with_skybox;

fn roles(pack: &Pack) -> impl Iterator<Item = Role> {
    pack.manifest().textures.iter().map(|entry| entry.role)
}

#[test]
fn ktx_parse_reads_the_same_texels() {
    let place = tempfile::tempdir().unwrap();
    let folder = place.path().join("pack");
    let pack = &with_skybox(16, |[x, y, z]| [x * x, y * y, z * z, 1.0]);
    pack.save(&folder, Overwrite::Keep, &|| false).unwrap();
    let script = Path::new(env!("CARGO_MANIFEST_DIR")).join("node/read.mjs");
    let output = Command::new("node")
        .arg(script)
        .arg(place.path())
        .args(roles(pack).map(|role| folder.join(role.file())))
        .output()
        .expect("node runs; `make tools` installs it");
    let message = String::from_utf8_lossy(&output.stderr);
    assert!(
        output.status.success(),
        "{message}; `make tools` installs ktx-parse"
    );
    let lines = String::from_utf8(output.stdout).unwrap();
    let containers: Vec<serde_json::Value> = lines
        .lines()
        .map(|line| serde_json::from_str(line).unwrap())
        .collect();
    assert_eq!(containers.len(), roles(pack).count());
    for (role, container) in roles(pack).zip(&containers) {
        let texture = pack.texture(role).unwrap();
        let raw = std::fs::read(place.path().join(format!("{}.raw", role.file()))).unwrap();
        assert!(
            raw == texture.levels.concat(),
            "{} has other texels",
            role.name()
        );
        let levels: Vec<usize> = texture.levels.iter().map(Vec::len).collect();
        assert_eq!(container["levels"], serde_json::json!(levels));
        assert_eq!(container["width"], texture.width);
        assert_eq!(container["height"], texture.height);
        let (layers, faces) = match texture.shape {
            Shape::D2 => (0, 1),
            Shape::Array => (texture.layers, 1),
            Shape::Cube => (0, 6),
        };
        assert_eq!(container["layers"], layers);
        assert_eq!(container["faces"], faces);
        assert_eq!(container["orientation"], "rd");
        assert_eq!(container["writer"], pack.manifest().baker);
        assert_eq!(container["bytesPlane0"], texture.format.bytes_per_texel());
        assert_eq!(container["transfer"], 1, "KHR_DF_TRANSFER_LINEAR");
    }
}
