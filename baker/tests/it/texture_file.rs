//! Textures that another tool made: what is read is what the file holds, and all else is refused by name.

#![allow(clippy::unwrap_used, reason = "a test may stop where it fails")]

use std::io::Cursor;

use exr::prelude::{
    AnyChannel, AnyChannels, Encoding, FlatSamples, Image as Exr, Layer, LayerAttributes,
    WritableImage,
};
use image::codecs::png::PngEncoder;
use image::{ExtendedColorType, ImageEncoder};
use welkin_baker::{TextureFile, decode_texture};
use welkin_pack::check::check_texture;
use welkin_pack::{Format, Image, Pack, PackInfo, Role, Texture, ktx};

use crate::common;

const RECIPE: &str = "[clouds]\nsize = 64\n[stars]\nsize = 64\ncount = 60\n\
    [galaxy]\nsize = 32\n[sky]\nsuns = 16\n[sun]\nsize = 32\n\
    [fbm]\nsize = 64\ncells = 16\noctaves = 2\n[flares]\nsize = 64\n[layers]\nsize = 64\n[sprites]\nsize = 128\n";

fn pack() -> Pack {
    let (resolved, sources) = common::bake(RECIPE, None);
    let info = PackInfo {
        name: resolved.name,
        seed: resolved.seed,
        baker: "test".to_string(),
        recipe: resolved.recipe,
        inputs: Vec::new(),
        noon_elevation_rad: resolved.sun.noon_elevation_rad,
        aerosol_depths: resolved.sky.aerosol_depths,
        ..PackInfo::default()
    };
    Pack::build(info, sources).unwrap()
}

fn png(width: u32, height: u32, colour: ExtendedColorType, bytes: &[u8]) -> Vec<u8> {
    let mut png = Vec::new();
    let encoder = PngEncoder::new(&mut png);
    encoder.write_image(bytes, width, height, colour).unwrap();
    png
}

/// 32-bit floats, a channel each.
fn exr(width: u32, height: u32, channels: &[(&str, Vec<f32>)]) -> Vec<u8> {
    let channel = |(name, values): &(&str, Vec<f32>)| {
        AnyChannel::new(*name, FlatSamples::F32(values.clone()))
    };
    let channels = AnyChannels::sort(channels.iter().map(channel).collect());
    let size = (width as usize, height as usize);
    let layer = Layer::new(
        size,
        LayerAttributes::default(),
        Encoding::SMALL_LOSSLESS,
        channels,
    );
    let mut bytes = Cursor::new(Vec::new());
    Exr::from_layer(layer)
        .write()
        .non_parallel()
        .to_buffered(&mut bytes)
        .unwrap();
    bytes.into_inner()
}

fn named<'a>(image: &Image, names: &[&'a str]) -> Vec<(&'a str, Vec<f32>)> {
    names
        .iter()
        .enumerate()
        .map(|(i, name)| (*name, image.channel(i).collect()))
        .collect()
}

fn read(bytes: &[u8], role: Role) -> TextureFile {
    decode_texture(bytes, "made.file", role, None).unwrap()
}

fn refused(bytes: &[u8], role: Role, channel: Option<usize>) -> String {
    decode_texture(bytes, "made.file", role, channel)
        .unwrap_err()
        .to_string()
}

#[test]
fn every_role_comes_back_from_every_kind_of_file_and_is_sound() {
    let pack = pack();
    for entry in &pack.manifest().textures {
        let (role, texture) = (entry.role, pack.texture(entry.role).unwrap());
        let stacked = texture.stacked(0);
        let base = Texture {
            levels: texture.levels[..1].to_vec(),
            ..texture.clone()
        };
        assert_eq!(
            read(&ktx::encode("x", texture, "test").unwrap(), role).texture,
            *texture
        );
        assert_eq!(
            read(&ktx::encode("x", &base, "test").unwrap(), role).texture,
            base
        );

        let own: Vec<&str> = role.spec().channels.iter().map(|c| c.name).collect();
        let rgba = ["R", "G", "B", "A"];
        let names = if own.len() == 1 {
            &["Y"]
        } else {
            &rgba[..own.len()]
        };
        for names in [names, &own] {
            let bytes = exr(stacked.width, stacked.height, &named(&stacked, names));
            let found = read(&bytes, role).texture;
            if role == Role::Clouds {
                // Floats become half floats, where the role has them.
                assert_eq!(found.format, Format::Rgba16Float);
                let halves = found.stacked(0);
                let apart = halves
                    .texels
                    .iter()
                    .zip(&stacked.texels)
                    .map(|(a, b)| (a - b).abs());
                assert!(apart.fold(0.0, f32::max) < 1.0 / 4096.0);
            } else {
                assert_eq!(found, base, "{role:?} {names:?}");
            }
            assert!(
                check_texture(role, &found).is_sound() || role == Role::Clouds,
                "{role:?}"
            );
        }
        let colour = match texture.format {
            Format::R8Unorm => ExtendedColorType::L8,
            Format::Rg8Unorm => ExtendedColorType::La8,
            Format::Rgba8Unorm => ExtendedColorType::Rgba8,
            Format::Rgba16Float => continue,
        };
        let found = read(
            &png(stacked.width, stacked.height, colour, &texture.levels[0]),
            role,
        );
        assert_eq!((found.texture, found.notes.len()), (base, 0), "{role:?}");
    }
}

#[test]
fn what_is_changed_on_the_way_is_told() {
    let side = 32_u32;
    let count = (side * side) as usize;
    let words: Vec<u8> = (0..count)
        .flat_map(|i| ((i * 61) as u16).to_ne_bytes())
        .collect();
    let deep = read(
        &png(side, side, ExtendedColorType::L16, &words),
        Role::Galaxy,
    );
    assert!(deep.notes[0].contains("16-bit"), "{:?}", deep.notes);
    let rounded = |i: usize| (f64::from((i * 61) as u16) / 257.0).round() as u8;
    let expected: Vec<u8> = (0..count).map(rounded).collect();
    assert_eq!(deep.texture.levels, [expected]);

    let pixels: Vec<u8> = (0..count).flat_map(|i| [i as u8, 2, 3]).collect();
    let sun = read(
        &png(side, side, ExtendedColorType::Rgb8, &pixels),
        Role::Sun,
    );
    assert!(sun.notes[0].contains("red and green"), "{:?}", sun.notes);
    assert_eq!(sun.texture.levels[0][..4], [0, 2, 1, 2]);

    let floats = vec![("Y", vec![0.25; count])];
    let grey = read(&exr(side, side, &floats), Role::Galaxy);
    assert!(
        grey.notes[0].contains("rounded to bytes"),
        "{:?}",
        grey.notes
    );
    // Grey that was saved as colours is grey.
    let same: Vec<u8> = (0..count).flat_map(|i| [i as u8; 3]).collect();
    let grey = read(
        &png(side, side, ExtendedColorType::Rgb8, &same),
        Role::Galaxy,
    );
    assert_eq!(
        (grey.texture.format, grey.texture.levels[0][7]),
        (Format::R8Unorm, 7)
    );
}

#[test]
fn half_floats_that_are_no_numbers_reach_the_rules() {
    let names = ["R", "G", "B", "A"];
    let mut values: Vec<(&str, Vec<f32>)> =
        names.iter().map(|n| (*n, vec![0.5; 16 * 96])).collect();
    values[1].1[700] = f32::NAN;
    values[2].1[3] = 1e9;
    let texture = read(&exr(16, 96, &values), Role::Skybox).texture;
    assert_eq!((texture.layers, texture.levels.len()), (6, 1));
    assert!(texture.stacked(0).texels[700 * 4 + 1].is_nan());
    assert!(texture.stacked(0).texels[3 * 4 + 2].is_infinite());
    assert!(!check_texture(Role::Skybox, &texture).is_sound());
}

#[test]
fn one_channel_alone_is_put_where_it_belongs() {
    let grey: Vec<u8> = (0..64 * 64).map(|i| (i % 251) as u8).collect();
    let bytes = png(64, 64, ExtendedColorType::L8, &grey);
    let found = decode_texture(&bytes, "noise.png", Role::Clouds, Some(1))
        .unwrap()
        .texture;
    let image = found.image(0, 0);
    assert_eq!(
        image.channel(1).collect::<Vec<_>>(),
        grey.iter()
            .map(|&b| f32::from(b) / 255.0)
            .collect::<Vec<_>>()
    );
    assert!(image.channel(0).all(|v| v == 0.0));
    let colours: Vec<u8> = (0..64 * 64).flat_map(|i| [i as u8, 0, 0]).collect();
    let coloured = png(64, 64, ExtendedColorType::Rgb8, &colours);
    let error = refused(&coloured, Role::Clouds, Some(1));
    assert_eq!(
        error,
        "made.file: channels is coloured, expected grey: noise"
    );
}

#[test]
fn what_does_not_fit_is_refused_with_what_was_found_and_expected() {
    let blank = |width: u32, height: u32, colour: ExtendedColorType, channels: u32| {
        png(
            width,
            height,
            colour,
            &vec![0; (width * height * channels) as usize],
        )
    };
    let l = |w, h| blank(w, h, ExtendedColorType::L8, 1);
    let rgb = |w, h| blank(w, h, ExtendedColorType::Rgb8, 3);
    let rgba = |w, h| blank(w, h, ExtendedColorType::Rgba8, 4);
    let float = |names: &[&'static str]| {
        let channels: Vec<_> = names.iter().map(|n| (*n, vec![0.5; 64 * 64])).collect();
        exr(64, 64, &channels)
    };
    let sky = |width: u32, height: u32| {
        let values = vec![0.5; (width * height) as usize];
        exr(
            width,
            height,
            &["R", "G", "B", "A"].map(|n| (n, values.clone())),
        )
    };
    let mut out_of_range = vec![0.5_f32; 64 * 64];
    out_of_range[65] = 1.5;
    let r8 = Texture {
        format: Format::R8Unorm,
        shape: welkin_pack::Shape::D2,
        width: 64,
        height: 64,
        layers: 1,
        levels: vec![vec![0; 4096]],
    };
    let cases: Vec<(Vec<u8>, Role, &str)> = vec![
        (
            b"GIF89a".to_vec(),
            Role::Clouds,
            "format is unknown, expected a PNG, OpenEXR or KTX2 file",
        ),
        (Vec::new(), Role::Clouds, "format is unknown"),
        (
            rgb(64, 64),
            Role::Clouds,
            "channels is 3 (RGB), expected 4: photo, noise, detail, gradient",
        ),
        (
            l(64, 64),
            Role::Sun,
            "channels is 1 (grey), expected 2: disc, glow",
        ),
        (
            rgba(64, 64),
            Role::Galaxy,
            "channels is coloured, or transparent, expected grey: brightness",
        ),
        (
            rgba(500, 500),
            Role::Clouds,
            "width is 500, expected a power of two from 4 to 8192",
        ),
        (
            rgba(64, 32),
            Role::Clouds,
            "height is 32, expected 64, as the width",
        ),
        (
            rgba(64, 150),
            Role::Layers,
            "size is 64x150, expected layers of 64x64, one below the other",
        ),
        (rgba(64, 128), Role::Layers, "layers is 2, expected 3"),
        (
            sky(16, 48),
            Role::Sky,
            "size is 16x48, expected layers of 16x32, one below the other",
        ),
        (
            sky(8, 16 * 66),
            Role::Sky,
            "layers is 66, expected a multiple of 4",
        ),
        (
            rgba(64, 64),
            Role::Sky,
            "format is PNG, expected OpenEXR or KTX2",
        ),
        (
            float(&["R", "G", "B"]),
            Role::Sky,
            "channels is B, G, R, expected 4: red, green, blue, padding",
        ),
        (
            float(&["R", "G"]),
            Role::Galaxy,
            "channels is G, R, expected grey: brightness",
        ),
        (
            exr(64, 64, &[("Y", out_of_range)]),
            Role::Galaxy,
            "value is 1.5 at (1, 1), expected 0 to 1",
        ),
        (
            ktx::encode("x", &r8, "t").unwrap(),
            Role::Clouds,
            "format is r8unorm, expected rgba8unorm or rgba16float",
        ),
    ];
    for (bytes, role, expected) in cases {
        let error = refused(&bytes, role, None);
        assert!(
            error.starts_with("made.file: ") && error.contains(expected),
            "{error}\n{expected}"
        );
    }
    for whole in [
        rgba(64, 64),
        float(&["R", "G", "B", "A"]),
        ktx::encode("x", &r8, "t").unwrap(),
    ] {
        let error = refused(&whole[..whole.len() - 40], Role::Clouds, None);
        assert!(error.starts_with("made.file: "), "{error}");
    }
}
