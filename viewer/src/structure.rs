//! How fine the structure inside clouds is, and whether shapes come back: two numbers that tell pictures of clouds from noise.
//!
//! # Theory
//! The logarithm of luminance inside clouds is split into bands between Gaussians of 1, 2, 4, 8, 16 and 32 pixels of a picture of 1280x720,
//! as in D. Marr, E. Hildreth, "Theory of edge detection", Proc. R. Soc. Lond. B 207, 1980. Photographs of clouds (twelve of cumulus, stratus,
//! haze and sunset, all round and overhead) have 0.12 to 0.25 times as much in the two finest as in the two coarsest, whatever the exposure; white
//! noise has some thirty times as much.

use glam::Vec3;
use welkin_runtime::internals::geometry::math::luminance;

use crate::frame::{Frame, Pixels, linear};

/// Size of the pictures that are measured.
pub const SIZE: [u32; 2] = [1280, 720];

/// Standard deviations of the Gaussians, in pixels.
const SIGMAS: [f32; 6] = [1.0, 2.0, 4.0, 8.0, 16.0, 32.0];
/// Saturation, blurred by [`SATURATION_SIGMA`] pixels, below which a pixel is cloud.
const CLOUD_SATURATION: f32 = 0.38;
const SATURATION_SIGMA: f32 = 3.0;
/// Pixels along rows and columns from the edge of a cloud to its inside.
const INSIDE: usize = 10;
/// Share of the picture's height, from the top, that is looked at.
const ABOVE: f32 = 0.75;
/// What is added to luminance before its logarithm.
const DARK: f32 = 1e-3;
/// The least share of the picture that has to be inside clouds.
const LEAST_SHARE: f32 = 0.01;
/// Gaussians end at so many standard deviations.
const REACH: f32 = 4.0;

/// A plane of numbers, row by row.
struct Plane {
    width: usize,
    values: Vec<f32>,
}

impl Plane {
    fn height(&self) -> usize {
        self.values.len() / self.width
    }

    fn map(&self, of: impl Fn(f32) -> f32) -> Plane {
        Plane {
            width: self.width,
            values: self.values.iter().map(|&v| of(v)).collect(),
        }
    }

    /// Blurred by a Gaussian; sides are mirrored.
    fn blurred(&self, sigma: f32) -> Plane {
        let down = self.blurred_down(sigma);
        down.transposed().blurred_down(sigma).transposed()
    }

    /// Along columns: rows are added up whole, which is many times faster than number by number.
    fn blurred_down(&self, sigma: f32) -> Plane {
        let reach = (REACH * sigma + 0.5) as isize;
        let weight = |i: isize| {
            let x = i as f32 / sigma;
            (-0.5 * x * x).exp()
        };
        let sum: f32 = (-reach..=reach).map(weight).sum();
        let height = self.height();
        let mirrored = |i: isize| {
            let around = i.rem_euclid(2 * height as isize) as usize;
            around.min(2 * height - 1 - around)
        };
        let mut blurred = Plane {
            width: self.width,
            values: vec![0.0; self.values.len()],
        };
        for (y, out) in blurred.values.chunks_exact_mut(self.width).enumerate() {
            for i in -reach..=reach {
                let share = weight(i) / sum;
                let row = &self.values[mirrored(y as isize + i) * self.width..][..self.width];
                for (out, value) in out.iter_mut().zip(row) {
                    *out += share * value;
                }
            }
        }
        blurred
    }

    fn transposed(&self) -> Plane {
        let (width, height) = (self.width, self.height());
        let values = (0..width).flat_map(|x| (0..height).map(move |y| (x, y)));
        Plane {
            width: height,
            values: values.map(|(x, y)| self.values[y * width + x]).collect(),
        }
    }
}

/// Fine over coarse structure inside the clouds of a display-referred picture; none without clouds.
///
/// # Panics
/// With another kind of pixels.
pub fn fine_over_coarse(frame: &Frame) -> Option<f32> {
    let (light, saturation) = planes(frame);
    let inside = inside(&saturation, frame);
    let count = inside.iter().filter(|inside| **inside).count();
    if (count as f32) < LEAST_SHARE * inside.len() as f32 {
        return None;
    }
    let logarithm = light.map(|l| (l + DARK).ln());
    let blurred = SIGMAS.map(|sigma| logarithm.blurred(sigma));
    let bands = blurred.windows(2).map(|pair| {
        let pairs = pair[0].values.iter().zip(&pair[1].values).zip(&inside);
        let apart = pairs.filter(|(_, inside)| **inside);
        let apart: Vec<f64> = apart.map(|((a, b), _)| f64::from(a - b)).collect();
        let mean = apart.iter().sum::<f64>() / apart.len() as f64;
        let square = apart.iter().map(|v| (v - mean) * (v - mean)).sum::<f64>();
        (square / apart.len() as f64).sqrt() as f32
    });
    let bands: Vec<f32> = bands.collect();
    Some((bands[0] + bands[1]) / (bands[3] + bands[4]))
}

/// Luminance and saturation of linear light.
fn planes(frame: &Frame) -> (Plane, Plane) {
    let Pixels::Srgb8(pixels) = &frame.pixels else {
        panic!("a display-referred picture is measured");
    };
    let plane = |of: &dyn Fn([f32; 3]) -> f32| Plane {
        width: frame.width as usize,
        values: pixels
            .iter()
            .map(|[r, g, b, _]| of([*r, *g, *b].map(linear)))
            .collect(),
    };
    (
        plane(&|light| luminance(Vec3::from(light))),
        plane(&|[r, g, b]| 1.0 - r.min(g).min(b) / (r.max(g).max(b) + 1e-6)),
    )
}

/// Which pixels are inside clouds, and high enough.
fn inside(saturation: &Plane, frame: &Frame) -> Vec<bool> {
    let width = frame.width as usize;
    let rows = (frame.height as f32 * ABOVE) as usize;
    let blurred = saturation.blurred(SATURATION_SIGMA);
    let cloud = blurred.values.iter().enumerate();
    let mut inside: Vec<bool> = cloud
        .map(|(i, s)| i / width < rows && *s < CLOUD_SATURATION)
        .collect();
    for _ in 0..INSIDE {
        let before = inside.clone();
        let is = |x: isize, y: isize| {
            let within = x >= 0 && x < width as isize && y >= 0 && y < frame.height as isize;
            within && before[y as usize * width + x as usize]
        };
        for (i, inside) in inside.iter_mut().enumerate() {
            let (x, y) = ((i % width) as isize, (i / width) as isize);
            *inside &= is(x - 1, y) && is(x + 1, y) && is(x, y - 1) && is(x, y + 1);
        }
    }
    inside
}

/// Texels a side of what is looked at for shapes that come back.
const SHAPE_SIDE: usize = 96;
/// Blur that stands for what is not a shape, as a share of the side.
const UNEVEN: f32 = 0.16;
/// How far off shapes are others, as a share of the side.
const APART: f32 = 0.12;
/// Share of the picture that has to meet itself.
const LEAST_OVERLAP: f32 = 0.3;

/// The largest correlation of a square display-referred picture with itself, moved away: 1 where all of it comes back, about 0.2 where
/// nothing does.
///
/// # Panics
/// With another kind of pixels, and where the picture is no square.
pub fn repetition(frame: &Frame) -> f32 {
    let shapes = shapes_of(frame);
    let side = SHAPE_SIDE as isize;
    let mut most = 0.0_f32;
    for (dx, dy) in (0..side).flat_map(|dy| (1 - side..side).map(move |dx| (dx, dy))) {
        let apart = ((dx * dx + dy * dy) as f32).sqrt();
        if apart >= APART * side as f32 {
            most = most.max(correlation(&shapes, &shapes, [dx, dy]).unwrap_or(0.0));
        }
    }
    most
}

/// The largest correlation of two square display-referred pictures over all ways of moving one: 1 where the same shapes have only moved, about 0.2
/// where they are others.
///
/// # Panics
/// With another kind of pixels, and where a picture is no square.
pub fn remaining(first: &Frame, later: &Frame) -> f32 {
    let [first, later] = [first, later].map(shapes_of);
    let moves = 1 - SHAPE_SIDE as isize..SHAPE_SIDE as isize;
    let moves = moves
        .clone()
        .flat_map(|dy| moves.clone().map(move |dx| [dx, dy]));
    let found = moves.filter_map(|by| correlation(&first, &later, by));
    found.fold(0.0, f32::max)
}

/// Luminance of a square picture, [`SHAPE_SIDE`] a side, without what is not a shape.
fn shapes_of(frame: &Frame) -> Vec<f32> {
    assert_eq!(frame.width, frame.height, "a square is looked at");
    let (light, _) = planes(frame);
    let small = shrunk(&light);
    let uneven = small.blurred(UNEVEN * SHAPE_SIDE as f32);
    let pairs = small.values.iter().zip(&uneven.values);
    pairs.map(|(value, uneven)| value - uneven).collect()
}

/// Correlation of one square with another, moved so far; none if too little of them meets.
fn correlation(one: &[f32], other: &[f32], [dx, dy]: [isize; 2]) -> Option<f32> {
    let side = SHAPE_SIDE as isize;
    let overlap = ((side - dx.abs()) * (side - dy.abs())) as f32;
    if overlap < LEAST_OVERLAP * (side * side) as f32 {
        return None;
    }
    let (mut product, mut here, mut there) = (0.0_f32, 0.0_f32, 0.0_f32);
    for y in (-dy).max(0)..side.min(side - dy) {
        for x in (-dx).max(0)..side.min(side - dx) {
            let a = one[(y * side + x) as usize];
            let b = other[((y + dy) * side + x + dx) as usize];
            product += a * b;
            here += a * a;
            there += b * b;
        }
    }
    Some(product / (here * there).sqrt().max(f32::MIN_POSITIVE))
}

/// A square plane averaged down to [`SHAPE_SIDE`].
fn shrunk(plane: &Plane) -> Plane {
    let bounds = |i: usize| i * plane.width / SHAPE_SIDE..(i + 1) * plane.width / SHAPE_SIDE;
    let mean = |(x, y): (usize, usize)| {
        let texels = bounds(y).flat_map(|y| bounds(x).map(move |x| (x, y)));
        let sum: f32 = texels.map(|(x, y)| plane.values[y * plane.width + x]).sum();
        sum / (bounds(x).len() * bounds(y).len()).max(1) as f32
    };
    let places = (0..SHAPE_SIDE).flat_map(|y| (0..SHAPE_SIDE).map(move |x| (x, y)));
    Plane {
        width: SHAPE_SIDE,
        values: places.map(mean).collect(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn picture(width: u32, height: u32, colour: impl Fn(f32, f32) -> [u8; 3]) -> Frame {
        let places = (0..height).flat_map(|y| (0..width).map(move |x| (x as f32, y as f32)));
        let pixels = places.map(|(x, y)| {
            let [r, g, b] = colour(x, y);
            [r, g, b, 255]
        });
        Frame {
            width,
            height,
            pixels: Pixels::Srgb8(pixels.collect()),
        }
    }

    /// Waves of this length in pixels, coarse and fine, right of a blue sky.
    fn waves(coarse: f32, fine: f32) -> Frame {
        picture(320, 180, |x, y| {
            if x < 60.0 {
                return [50, 90, 190];
            }
            let wave = |length: f32| {
                let k = std::f32::consts::TAU / length;
                (k * x).sin() * (k * y).cos()
            };
            [(150.0 + 40.0 * wave(coarse) + 12.0 * wave(fine)).round() as u8; 3]
        })
    }

    /// By numpy and scipy (gaussian_filter, binary_erosion), for the same pictures.
    #[test]
    fn numbers_are_those_of_another_implementation() {
        for ([coarse, fine], expected) in EXPECTED {
            let found = fine_over_coarse(&waves(coarse, fine)).unwrap();
            assert!(
                (found / expected - 1.0).abs() < 2e-3,
                "{found}, expected {expected}"
            );
        }
    }

    const EXPECTED: [([f32; 2], f32); 3] = [
        ([60.0, 5.0], 0.31347),
        ([30.0, 8.0], 2.05812),
        ([90.0, 20.0], 0.30662),
    ];

    #[test]
    fn a_clear_sky_has_no_structure() {
        assert_eq!(
            fine_over_coarse(&picture(320, 180, |_, _| [50, 90, 190])),
            None
        );
    }

    #[test]
    fn what_comes_back_is_told_from_what_does_not() {
        // A hash in place of noise: each block of eight pixels has its own grey.
        let noise = |x: u32, y: u32| {
            let mixed = (x.wrapping_mul(0x9E37_79B1) ^ y.wrapping_mul(0x85EB_CA77))
                .wrapping_mul(0xC2B2_AE3D);
            (mixed >> 24) as u8
        };
        let blocks = |period: u32| {
            picture(256, 256, move |x, y| {
                let block = |v: f32| (v as u32 / 8) % period;
                [noise(block(x), block(y)); 3]
            })
        };
        let (once, twice) = (repetition(&blocks(64)), repetition(&blocks(16)));
        assert!(once < 0.3, "{once}");
        assert!(twice > 0.95, "{twice}");
    }

    #[test]
    fn what_has_only_moved_is_told_from_what_has_changed() {
        // Rings about places that move, and others between them that come and go.
        let rings = |[along, down]: [f32; 2], turned: f32| {
            picture(256, 256, move |x, y| {
                let (x, y) = (x + along, y + down);
                let wave = (0.11 * x + 2.0 * (0.07 * y).sin()).sin()
                    * (0.09 * y + turned * (0.05 * x).cos()).cos();
                [(128.0 + 90.0 * wave).round() as u8; 3]
            })
        };
        let first = rings([0.0, 0.0], 1.0);
        let moved = remaining(&first, &rings([-32.0, 24.0], 1.0));
        let changed = remaining(&first, &rings([-32.0, 24.0], 6.0));
        assert!(moved > 0.97, "{moved}");
        assert!(changed < 0.8, "{changed}");
        assert!(remaining(&first, &first) > 0.999);
    }
}
