//! The map of the octaves method: white noise in two states, interpolated, up-sampled, filtered, tiled and summed.
//!
//! # Theory
//! Guthikonda et al. (see [`crate::clouds::octaves`]), sections "Cloud Generation" and "Cloud Movement": octave k is noise of 32x32
//! texels, up-sampled to 256, 128, 64 and 32, filtered by a Gaussian, tiled 1, 2, 4 and 8 times; so it has 32, 64, 128
//! and 256 cells across the map, each weighing half of the one before. Every `formation_interval` a new state comes in,
//! and the picture goes over to it linearly.
//!
//! # Changes versus the paper
//! - New noise is not drawn but a function of (seed, octave, number of the interval): two of the pack's channels, each
//!   turned and shifted by a hash, added modulo 1. The sum of independent uniform noises modulo 1 is uniform noise.
//! - The Gaussian is the cubic B-spline, the fourfold convolution of a box: bilinear up-sampling is its first half.
//!   It has the variance 1/3 of a cell and differs from the Gaussian of that variance by 0.025 at most, where its peak is 0.69.
//! - Half way between two independent states a linear blend has half of their variance, and clouds would come and go
//!   with every interval; it is divided by `sqrt(f^2 + (1 - f)^2)`. Octaves change in turn, not all at once.
//! - The sum is mapped by the normal distribution, so that every cover finds that share of the sky.
//! - Beyond four octaves: the fifth and sixth are larger than the first (16 and 8 cells: the sky has open and
//!   closed parts), the seventh and eighth are finer than the fourth, and the map grows to hold them.
//!
//! # Practice
//! The states are made on the CPU, one or two kilobytes an octave and frame; the pass reads four bilinear samples an octave
//! and texel, two of them twice for the relief. R holds the amount of cloud, G and B the opacity of the low and of the middle dome, A
//! the grey of the low one. Nothing is remembered, so the sky at any second can be drawn at once.

use half::f16;

use crate::device::context::{Context, Shader};
use crate::device::layouts::{Layouts, array_layers};
use crate::device::map::Plane;
use crate::device::upload::written_array;
use crate::geometry::math::mix;
use crate::geometry::part::{Part, Value};
use crate::params::{MAX_OCTAVES, SkyParams};

/// Its part of the shader.
pub const PART: Part = Part {
    constants: &[
        ("OCTAVE_NOISE_SIDE", Value::F32(NOISE_SIDE as f32)),
        ("OCTAVE_RELIEF_COUNT", Value::Int(RELIEF_COUNT)),
    ],
    structs: &[],
    wgsl: include_str!("map.wgsl"),
};

/// Texels a side of an octave's noise.
pub const NOISE_SIDE: u32 = 32;

/// Channels of the pack's texture.
const CHANNELS: u64 = 4;

/// Octaves that give relief: the first two, which are wider than the step towards the sun.
pub const RELIEF_COUNT: i32 = 2;

/// Cells across the map, in the order in which octaves are added.
const CELLS: [u32; MAX_OCTAVES as usize] = [32, 64, 128, 256, 16, 8, 512, 1024];

/// Texels a side of the map for a number of octaves.
pub fn side(count: u32) -> u32 {
    match count {
        0..=6 => 256,
        7 => 512,
        _ => 1024,
    }
}

/// How often the noise of each octave repeats across the map; below 1 only a part of it is used.
pub(crate) fn copies(count: u32) -> [f32; MAX_OCTAVES as usize] {
    let mut copies = [0.0; MAX_OCTAVES as usize];
    for (copies, cells) in copies.iter_mut().zip(CELLS).take(count as usize) {
        *copies = cells as f32 / NOISE_SIDE as f32;
    }
    copies
}

/// The state of every octave at a moment, weighted and centred so that the filtered sum has mean 0 and variance 1.
///
/// One 32x32 image an octave, rows from the top. `noise` are the bytes of the pack's texture, `seed` is the pack's.
pub fn states(noise: &[u8], seed: u64, params: &SkyParams, seconds: f64) -> Vec<f32> {
    let own = params.octaves;
    let scales = scales(own.count);
    let mut states = Vec::with_capacity(own.count as usize * (NOISE_SIDE * NOISE_SIDE) as usize);
    for octave in 0..own.count {
        // Octaves change in turn: at no moment do all begin a new interval.
        let turn = f64::from(octave) * 0.618_033_988_749_894_9;
        let intervals = seconds / f64::from(own.formation_interval_s) + turn;
        let share = (intervals - intervals.floor()) as f32;
        let [previous, current] = [0, 1]
            .map(|next| Place::new(seed, octave, (intervals.floor() as i64).wrapping_add(next)));
        let scale =
            scales[octave as usize] / (share * share + (1.0 - share) * (1.0 - share)).sqrt();
        // A coarser octave uses a part of the noise, again and again.
        let mask = CELLS[octave as usize].min(NOISE_SIDE) - 1;
        for cell in 0..NOISE_SIDE * NOISE_SIDE {
            let (x, y) = ((cell % NOISE_SIDE) & mask, (cell / NOISE_SIDE) & mask);
            let [from, to] = [&previous, &current].map(|p| p.byte(noise, x, y) / 255.0 - 0.5);
            states.push((from + (to - from) * share) * scale);
        }
    }
    states
}

/// Factor of each octave: half of the next coarser one's, and all together such that the sum has variance 1.
fn scales(count: u32) -> Vec<f32> {
    let cells = &CELLS[..count as usize];
    let weights: Vec<f64> = cells.iter().map(|&c| 1.0 / f64::from(c)).collect();
    let variance: f64 = cells
        .iter()
        .zip(&weights)
        .map(|(&c, w)| w * w * BYTE_VARIANCE * filtered_variance(side(count) / c))
        .sum();
    weights
        .iter()
        .map(|w| (w / variance.sqrt()) as f32)
        .collect()
}

/// Variance of a byte / 255 when every byte is equally likely: (256^2 - 1) / 12 / 255^2.
const BYTE_VARIANCE: f64 = 65535.0 / 12.0 / 65025.0;

/// What the filter leaves of the variance of white noise, on average over the texels of a cell that is `texels` wide.
fn filtered_variance(texels: u32) -> f64 {
    let spline = |t: f64| {
        let s = 1.0 - t;
        [
            s * s * s / 6.0,
            (4.0 + 3.0 * t * t * (t - 2.0)) / 6.0,
            (4.0 + 3.0 * s * s * (s - 2.0)) / 6.0,
            t * t * t / 6.0,
        ]
    };
    let line = (0..texels).map(|i| {
        let place = (f64::from(i) + 0.5) / f64::from(texels) - 0.5;
        let weights = spline(place - place.floor());
        weights.iter().map(|w| w * w).sum::<f64>()
    });
    let mean = line.sum::<f64>() / f64::from(texels);
    mean * mean
}

/// Where the noise of an octave and interval is read.
struct Place {
    /// For each of the two noises: channel, shift along x and y, whether x and y are exchanged.
    reads: [(usize, u32, u32, bool); 2],
}

impl Place {
    fn new(seed: u64, octave: u32, interval: i64) -> Place {
        let mixed = mix(mix(seed ^ mix(u64::from(octave) + 1)) ^ interval as u64);
        let read = |bits: u64, channel: u64| {
            (
                channel as usize,
                bits as u32 & (NOISE_SIDE - 1),
                (bits >> 5) as u32 & (NOISE_SIDE - 1),
                bits >> 10 & 1 == 1,
            )
        };
        // Two different channels: a noise added to itself would not be uniform.
        let first = mixed >> 32 & (CHANNELS - 1);
        let second = (first + 1 + (mixed >> 34) % (CHANNELS - 1)) % CHANNELS;
        Place {
            reads: [read(mixed, first), read(mixed >> 11, second)],
        }
    }

    /// The noise of a cell, 0..=255.
    fn byte(&self, noise: &[u8], x: u32, y: u32) -> f32 {
        let sum = self
            .reads
            .iter()
            .fold(0_u8, |sum, &(channel, dx, dy, swap)| {
                let (x, y) = if swap { (y, x) } else { (x, y) };
                let texel = (y + dy) % NOISE_SIDE * NOISE_SIDE + (x + dx) % NOISE_SIDE;
                let byte = noise.get(texel as usize * CHANNELS as usize + channel);
                sum.wrapping_add(byte.copied().unwrap_or_default())
            });
        f32::from(sum)
    }
}

/// The pass on a device.
#[derive(Debug)]
pub(crate) struct Pass {
    pub states: wgpu::Texture,
    /// What it draws.
    pub map: Plane,
}

impl Pass {
    pub fn new(context: &Context, shader: &Shader, count: u32) -> Pass {
        let states = states_texture(&context.device, count);
        let drawn = ("fs_octaves_map", side(count));
        Pass {
            map: Plane::new(context, shader, drawn, &states),
            states,
        }
    }

    /// Makes the textures anew if they are for another number of octaves.
    pub fn resize(&mut self, device: &wgpu::Device, layouts: &Layouts, count: u32) {
        if self.states.depth_or_array_layers() != array_layers(count) {
            self.states = states_texture(device, count);
            self.map.set_source(device, layouts, &self.states);
        }
        self.map.resize(device, layouts, side(count));
    }

    /// Uploads the states of the octaves and records the pass.
    pub fn draw(
        &self,
        queue: &wgpu::Queue,
        encoder: &mut wgpu::CommandEncoder,
        shared: &wgpu::BindGroup,
        states: &[f32],
    ) {
        let bytes: Vec<u8> = states
            .iter()
            .flat_map(|&v| f16::from_f32(v).to_le_bytes())
            .collect();
        let layout = wgpu::TexelCopyBufferLayout {
            offset: 0,
            bytes_per_row: Some(NOISE_SIDE * 2),
            rows_per_image: Some(NOISE_SIDE),
        };
        let size = wgpu::Extent3d {
            depth_or_array_layers: states.len() as u32 / (NOISE_SIDE * NOISE_SIDE),
            ..self.states.size()
        };
        queue.write_texture(self.states.as_image_copy(), &bytes, layout, size);
        self.map.record(encoder, shared);
    }
}

/// An array with a layer an octave.
fn states_texture(device: &wgpu::Device, count: u32) -> wgpu::Texture {
    let size = [NOISE_SIDE, NOISE_SIDE, array_layers(count)];
    written_array(device, "octave states", wgpu::TextureFormat::R16Float, size)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Noise as the pack holds it: every byte equally often, shuffled.
    fn shuffled() -> Vec<u8> {
        let mut bytes = vec![0; 4096];
        for channel in 0..4 {
            let mut order: Vec<(u64, u8)> =
                (0..1024).map(|i| (mix(i * 4 + channel), i as u8)).collect();
            order.sort_unstable();
            for (texel, (_, byte)) in order.into_iter().enumerate() {
                bytes[texel * 4 + channel as usize] = byte;
            }
        }
        bytes
    }

    fn states_at(count: u32, interval_s: f32, seconds: f64) -> Vec<f32> {
        let mut params = SkyParams::default();
        params.octaves.count = count;
        params.octaves.formation_interval_s = interval_s;
        states(&shuffled(), 7, &params, seconds)
    }

    #[test]
    fn every_octave_has_its_cells_and_the_map_holds_them() {
        for count in 1..=MAX_OCTAVES {
            let finest = CELLS[..count as usize].iter().max().copied().unwrap_or(0);
            assert!(finest <= side(count), "{count}");
            assert_eq!(states_at(count, 60.0, 5.0).len(), count as usize * 1024);
        }
        assert_eq!(copies(4), [1.0, 2.0, 4.0, 8.0, 0.0, 0.0, 0.0, 0.0]);
    }

    #[test]
    fn a_spline_leaves_the_variance_of_the_closed_form() {
        // The integral of the squared cubic B-spline is 151 / 315; at whole cells it is 1/2.
        let limit = (151.0_f64 / 315.0).powi(2);
        assert!((filtered_variance(64) - limit).abs() < 1e-3);
        assert!((filtered_variance(1) - 0.25).abs() < 1e-12);
    }

    #[test]
    fn states_have_no_mean_and_the_same_variance_at_every_moment() {
        let scale = scales(4)[0];
        for seconds in [0.0, 10.0, 30.0, 59.9, 1e6] {
            let first = &states_at(4, 60.0, seconds)[..1024];
            let mean = first.iter().sum::<f32>() / 1024.0;
            let variance = first.iter().map(|v| (v - mean) * (v - mean)).sum::<f32>() / 1024.0;
            let expected = scale * scale * BYTE_VARIANCE as f32;
            // 1024 values: the mean is off by sigma / 32, the variance by sqrt(2 / 1024), five times at most.
            assert!(
                mean.abs() < 5.0 * expected.sqrt() / 32.0,
                "{seconds}: {mean}"
            );
            assert!(
                (variance / expected - 1.0).abs() < 5.0 * 0.045,
                "{seconds}: {variance} {expected}"
            );
        }
    }

    #[test]
    fn the_picture_goes_over_to_the_next_state_without_a_jump() {
        let (before, at, after) = (
            states_at(4, 60.0, 60.0 - 1e-3),
            states_at(4, 60.0, 60.0),
            states_at(4, 60.0, 60.0 + 1e-3),
        );
        let apart = |a: &[f32], b: &[f32]| {
            a.iter()
                .zip(b)
                .map(|(a, b)| (a - b).abs())
                .fold(0.0, f32::max)
        };
        let limit = 1e-3 / 60.0 * 4.0 * scales(4)[0];
        assert!(apart(&before, &at) < limit && apart(&at, &after) < limit);
        assert!(apart(&before, &states_at(4, 60.0, 120.0)) > 0.5 * scales(4)[0]);
    }

    #[test]
    fn states_an_interval_apart_are_independent() {
        let correlation = |a: &[f32], b: &[f32]| {
            let dot = |a: &[f32], b: &[f32]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f32>();
            dot(a, b) / (dot(a, a) * dot(b, b)).sqrt()
        };
        let first = |interval: i64| states_at(1, 1.0, interval as f64);
        for interval in 0..40 {
            for later in 1..4 {
                // 1024 pairs: a correlation has the deviation 1/32; six of them in 120 trials are a chance of 1e-7.
                let found = correlation(&first(interval), &first(interval + later));
                assert!(found.abs() < 6.0 / 32.0, "{interval} {later}: {found}");
            }
        }
    }

    #[test]
    fn other_seeds_octaves_and_negative_times_have_their_own_noise() {
        let params = SkyParams::default();
        let noise = shuffled();
        let one = states(&noise, 1, &params, 0.0);
        assert_ne!(one, states(&noise, 2, &params, 0.0));
        assert_ne!(one[..1024], one[1024..2048]);
        assert_ne!(one, states(&noise, 1, &params, -60.0));
        assert_eq!(one, states(&noise, 1, &params, 0.0));
    }
}
