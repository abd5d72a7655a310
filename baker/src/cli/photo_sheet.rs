//! The sheet of `welkin photo`: what became of a photograph, step by step.

use anyhow::Result;
use image::imageops::{self, FilterType};
use image::{ExtendedColorType, Rgb, RgbImage};
use welkin_baker::{PhotoSettings, PhotoTile};
use welkin_pack::Image;
use welkin_pack::texture::unorm8;

use super::picture;
use super::sheet::{self, PANEL, Panel, Section};

/// Bars of the histogram.
const BARS: usize = 64;

/// The outline of the part that is used, and what a mask leaves out.
const OUTLINE: [u8; 3] = [255, 200, 0];
const LEFT_OUT: [f32; 3] = [0.8, 0.1, 0.5];

/// Encodes the sheet.
pub fn png(tile: &PhotoTile, settings: &PhotoSettings) -> Result<Vec<u8>> {
    let [width, height] = tile.size;
    let [left, top, columns, rows] = tile.region;
    let (mean, spread) = tile.channel.mean_and_spread(0);
    let size = tile.channel.width;
    let grey = grey(&tile.channel);
    let panels = vec![
        panel("photograph", format!("{width}x{height}"), source(tile)),
        panel(
            "plan",
            format!("{columns}x{rows} at {left}, {top}"),
            scaled(&colours(&tile.plan), PANEL),
        ),
        panel("tile", format!("{size}x{size}"), scaled(&grey, PANEL)),
        panel("2 x 2", "seams in the middle".to_string(), repeated(&grey)),
        panel(
            "histogram",
            format!("mean {mean:.3}, spread {spread:.3}"),
            histogram(&tile.channel),
        ),
    ];
    let section = Section {
        title: "clouds.photo".to_string(),
        note: "clear is black, cloud is white".to_string(),
        panels,
    };
    let sheet = sheet::lay_out("photograph", &told(settings), vec![section]);
    picture::png(
        sheet.width,
        sheet.height,
        ExtendedColorType::Rgb8,
        &sheet.rgb,
    )
}

/// The settings that shape the tile, on a line.
fn told(settings: &PhotoSettings) -> String {
    let [black, white] = settings.levels;
    let mean = settings
        .mean
        .map_or(String::new(), |mean| format!("mean {mean}, "));
    let shape = if settings.as_is {
        "as it is".to_string()
    } else {
        format!(
            "flatten {}, sharpness {}",
            settings.flatten, settings.sharpness
        )
    };
    let inverted = if settings.invert { ", inverted" } else { "" };
    format!("{mean}levels {black} to {white}, {shape}{inverted}")
}

fn panel(title: &str, note: String, image: RgbImage) -> Panel {
    Panel {
        title: title.to_string(),
        note,
        width: image.width(),
        height: image.height(),
        pixels: image.pixels().map(|pixel| pixel.0).collect(),
    }
}

fn colours(image: &Image) -> RgbImage {
    RgbImage::from_fn(image.width, image.height, |x, y| match *image.texel(x, y) {
        [r, g, b] => Rgb([r, g, b].map(unorm8)),
        _ => Rgb([0; 3]),
    })
}

fn grey(image: &Image) -> RgbImage {
    RgbImage::from_fn(image.width, image.height, |x, y| {
        Rgb([unorm8(image.texel(x, y)[0]); 3])
    })
}

fn scaled(image: &RgbImage, side: u32) -> RgbImage {
    imageops::resize(image, side, side, FilterType::Triangle)
}

/// The photograph, what its mask leaves out tinted, and the outline of the part that is used.
fn source(tile: &PhotoTile) -> RgbImage {
    let [width, height] = tile.size.map(f64::from);
    let scale = f64::from(PANEL) / width.max(height);
    let [columns, rows] = [width, height].map(|side| ((side * scale).round() as u32).max(1));
    let mut small = RgbImage::from_fn(columns, rows, |x, y| Rgb(shown(tile, [x, y], scale)));
    for [x, y] in &tile.outline {
        let at = |place: f32, side: u32| ((f64::from(place) * scale) as u32).min(side - 1);
        small.put_pixel(at(*x, columns), at(*y, rows), Rgb(OUTLINE));
    }
    small
}

/// The mean of what a pixel of the panel covers.
fn shown(tile: &PhotoTile, place: [u32; 2], scale: f64) -> [u8; 3] {
    let span = |i: u32, side: u32| {
        let [from, to] = [i, i + 1].map(|i| (f64::from(i) / scale) as u32);
        let from = from.min(side - 1);
        from..to.clamp(from + 1, side)
    };
    let [columns, rows] = [0, 1].map(|axis| span(place[axis], tile.size[axis]));
    let (mut sum, mut count) = ([0.0_f32; 3], 0.0);
    for (x, y) in rows.flat_map(|y| columns.clone().map(move |x| (x, y))) {
        let cover = tile
            .cover
            .as_ref()
            .map_or(1.0, |cover| cover.texel(x, y)[0]);
        let texel = tile.picture.texel(x, y);
        for ((sum, value), tint) in sum.iter_mut().zip(texel).zip(LEFT_OUT) {
            *sum += cover * value + (1.0 - cover) * 0.5 * (value + tint);
        }
        count += 1.0;
    }
    sum.map(|value| unorm8(value / count))
}

/// Two by two tiles.
fn repeated(tile: &RgbImage) -> RgbImage {
    let half = scaled(tile, PANEL / 2);
    RgbImage::from_fn(PANEL, PANEL, |x, y| {
        *half.get_pixel(x % (PANEL / 2), y % (PANEL / 2))
    })
}

/// How many texels have which value: from clear at the left to cloud at the right; the highest bar but that of clear is as high as
/// the panel.
fn histogram(channel: &Image) -> RgbImage {
    let mut counts = [0_u32; BARS];
    for value in &channel.texels {
        counts[((value * BARS as f32) as usize).min(BARS - 1)] += 1;
    }
    let highest = counts[1..].iter().copied().max().unwrap_or(0).max(1);
    let bar = PANEL / BARS as u32;
    RgbImage::from_fn(PANEL, PANEL, |x, y| {
        let count = counts[((x / bar) as usize).min(BARS - 1)];
        let height = u64::from(count) * u64::from(PANEL) / u64::from(highest);
        let is_bar = u64::from(PANEL - y) <= height;
        Rgb(if is_bar { [200; 3] } else { [40; 3] })
    })
}
