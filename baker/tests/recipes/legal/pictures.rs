//! Pictures that random recipes name: made here, so that the test needs no file.

use std::collections::BTreeMap;
use std::f32::consts::TAU;
use std::io::Cursor;
use std::sync::OnceLock;

use image::{DynamicImage, ImageFormat, Rgb, RgbImage, Rgba, RgbaImage};
use welkin_pack::{SheetCell, SheetKind};

/// Skies with white clouds: many, few, and under a bright haze.
pub const PHOTOS: [&str; 3] = ["broken.png", "scattered.png", "hazy.png"];

/// A sheet of cloud sprites.
pub const SHEET: &str = "sheet.png";

/// Every picture by its name.
pub fn files() -> &'static BTreeMap<String, Vec<u8>> {
    static FILES: OnceLock<BTreeMap<String, Vec<u8>>> = OnceLock::new();
    FILES.get_or_init(|| {
        let skies = [(0.5, 0.0), (0.25, 0.0), (0.4, 0.4)];
        let photos = PHOTOS.iter().zip(skies).map(|(name, (share, haze))| {
            (
                name.to_string(),
                png(DynamicImage::ImageRgb8(sky(share, haze))),
            )
        });
        let sheet = (SHEET.to_string(), png(DynamicImage::ImageRgba8(sheet())));
        photos.chain([sheet]).collect()
    })
}

fn png(picture: DynamicImage) -> Vec<u8> {
    let mut bytes = Cursor::new(Vec::new());
    picture.write_to(&mut bytes, ImageFormat::Png).unwrap();
    bytes.into_inner()
}

/// A blue sky, with clouds where a sum of waves of all sizes is high.
fn sky(share: f32, haze: f32) -> RgbImage {
    let waves: Vec<[f32; 4]> = (0..60)
        .map(|i| {
            let turn = |step: f32| (step * i as f32).fract();
            let cycles = 1.0 + 9.0 * turn(0.618_034) * turn(0.754_878);
            let angle = TAU * turn(0.569_840);
            [
                cycles * libm::cosf(angle),
                cycles * libm::sinf(angle),
                turn(0.324_718),
                1.0 / cycles,
            ]
        })
        .collect();
    RgbImage::from_fn(160, 160, |x, y| {
        let [u, v] = [x, y].map(|i| i as f32 / 160.0);
        let wave =
            |[a, b, phase, weight]: &[f32; 4]| weight * libm::cosf(TAU * (a * u + b * v + phase));
        let height = waves.iter().map(wave).sum::<f32>() / 6.0 + share - 0.5;
        let cloud = (0.5 + height).clamp(0.0, 1.0);
        let white = haze + (1.0 - haze) * cloud;
        let [red, green, blue] = [0.25, 0.45, 0.75].map(|sky| sky + (0.9 - sky) * white);
        Rgb([red, green, blue].map(|c| (255.0 * c) as u8))
    })
}

/// Round clouds as opaque as their kinds are.
fn sheet() -> RgbaImage {
    let side = 64;
    RgbaImage::from_fn(4 * side, 4 * side, |x, y| {
        let cell = SheetCell((y / side * SheetCell::A_SIDE + x / side) as u8);
        let peak = match cell.kind() {
            SheetKind::Foggy => 0.6,
            SheetKind::Wispy => 0.7,
            SheetKind::FlatBottomed | SheetKind::Puffy => 1.0,
        };
        let [u, v] = [x, y].map(|i| ((i % side) as f32 + 0.5) / side as f32 * 2.0 - 1.0);
        let alpha = peak * ((0.9 - libm::hypotf(u, v)) / 0.5).clamp(0.0, 1.0);
        let grey = 0.7 + 0.2 * libm::sinf(7.0 * u) * libm::sinf(7.0 * v + f32::from(cell.0));
        let grey = (255.0 * grey) as u8;
        Rgba([grey, grey, grey, (255.0 * alpha) as u8])
    })
}
