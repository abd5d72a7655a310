//! How small, how large, how long, how whole a photograph has to be.

use image::codecs::jpeg::JpegEncoder;
use image::{DynamicImage, ExtendedColorType, ImageFormat, RgbImage};
use welkin_baker::{PhotoFile, PhotoTile, photo_tile};

use super::files::exr;
use super::{encoded, error, linear, png, settings, sky};

fn tile(bytes: &[u8]) -> PhotoTile {
    let picture = PhotoFile {
        name: "large.png",
        bytes,
    };
    photo_tile(picture, None, &settings()).unwrap()
}

#[test]
fn a_single_texel_is_told_by_its_size() {
    let one = RgbImage::from_pixel(1, 1, image::Rgb([200, 210, 230]));
    let whole = DynamicImage::from(one);
    for format in [
        ImageFormat::Png,
        ImageFormat::Jpeg,
        ImageFormat::Tiff,
        ImageFormat::WebP,
    ] {
        let error = error(&encoded(&whole, format));
        assert!(
            error.contains("size is 1x1, expected 64 to 32768 texels a side"),
            "{error}"
        );
    }
    assert!(error(&exr(1, 1, &[0.5; 3])).contains("size is 1x1"));
}

#[test]
fn a_strip_of_a_horizon_is_taken_and_what_is_used_is_told() {
    let strip = sky(30_000, 80);
    let tile = tile(&png(&strip));
    assert_eq!(
        (tile.size, tile.region),
        ([30_000, 80], [14_960, 0, 80, 80])
    );
    let error = error(&png(&sky(30_000, 20)));
    assert!(error.contains("size is 30000x20"), "{error}");
}

/// 9504x6336, as Sony's camera of 61 million texels has them.
#[test]
fn sixty_million_texels_are_taken() {
    let (width, height) = (9504, 6336);
    let piece = sky(96, 64);
    let large = image::GrayImage::from_fn(width, height, |x, y| {
        image::Luma([piece.get_pixel(x / 99, y / 99)[0]])
    });
    let mut jpeg = Vec::new();
    let mut encoder = JpegEncoder::new_with_quality(&mut jpeg, 80);
    encoder
        .encode(large.as_raw(), width, height, ExtendedColorType::L8)
        .unwrap();
    drop(large);
    let tile = tile(&jpeg);
    assert_eq!(tile.region, [1584, 0, 6336, 6336]);
}

#[test]
fn a_part_of_a_file_is_refused_at_every_length() {
    let picture = sky(120, 90);
    let whole = DynamicImage::from(picture.clone());
    let light: Vec<f32> = picture.pixels().flat_map(|p| p.0).map(linear).collect();
    let hdr = encoded(&whole.to_rgb32f().into(), ImageFormat::Hdr);
    for (name, bytes) in [
        ("TIFF", encoded(&whole, ImageFormat::Tiff)),
        ("WebP", encoded(&whole, ImageFormat::WebP)),
        ("EXR", exr(120, 90, &light)),
        ("HDR", hdr),
    ] {
        for sixteenths in 1..16 {
            let part = &bytes[..bytes.len() * sixteenths / 16];
            assert!(!error(part).is_empty(), "{name}");
        }
    }
}
