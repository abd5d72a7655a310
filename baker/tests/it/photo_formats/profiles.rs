//! What stored values mean: ICC profiles and PNG's gamma.

use image::codecs::jpeg::JpegEncoder;
use image::codecs::png::PngEncoder;
use image::codecs::webp::WebPEncoder;
use image::{DynamicImage, ExtendedColorType, GrayImage, ImageEncoder, ImageFormat, RgbImage};

use super::files::{chunk, find_chunk, tiff};
use super::{channel, difference, encoded, error, linear, png, sky};

/// A profile with these tags, ICC.1:2010, 7.2 and 7.3.
fn icc(space: &[u8; 4], tags: &[(&[u8; 4], Vec<u8>)]) -> Vec<u8> {
    let mut header = vec![0; 128];
    header[8] = 4;
    header[12..16].copy_from_slice(b"mntr");
    header[16..20].copy_from_slice(space);
    header[20..24].copy_from_slice(b"XYZ ");
    header[36..40].copy_from_slice(b"acsp");
    header.extend((tags.len() as u32).to_be_bytes());
    let mut at = header.len() + 12 * tags.len();
    for (name, data) in tags {
        header.extend(*name);
        header.extend((at as u32).to_be_bytes());
        header.extend((data.len() as u32).to_be_bytes());
        at += data.len();
    }
    header.extend(tags.iter().flat_map(|(_, data)| data.clone()));
    let length = (header.len() as u32).to_be_bytes();
    header[..4].copy_from_slice(&length);
    header
}

fn xyz(values: [f64; 3]) -> Vec<u8> {
    let mut data = b"XYZ \0\0\0\0".to_vec();
    data.extend(
        values
            .iter()
            .flat_map(|v| ((v * 65536.0) as i32).to_be_bytes()),
    );
    data
}

fn gamma(gamma: f64) -> Vec<u8> {
    let mut data = b"curv\0\0\0\0\0\0\0\x01".to_vec();
    data.extend(((gamma * 256.0) as u16).to_be_bytes());
    data
}

/// The sRGB of most files: a table of the curve, and its colours.
fn srgb() -> Vec<u8> {
    let mut curve = b"curv\0\0\0\0\0\0\x01\0".to_vec();
    curve.extend((0..=255).flat_map(|v| ((linear(v) * 65535.0 + 0.5) as u16).to_be_bytes()));
    rgb(
        [
            [0.4361, 0.2225, 0.0139],
            [0.3851, 0.7169, 0.0971],
            [0.1431, 0.0606, 0.7141],
        ],
        curve,
    )
}

/// Adobe RGB (1998), 4.3.1.1 and 4.3.4.2, its colours as profiles have them, for D50.
fn adobe() -> Vec<u8> {
    rgb(
        [
            [0.60974, 0.31111, 0.01947],
            [0.20528, 0.62567, 0.06087],
            [0.14919, 0.06322, 0.74457],
        ],
        gamma(2.199_218_75),
    )
}

fn rgb(colours: [[f64; 3]; 3], curve: Vec<u8>) -> Vec<u8> {
    let [r, g, b] = colours.map(xyz);
    let tags: [(&[u8; 4], Vec<u8>); 6] = [
        (b"rXYZ", r),
        (b"gXYZ", g),
        (b"bXYZ", b),
        (b"rTRC", curve.clone()),
        (b"gTRC", curve.clone()),
        (b"bTRC", curve),
    ];
    icc(b"RGB ", &tags)
}

fn png_with(picture: &DynamicImage, icc: Vec<u8>) -> Vec<u8> {
    let mut bytes = Vec::new();
    let mut encoder = PngEncoder::new(&mut bytes);
    encoder.set_icc_profile(icc).unwrap();
    let (width, height) = (picture.width(), picture.height());
    encoder
        .write_image(picture.as_bytes(), width, height, picture.color().into())
        .unwrap();
    bytes
}

/// The sky of sRGB as Adobe RGB stores it. Its red and its green are others', by the inverse of the matrix of its colours
/// times that of sRGB.
fn as_adobe(picture: &RgbImage) -> RgbImage {
    const MATRIX: [[f32; 3]; 3] = [
        [0.715_12, 0.284_88, 0.0],
        [0.0, 1.0, 0.0],
        [0.0, 0.041_17, 0.958_83],
    ];
    let mut stored = picture.clone();
    for pixel in stored.pixels_mut() {
        let light = pixel.0.map(linear);
        pixel.0 = MATRIX.map(|row| {
            let light: f32 = row.iter().zip(light).map(|(m, v)| m * v).sum();
            (libm::powf(light, 1.0 / 2.199_218_8) * 255.0 + 0.5) as u8
        });
    }
    stored
}

#[test]
fn a_picture_in_adobe_rgb_gives_the_clouds_of_the_same_in_srgb() {
    let picture = sky(150, 100);
    let expected = channel(&png(&picture));
    let stored = as_adobe(&picture);
    let found = channel(&png_with(&stored.clone().into(), adobe()));
    let with_profile = difference(&found, &expected);
    let without = difference(&channel(&png(&stored)), &expected);
    assert!(
        with_profile < 0.01 && without > 2.0 * with_profile,
        "{with_profile} {without}"
    );
    let same = |bytes: &[u8], most: f32| {
        let found = difference(&channel(bytes), &found);
        assert!(found <= most, "{found}");
    };
    same(&tiff(&stored, 2, &[(0x8773, 7, adobe())]), 0.0);
    let mut webp = Vec::new();
    let mut encoder = WebPEncoder::new_lossless(&mut webp);
    encoder.set_icc_profile(adobe()).unwrap();
    encoder
        .write_image(&stored, 150, 100, ExtendedColorType::Rgb8)
        .unwrap();
    same(&webp, 0.0);
    let mut jpeg = Vec::new();
    let mut encoder = JpegEncoder::new_with_quality(&mut jpeg, 98);
    encoder.set_icc_profile(adobe()).unwrap();
    encoder
        .encode(&stored, 150, 100, ExtendedColorType::Rgb8)
        .unwrap();
    same(&jpeg, 0.02);
}

#[test]
fn a_profile_of_srgb_changes_no_byte() {
    let picture = sky(150, 100);
    let found = channel(&png_with(&picture.clone().into(), srgb()));
    assert_eq!(difference(&found, &channel(&png(&picture))), 0.0);
}

#[test]
fn a_grey_profile_tells_the_curve() {
    let grey = DynamicImage::from(sky(150, 100)).to_luma8();
    let expected = channel(&encoded(&grey.clone().into(), ImageFormat::Png));
    // Stored straight: as light.
    let light = GrayImage::from_fn(150, 100, |x, y| {
        image::Luma([(linear(grey.get_pixel(x, y)[0]) * 255.0 + 0.5) as u8])
    });
    let profile = icc(b"GRAY", &[(b"kTRC", gamma(1.0))]);
    let found = difference(&channel(&png_with(&light.into(), profile)), &expected);
    assert!(found < 0.01, "{found}");
}

#[test]
fn a_png_that_tells_a_gamma_is_read_by_it() {
    let grey = DynamicImage::from(sky(150, 100)).to_luma8();
    let straight = GrayImage::from_fn(150, 100, |x, y| {
        image::Luma([(linear(grey.get_pixel(x, y)[0]) * 255.0 + 0.5) as u8])
    });
    let [usual, straight] = [grey, straight].map(|p| encoded(&p.into(), ImageFormat::Png));
    let expected = channel(&usual);
    let with = |png: &[u8], gamma: u32| {
        let (at, _) = find_chunk(png, b"IDAT");
        [
            &png[..at],
            &chunk(b"gAMA", &gamma.to_be_bytes()),
            &png[at..],
        ]
        .concat()
    };
    let found = difference(&channel(&with(&straight, 100_000)), &expected);
    assert!(found < 0.01, "{found}");
    for usual_gamma in [45_455, 45_454, 45_500, 0] {
        assert_eq!(
            difference(&channel(&with(&usual, usual_gamma)), &expected),
            0.0
        );
    }
}

#[test]
fn profiles_that_are_not_used_are_told_with_what_to_do() {
    let picture = DynamicImage::from(sky(100, 100));
    let of = |profile: Vec<u8>| error(&png_with(&picture, profile));
    for (profile, expected) in [
        (
            icc(b"CMYK", &[]),
            "ICC profile is of CMYK, expected one of RGB or GRAY",
        ),
        (icc(b"RGB ", &[]), "ICC profile is one of tables"),
        (icc(b"GRAY", &[]), "ICC profile is broken"),
        (b"no profile at all".to_vec(), "ICC profile is broken"),
        (
            icc(
                b"GRAY",
                &[(b"kTRC", b"curv\0\0\0\0\xff\xff\xff\xff".to_vec())],
            ),
            "is broken",
        ),
    ] {
        let error = of(profile);
        assert!(
            error.contains(expected) && error.contains("sRGB"),
            "{error}"
        );
    }
}

#[test]
fn inks_are_refused() {
    let picture = sky(100, 100);
    assert!(error(&tiff(&picture, 5, &[])).contains("colours is CMYK"));
    // A frame of four components (ITU-T T.81, B.2.2), and nothing behind it.
    let mut jpeg = b"\xff\xd8\xff\xc0\0\x14\x08\0\x64\0\x64\x04".to_vec();
    jpeg.extend([1, 0x11, 0, 2, 0x11, 0, 3, 0x11, 0, 4, 0x11, 0]);
    jpeg.extend(b"\xff\xd9");
    assert!(error(&jpeg).contains("colours is CMYK"), "{}", error(&jpeg));
}
