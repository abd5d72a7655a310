//! Photographs in every format: the same clouds, or an error that says what to do.

#![allow(clippy::unwrap_used, reason = "a test may stop where it fails")]

mod animated;
mod files;
mod limits;
mod profiles;

use std::io::Cursor;

use image::codecs::webp::WebPEncoder;
use image::{DynamicImage, ExtendedColorType, ImageEncoder, ImageFormat, RgbImage};
use welkin_baker::{PhotoSettings, photo_channel};
use welkin_pack::Image;

use files::{exr, tiff};

use crate::common::sky;

fn settings() -> PhotoSettings {
    PhotoSettings {
        size: 64,
        mean: Some(0.3),
        ..PhotoSettings::default()
    }
}

fn channel(bytes: &[u8]) -> Image {
    photo_channel(bytes, "sky.png", &settings()).unwrap()
}

fn error(bytes: &[u8]) -> String {
    let made = photo_channel(bytes, "sky.png", &settings()).map(|image| image.width);
    let error = made
        .expect_err("a photograph that must be refused")
        .to_string();
    assert!(
        error.starts_with("sky.png: ") && error.contains("expected"),
        "{error}"
    );
    error
}

fn encoded(picture: &DynamicImage, format: ImageFormat) -> Vec<u8> {
    let mut bytes = Cursor::new(Vec::new());
    picture.write_to(&mut bytes, format).unwrap();
    bytes.into_inner()
}

fn png(picture: &RgbImage) -> Vec<u8> {
    encoded(&picture.clone().into(), ImageFormat::Png)
}

/// Mean difference of two channels.
fn difference(a: &Image, b: &Image) -> f32 {
    let pairs = a.texels.iter().zip(&b.texels);
    pairs.map(|(x, y)| (x - y).abs()).sum::<f32>() / a.texels.len() as f32
}

/// IEC 61966-2-1.
fn linear(stored: u8) -> f32 {
    let v = f32::from(stored) / 255.0;
    if v <= 0.04045 {
        v / 12.92
    } else {
        libm::powf((v + 0.055) / 1.055, 2.4)
    }
}

/// A tag is what a picture's rows are turned by: here three quarters to the left.
fn turned(picture: &RgbImage) -> RgbImage {
    image::imageops::rotate270(picture)
}

#[test]
fn every_lossless_format_gives_the_same_clouds_under_any_name() {
    let picture = sky(150, 100);
    let whole = DynamicImage::from(picture.clone());
    let expected = channel(&png(&picture));
    for (name, bytes) in [
        (
            "16 bits",
            encoded(&whole.to_rgb16().into(), ImageFormat::Png),
        ),
        ("alpha", encoded(&whole.to_rgba8().into(), ImageFormat::Png)),
        (
            "16 bits and alpha",
            encoded(&whole.to_rgba16().into(), ImageFormat::Png),
        ),
        ("TIFF", encoded(&whole, ImageFormat::Tiff)),
        (
            "TIFF of 16 bits",
            encoded(&whole.to_rgb16().into(), ImageFormat::Tiff),
        ),
        (
            "TIFF with alpha",
            encoded(&whole.to_rgba8().into(), ImageFormat::Tiff),
        ),
        ("WebP", encoded(&whole, ImageFormat::WebP)),
        (
            "WebP with alpha",
            encoded(&whole.to_rgba8().into(), ImageFormat::WebP),
        ),
    ] {
        assert_eq!(difference(&channel(&bytes), &expected), 0.0, "{name}");
    }
    let jpeg = channel(&encoded(&whole, ImageFormat::Jpeg));
    assert!(
        difference(&jpeg, &expected) < 0.03,
        "{}",
        difference(&jpeg, &expected)
    );
}

#[test]
fn grey_formats_give_the_same_clouds() {
    let grey = DynamicImage::from(sky(150, 100)).to_luma8();
    let of = |picture: DynamicImage, format| channel(&encoded(&picture, format));
    let expected = of(grey.clone().into(), ImageFormat::Png);
    let whole = DynamicImage::from(grey);
    for (name, found) in [
        ("16 bits", of(whole.to_luma16().into(), ImageFormat::Png)),
        ("alpha", of(whole.to_luma_alpha8().into(), ImageFormat::Png)),
        ("TIFF", of(whole.clone(), ImageFormat::Tiff)),
        (
            "TIFF of 16 bits",
            of(whole.to_luma16().into(), ImageFormat::Tiff),
        ),
        ("WebP", of(whole.to_rgb8().into(), ImageFormat::WebP)),
    ] {
        assert_eq!(difference(&found, &expected), 0.0, "{name}");
    }
}

/// Light whose brightest hundredth is white is what sRGB encodes; ten times as much of it is exposed to the same.
#[test]
fn light_gives_the_clouds_of_its_picture() {
    let mut picture = sky(150, 100);
    for x in 0..150 {
        picture.put_pixel(x, 0, image::Rgb([255; 3]));
        picture.put_pixel(x, 99, image::Rgb([255; 3]));
    }
    let expected = channel(&png(&picture));
    for gain in [1.0, 10.0] {
        let light = picture.pixels().flat_map(|p| p.0).map(|v| gain * linear(v));
        let light: Vec<f32> = light.collect();
        let as_exr = exr(150, 100, &light);
        let found = difference(&channel(&as_exr), &expected);
        assert!(found < 1e-3, "EXR: {found}");
        let buffer = image::Rgb32FImage::from_raw(150, 100, light).unwrap();
        let found = encoded(&buffer.clone().into(), ImageFormat::Tiff);
        assert!(
            difference(&channel(&found), &expected) < 1e-3,
            "TIFF of floats"
        );
        let found = encoded(&buffer.into(), ImageFormat::Hdr);
        // A texel of three colours shares an exponent, with a hundredth of the largest as the least step.
        assert!(difference(&channel(&found), &expected) < 0.02, "HDR");
    }
}

#[test]
fn light_that_is_not_a_number_is_told_with_its_place_and_infinity_is_white() {
    let mut light: Vec<f32> = sky(100, 100)
        .pixels()
        .flat_map(|p| p.0)
        .map(linear)
        .collect();
    light[(7 * 100 + 5) * 3] = f32::INFINITY;
    channel(&exr(100, 100, &light));
    light[(9 * 100 + 4) * 3 + 1] = f32::NAN;
    let error = error(&exr(100, 100, &light));
    assert!(
        error.contains("not a number in 1 texels, the first in column 4, row 9"),
        "{error}"
    );
    let black = photo_channel(&exr(100, 100, &[0.0; 30_000]), "b.exr", &settings());
    let text = black.unwrap_err().to_string();
    assert!(text.contains("radiance is 0"), "{text}");
}

#[test]
fn tiff_and_webp_are_turned_as_their_camera_says() {
    let upright = sky(90, 120);
    let expected = channel(&png(&upright));
    let stored = turned(&upright);
    let (width, height) = stored.dimensions();
    let as_tiff = tiff(&stored, 2, &[(0x0112, 3, 6_u16.to_le_bytes().to_vec())]);
    assert_eq!(difference(&channel(&as_tiff), &expected), 0.0);
    let mut webp = Vec::new();
    let mut encoder = WebPEncoder::new_lossless(&mut webp);
    let exif = b"II*\0\x08\0\0\0\x01\0\x12\x01\x03\0\x01\0\0\0\x06\0\0\0\0\0\0\0";
    encoder.set_exif_metadata(exif.to_vec()).unwrap();
    encoder
        .write_image(&stored, width, height, ExtendedColorType::Rgb8)
        .unwrap();
    assert_eq!(difference(&channel(&webp), &expected), 0.0);
    // Without the tag the clouds are others.
    assert!(difference(&channel(&png(&stored)), &expected) > 0.04);
}

#[test]
fn what_is_transparent_is_clear_sky() {
    let opaque = sky(160, 160);
    let mut picture = DynamicImage::from(opaque.clone()).to_rgba8();
    let in_hole = |x: u32, y: u32| {
        let [x, y] = [x, y].map(|i| f64::from(i) - 100.0);
        x * x + y * y < 900.0
    };
    for (x, y, pixel) in picture.enumerate_pixels_mut() {
        if in_hole(x, y) {
            *pixel = image::Rgba([0; 4]);
        }
    }
    let whole = channel(&png(&opaque));
    let holed = channel(&encoded(&picture.into(), ImageFormat::Png));
    let mean = |image: &Image, is_in: bool| {
        let texels = (0..64 * 64_u32).filter(|i| {
            // The tile has four fifths of the photograph, and one margin is blended.
            let [x, y] = [i % 64, i / 64].map(|i| i * 2);
            let [x, y] = [x, y].map(|i| f64::from(i) - 100.0);
            (x * x + y * y < 600.0) == is_in
        });
        let values: Vec<f32> = texels.map(|i| image.texels[i as usize]).collect();
        values.iter().sum::<f32>() / values.len() as f32
    };
    assert!(mean(&holed, true) < 0.02, "{}", mean(&holed, true));
    assert!(mean(&whole, true) > 0.1, "{}", mean(&whole, true));
    assert!(mean(&holed, false) > 0.2, "{}", mean(&holed, false));
}

#[test]
fn a_cloud_cut_out_of_its_sky_has_its_outline_even_where_it_is_of_one_colour() {
    let puff = image::RgbaImage::from_fn(128, 128, |x, y| {
        let [x, y] = [x, y].map(|i| f64::from(i) - 64.0);
        let edge = (1.5 - libm::sqrt(x * x + y * y) / 32.0).clamp(0.0, 1.0);
        image::Rgba([240, 240, 240, (edge * 255.0) as u8])
    });
    let tile = channel(&encoded(&puff.into(), ImageFormat::Png));
    let [middle, corner] = [(32, 32), (1, 60)].map(|(x, y)| tile.texel(x, y)[0]);
    assert!(middle > corner + 0.3, "{middle} {corner}");
}
