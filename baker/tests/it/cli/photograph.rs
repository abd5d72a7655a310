//! Photographs that are missing, truncated, corrupt, empty or huge: in a recipe and for `welkin photo`.

use std::fs;
use std::path::{Path, PathBuf};

use super::{Desk, run, welkin};

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
            "name a photograph",
        ],
    );
}

/// Sixteen pictures that together take more memory than there is, and one alone does not. What follows the end of a PNG is
/// not looked at, but read.
#[cfg(target_os = "linux")]
#[test]
fn pictures_are_read_one_after_another() {
    const EACH: u64 = 32 << 20;
    const MEMORY_KIB: u64 = 256 << 10;
    let desk = Desk::new();
    let disc = image::GrayAlphaImage::from_fn(32, 32, |x, y| {
        let [x, y] = [x, y].map(|i| i as f32 - 15.5);
        image::LumaA([200, if x * x + y * y < 100.0 { 255 } else { 0 }])
    });
    let names: Vec<String> = (0..16).map(|i| format!("\"{i}.png\"")).collect();
    for name in &names {
        let path = desk.path(name.trim_matches('"'));
        disc.save(&path).unwrap();
        let file = fs::File::options().write(true).open(&path).unwrap();
        file.set_len(EACH).unwrap();
    }
    let pictures = format!("[sprites]\nsize = 128\npictures = [{}]\n", names.join(", "));
    let text = super::SMALL_RECIPE.replace("[sprites]\nsize = 128\n", &pictures);
    let recipe = desk.write("sky.toml", text);
    let bake = "ulimit -d $0; exec \"$1\" bake \"$2\" -o \"$3\" --threads 1";
    let mut limited = std::process::Command::new("sh");
    limited.args([
        "-c",
        bake,
        &MEMORY_KIB.to_string(),
        env!("CARGO_BIN_EXE_welkin"),
    ]);
    run(limited.arg(&recipe).arg(desk.path("pack"))).done();
    let manifest = fs::read_to_string(desk.path("pack/pack.json")).unwrap();
    let hash = blake3::hash(&fs::read(desk.path("7.png")).unwrap()).to_hex();
    assert_eq!(manifest.matches(hash.as_str()).count(), 16);
}

/// A model is refused before more than its limit is read.
#[test]
fn a_long_model_is_told_its_limit() {
    let desk = Desk::new();
    fs::File::create(desk.path("m.glb"))
        .unwrap()
        .set_len((16 << 20) + 1)
        .unwrap();
    let recipe = desk.write(
        "sky.toml",
        "[[field.models]]\nkind = \"cumulus\"\nfile = \"m.glb\"\n",
    );
    let bake = run(welkin()
        .arg("bake")
        .arg(recipe)
        .arg("-o")
        .arg(desk.path("pack")));
    bake.failed(
        1,
        &["m.glb: length is over 16 MiB, expected at most 16 MiB"],
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
    refused(
        Some(b"these are not pixels"),
        &["format is unknown", "PNG, JPEG, TIFF"],
    );
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
            &["sky.png", "expected 64 to 32768"],
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
fn a_recipe_says_how_and_the_sheet_shows_what_became_of_it() {
    let desk = Desk::new();
    fs::copy(god_rays(), desk.path("sky.png")).unwrap();
    let mask = image::GrayImage::from_fn(1024, 1024, |x, _| {
        image::Luma([if x < 700 { 255 } else { 0 }])
    });
    mask.save(desk.path("mask.png")).unwrap();
    let text = "[clouds]\nsize = 128\n[clouds.photo]\nfile = \"sky.png\"\nmask = \"mask.png\"\nregion = [100, 50, 800, 700]\n";
    let recipe = desk.write("sky.toml", text);
    let (tile, sheet) = (desk.path("tile.png"), desk.path("sheet.png"));
    let mut photo = welkin();
    photo.arg("photo").arg("--recipe").arg(&recipe);
    let done = run(photo.arg("-o").arg(&tile).arg("--sheet").arg(&sheet));
    assert!(
        done.stderr
            .contains("used 700x700 at 150, 50 of 1024x1024, 47 %"),
        "{done:?}"
    );
    done.done();
    assert_eq!(image::open(&tile).unwrap().width(), 128);
    let sheet_image = image::open(&sheet).unwrap().into_rgb8();
    let outline = sheet_image
        .pixels()
        .filter(|p| p.0 == [255, 200, 0])
        .count();
    // Four sides of 131 pixels: the picture is 192 wide.
    assert!((480..=530).contains(&outline), "{outline}");

    // One that is named comes before the recipe's, whose mask then has to fit it.
    image::RgbImage::from_fn(80, 80, |x, y| {
        image::Rgb([(x * 3) as u8, (y * 2) as u8, 200])
    })
    .save(desk.path("other.png"))
    .unwrap();
    let other = run(welkin()
        .arg("photo")
        .arg(desk.path("other.png"))
        .arg("-r")
        .arg(&recipe)
        .arg("-o")
        .arg(&tile));
    other.failed(1, &["mask.png: size is 1024x1024, expected 80x80"]);
    for (output, parts) in [
        ("sheet.jpg", ["sheet.jpg", "would be a PNG file"]),
        ("mask.png", ["mask.png", "mask.png"]),
        ("sky.png", ["sky.png", "sky.png"]),
    ] {
        let run = run(welkin()
            .args(["photo", "-r"])
            .arg(&recipe)
            .arg("--sheet")
            .arg(desk.path(output)));
        run.failed(1, &parts);
    }
    // Without a recipe's photograph the built-in one.
    let plain = desk.write("plain.toml", "clouds.size = 64\n");
    run(welkin()
        .args(["photo", "-r"])
        .arg(&plain)
        .arg("-s")
        .arg(&sheet))
    .done();
}

#[test]
fn a_photograph_that_a_recipe_names_is_not_written_over_when_another_is_used() {
    let desk = Desk::new();
    let own = desk.write("sky.png", "precious");
    let recipe = desk.write("sky.toml", "[clouds.photo]\nfile = \"sky.png\"\n");
    for names in [&["-o", "sky.png"][..], &["-o", "tile.png", "-s", "sky.png"]] {
        let place = |name: &&str| match name.starts_with('-') {
            true => PathBuf::from(name),
            false => desk.path(name),
        };
        let mut photo = welkin();
        photo.arg("photo").arg(god_rays()).arg("-r").arg(&recipe);
        run(photo.args(names.iter().map(place))).failed(1, &["sky.png"]);
        assert_eq!(fs::read_to_string(&own).unwrap(), "precious");
        assert!(!desk.path("tile.png").exists());
    }
}

#[test]
fn a_whole_one_becomes_a_tile_and_a_pack() {
    let desk = Desk::new();
    fs::copy(god_rays(), desk.path("sky.png")).unwrap();
    let recipe = desk.write(
        "sky.toml",
        format!(
            "{}[clouds.photo]\nfile = \"sky.png\"\n",
            super::SMALL_RECIPE
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
