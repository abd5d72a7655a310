//! Photographs: what is accepted, and a clear error for everything that is not.

#![allow(clippy::unwrap_used, reason = "a test may stop where it fails")]

use std::io::Cursor;
use std::ops::ControlFlow;

use image::{DynamicImage, ImageFormat, RgbImage};
use welkin_baker::{BakeError, PhotoSettings, Recipe, bake, photo_channel};

const PHOTO: &[u8] = include_bytes!("../../assets-src/photos/god-rays-1024.png");

fn settings() -> PhotoSettings {
    PhotoSettings {
        file: None,
        size: 64,
        mean: 0.16,
    }
}

fn error(bytes: &[u8]) -> String {
    let size = photo_channel(bytes, "clouds.png", &settings()).map(|image| image.width);
    let error = size.expect_err("a photograph that must be refused");
    let text = error.to_string();
    assert!(text.starts_with("clouds.png: "), "{text}");
    assert!(text.contains("expected"), "{text}");
    text
}

/// A picture of soft stripes, so that it has contrast.
fn stripes(width: u32, height: u32) -> DynamicImage {
    RgbImage::from_fn(width, height, |x, y| {
        let v = 80 + ((x / 3 + y / 5) % 16) as u8 * 8;
        image::Rgb([v, v, 200])
    })
    .into()
}

fn encoded(picture: &DynamicImage, format: ImageFormat) -> Vec<u8> {
    let mut bytes = Cursor::new(Vec::new());
    picture.write_to(&mut bytes, format).unwrap();
    bytes.into_inner()
}

/// A PNG that says a size and ends after one empty data chunk.
fn header_only(width: u32, height: u32) -> Vec<u8> {
    let mut header = Vec::from(width.to_be_bytes());
    header.extend(height.to_be_bytes());
    header.extend([8, 2, 0, 0, 0]);
    let mut png = Vec::from(*b"\x89PNG\r\n\x1a\n");
    for (kind, data) in [(b"IHDR", header.as_slice()), (b"IDAT", &[]), (b"IEND", &[])] {
        png.extend((data.len() as u32).to_be_bytes());
        let start = png.len();
        png.extend(kind);
        png.extend(data);
        let crc = crc32(&png[start..]);
        png.extend(crc.to_be_bytes());
    }
    png
}

/// The checksum of PNG chunks, ISO 3309.
fn crc32(bytes: &[u8]) -> u32 {
    !bytes.iter().fold(!0_u32, |crc, &byte| {
        (0..8).fold(crc ^ u32::from(byte), |c, _| {
            if c & 1 == 1 {
                (c >> 1) ^ 0xedb8_8320
            } else {
                c >> 1
            }
        })
    })
}

#[test]
fn png_and_jpeg_of_any_layout_are_accepted() {
    let picture = stripes(200, 120);
    let variants = [
        encoded(&picture, ImageFormat::Png),
        encoded(&picture, ImageFormat::Jpeg),
        encoded(&picture.to_rgba8().into(), ImageFormat::Png),
        encoded(&picture.to_rgb16().into(), ImageFormat::Png),
        encoded(&picture.to_luma8().into(), ImageFormat::Png),
        encoded(&picture.to_luma8().into(), ImageFormat::Jpeg),
    ];
    for bytes in variants {
        let channel = photo_channel(&bytes, "clouds.png", &settings()).unwrap();
        assert_eq!(
            (channel.width, channel.height, channel.channels),
            (64, 64, 1)
        );
        let (mean, _) = channel.mean_and_spread(0);
        assert!((mean - 0.16).abs() < 1.0 / 512.0, "{mean}");
    }
}

#[test]
fn empty_and_foreign_files_are_refused() {
    assert!(error(&[]).contains("0 bytes"));
    assert!(error(b"GIF89a................").contains("PNG or JPEG"));
    assert!(error(b"not a picture at all").contains("PNG or JPEG"));
}

#[test]
fn truncated_files_are_refused_at_every_length() {
    let jpeg = encoded(&stripes(200, 120), ImageFormat::Jpeg);
    let png = encoded(&stripes(200, 120), ImageFormat::Png);
    // A JPEG's end marker takes 2 bytes; a PNG's end chunk takes 12 and follows its data's checksums.
    for (whole, end) in [(jpeg, 2), (png, 20)] {
        for sixteenths in 1..16 {
            error(&whole[..whole.len() * sixteenths / 16]);
        }
        error(&whole[..whole.len() - end]);
    }
    error(&PHOTO[..PHOTO.len() - 2000]);
}

#[test]
fn corrupt_files_are_refused() {
    for place in [20, 40, PHOTO.len() / 2, PHOTO.len() - 200] {
        let mut bytes = PHOTO.to_vec();
        bytes[place] ^= 0x10;
        error(&bytes);
    }
}

#[test]
fn sizes_are_checked_in_the_header() {
    assert!(error(&header_only(100_000, 100_000)).contains("100000x100000"));
    assert!(error(&header_only(8193, 64)).contains("64 to 8192"));
    assert!(error(&header_only(63, 500)).contains("63x500"));
    error(&header_only(0, 0));
    error(&header_only(0, 500));
    error(&header_only(u32::MAX, u32::MAX));
    // A size that is allowed, with nothing behind it.
    error(&header_only(8192, 8192));
}

#[test]
fn a_blank_picture_is_refused() {
    let blank = RgbImage::from_pixel(100, 100, image::Rgb([90, 120, 200]));
    let bytes = encoded(&blank.into(), ImageFormat::Png);
    assert!(error(&bytes).contains("contrast"));
}

#[test]
fn files_are_found_beside_the_recipe_or_named_in_the_error() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(
        folder.path().join("my.png"),
        encoded(&stripes(90, 90), ImageFormat::Png),
    )
    .unwrap();
    let bake_with = |file: &str, base| {
        let text = format!("[clouds]\nsize = 64\n[clouds.photo]\nfile = '{file}'\n");
        let resolved = Recipe::parse("sky.toml", &text)
            .unwrap()
            .resolve(None)
            .unwrap();
        bake(&resolved, base, &|_| ControlFlow::Continue(()))
    };
    let pack = bake_with("my.png", Some(folder.path())).unwrap();
    assert_eq!(pack.manifest().inputs.len(), 1);
    assert_eq!(pack.manifest().inputs[0].key, "clouds.photo.file");
    bake_with(&folder.path().join("my.png").display().to_string(), None).unwrap();

    let missing = bake_with("other.png", Some(folder.path())).unwrap_err();
    assert!(
        matches!(&missing, BakeError::Read { file, .. } if file.ends_with("other.png")),
        "{missing}"
    );
    let is_folder = bake_with(".", Some(folder.path())).unwrap_err();
    assert!(matches!(is_folder, BakeError::Read { .. }), "{is_folder}");
    let no_base = bake_with("my.png", None).unwrap_err();
    assert!(matches!(no_base, BakeError::NoBase { .. }), "{no_base}");
}
