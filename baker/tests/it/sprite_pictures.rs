//! Sprites from pictures of one's own: where they come to lie, what their values become, what is refused.

#![allow(clippy::unwrap_used, reason = "a test may stop where it fails")]

use std::io::Cursor;
use std::ops::ControlFlow;
use std::path::Path;

use image::{DynamicImage, GrayAlphaImage, ImageFormat, LumaA, Rgb, RgbImage, Rgba, RgbaImage};
use welkin_baker::{BakeError, Recipe, SpriteSource, SpritesSettings, bake, sprite_sheet};
use welkin_pack::check::check;
use welkin_pack::{Image, Overwrite, Role, SheetCell};

fn png(picture: impl Into<DynamicImage>) -> Vec<u8> {
    let mut bytes = Cursor::new(Vec::new());
    let picture: DynamicImage = picture.into();
    picture.write_to(&mut bytes, ImageFormat::Png).unwrap();
    bytes.into_inner()
}

/// Opacity of a disc with a soft edge, as a byte; `(x, y)` in a cell of `side` texels.
fn disc(x: u32, y: u32, side: u32) -> u8 {
    let unit = |i: u32| (i as f32 + 0.5) / side as f32 * 2.0 - 1.0;
    let radius = libm::sqrtf(unit(x) * unit(x) + unit(y) * unit(y));
    (((0.8 - radius) / 0.3).clamp(0.0, 1.0) * 255.0) as u8
}

/// A grey disc of `side` texels; the right half is darker.
fn cell(side: u32) -> GrayAlphaImage {
    GrayAlphaImage::from_fn(side, side, |x, y| {
        let grey = if 2 * x < side { 255 } else { 188 };
        LumaA([grey, disc(x, y, side)])
    })
}

/// A sheet of such discs, in cell `i` of `20 + 15 i` of 255 as opaque.
fn discs(side: u32) -> RgbaImage {
    RgbaImage::from_fn(4 * side, 4 * side, |x, y| {
        let index = y / side * 4 + x / side;
        let alpha = u32::from(disc(x % side, y % side, side)) * (20 + 15 * index) / 255;
        Rgba([255, 128, 64, alpha as u8])
    })
}

fn settings(source: SpriteSource) -> SpritesSettings {
    SpritesSettings {
        size: 128,
        contrast: 1.0,
        source,
    }
}

/// A sheet of 128 texels from one picture.
fn from_sheet(bytes: &[u8]) -> Result<Image, BakeError> {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("my sheet"), bytes).unwrap();
    let source = SpriteSource::Sheet("my sheet".to_string());
    sprite_sheet(&settings(source), 1, Some(folder.path()))
}

fn names() -> Box<[String; 16]> {
    Box::new(std::array::from_fn(|i| format!("{i}.png")))
}

/// The same from 16.
fn from_cells(pictures: &[Vec<u8>; 16]) -> Result<Image, BakeError> {
    let folder = tempfile::tempdir().unwrap();
    write_all(folder.path(), pictures);
    sprite_sheet(
        &settings(SpriteSource::Cells(names())),
        1,
        Some(folder.path()),
    )
}

fn write_all(folder: &Path, pictures: &[Vec<u8>; 16]) {
    for (name, bytes) in names().iter().zip(pictures) {
        std::fs::write(folder.join(name), bytes).unwrap();
    }
}

fn told(error: BakeError, parts: &[&str]) {
    let text = error.to_string();
    for part in parts {
        assert!(text.contains(part), "{text} does not tell {part}");
    }
}

#[test]
fn a_sheet_of_the_right_size_keeps_its_opacity_texel_by_texel() {
    let sheet = from_sheet(&png(discs(32))).unwrap();
    for (pixel, texel) in discs(32).pixels().zip(sheet.texels.chunks_exact(4)) {
        assert!((texel[1] - f32::from(pixel.0[3]) / 255.0).abs() < 1e-6);
        // One colour: its luminance is the mean.
        assert!((texel[0] - 0.5).abs() < 1e-3);
    }
}

#[test]
fn pictures_lie_in_the_order_of_the_cells() {
    for side in [32, 64, 100] {
        let mut pictures = [(); 16].map(|()| png(cell(side)));
        // The one of another opacity.
        let thin = GrayAlphaImage::from_fn(side, side, |x, y| LumaA([90, disc(x, y, side) / 2]));
        pictures[6] = png(thin);
        let sheet = from_cells(&pictures).unwrap();
        for index in (0..SheetCell::COUNT).map(SheetCell) {
            let [x, y] = index.place().map(|i| 32 * i + 16);
            let expected = if index.0 == 6 { 127.0 / 255.0 } else { 1.0 };
            assert!((sheet.texel(x, y)[1] - expected).abs() < 0.01, "{index:?}");
        }
    }
}

#[test]
fn grey_is_the_linear_luminance_relative_to_its_mean() {
    let sheet = from_cells(&[(); 16].map(|()| png(cell(32)))).unwrap();
    // 188 of 255 in sRGB is 0.5029 linear; both halves weigh the same.
    let dark = 0.5029_f32;
    let mean = (1.0 + dark) / 2.0;
    for (x, light) in [(6, 1.0), (25, dark)] {
        let found = sheet.texel(x, 16)[0];
        assert!((found - 0.5 * light / mean).abs() < 5e-3, "{found} at {x}");
    }
}

#[test]
fn resizing_keeps_the_mean_opacity() {
    let small = from_sheet(&png(discs(32))).unwrap();
    let large = from_sheet(&png(discs(150))).unwrap();
    let [a, b] = [&small, &large].map(|sheet| sheet.mean_and_spread(1).0);
    assert!((a - b).abs() < 0.01 * a, "{a} {b}");
}

#[test]
fn pictures_must_be_square_and_of_a_fit_size() {
    for (width, height) in [(128, 64), (64, 64), (130, 130), (4100, 4100)] {
        let error = from_sheet(&png(RgbaImage::new(width, height))).unwrap_err();
        let found = format!("size is {width}x{height}");
        told(
            error,
            &["my sheet", &found, "square of 128 to 4096", "4x4 cells"],
        );
    }
    let mut pictures = [(); 16].map(|()| png(cell(32)));
    pictures[9] = png(RgbaImage::new(64, 32));
    told(
        from_cells(&pictures).unwrap_err(),
        &["9.png", "64x32", "square of 32 to 1024"],
    );
    pictures[9] = png(RgbaImage::new(16, 16));
    told(from_cells(&pictures).unwrap_err(), &["9.png", "16x16"]);
}

#[test]
fn pictures_must_show_something_that_ends_inside() {
    let mut pictures = [(); 16].map(|()| png(cell(32)));
    pictures[3] = png(RgbImage::from_pixel(32, 32, Rgb([200; 3])));
    told(
        from_cells(&pictures).unwrap_err(),
        &["3.png", "alpha along the border is 1.00", "at most 0.05"],
    );
    pictures[3] = png(RgbaImage::new(32, 32));
    told(
        from_cells(&pictures).unwrap_err(),
        &["3.png", "mean alpha is 0.000", "0.01 to 0.785"],
    );
    let mut sheet = discs(32);
    sheet.put_pixel(63, 40, Rgba([9, 9, 9, 99]));
    told(
        from_sheet(&png(sheet)).unwrap_err(),
        &["my sheet", "border is 0.39 in cell 5"],
    );
    let full = RgbaImage::from_fn(128, 128, |x, y| {
        let inside = [x, y].iter().all(|i| (1..31).contains(&(i % 32)));
        Rgba([9, 9, 9, if inside { 255 } else { 0 }])
    });
    told(
        from_sheet(&png(full)).unwrap_err(),
        &["mean alpha is 0.879 in cell 0"],
    );
}

#[test]
fn files_that_cannot_be_read_are_named_with_their_key() {
    let cells = settings(SpriteSource::Cells(names()));
    let folder = tempfile::tempdir().unwrap();
    write_all(folder.path(), &[(); 16].map(|()| png(cell(32))));
    std::fs::remove_file(folder.path().join("11.png")).unwrap();
    let error = sprite_sheet(&cells, 1, Some(folder.path())).unwrap_err();
    told(error, &["11.png", "`sprites.pictures[11]`"]);
    let sheet = settings(SpriteSource::Sheet("a.png".to_string()));
    told(
        sprite_sheet(&sheet, 1, None).unwrap_err(),
        &["a.png", "`sprites.file`"],
    );
    told(
        from_sheet(b"GIF89a").unwrap_err(),
        &["my sheet", "format is unknown"],
    );
    assert!(matches!(
        from_sheet(&png(discs(32))[..500]).unwrap_err(),
        BakeError::Decode { .. }
    ));
}

fn resolve(text: &str) -> Result<SpritesSettings, String> {
    let recipe = Recipe::parse("sky.toml", text).map_err(|e| e.to_string())?;
    let resolved = recipe.resolve(None).map_err(|e| e.to_string())?;
    Ok(resolved.sprites)
}

#[test]
fn mistakes_in_the_recipe_are_told_with_their_place() {
    let list = |count: usize| vec!["'a'"; count].join(", ");
    let table = |keys: String| format!("[sprites]\n{keys}");
    let told = |keys: String, parts: &[&str]| {
        let error = resolve(&table(keys.clone())).expect_err(&keys);
        for part in parts {
            assert!(error.contains(part), "{keys}: {error}");
        }
    };
    let all = list(16);
    let sheet = resolve("sprites.file = 'a'").unwrap().source;
    assert_eq!(sheet, SpriteSource::Sheet("a".to_string()));
    let cells = resolve(&table(format!("pictures = [{all}]")))
        .unwrap()
        .source;
    assert_eq!(
        cells,
        SpriteSource::Cells(Box::new([(); 16].map(|()| "a".to_string())))
    );
    for count in [0, 1, 15, 17] {
        told(
            format!("pictures = [{}]", list(count)),
            &[
                "sky.toml:2:12: sprites.pictures is",
                &format!("a list of {count}"),
                "a list of 16",
            ],
        );
    }
    told(
        "file = 3".into(),
        &["sky.toml:2:8: sprites.file is 3", "PNG or OpenEXR"],
    );
    told("file = ''".into(), &["sprites.file"]);
    told(
        format!("pictures = [{}, 7]", list(15)),
        &["sky.toml:2:88: sprites.pictures[15] is 7"],
    );
    let no_list = "sky.toml:2:12: sprites.pictures is 'a', expected a list";
    told("pictures = 'a'".into(), &[no_list]);
    told(
        format!("file = 'a'\npictures = [{all}]"),
        &[
            "sky.toml:3:12: sprites.pictures is given",
            "none with `file`",
        ],
    );
    for key in ["detail", "softness"] {
        told(
            format!("file = 'a'\n{key} = 1"),
            &[&format!("sprites.{key} is 1"), "none with pictures"],
        );
    }
}

#[test]
fn a_pack_with_pictures_is_sound_and_names_its_inputs() {
    let folder = tempfile::tempdir().unwrap();
    write_all(folder.path(), &[(); 16].map(|()| png(cell(48))));
    let files = names().map(|name| format!("'{name}'")).join(", ");
    let small = "[clouds]\nsize = 64\n[layers]\nsize = 64\n";
    let text = format!("{small}[sprites]\npictures = [{files}]\n");
    let recipe = Recipe::parse("sky.toml", &text).unwrap();
    let resolved = recipe.resolve(None).unwrap();
    let proceed = |_| ControlFlow::Continue(());
    let pack = bake(&resolved, Some(folder.path()), &proceed).unwrap();
    let inputs = &pack.manifest().inputs;
    let keys: Vec<&str> = inputs.iter().map(|input| input.key.as_str()).collect();
    let expected: Vec<String> = (0..16).map(|i| format!("sprites.pictures[{i}]")).collect();
    assert_eq!(keys, expected);
    assert_eq!(pack.texture(Role::Sprites).unwrap().levels.len(), 5);
    let place = folder.path().join("pack");
    pack.save(&place, Overwrite::Keep, &|| false).unwrap();
    let report = check(&place).unwrap();
    assert!(report.is_sound());
    // Discs are no clouds, but nothing worse than a warning.
    let warned: Vec<_> = report.problems().map(|finding| finding.rule).collect();
    assert_eq!(warned, ["sprite-flat"]);
}
