//! Photographs: what is accepted, and a clear error for everything that is not.

#![allow(clippy::unwrap_used, reason = "a test may stop where it fails")]

use std::io::Cursor;
use std::ops::ControlFlow;

use image::codecs::jpeg::JpegEncoder;
use image::codecs::png::PngEncoder;
use image::{DynamicImage, ExtendedColorType, ImageEncoder, ImageFormat, RgbImage};
use welkin_baker::{BakeError, PhotoSettings, Recipe, bake, photo_channel};

const PHOTO: &[u8] = include_bytes!("../../../assets-src/photos/god-rays-1024.png");

fn settings() -> PhotoSettings {
    PhotoSettings {
        size: 64,
        mean: Some(0.16),
        ..PhotoSettings::default()
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

/// Exif 2.32, 4.6.4 A, Orientation: on which side of the picture row 0 and column 0 of the file are. So the texel of the
/// file at a column and a row is that of the upright picture at these.
fn stored(upright: &RgbImage, orientation: u8) -> RgbImage {
    let (width, height) = upright.dimensions();
    let (right, bottom) = (width - 1, height - 1);
    let is_turned = orientation > 4;
    let (columns, rows) = if is_turned {
        (height, width)
    } else {
        (width, height)
    };
    RgbImage::from_fn(columns, rows, |column, row| {
        let (x, y) = match orientation {
            1 => (column, row),
            2 => (right - column, row),
            3 => (right - column, bottom - row),
            4 => (column, bottom - row),
            5 => (row, column),
            6 => (right - row, column),
            7 => (right - row, bottom - column),
            _ => (row, bottom - column),
        };
        *upright.get_pixel(x, y)
    })
}

/// The least Exif block that has an orientation: a TIFF header in either order of bytes, one entry, no further directory.
fn exif(orientation: u8, little_endian: bool) -> Vec<u8> {
    let short = |v: u16| {
        if little_endian {
            v.to_le_bytes()
        } else {
            v.to_be_bytes()
        }
    };
    let long = |v: u32| {
        if little_endian {
            v.to_le_bytes()
        } else {
            v.to_be_bytes()
        }
    };
    let mut bytes = if little_endian {
        b"II".to_vec()
    } else {
        b"MM".to_vec()
    };
    bytes.extend(short(42));
    bytes.extend(long(8));
    bytes.extend(short(1));
    bytes.extend(short(0x0112));
    bytes.extend(short(3));
    bytes.extend(long(1));
    bytes.extend(short(orientation.into()));
    bytes.extend([0; 6]);
    bytes
}

#[test]
fn a_photograph_is_turned_upright_as_its_camera_says() {
    // No symmetry of any kind.
    let upright = RgbImage::from_fn(120, 90, |x, y| {
        let v = ((x * x / 37 + 3 * y) % 160 + y / 2) as u8;
        image::Rgb([v, v / 2 + 40, 210 - v])
    });
    let expected = photo_channel(
        &encoded(&upright.clone().into(), ImageFormat::Png),
        "a.png",
        &settings(),
    );
    let expected = expected.unwrap();
    let difference = |bytes: &[u8]| {
        let channel = photo_channel(bytes, "a.jpg", &settings()).unwrap();
        let pairs = channel.texels.iter().zip(&expected.texels);
        pairs.map(|(a, b)| (a - b).abs()).sum::<f32>() / channel.texels.len() as f32
    };
    for orientation in 1..=8 {
        let picture = stored(&upright, orientation);
        let (width, height) = picture.dimensions();
        for little_endian in [true, false] {
            let mut png = Vec::new();
            let mut encoder = PngEncoder::new(&mut png);
            encoder
                .set_exif_metadata(exif(orientation, little_endian))
                .unwrap();
            encoder
                .write_image(&picture, width, height, ExtendedColorType::Rgb8)
                .unwrap();
            assert_eq!(difference(&png), 0.0, "{orientation}");
            let mut jpeg = Vec::new();
            let mut encoder = JpegEncoder::new_with_quality(&mut jpeg, 98);
            encoder
                .set_exif_metadata(exif(orientation, little_endian))
                .unwrap();
            encoder
                .encode(&picture, width, height, ExtendedColorType::Rgb8)
                .unwrap();
            // A JPEG loses a little; a picture that is turned otherwise differs by tenths.
            assert!(
                difference(&jpeg) < 0.02,
                "{orientation}: {}",
                difference(&jpeg)
            );
        }
        if orientation > 1 {
            let as_stored = encoded(&picture.into(), ImageFormat::Png);
            assert!(
                difference(&as_stored) > 0.04,
                "{orientation}: {}",
                difference(&as_stored)
            );
        }
    }
}

#[test]
fn empty_and_foreign_files_are_refused() {
    assert!(error(&[]).contains("0 bytes"));
    assert!(error(b"GIF89a................").contains("format is GIF"));
    assert!(error(b"not a picture at all").contains("PNG, JPEG"));
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
    assert!(error(&header_only(32769, 64)).contains("64 to 32768"));
    assert!(error(&header_only(8193, 8192)).contains("67108864 in all"));
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
