//! The map of the fbm method: octaves moved, weighted and summed, remapped, and marched towards the sun.
//!
//! # Theory
//! I. Quilez, "Dynamic Clouds", 2005: `fbm = 1/2 n1 + 1/4 n2 + 1/8 n3 + 1/16 n4`, each octave at its own offset. The four
//! channels of an octave hold the noise here and one, two, three steps towards the sun, so one read an octave gives the
//! sum at all four. What of the four heights lies above the ray is the cloud that the light has passed.
//!
//! # Changes versus the article
//! - Weights add up to 1, whatever the number of octaves.
//! - Its listing moves coarse octaves fastest, its text asks for the contrary: here velocities grow with the frequency,
//!   2.5, 3, 3.5 ... of the listing, and axes alternate as there.
//! - Its listing pairs the ray's depths with the channels such that the ray sinks towards the sun; as in its figure, here
//!   it rises: depth 0 at the pixel, 0.3, 0.6, 0.9 along the steps.
//! - Heights are not cut at 1 before the march, and the light falls off exponentially with the cloud that it passes:
//!   the article's plateaus show as flat grey spots.
//! - The map keeps the blend and not the blended colour, which is the same by linearity and keeps 8 bits for it.
//!
//! # Practice
//! 512x512 texels, one bilinear read an octave. Channels: R the shade, G the sum, A the cover.

use glam::Vec2;
use welkin_pack::Texture;

use crate::clouds::fbm::pack;
use crate::device::context::{Context, Shader};
use crate::device::map::Plane;
use crate::geometry::part::{Part, Value};

/// Its part of the shader.
pub const PART: Part = Part {
    constants: &[
        ("FBM_ABSORPTION", Value::F32(ABSORPTION)),
        ("FBM_DEPTHS", Value::Vec4(DEPTHS)),
    ],
    structs: &[],
    wgsl: include_str!("map.wgsl"),
};

/// Texels a side.
pub const SIDE: u32 = 512;

/// The most octaves.
pub const MAX_OCTAVES: usize = 8;

/// Depths of the ray, three, two, one steps towards the sun and here, as shares of the height of the clouds.
pub const DEPTHS: [f32; 4] = [0.9, 0.6, 0.3, 0.0];

/// Halvings of the light by a mean height of 1 above the ray.
pub const ABSORPTION: f32 = 3.6;

/// Velocity of the first octave and what each further one adds, in the unit of the article's listing.
const VELOCITY: [f64; 2] = [2.5, 0.5];

/// Axis and sense of each octave's motion: the article's d[0] to d[7].
const AXES: [[f64; 2]; MAX_OCTAVES] = [
    [0.0, 1.0],
    [1.0, 0.0],
    [-1.0, 0.0],
    [0.0, 1.0],
    [1.0, 0.0],
    [-1.0, 0.0],
    [0.0, 1.0],
    [-1.0, 0.0],
];

/// How far apart octaves start, in tiles: any numbers by which no lattice points of theirs coincide.
const STARTS_APART: [f64; 2] = [0.137, 0.291];

/// What the runtime keeps of the pack's octaves: mean and standard deviation of each.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Octaves {
    /// Coarsest first, at most eight.
    pub mean_and_spread: Vec<[f32; 2]>,
}

impl Octaves {
    /// Measures the noise (the last channel) of every layer.
    pub fn new(texture: &Texture) -> Octaves {
        let layers = texture.layers.min(MAX_OCTAVES as u32);
        let measure = |layer: u32| {
            let (mean, spread) = texture.image(0, layer).mean_and_spread(3);
            [mean, spread]
        };
        Octaves {
            mean_and_spread: (0..layers).map(measure).collect(),
        }
    }

    /// How many there are.
    pub fn count(&self) -> usize {
        self.mean_and_spread.len()
    }
}

/// Weight of each octave, half of the one before; together 1.
pub fn weights(octaves: &Octaves) -> [f32; MAX_OCTAVES] {
    let mut weights = [0.0; MAX_OCTAVES];
    let sum = 1.0 - 0.5_f32.powi(octaves.count() as i32);
    for (k, weight) in weights.iter_mut().enumerate().take(octaves.count()) {
        *weight = 0.5_f32.powi(k as i32 + 1) / sum;
    }
    weights
}

/// Mean and standard deviation of the sum: octaves are independent.
pub fn mean_and_spread(octaves: &Octaves) -> (f32, f32) {
    let (mut mean, mut variance) = (0.0, 0.0);
    for ([m, s], weight) in octaves.mean_and_spread.iter().zip(weights(octaves)) {
        mean += weight * m;
        variance += weight * weight * s * s;
    }
    (mean, variance.sqrt().max(1e-4))
}

/// Where each octave is read, 0..1, when the slowest one has gone `way` tiles.
pub fn offsets(way: f64) -> [[f32; 2]; MAX_OCTAVES] {
    let mut offsets = [[0.0; 2]; MAX_OCTAVES];
    for (k, (offset, axis)) in offsets.iter_mut().zip(AXES).enumerate() {
        let gone = way * (1.0 + VELOCITY[1] / VELOCITY[0] * k as f64);
        let start = STARTS_APART.map(|apart| apart * k as f64);
        *offset = [0, 1].map(|i| {
            let place = start[i] - axis[i] * gone;
            (place - place.floor()) as f32
        });
    }
    offsets
}

/// The pass on a device, and the re-packing before it.
#[derive(Debug)]
pub(crate) struct Pass {
    pub packing: pack::Pass,
    /// What it draws.
    pub map: Plane,
}

impl Pass {
    /// `octaves` is the pack's texture.
    pub fn new(context: &Context, shader: &Shader, octaves: &wgpu::Texture) -> Pass {
        let packing = pack::Pass::new(context, shader, octaves);
        let drawn = ("fs_fbm_map", SIDE);
        Pass {
            map: Plane::new(context, shader, drawn, packing.texture()),
            packing,
        }
    }

    /// Records the pass; `step` is the uniforms' step towards the sun.
    pub fn draw(
        &mut self,
        encoder: &mut wgpu::CommandEncoder,
        shared: &wgpu::BindGroup,
        step: Vec2,
    ) {
        self.packing.record(encoder, shared, step);
        self.map.record(encoder, shared);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn octaves(count: usize) -> Octaves {
        Octaves {
            mean_and_spread: vec![[0.5, 0.2]; count],
        }
    }

    #[test]
    fn weights_halve_and_add_up_to_one() {
        for count in 1..=MAX_OCTAVES {
            let weights = weights(&octaves(count));
            assert!((weights.iter().sum::<f32>() - 1.0).abs() < 1e-6);
            assert!(
                weights[..count]
                    .windows(2)
                    .all(|w| (w[0] / w[1] - 2.0).abs() < 1e-5)
            );
            assert!(weights[count..].iter().all(|&w| w == 0.0));
        }
    }

    #[test]
    fn finer_octaves_are_faster_and_axes_alternate() {
        let (before, after) = (offsets(0.0), offsets(1e-3));
        let mut last = 0.0;
        for k in 0..MAX_OCTAVES {
            let moved = [0, 1].map(|i| {
                let d = before[k][i] - after[k][i];
                d - d.round()
            });
            let speed = (moved[0].abs()).max(moved[1].abs());
            assert!(
                speed > last && moved[0].abs().min(moved[1].abs()) < 1e-6,
                "{k}"
            );
            last = speed;
        }
        assert!(
            (last / 1e-3 - 2.4).abs() < 1e-2,
            "the last moves at 6 where the first moves at 2.5"
        );
    }

    #[test]
    fn offsets_stay_in_the_tile_for_ever() {
        for way in [-1e9, 0.0, 1e-3, 1e9] {
            assert!(
                offsets(way)
                    .as_flattened()
                    .iter()
                    .all(|o| (0.0..=1.0).contains(o))
            );
        }
    }
}
