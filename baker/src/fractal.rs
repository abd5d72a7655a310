//! Fractal sums of gradient noise that tile.
//!
//! # Theory
//! Fractal Brownian motion is a sum of octaves of gradient noise (K. Perlin, "An Image Synthesizer", SIGGRAPH 1985),
//! each twice as fine and weaker by `gain`. Other functions of an octave than itself make other characters: of its
//! absolute value, ridges and billows. `lattice.rs` makes the octaves.

use crate::lattice::Lattice;
use crate::stream::Stream;

/// Octaves finer than this many texels a cell are left out: they would not be smooth at the texel.
const FINEST_CELL_TEXELS: u32 = 6;

/// Angle of the first octave's lattice to the tile, in radians.
const FIRST_ANGLE_RAD: f64 = 0.7;

/// Turn from one octave's lattice to the next, in radians: the golden angle, pi (3 - sqrt 5).
const TURN_RAD: f64 = 2.399_963_229_728_653;

/// Octaves of gradient noise on the unit torus.
pub(crate) struct Fractal {
    octaves: Vec<Lattice>,
    gain: f64,
}

/// What a sum is made of.
#[derive(Clone, Copy)]
pub(crate) struct Octaves {
    /// Octaves; each doubles the cells of the one before.
    pub count: u32,
    /// Amplitude of an octave as a share of the one before.
    pub gain: f64,
}

impl Octaves {
    pub(crate) fn new(count: u32, gain: f32) -> Octaves {
        Octaves {
            count,
            gain: f64::from(gain),
        }
    }
}

impl Fractal {
    /// `cells` are the first octave's along u and along v, `size` the texels a side.
    pub(crate) fn new(
        cells: [f64; 2],
        octaves: Octaves,
        size: u32,
        stream: &mut Stream,
    ) -> Fractal {
        let finest = f64::from(size / FINEST_CELL_TEXELS);
        let lattices = (0..octaves.count)
            .map(|k| {
                let cells = cells.map(|n| n * f64::from(1_u32 << k));
                (cells, FIRST_ANGLE_RAD + TURN_RAD * f64::from(k))
            })
            .filter(|(cells, _)| cells.iter().all(|&n| n <= finest));
        Fractal {
            octaves: lattices
                .map(|(cells, angle)| Lattice::new(cells, angle, stream))
                .collect(),
            gain: octaves.gain,
        }
    }

    /// The sum at a point of the plane; its period is 1 along u and v.
    pub(crate) fn at(&self, point: [f64; 2]) -> f64 {
        self.sum(point, |noise| noise)
    }

    /// The sum of what `shape` makes of each octave, which is in -1..1.
    pub(crate) fn sum(&self, point: [f64; 2], shape: impl Fn(f64) -> f64) -> f64 {
        let mut amplitude = 1.0;
        let mut sum = 0.0;
        for octave in &self.octaves {
            sum += amplitude * shape(octave.noise(point));
            amplitude *= self.gain;
        }
        sum
    }
}
