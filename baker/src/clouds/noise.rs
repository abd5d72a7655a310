//! The noise and detail channels: periodic fractal noise.
//!
//! # Theory
//! Fractal Brownian motion is a sum of octaves of gradient noise (K. Perlin, "Improving Noise", SIGGRAPH
//! 2002), each twice as fine and weaker by `gain`. The kernel is the `noise` crate's; this file gives it
//! lattices that tile.
//!
//! Read a lattice point (x, y) as the Gaussian integer x + iy. If the tile's sides are `w = a + ib` and
//! `iw`, whole lattice points, then giving points that differ by a multiple of `w` the same gradient makes
//! the noise tile exactly, and the lattice stands at the angle `atan2(b, a)` to the tile. Every octave takes
//! another angle, so no direction of the lattice shows: a rotation of the domain that still tiles.
//!
//! The kernel is read on the plane half way between two layers of a three-dimensional lattice: there, unlike
//! on a layer, the noise is not zero at lattice points, and twelve gradients instead of four hide its axes.

use noise::Vector3;
use noise::core::perlin::perlin_3d;
use noise::permutationtable::NoiseHasher;
use welkin_pack::Image;

use crate::filter;
use crate::settings::FractalSettings;
use crate::stream::Stream;

/// Octaves finer than this many texels a cell are left out: they would not be smooth at the texel.
const FINEST_CELL_TEXELS: u32 = 6;

/// Turn from one octave's lattice to the next, in radians: the golden angle, pi (3 - sqrt 5).
const TURN_RAD: f64 = 2.399_963_229_728_653;

/// Share of the texels that is clipped to 0.
const CLIPPED: f32 = 0.002;

/// Where outliers are bent in, in standard deviations.
const OUTLIER: f32 = 4.0;

/// A channel of `size` texels a side that tiles, with the settings' mean. `name` is its random stream.
pub(crate) fn channel(settings: &FractalSettings, size: u32, seed: u64, name: &str) -> Image {
    let mut stream = Stream::new(seed, name);
    let finest = f64::from(size / FINEST_CELL_TEXELS);
    let octaves: Vec<Lattice> = (0..settings.octaves)
        .map(|k| {
            (
                f64::from(settings.cells) * f64::from(1_u32 << k),
                0.7 + TURN_RAD * f64::from(k),
            )
        })
        .filter(|&(cells, _)| cells <= finest)
        .map(|(cells, angle)| Lattice::new(cells, angle, &mut stream))
        .collect();
    let gain = f64::from(settings.gain);
    let mut channel = filter::plane(size, size, |x, y| {
        let [u, v] = [x, y].map(|i| (f64::from(i) + 0.5) / f64::from(size));
        fractal(&octaves, gain, u, v)
    });
    filter::calibrate(&mut channel, CLIPPED, OUTLIER, settings.mean);
    channel
}

fn fractal(octaves: &[Lattice], gain: f64, u: f64, v: f64) -> f32 {
    let mut amplitude = 1.0;
    let mut sum = 0.0;
    for octave in octaves {
        sum += amplitude * octave.noise(u, v);
        amplitude *= gain;
    }
    sum as f32
}

/// Gradient noise on the unit torus: a lattice whose points repeat by a Gaussian integer.
struct Lattice {
    /// The tile's side, a + ib.
    side: [i64; 2],
    /// The lattice points that the tile reaches: first column and row, and columns.
    origin: [i64; 2],
    columns: i64,
    /// Gradient index of each, row by row, in the two layers that the slice lies between.
    gradients: Vec<[u8; 2]>,
}

impl Lattice {
    /// About `cells` cells a side, turned by about `angle` radians: both are rounded to whole lattice points.
    fn new(cells: f64, angle: f64, stream: &mut Stream) -> Lattice {
        // A quarter turn is a symmetry of the lattice, so the angle can be taken in the first quadrant.
        let (sin, cos) = (libm::sin(angle).abs(), libm::cos(angle).abs());
        let a = (libm::round(cells * cos) as i64).max(1);
        let b = libm::round(cells * sin) as i64;
        // The tile's corners are 0, a + ib, i(a + ib) and their sum; one more point on every side.
        let (origin, columns, rows) = ([-b - 1, -1], a + b + 4, a + b + 4);
        let mut lattice = Lattice {
            side: [a, b],
            origin,
            columns,
            gradients: vec![[0; 2]; (columns * rows) as usize],
        };
        lattice.draw(rows, stream);
        lattice
    }

    fn draw(&mut self, rows: i64, stream: &mut Stream) {
        let points = (0..rows).flat_map(|r| (0..self.columns).map(move |c| (c, r)));
        let points: Vec<[i64; 2]> = points
            .map(|(c, r)| [self.origin[0] + c, self.origin[1] + r])
            .collect();
        // Only a class's representative draws, so that the stream does not depend on the margin.
        for &point in &points {
            if self.representative(point) == point {
                let index = self.index(point);
                let bits = stream.bits();
                self.gradients[index] = [(bits >> 56) as u8, (bits >> 48) as u8];
            }
        }
        for &point in &points {
            let (from, to) = (self.index(self.representative(point)), self.index(point));
            self.gradients[to] = self.gradients[from];
        }
    }

    /// The one point in the tile that differs from `point` by a Gaussian multiple of the side.
    fn representative(&self, [x, y]: [i64; 2]) -> [i64; 2] {
        let [a, b] = self.side;
        let norm = a * a + b * b;
        let s = (x * a + y * b).div_euclid(norm);
        let t = (y * a - x * b).div_euclid(norm);
        [x - s * a + t * b, y - s * b - t * a]
    }

    fn index(&self, [x, y]: [i64; 2]) -> usize {
        ((y - self.origin[1]) * self.columns + x - self.origin[0]) as usize
    }

    /// Noise in -1..1 at (u, v), with period 1 in both.
    fn noise(&self, u: f64, v: f64) -> f64 {
        let [a, b] = self.side.map(|n| n as f64);
        perlin_3d(Vector3::new(u * a - v * b, u * b + v * a, 0.5), self)
    }
}

impl NoiseHasher for Lattice {
    fn hash(&self, point: &[isize]) -> usize {
        usize::from(
            self.gradients[self.index([point[0] as i64, point[1] as i64])][(point[2] & 1) as usize],
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeSet;

    fn lattices() -> Vec<Lattice> {
        let mut stream = Stream::new(1, "test");
        [(1.0, 0.0), (4.0, 0.7), (8.0, 3.1), (13.0, 5.5)]
            .map(|(c, a)| Lattice::new(c, a, &mut stream))
            .into()
    }

    #[test]
    fn points_a_side_apart_are_one() {
        for lattice in lattices() {
            let [a, b] = lattice.side;
            let mut classes = BTreeSet::new();
            for (x, y) in (-20..20).flat_map(|x| (-20..20).map(move |y| (x, y))) {
                let here = lattice.representative([x, y]);
                assert_eq!(here, lattice.representative([x + a, y + b]));
                assert_eq!(here, lattice.representative([x - b, y + a]));
                assert_eq!(here, lattice.representative(here));
                classes.insert(here);
            }
            // The norm of a Gaussian integer counts the residues modulo it; 40 points a side reach all.
            assert_eq!(classes.len() as i64, a * a + b * b);
        }
    }

    #[test]
    fn opposite_sides_are_equal() {
        for lattice in lattices() {
            for i in 0..50 {
                let t = f64::from(i) / 50.0;
                // Lattice coordinates of a few cells carry errors of 1e-15; the slope is below 10 a cell.
                assert!((lattice.noise(0.0, t) - lattice.noise(1.0, t)).abs() < 1e-12);
                assert!((lattice.noise(t, 0.0) - lattice.noise(t, 1.0)).abs() < 1e-12);
            }
        }
    }
}
