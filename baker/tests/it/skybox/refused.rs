//! A clear error for everything that is not a sky.

use exr::meta::attribute::Chromaticities;
use exr::prelude::{
    AnyChannel, AnyChannels, Compression, Encoding, FlatSamples, Image as ExrImage, IntegerBounds,
    Layer, LayerAttributes, Vec2,
};
use image::codecs::hdr::HdrEncoder;
use image::{ImageFormat, Rgb, RgbImage};
use welkin_baker::{BakeError, skybox_faces};

use super::{bake, bake_faces, bytes_of, exr, panorama, plain_exr, scene, settings};

fn error(bytes: &[u8]) -> String {
    let size = bake("my sky", bytes, Some(16)).map(|faces| faces[0].width);
    let text = size
        .expect_err("a picture that must be refused")
        .to_string();
    // The file, what was found, what was expected.
    assert!(
        text.contains("my sky: ") && text.contains("expected"),
        "{text}"
    );
    text
}

fn png(width: u32, height: u32) -> Vec<u8> {
    let picture = RgbImage::from_fn(width, height, |x, y| Rgb([x as u8, y as u8, (x * y) as u8]));
    let mut bytes = std::io::Cursor::new(Vec::new());
    picture.write_to(&mut bytes, ImageFormat::Png).unwrap();
    bytes.into_inner()
}

fn jpeg() -> Vec<u8> {
    let mut bytes = std::io::Cursor::new(Vec::new());
    let picture = RgbImage::from_fn(128, 64, |x, y| Rgb([x as u8, y as u8, 7]));
    picture.write_to(&mut bytes, ImageFormat::Jpeg).unwrap();
    bytes.into_inner()
}

fn hdr(width: usize, height: usize) -> Vec<u8> {
    let pixels: Vec<_> = (0..width * height)
        .map(|i| Rgb([i as f32, 1.0, 0.5]))
        .collect();
    let mut bytes = Vec::new();
    HdrEncoder::new(&mut bytes)
        .encode(&pixels, width, height)
        .unwrap();
    bytes
}

#[test]
fn panoramas_must_be_twice_as_wide_as_high() {
    for (width, height) in [(64, 64), (100, 40), (32, 64), (129, 64), (1, 1)] {
        let text = error(&png(width, height));
        assert!(
            text.contains(&format!("{width}x{height}")) && text.contains("twice as wide"),
            "{text}"
        );
    }
    assert!(error(&hdr(64, 64)).contains("64x64"));
    let square = welkin_pack::Image::new(64, 64, 4);
    assert!(error(&plain_exr(&square)).contains("64x64"));
    assert!(error(&png(32, 16)).contains("32 to 4096 rows"));
}

#[test]
fn faces_must_be_square_and_of_one_size() {
    let folder = tempfile::tempdir().unwrap();
    let square = png(32, 32);
    let mut pictures = [(); 6].map(|()| square.clone());
    bake_faces(folder.path(), &pictures, None).unwrap();
    pictures[2] = png(32, 16);
    let text = bake_faces(folder.path(), &pictures, None)
        .unwrap_err()
        .to_string();
    assert!(
        text.contains("up.picture: size is 32x16") && text.contains("32x32"),
        "{text}"
    );
    pictures[2] = png(64, 64);
    let text = bake_faces(folder.path(), &pictures, None)
        .unwrap_err()
        .to_string();
    assert!(
        text.contains("up.picture: size is 64x64, expected 32x32, as `skybox.faces.east`"),
        "{text}"
    );
    pictures[0] = png(64, 32);
    let text = bake_faces(folder.path(), &pictures, None)
        .unwrap_err()
        .to_string();
    assert!(
        text.contains("east.picture: size is 64x32, expected a square"),
        "{text}"
    );
    pictures[0] = png(8, 8);
    let text = bake_faces(folder.path(), &pictures, None)
        .unwrap_err()
        .to_string();
    assert!(text.contains("16 to 2048"), "{text}");
}

#[test]
fn sizes_are_checked_before_anything_is_allocated() {
    let header = b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 2000000000 +X 4000000000\n";
    assert!(error(header).contains("4000000000x2000000000"));
    let mut tall = plain_exr(&panorama(64, scene));
    let window = |bytes: &[u8]| {
        let name = b"dataWindow\0box2i\0";
        bytes.windows(name.len()).position(|w| w == name).unwrap() + name.len() + 4
    };
    // The far corner of data and display window, as little-endian integers.
    let places = [
        window(&tall),
        window(&tall) + 16 + b"displayWindow\0box2i\0".len() + 4,
    ];
    for place in places {
        tall[place + 8..place + 16].copy_from_slice(&[0xff, 0xff, 0, 1, 0xff, 0xff, 0, 1]);
    }
    error(&tall);
}

#[test]
fn foreign_and_empty_files_are_refused() {
    assert!(error(&[]).contains("0 bytes"));
    for bytes in [
        &b"GIF89a................"[..],
        b"not a picture at all",
        b"#?RAD",
        b"v/1",
    ] {
        let text = error(bytes);
        assert!(text.contains("OpenEXR file; convert it"), "{text}");
    }
}

#[test]
fn truncated_files_are_refused_at_every_length() {
    let picture = panorama(64, scene);
    let names = ["R", "G", "B", "A"];
    let files = [
        png(128, 64),
        jpeg(),
        hdr(128, 64),
        plain_exr(&picture),
        exr(&picture, &names, Compression::Uncompressed, false),
        exr(&picture, &names, Compression::DWAB(None), true),
    ];
    for whole in files {
        for sixteenths in 0..16 {
            error(&whole[..whole.len() * sixteenths / 16]);
        }
        error(&whole[..whole.len() - 20]);
    }
}

#[test]
fn damage_is_an_error_or_harmless_but_never_a_panic() {
    let picture = panorama(64, scene);
    let names = ["R", "G", "B", "A"];
    let files = [
        hdr(64, 32),
        plain_exr(&picture),
        exr(&picture, &names, Compression::PIZ, true),
        exr(&picture, &names, Compression::DWAA(None), true),
    ];
    for whole in files {
        // Every other byte of the headers, the rest here and there.
        let headers = (0..400).step_by(2);
        let places = headers
            .chain((400..).step_by(397))
            .take_while(|&at| at < whole.len());
        for at in places {
            let mut bytes = whole.clone();
            bytes[at] ^= 1 << (at % 8);
            drop(bake("my sky", &bytes, Some(16)));
        }
    }
}

#[test]
fn what_is_not_a_number_is_counted_and_refused() {
    for channel in 0..4 {
        let mut picture = panorama(64, scene);
        picture.texel_mut(5, 3)[channel] = f32::NAN;
        picture.texel_mut(63, 31)[channel] = f32::NAN;
        let text = error(&plain_exr(&picture));
        assert!(
            text.contains("not a number in 2 texels, the first in column 5, row 3"),
            "{text}"
        );
    }
}

#[test]
fn an_openexr_that_would_come_out_wrong_is_refused() {
    let picture = panorama(64, scene);
    let text = error(&exr(&picture, &["Y"], Compression::ZIP16, false));
    assert!(
        text.contains("channels is Y, expected R, G and B"),
        "{text}"
    );
    let layered = exr(
        &picture,
        &["sky.R", "sky.G", "sky.B"],
        Compression::ZIP16,
        false,
    );
    assert!(error(&layered).contains("sky.R"));

    let layer = |attributes: LayerAttributes| {
        let channel = |(index, name): (usize, &str)| {
            AnyChannel::new(name, FlatSamples::F32(picture.channel(index).collect()))
        };
        let channels = ["R", "G", "B"]
            .into_iter()
            .enumerate()
            .map(channel)
            .collect();
        let channels = AnyChannels::sort(channels);
        Layer::new((64, 32), attributes, Encoding::FAST_LOSSLESS, channels)
    };
    let mut cropped = ExrImage::from_layer(layer(LayerAttributes::default()));
    cropped.attributes.display_window = IntegerBounds::from_dimensions(Vec2(128, 64));
    let text = error(&bytes_of(cropped));
    assert!(
        text.contains("data window is 64x32 at 0, 0") && text.contains("128x64"),
        "{text}"
    );

    let mut wide = ExrImage::from_layer(layer(LayerAttributes::default()));
    // Primaries of ACES2065-1, SMPTE ST 2065-1.
    wide.attributes.chromaticities = Some(Chromaticities {
        red: Vec2(0.7347, 0.2653),
        green: Vec2(0.0, 1.0),
        blue: Vec2(0.0001, -0.077),
        white: Vec2(0.32168, 0.33767),
    });
    let text = error(&bytes_of(wide));
    assert!(
        text.contains("chromaticities is [[0.7347, 0.2653]") && text.contains("BT.709"),
        "{text}"
    );
}

#[test]
fn a_radiance_file_of_other_primaries_is_refused_as_an_openexr_is() {
    let whole = hdr(128, 64);
    let with = |line: &str| {
        let end = b"#?RADIANCE\n".len();
        [&whole[..end], line.as_bytes(), b"\n", &whole[end..]].concat()
    };
    // ACES2065-1 (SMPTE ST 2065-1), Display P3, BT.2020, and no numbers.
    for (line, found) in [
        (
            "PRIMARIES=0.7347 0.2653 0 1 0.0001 -0.077 0.32168 0.33767",
            "[[0.7347, 0.2653]",
        ),
        (
            "PRIMARIES=\t0.680 0.320 0.265 0.690 0.150 0.060 0.3127 0.3290",
            "[[0.68, 0.32]",
        ),
        (
            "PRIMARIES= 0.708 0.292 0.170 0.797 0.131 0.046 0.3127 0.3290",
            "[[0.708, 0.292]",
        ),
        (
            "PRIMARIES=0.64 0.33 0.3 0.6 0.15 0.06 0.3127 0.3290\nPRIMARIES=0.7 0.3 0.3 0.6 0.15 0.06 0.3127 0.3290",
            "[[0.7, 0.3]",
        ),
        (
            "PRIMARIES=nan 0.33 0.3 0.6 0.15 0.06 0.3127 0.3290",
            "[[NaN, 0.33]",
        ),
    ] {
        let text = error(&with(line));
        assert!(
            text.contains(&format!("PRIMARIES is {found}")) && text.contains("BT.709"),
            "{text}"
        );
    }
    for line in ["PRIMARIES=0.64 0.33", "PRIMARIES=red \u{1b}[31m"] {
        let text = error(&with(line));
        assert!(
            text.contains("expected eight numbers") && !text.contains('\u{1b}'),
            "{text}"
        );
    }
    // BT.709 as programs write it, nothing as Photoshop does, and what the format means by itself.
    for line in [
        "PRIMARIES=0.640 0.330 0.300 0.600 0.150 0.060 0.3127 0.3290",
        "PRIMARIES= .64 .33 .3 .6 .15 .06 .3127 .329",
        "PRIMARIES=0 0 0 0 0 0 0 0",
        "PRIMARIES=",
        "PRIMARIES=0.640 0.330 0.290 0.600 0.150 0.060 0.333 0.333",
    ] {
        bake("my sky", &with(line), Some(16)).unwrap();
    }
}

#[test]
fn files_that_cannot_be_read_are_named_with_their_key() {
    let folder = tempfile::tempdir().unwrap();
    let missing = skybox_faces(&settings("none.exr", None), Some(folder.path())).unwrap_err();
    assert!(
        matches!(&missing, BakeError::Read { file, key, .. } if file.ends_with("none.exr") && key == "skybox.file")
    );
    let text = missing.to_string();
    assert!(text.contains("check `skybox.file` in the recipe"), "{text}");
    let no_base = skybox_faces(&settings("none.exr", None), None).unwrap_err();
    assert!(matches!(&no_base, BakeError::NoBase { key, .. } if key == "skybox.file"));
    let square = png(32, 32);
    let pictures = [(); 6].map(|()| square.clone());
    bake_faces(folder.path(), &pictures, None).unwrap();
    std::fs::remove_file(folder.path().join("down.picture")).unwrap();
    let mut settings = settings("", None);
    settings.picture = welkin_baker::SkyboxPicture::Faces(
        welkin_pack::format::CUBE_FACES.map(|face| format!("{face}.picture")),
    );
    let text = skybox_faces(&settings, Some(folder.path()))
        .unwrap_err()
        .to_string();
    assert!(
        text.contains("down.picture") && text.contains("`skybox.faces.down`"),
        "{text}"
    );
}
