//! Tiles that are closed by a cut: their seams, and what they keep.

use welkin_pack::check::radial_spectrum;

use super::*;
use crate::clouds::photo::{PhotoFile, PhotoTile, amount, photo_tile};
use crate::filter;
use crate::settings::{PhotoSeam, PhotoSettings};
use crate::stream::Stream;

const SIZE: u32 = 256;
const MARGIN: u32 = 64;

/// Noise whose energy falls by the power `slope` of the wave number, `side` texels across.
fn noise(side: usize, slope: f64, seed: u64) -> Image {
    let mut stream = Stream::new(seed, "noise");
    let mut plane = Plane::new(side);
    for i in 0..side * side {
        plane.add([i % side, i / side], stream.unit() - 0.5);
    }
    fourier::transform(&mut plane, false);
    plane.scale(|place| {
        let [x, y] = place.map(|k| k.min(side - k) as f64);
        let length = libm::hypot(x, y);
        if length == 0.0 {
            0.0
        } else {
            libm::pow(length, -0.5 * slope)
        }
    });
    fourier::transform(&mut plane, true);
    let mut image = Image::new(side as u32, side as u32, 1);
    let texels = image.texels.iter_mut().zip(plane.real());
    texels.for_each(|(texel, value)| *texel = value as f32);
    filter::standardise(&mut image, 1e-9);
    image
}

/// The power by which energy falls with the wave number, from 6 waves a side to waves of 8 texels, by least squares. What does not tile
/// is windowed (F. J. Harris, "On the Use of Windows for Harmonic Analysis with the Discrete Fourier Transform", Proc. IEEE 66,
/// 1978, eq. 27b).
fn slope(image: &Image, tiles: bool) -> f64 {
    let (mean, _) = image.mean_and_spread(0);
    let side = image.width;
    let window = |i: u32| libm::sinf(std::f32::consts::PI * (i as f32 + 0.5) / side as f32);
    let windowed = filter::plane(side, side, |x, y| {
        let weight = if tiles {
            1.0
        } else {
            window(x) * window(x) * window(y) * window(y)
        };
        weight * (image.texel(x, y)[0] - mean)
    });
    let spectrum = radial_spectrum(&windowed, 0).unwrap();
    let points: Vec<[f64; 2]> = (6..=side as usize / 8)
        .map(|k| [libm::log(k as f64), libm::log(spectrum[k - 1])])
        .collect();
    let means = [0, 1].map(|i| points.iter().map(|p| p[i]).sum::<f64>() / points.len() as f64);
    let sum = |i: usize| -> f64 {
        let products = points.iter().map(|p| (p[0] - means[0]) * (p[i] - means[i]));
        products.sum()
    };
    -sum(1) / sum(0)
}

fn field(slope: f64, seed: u64) -> Image {
    let noise = noise(512, slope, seed);
    filter::plane(SIZE + MARGIN, SIZE + MARGIN, |x, y| {
        noise.texel(x + 60, y + 90)[0]
    })
}

#[test]
fn the_cheapest_way_is_found() {
    // A valley that winds.
    let valley = |place: usize| 4 + (place / 3 % 4).abs_diff(2);
    let way = cheapest(
        30,
        12,
        |place, at| if at == valley(place) { 0.0 } else { 1.0 },
    );
    assert!((0..30).all(|place| way[place] == valley(place)), "{way:?}");
}

#[test]
fn what_tiles_already_stays_as_it_is() {
    let tile = noise(SIZE as usize, 3.0, 3);
    let field = filter::plane(SIZE + MARGIN, SIZE + MARGIN, |x, y| {
        tile.texel(x % SIZE, y % SIZE)[0]
    });
    let closed = close(&field, SIZE, MARGIN);
    let pairs = closed.texels.iter().zip(&tile.texels);
    let worst = pairs.map(|(a, b)| (a - b).abs()).fold(0.0, f32::max);
    assert!(worst < 1e-4, "{worst}");
}

#[test]
fn steps_over_the_sides_are_no_larger_than_elsewhere_and_the_slope_stays() {
    for (wanted, seed) in [(2.4, 1), (3.0, 2), (3.6, 5)] {
        let field = field(wanted, seed);
        let tile = close(&field, SIZE, MARGIN);
        let steps = |x: u32| {
            let squares = (0..SIZE).map(|y| {
                let step = tile.texel((x + 1) % SIZE, y)[0] - tile.texel(x, y)[0];
                f64::from(step * step)
            });
            libm::sqrt(squares.sum::<f64>() / f64::from(SIZE))
        };
        let inside = (0..SIZE - 1).map(steps).sum::<f64>() / f64::from(SIZE - 1);
        assert!(
            steps(SIZE - 1) < 1.3 * inside,
            "{wanted}: {} {inside}",
            steps(SIZE - 1)
        );
        let source = filter::plane(SIZE, SIZE, |x, y| field.texel(x + 30, y + 30)[0]);
        let (before, after) = (slope(&source, false), slope(&tile, true));
        assert!((before - after).abs() < 0.25, "{wanted}: {before} {after}");
    }
}

/// The whole way from a picture to its tile.
fn made(bytes: &[u8]) -> PhotoTile {
    let settings = PhotoSettings {
        size: SIZE,
        seam: PhotoSeam::Cut,
        ..PhotoSettings::default()
    };
    let file = PhotoFile {
        name: "sky.png",
        bytes,
    };
    photo_tile(file, None, &settings).unwrap()
}

fn png(picture: image::RgbImage) -> Vec<u8> {
    let mut bytes = std::io::Cursor::new(Vec::new());
    picture
        .write_to(&mut bytes, image::ImageFormat::Png)
        .unwrap();
    bytes.into_inner()
}

#[test]
fn a_tile_has_the_slope_of_its_photograph() {
    let grey = |wanted: f64, seed: u64| {
        let noise = noise(512, wanted, seed);
        png(image::RgbImage::from_fn(400, 400, |x, y| {
            image::Rgb([(128.0 + 36.0 * noise.texel(x, y)[0]).clamp(0.0, 255.0) as u8; 3])
        }))
    };
    let mut pictures = vec![
        ("2.4", grey(2.4, 1)),
        ("3", grey(3.0, 2)),
        ("3.6", grey(3.6, 5)),
    ];
    let photographs = crate::clouds::photo::BUILT_IN.map(<[u8]>::to_vec);
    pictures.extend(photographs.map(|bytes| ("built-in", bytes)));
    for (name, bytes) in pictures {
        let tile = made(&bytes);
        // In the scale of the tile, which has four fifths of the plan's sides.
        let planes = [0, 1, 2].map(|c| {
            let plane = filter::plane(SIZE, SIZE, |x, y| tile.plan.texel(x, y)[c]);
            let whole = filter::resample(&plane, SIZE + MARGIN, SIZE + MARGIN);
            filter::plane(SIZE, SIZE, |x, y| {
                whole.texel(x + MARGIN / 2, y + MARGIN / 2)[0]
            })
        });
        let before = slope(&amount::luminance(&planes), false);
        let after = slope(&tile.channel, true);
        assert!((before - after).abs() < 0.5, "{name}: {before} {after}");
    }
}
