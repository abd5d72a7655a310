//! Photographs that are missing, truncated, corrupt, empty or huge: in a recipe and for `welkin photo`.

use std::fs;
use std::path::{Path, PathBuf};

use crate::{Desk, run, welkin};

fn god_rays() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../assets-src/photos/god-rays-1024.png")
}

/// Both ways to use a photograph fail, name it, and leave nothing.
fn refused(bytes: Option<&[u8]>, parts: &[&str]) {
    let desk = Desk::new();
    let photograph = desk.path("sky.png");
    if let Some(bytes) = bytes {
        desk.write("sky.png", bytes);
    }
    let recipe = desk.write("sky.toml", "[clouds.photo]\nfile = \"sky.png\"\n");
    let before = desk.names();
    let parts = [&["sky.png"], parts].concat();
    run(welkin()
        .arg("bake")
        .arg(&recipe)
        .arg("-o")
        .arg(desk.path("pack")))
    .failed(1, &parts);
    run(welkin()
        .arg("photo")
        .arg(&photograph)
        .arg("-o")
        .arg(desk.path("tile.png")))
    .failed(1, &parts);
    assert_eq!(desk.names(), before);
}

/// A PNG whose header says this size; its checksum is right, its pixels are those of a smaller picture.
fn png_that_claims(width: u32, height: u32) -> Vec<u8> {
    let mut bytes = fs::read(god_rays()).unwrap();
    bytes[16..20].copy_from_slice(&width.to_be_bytes());
    bytes[20..24].copy_from_slice(&height.to_be_bytes());
    let checksum = crc32(&bytes[12..29]);
    bytes[29..33].copy_from_slice(&checksum.to_be_bytes());
    bytes
}

/// The checksum of PNG's chunks: ISO/IEC 15948:2004, annex D.
fn crc32(bytes: &[u8]) -> u32 {
    let step = |crc: u32, _| {
        if crc & 1 == 1 {
            0xEDB8_8320 ^ (crc >> 1)
        } else {
            crc >> 1
        }
    };
    !bytes
        .iter()
        .fold(!0, |crc, &byte| (0..8).fold(crc ^ u32::from(byte), step))
}

#[test]
fn the_test_header_is_right_where_it_changes_nothing() {
    assert_eq!(png_that_claims(1024, 1024), fs::read(god_rays()).unwrap());
}

#[test]
fn missing() {
    refused(None, &["cannot be read", "No such file"]);
}

/// Nobody wrote a recipe, so none is to blame.
#[test]
fn missing_for_photo_alone() {
    let desk = Desk::new();
    let run = run(welkin()
        .arg("photo")
        .arg(desk.path("none.png"))
        .arg("-o")
        .arg(desk.path("tile.png")));
    assert!(!run.stderr.contains("recipe"), "{run:?}");
    run.failed(
        1,
        &[
            "none.png: cannot be read: No such file",
            "name a PNG or JPEG file",
        ],
    );
}

#[test]
fn truncated() {
    let bytes = fs::read(god_rays()).unwrap();
    for kept in [8, 33, 40, bytes.len() / 2] {
        refused(Some(&bytes[..kept]), &["cannot be decoded"]);
    }
}

#[test]
fn corrupt() {
    let mut bytes = fs::read(god_rays()).unwrap();
    let middle = bytes.len() / 2;
    bytes[middle] ^= 0xff;
    refused(Some(&bytes), &["cannot be decoded"]);
    refused(Some(b"these are not pixels"), &["PNG or JPEG"]);
}

#[test]
fn of_no_size() {
    refused(Some(b""), &["0 bytes"]);
    refused(Some(&png_that_claims(0, 0)), &["sky.png"]);
    refused(Some(&png_that_claims(1024, 0)), &["sky.png"]);
}

#[test]
fn huge_by_its_header() {
    for (width, height) in [(60_000, 60_000), (1024, 2_000_000_000), (100_000, 1)] {
        refused(
            Some(&png_that_claims(width, height)),
            &["sky.png", "expected 64 to 8192"],
        );
    }
}

#[test]
fn without_an_end() {
    let desk = Desk::new();
    let run = run(welkin()
        .args(["photo", "/dev/zero", "-o"])
        .arg(desk.path("tile.png")));
    run.failed(1, &["/dev/zero", "over 256 MiB"]);
    assert!(desk.names().is_empty());
}

#[test]
fn a_whole_one_becomes_a_tile_and_a_pack() {
    let desk = Desk::new();
    fs::copy(god_rays(), desk.path("sky.png")).unwrap();
    let recipe = desk.write(
        "sky.toml",
        format!(
            "{}[clouds.photo]\nfile = \"sky.png\"\n",
            crate::SMALL_RECIPE
        ),
    );
    run(welkin()
        .arg("bake")
        .arg(&recipe)
        .arg("-o")
        .arg(desk.path("pack")))
    .done();
    let tile = desk.path("tile.png");
    run(welkin()
        .arg("photo")
        .arg(desk.path("sky.png"))
        .arg("-o")
        .arg(&tile))
    .done();
    let tile = image::open(&tile).unwrap();
    assert_eq!(
        (tile.width(), tile.height(), tile.color()),
        (512, 512, image::ColorType::L8)
    );
    assert_eq!(desk.names(), ["pack", "sky.png", "sky.toml", "tile.png"]);
}
