//! What the values of each format become.

use std::collections::BTreeMap;
use std::io::Cursor;
use std::ops::ControlFlow;
use std::sync::Mutex;

use exr::prelude::Compression;
use image::codecs::hdr::HdrEncoder;
use image::codecs::png::PngEncoder;
use image::{DynamicImage, ExtendedColorType, ImageBuffer, ImageEncoder, ImageFormat, Rgb, Rgba};
use welkin_baker::{Inputs, Notice, Recipe, bake_from, skybox_faces};
use welkin_pack::Image;

use super::{bake, exr, panorama, plain_exr, scene, settings, worst};

fn encoded(picture: impl Into<DynamicImage>, format: ImageFormat) -> Vec<u8> {
    let mut bytes = Cursor::new(Vec::new());
    picture.into().write_to(&mut bytes, format).unwrap();
    bytes.into_inner()
}

/// The one value of a baked picture of one colour.
fn flat(name: &str, bytes: &[u8]) -> [f32; 4] {
    let faces = bake(name, bytes, Some(16)).unwrap();
    let first = faces[0].texel(0, 0).to_vec();
    for texel in faces.iter().flat_map(|face| face.texels.chunks_exact(4)) {
        for (a, b) in texel.iter().zip(&first) {
            assert!((a - b).abs() <= 1e-6 * b.abs(), "{texel:?} {first:?}");
        }
    }
    [first[0], first[1], first[2], first[3]]
}

fn assert_close(found: [f32; 4], expected: [f32; 4], share: f32) {
    for (a, b) in found.iter().zip(expected) {
        assert!(
            (a - b).abs() <= share * b.abs() + 1e-6,
            "{found:?} {expected:?}"
        );
    }
}

/// Stored 0, 1/2, 1 in sRGB are 0, 0.21404, 1 in light (IEC 61966-2-1); 188 of 255 is the byte nearest to half.
#[test]
fn pictures_of_few_bits_are_decoded_from_srgb() {
    let png8 = ImageBuffer::from_pixel(64, 32, Rgb([0_u8, 188, 255]));
    let light = [0.0, 0.502_886_5, 1.0, 1.0];
    assert_close(
        flat("sky.png", &encoded(png8.clone(), ImageFormat::Png)),
        light,
        1e-5,
    );
    // A JPEG's colour is rounded on its way: two steps of a byte here, each 1.8 % of the light in between.
    let jpeg = flat("sky.jpg", &encoded(png8, ImageFormat::Jpeg));
    assert!(
        (jpeg[1] - light[1]).abs() < 0.02 && jpeg[0] < 0.01 && jpeg[2] > 0.98,
        "{jpeg:?}"
    );
    let png16 = ImageBuffer::from_pixel(64, 32, Rgb([0_u16, 32768, 65535]));
    let light = [0.0, 0.214_049, 1.0, 1.0];
    assert_close(
        flat(
            "sky.png",
            &encoded(DynamicImage::ImageRgb16(png16), ImageFormat::Png),
        ),
        light,
        1e-4,
    );
}

#[test]
fn alpha_is_cover_and_weighs_the_radiance() {
    let half = ImageBuffer::from_pixel(64, 32, Rgba([255_u8, 188, 0, 51]));
    let found = flat("sky.png", &encoded(half, ImageFormat::Png));
    assert_close(found, [0.2, 0.2 * 0.502_886_5, 0.0, 0.2], 1e-5);
    let clear = ImageBuffer::from_pixel(64, 32, Rgba([255_u8, 255, 255, 0]));
    assert_eq!(flat("sky.png", &encoded(clear, ImageFormat::Png)), [0.0; 4]);
    // OpenEXR stores colours times alpha already.
    let picture = panorama(64, |_| [0.2, 0.1, 3.0, 0.25]);
    assert_close(
        flat("sky.exr", &plain_exr(&picture)),
        [0.2, 0.1, 3.0, 0.25],
        1e-6,
    );
}

/// The middle of a border between white and nothing is half white and half there: no dark rim.
#[test]
fn the_rim_of_what_is_covered_keeps_its_colour() {
    let picture = ImageBuffer::from_fn(128, 64, |_, y| {
        Rgba([255_u8, 255, 255, if y < 32 { 255 } else { 0 }])
    });
    let faces = bake("sky.png", &encoded(picture, ImageFormat::Png), Some(16)).unwrap();
    for texel in faces.iter().flat_map(|face| face.texels.chunks_exact(4)) {
        assert!((texel[0] - texel[3]).abs() < 1e-6, "{texel:?}");
    }
}

#[test]
fn radiance_hdr_is_taken_as_stored_under_either_signature() {
    // Powers of two: a shared exponent holds them exactly.
    let pixels = vec![Rgb([64.0_f32, 2.0, 0.5]); 64 * 32];
    let mut bytes = Vec::new();
    HdrEncoder::new(&mut bytes).encode(&pixels, 64, 32).unwrap();
    let expected = [64.0, 2.0, 0.5, 1.0];
    assert_close(flat("sky.hdr", &bytes), expected, 1e-6);
    let text = b"#?RADIANCE\n";
    assert!(bytes.starts_with(text));
    let older = [b"#?RGBE\nEXPOSURE=3\n", &bytes[text.len()..]].concat();
    assert_close(flat("sky.hdr", &older), expected, 1e-6);
    // What a file is, its content says.
    assert_close(flat("sky.png", &bytes), expected, 1e-6);
}

/// A camera that was held upright says so; its rows are the picture's columns.
#[test]
fn a_picture_that_lies_on_its_side_is_turned_upright() {
    let upright = ImageBuffer::from_fn(64, 32, |x, y| Rgb([4 * x as u8, 8 * y as u8, 90_u8]));
    let expected = bake(
        "sky.png",
        &encoded(upright.clone(), ImageFormat::Png),
        Some(16),
    )
    .unwrap();
    // Exif 2.32, orientation 6: row 0 of the file is the right side, column 0 the top.
    let stored = ImageBuffer::from_fn(32, 64, |x, y| *upright.get_pixel(63 - y, x));
    let mut bytes = Vec::new();
    let mut encoder = PngEncoder::new(&mut bytes);
    encoder.set_exif_metadata(exif(6)).unwrap();
    encoder
        .write_image(stored.as_raw(), 32, 64, ExtendedColorType::Rgb8)
        .unwrap();
    assert_eq!(bake("sky.png", &bytes, Some(16)).unwrap(), expected);
}

/// The least Exif block that has an orientation: a TIFF header, one entry, no further directory.
fn exif(orientation: u8) -> Vec<u8> {
    let mut bytes = b"MM\0\x2a\0\0\0\x08\0\x01\x01\x12\0\x03\0\0\0\x01\0".to_vec();
    bytes.extend([orientation, 0, 0, 0, 0, 0, 0]);
    bytes
}

/// A sun that a half float does not hold: a gain that is low enough keeps the light that the same gain after the cut would
/// have lost.
#[test]
fn a_gain_keeps_the_light_of_a_sun() {
    let sun = panorama(64, |[_, up, _]| {
        if up > 0.9 {
            [4e5, 2e5, 1e5, 1.0]
        } else {
            [1.0; 4]
        }
    });
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("sun.exr"), plain_exr(&sun)).unwrap();
    let mut settings = settings("sun.exr", Some(16));
    settings.gain = 0.1;
    let faces = skybox_faces(&settings, Some(folder.path())).unwrap();
    assert_eq!(faces[2].texel(8, 8), [4e4, 2e4, 1e4, 1.0]);
    settings.gain = 1.0;
    let faces = skybox_faces(&settings, Some(folder.path())).unwrap();
    assert_eq!(faces[2].texel(8, 8), [65504.0, 65504.0, 65504.0, 1.0]);
}

/// What a bake tells of a skybox that was cut, and that the gain which it names is told of no more.
#[test]
fn a_bake_tells_how_much_light_was_cut_and_which_gain_keeps_it() {
    let sun = panorama(64, |_| [4e5, 2e5, 1e5, 1.0]);
    let files = BTreeMap::from([("sun.exr".to_string(), plain_exr(&sun))]);
    let notices = |gain: f32| {
        let text = format!("{SMALL}[skybox]\nfile = \"sun.exr\"\nsize = 16\ngain = {gain}\n");
        let resolved = Recipe::parse("sky.toml", &text)
            .unwrap()
            .resolve(None)
            .unwrap();
        let told = Mutex::new(Vec::new());
        bake_from(&resolved, Inputs::Memory(&files), &|progress| {
            told.lock().unwrap().extend(progress.notice);
            ControlFlow::Continue(())
        })
        .unwrap();
        told.into_inner().unwrap()
    };
    let told = notices(1.0);
    let [Notice::SkyboxClipped(clipped)] = told[..] else {
        panic!("{told:?}");
    };
    let luminance = |[r, g, b]: [f32; 3]| 0.2126 * r + 0.7152 * g + 0.0722 * b;
    let expected = 1.0 - luminance([65504.0; 3]) / luminance([4e5, 2e5, 1e5]);
    assert!(
        (clipped.share - expected).abs() < 1e-4,
        "{clipped:?} {expected}"
    );
    assert_eq!(clipped.texels, 6 * 16 * 16);
    assert_eq!(
        (clipped.brightest, clipped.keeping_gain),
        (4e5, Some(0.163))
    );
    let text = told[0].to_string();
    assert!(
        text.contains("% of the light was cut; `skybox.gain = 0.163` keeps all of it"),
        "{text}"
    );
    assert!(notices(0.163).is_empty());
}

const SMALL: &str = "[clouds]\nsize = 64\n[stars]\nsize = 64\ncount = 50\n[galaxy]\nsize = 32\n[fbm]\nsize = 64\ncells = 16\n\
    [flares]\nsize = 64\n[layers]\nsize = 64\n[sprites]\nsize = 128\n[field]\nsections = 0\n";

#[test]
fn every_compression_of_openexr_is_read() {
    let picture = panorama(64, scene);
    let lossless = bake("sky.exr", &plain_exr(&picture), None).unwrap();
    let names = ["R", "G", "B", "A"];
    let exact = [
        Compression::Uncompressed,
        Compression::RLE,
        Compression::ZIP1,
        Compression::ZIP16,
        Compression::PIZ,
    ];
    for compression in exact {
        let faces = bake("sky.exr", &exr(&picture, &names, compression, false), None).unwrap();
        assert_eq!(faces, lossless, "{compression}");
    }
    // PXR24 keeps 16 bits of mantissa, halves 11; B44 and DWA are made to lose what is hardly seen.
    let lossy = [
        (Compression::PXR24, false, 2e-4),
        (Compression::PXR24, true, 2e-3),
        (Compression::B44, true, 0.1),
        (Compression::B44A, true, 0.1),
        (Compression::DWAA(None), true, 0.1),
        (Compression::DWAB(None), true, 0.1),
    ];
    for (compression, halves, share) in lossy {
        let faces = bake("sky.exr", &exr(&picture, &names, compression, halves), None).unwrap();
        let texels = |faces: &[Image]| -> Vec<f32> {
            faces.iter().flat_map(|face| face.texels.clone()).collect()
        };
        for (a, b) in texels(&faces).iter().zip(texels(&lossless)) {
            assert!((a - b).abs() <= share * b.abs(), "{compression}: {a} {b}");
        }
    }
}

#[test]
fn an_openexr_without_alpha_covers_all() {
    let picture = panorama(64, |[x, y, z]| [1.0 + x, 1.0 + y, 1.0 + z, 1.0]);
    let bytes = exr(&picture, &["R", "G", "B"], Compression::ZIP16, false);
    let faces = bake("sky.exr", &bytes, None).unwrap();
    assert!(worst(&faces, |[x, y, z]| [1.0 + x, 1.0 + y, 1.0 + z, 1.0]) < 0.01);
}

#[test]
fn the_gain_multiplies_radiance_but_not_cover() {
    let folder = tempfile::tempdir().unwrap();
    let picture = panorama(64, |_| [0.5, 0.25, 2.0, 0.75]);
    std::fs::write(folder.path().join("sky.exr"), plain_exr(&picture)).unwrap();
    let mut settings = settings("sky.exr", Some(16));
    settings.gain = 3.0;
    let faces = skybox_faces(&settings, Some(folder.path())).unwrap();
    let texel = faces[5].texel(7, 7);
    assert_close(
        [texel[0], texel[1], texel[2], texel[3]],
        [1.5, 0.75, 6.0, 0.75],
        1e-6,
    );
}

#[test]
fn radiance_that_no_half_holds_is_clamped() {
    let picture = panorama(64, |[east, up, _]| {
        let sun = if up > 0.5 { f32::INFINITY } else { 1e6 };
        [sun, -3.0, 0.5, if east > 0.0 { 1.5 } else { -0.5 }]
    });
    let faces = bake("sky.exr", &plain_exr(&picture), Some(16)).unwrap();
    for texel in faces.iter().flat_map(|face| face.texels.chunks_exact(4)) {
        assert!((texel[0] - 65504.0).abs() < 0.1, "{texel:?}");
        assert_eq!([texel[1], texel[2]], [0.0, 0.5]);
        assert!((0.0..=1.0).contains(&texel[3]));
    }
}
