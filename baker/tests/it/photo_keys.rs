//! What the keys of `[clouds.photo]` do.

#![allow(clippy::unwrap_used, reason = "a test may stop where it fails")]

use std::collections::BTreeMap;
use std::f32::consts::TAU;
use std::io::Cursor;
use std::ops::ControlFlow;

use image::{DynamicImage, GrayImage, ImageFormat, RgbImage};
use welkin_baker::{
    Inputs, PhotoFile, PhotoProjection, PhotoRegion, PhotoSettings, Recipe, bake_from,
    photo_channel, photo_tile,
};
use welkin_pack::Image;

use crate::common::sky;

fn settings() -> PhotoSettings {
    PhotoSettings {
        size: 64,
        ..PhotoSettings::default()
    }
}

fn as_is() -> PhotoSettings {
    PhotoSettings {
        mean: None,
        as_is: true,
        ..settings()
    }
}

fn png(picture: impl Into<DynamicImage>) -> Vec<u8> {
    let mut bytes = Cursor::new(Vec::new());
    picture
        .into()
        .write_to(&mut bytes, ImageFormat::Png)
        .unwrap();
    bytes.into_inner()
}

fn made(bytes: &[u8], settings: &PhotoSettings) -> Image {
    photo_channel(bytes, "sky.png", settings).unwrap()
}

fn refused(bytes: &[u8], settings: &PhotoSettings) -> String {
    photo_channel(bytes, "sky.png", settings)
        .unwrap_err()
        .to_string()
}

fn masked(picture: &[u8], mask: &[u8], settings: &PhotoSettings) -> Result<Image, String> {
    let file = |name, bytes| PhotoFile { name, bytes };
    let tile = photo_tile(
        file("sky.png", picture),
        Some(file("mask.png", mask)),
        settings,
    );
    tile.map(|tile| tile.channel).map_err(|e| e.to_string())
}

/// A tile of bytes that differ from texel to texel.
fn grey(size: u32) -> GrayImage {
    GrayImage::from_fn(size, size, |x, y| image::Luma([(x * 37 + y * 101) as u8]))
}

fn correlation(a: &Image, b: &Image) -> f64 {
    let ((a_mean, a_spread), (b_mean, b_spread)) = (a.mean_and_spread(0), b.mean_and_spread(0));
    let pairs = a.texels.iter().zip(&b.texels);
    let sum: f64 = pairs
        .map(|(x, y)| f64::from((x - a_mean) * (y - b_mean)))
        .sum();
    sum / a.texels.len() as f64 / f64::from(a_spread * b_spread)
}

#[test]
fn a_finished_tile_is_taken_as_it_is() {
    let tile = grey(64);
    let expected: Vec<f32> = tile
        .as_raw()
        .iter()
        .map(|&v| f32::from(v) / 255.0)
        .collect();
    for bytes in [
        png(tile.clone()),
        png(DynamicImage::from(tile.clone()).to_rgb8()),
    ] {
        assert_eq!(made(&bytes, &as_is()).texels, expected);
    }
    let words = GrayImage::from_fn(64, 64, |x, _| image::Luma([x as u8])).into_raw();
    let words: Vec<u16> = words.iter().map(|&v| u16::from(v) * 1000 + 7).collect();
    let deep = image::ImageBuffer::<image::Luma<u16>, _>::from_raw(64, 64, words.clone()).unwrap();
    let found = made(&png(deep), &as_is());
    let expected_deep: Vec<f32> = words.iter().map(|&v| f32::from(v) / 65535.0).collect();
    assert_eq!(found.texels, expected_deep);

    let inverted = PhotoSettings {
        invert: true,
        ..as_is()
    };
    let found = made(&png(tile.clone()), &inverted);
    assert!(
        found
            .texels
            .iter()
            .zip(&expected)
            .all(|(a, b)| *a == 1.0 - b)
    );
    let levels = PhotoSettings {
        levels: [0.2, 0.6],
        ..as_is()
    };
    let found = made(&png(tile), &levels);
    let level = |v: f32| ((v - 0.2) / 0.4).clamp(0.0, 1.0);
    assert!(
        found
            .texels
            .iter()
            .zip(&expected)
            .all(|(a, b)| (a - level(*b)).abs() < 1e-6)
    );
}

#[test]
fn a_finished_tile_gets_a_mean_only_where_one_is_given() {
    let wave = GrayImage::from_fn(64, 64, |x, y| image::Luma([(x * 2 + y * 2) as u8]));
    for mean in [0.1, 0.5] {
        let settings = PhotoSettings {
            mean: Some(mean),
            ..as_is()
        };
        let found = made(&png(wave.clone()), &settings).mean_and_spread(0).0;
        assert!((found - mean).abs() < 2e-3, "{mean}: {found}");
    }
}

#[test]
fn a_finished_tile_of_another_size_still_tiles() {
    let wave =
        |x: f32, y: f32| 0.5 + 0.25 * (libm::sinf(TAU * (x + 0.1)) + libm::sinf(TAU * (y + 0.3)));
    for from in [96, 128, 256] {
        let tile = GrayImage::from_fn(from, from, |x, y| {
            let [x, y] = [x, y].map(|i| (i as f32 + 0.5) / from as f32);
            image::Luma([(wave(x, y) * 255.0 + 0.5) as u8])
        });
        let found = made(&png(tile), &as_is());
        for i in 0..64 * 64_u32 {
            let [x, y] = [i % 64, i / 64].map(|i| (i as f32 + 0.5) / 64.0);
            let off = found.texels[i as usize] - wave(x, y);
            // Half a step of a byte, and what the filter takes of a wave of 64 texels.
            assert!(off.abs() < 0.006, "{from}: {off} at {x}, {y}");
        }
    }
}

#[test]
fn what_is_no_finished_tile_is_told() {
    let error = refused(&png(sky(120, 80)), &as_is());
    assert!(
        error.contains("size is 120x80, expected as wide as high"),
        "{error}"
    );
    let part = PhotoSettings {
        region: PhotoRegion::Part([10, 5, 70, 70]),
        ..as_is()
    };
    made(&png(sky(120, 80)), &part);
    let flat = GrayImage::from_pixel(64, 64, image::Luma([90]));
    let error = refused(&png(flat), &as_is());
    assert!(
        error.contains("contrast of its channel is 0.00000"),
        "{error}"
    );
}

#[test]
fn a_region_gives_the_clouds_of_the_picture_cut_there() {
    let whole = sky(300, 200);
    let cut = image::imageops::crop_imm(&whole, 130, 40, 120, 120).to_image();
    let of = |part| PhotoSettings {
        region: PhotoRegion::Part(part),
        ..settings()
    };
    let found = made(&png(whole.clone()), &of([130, 40, 120, 120]));
    assert!(found == made(&png(cut), &settings()));
    // Of an oblong one the middle is used.
    let file = PhotoFile {
        name: "sky.png",
        bytes: &png(whole.clone()),
    };
    let tile = photo_tile(file, None, &of([10, 20, 200, 100])).unwrap();
    assert_eq!(tile.region, [60, 20, 100, 100]);
    for part in [
        [200, 0, 101, 100],
        [0, 101, 100, 100],
        [u32::MAX, u32::MAX, 64, 64],
    ] {
        let error = refused(&png(whole.clone()), &of(part));
        assert!(
            error.contains("expected within the 300x200 of the picture"),
            "{error}"
        );
    }
}

#[test]
fn a_mask_says_where_there_is_cloud() {
    let picture = png(sky(160, 160));
    let half = GrayImage::from_fn(160, 160, |_, y| image::Luma([if y < 80 { 255 } else { 0 }]));
    let found = masked(&picture, &png(half), &settings()).unwrap();
    // The tile has 128 rows of the picture; its first 32 are blended with what lies beyond.
    let rows = |from: usize, to: usize| {
        let part = &found.texels[from * 64..to * 64];
        part.iter().sum::<f32>() / part.len() as f32
    };
    assert!(
        rows(20, 38) > 0.5 && rows(46, 62) < 0.02,
        "{} {}",
        rows(20, 38),
        rows(46, 62)
    );

    let white = GrayImage::from_pixel(160, 160, image::Luma([255]));
    let (with, without) = (
        masked(&picture, &png(white), &settings()),
        made(&picture, &settings()),
    );
    let pairs = with.unwrap().texels.into_iter().zip(&without.texels);
    assert!({ pairs }.all(|(a, b)| (a - b).abs() < 1e-3));
    let other = GrayImage::from_pixel(160, 100, image::Luma([255]));
    let error = masked(&picture, &png(other), &settings()).unwrap_err();
    assert!(
        error.starts_with("mask.png: size is 160x100, expected 160x160"),
        "{error}"
    );
    let tile = masked(&png(grey(64)), &png(grey(64)), &as_is()).unwrap();
    let square = |v: u8| f32::from(v) / 255.0 * (f32::from(v) / 255.0);
    assert!(
        tile.texels
            .iter()
            .zip(grey(64).as_raw())
            .all(|(a, b)| *a == square(*b))
    );
}

/// A row of ground below a sky, and a panorama, as a camera and a stitcher give them.
#[test]
fn a_picture_of_a_camera_is_seen_from_below() {
    let clouds = sky(400, 240);
    let picture = RgbImage::from_fn(400, 300, |x, y| {
        if y < 240 {
            *clouds.get_pixel(x, y)
        } else {
            image::Rgb([60, 58, 30 + ((x * 7 + y * 3) % 20) as u8])
        }
    });
    let tile = |bytes: &[u8], projection| {
        let settings = PhotoSettings {
            projection,
            ..settings()
        };
        let file = PhotoFile {
            name: "sky.png",
            bytes,
        };
        photo_tile(file, None, &settings).map_err(|e| e.to_string())
    };
    let fov_rad = 1.2;
    let found = PhotoProjection::Perspective {
        fov_rad,
        horizon: None,
    };
    let given = PhotoProjection::Perspective {
        fov_rad,
        horizon: Some(0.8),
    };
    let bytes = png(picture);
    let [auto, by_hand] = [found, given].map(|projection| tile(&bytes, projection).unwrap());
    assert_eq!(auto.region, by_hand.region);
    let mut pairs = auto.channel.texels.iter().zip(&by_hand.channel.texels);
    assert!(pairs.all(|(a, b)| (a - b).abs() < 1e-3));
    // 15 degrees above the horizon, and no lower: 86 rows.
    let [_, top, _, height] = auto.region;
    assert!(
        top < 60 && (130..=154).contains(&(top + height)),
        "{:?}",
        auto.region
    );
    assert!(auto.channel != made(&bytes, &settings()));

    let error = tile(&png(sky(300, 200)), found).unwrap_err();
    assert!(
        error.contains("horizon is not found") && error.contains("`clouds.photo.horizon`"),
        "{error}"
    );
    let ground = PhotoProjection::Perspective {
        fov_rad,
        horizon: Some(0.1),
    };
    let error = tile(&bytes, ground).unwrap_err();
    assert!(
        error.contains("sky is none, expected 64 texels a side or more"),
        "{error}"
    );

    let panorama = PhotoProjection::Equirect { horizon: None };
    let around = tile(&png(sky(512, 256)), panorama).unwrap();
    assert_eq!((around.region[0], around.region[1]), (0, 0));
    let error = tile(&bytes, panorama).unwrap_err();
    assert!(
        error.contains("size is 400x300, expected a panorama twice as wide as high"),
        "{error}"
    );
    let strip = PhotoProjection::Equirect { horizon: Some(0.9) };
    tile(&png(sky(600, 150)), strip).unwrap();
}

#[test]
fn inverted_clouds_are_holes() {
    let picture = png(sky(160, 160));
    let inverted = PhotoSettings {
        invert: true,
        ..settings()
    };
    let alike = correlation(&made(&picture, &settings()), &made(&picture, &inverted));
    assert!(alike < -0.8, "{alike}");
}

/// Light that falls from one side to the other.
#[test]
fn what_is_not_flattened_keeps_its_uneven_light() {
    let even = sky(160, 160);
    let lit = RgbImage::from_fn(160, 160, |x, y| {
        let light = 0.3 + 0.7 * (y as f32 / 160.0);
        image::Rgb(even.get_pixel(x, y).0.map(|v| (f32::from(v) * light) as u8))
    });
    let bytes = png(lit);
    let lower_less_upper = |flatten| {
        let tile = made(
            &bytes,
            &PhotoSettings {
                flatten,
                ..settings()
            },
        );
        let rows =
            |from: usize| tile.texels[from * 64..(from + 20) * 64].iter().sum::<f32>() / 1280.0;
        rows(43) - rows(18)
    };
    let [none, half, all] = [0.0, 0.5, 1.0].map(lower_less_upper);
    assert!(
        none > half && half > all && none > all + 0.05,
        "{none} {half} {all}"
    );
}

#[test]
fn a_sharper_tile_changes_more_from_texel_to_texel() {
    let bytes = png(sky(160, 160));
    let roughness = |sharpness| {
        let tile = made(
            &bytes,
            &PhotoSettings {
                sharpness,
                ..settings()
            },
        );
        let steps = tile.texels.windows(2).map(|pair| (pair[1] - pair[0]).abs());
        steps.sum::<f32>() / tile.mean_and_spread(0).1
    };
    let [soft, usual, sharp] = [0.25, 1.0, 8.0].map(roughness);
    assert!(soft < usual && usual < sharp, "{soft} {usual} {sharp}");
}

#[test]
fn levels_cut_off_what_is_dark_and_what_is_bright() {
    let bytes = png(sky(160, 160));
    let of = |levels| {
        made(
            &bytes,
            &PhotoSettings {
                levels,
                ..settings()
            },
        )
    };
    assert!(of([0.0, 1.0]) == made(&bytes, &settings()));
    assert!(of([0.3, 0.8]) != of([0.0, 1.0]));
    let error = refused(
        &bytes,
        &PhotoSettings {
            levels: [0.0, 0.05],
            ..settings()
        },
    );
    assert!(error.contains("contrast"), "{error}");
}

#[test]
fn a_recipe_names_the_mask_beside_the_photograph() {
    let text = "clouds.size = 64\n[clouds.photo]\nfile = \"sky.png\"\nmask = \"mask.png\"\n";
    let resolved = Recipe::parse("sky.toml", text)
        .unwrap()
        .resolve(None)
        .unwrap();
    assert_eq!(resolved.files(), ["sky.png", "mask.png"]);
    let mut files = BTreeMap::from([("sky.png".to_string(), png(sky(100, 100)))]);
    let bake = |files: &BTreeMap<_, _>| {
        bake_from(&resolved, Inputs::Memory(files), &|_| {
            ControlFlow::Continue(())
        })
    };
    let error = bake(&files).unwrap_err().to_string();
    assert!(
        error.contains("mask.png: cannot be read") && error.contains("`clouds.photo.mask`"),
        "{error}"
    );
    let mask = GrayImage::from_fn(100, 100, |x, _| {
        image::Luma([if x < 60 { 255 } else { 40 }])
    });
    files.insert("mask.png".to_string(), png(mask));
    let pack = bake(&files).unwrap();
    let keys: Vec<&str> = pack
        .manifest()
        .inputs
        .iter()
        .map(|i| i.key.as_str())
        .collect();
    assert_eq!(keys, ["clouds.photo.file", "clouds.photo.mask"]);
}
