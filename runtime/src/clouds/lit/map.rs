//! The map of the lit method: light, opacity and shade of each layer, three layers at a time.
//!
//! # Theory
//! Mukhina and Bezgodov (see [`crate::clouds::lit`]), section 4: cover takes the brightest parts of the noise; normals are read from the
//! texture; shade is `SH = (1 - sum C)^m` (eq. 5), here of each place alone: the dome blurs it radially. Three layers
//! are drawn in an iteration, as the paper has them in three colour channels: here they are three colour attachments.
//!
//! # Changes versus the paper
//! - Two reads, weighted [`WEIGHTS`], move apart. Ranks are evenly distributed, so the sum has a trapezoidal distribution, whose
//!   integral makes it even again: what cover cuts is an exact share.
//! - `C` of eq. 5 is the share that the thickness towards the sun takes, `1 - 2^(-w s)`: a sum of coverages goes beyond 1.
//!
//! - By default the map holds what [`crate::clouds::shared`] lights clouds by: heights here and at three places towards the sun, farther away under a
//!   low one, are summed as far as they reach above the ray, and the slope of the clouds' surface, by their normals, adds relief.
//! - An overcast has rolls of a kilometre or two ([`ROLLS`]), of the lumps of cumulus and the bands of cirrus, in place of the noise's own lumps.
//! - The fibres of cirrus are bent by two shears: straight ones would be streaks from one point of the horizon.
//!
//! # Practice
//! 256x256 texels. Two reads a texel and layer by the paper's shading: R is `LT` (eq. 3), G the amount of cloud before cover, B the opacity, A the
//! shade. Else eight, or sixteen under an overcast: R is what is left of light that is scattered many times, A the height.

use glam::{Vec2, Vec3};
use welkin_pack::{Image, LayerKind, Texture};

use super::look::look;
use crate::device::context::{Context, Shader};
use crate::device::map::{FORMAT, Map};
use crate::geometry::part::{Part, Value};
use crate::params::{LAYERS_AN_ITERATION, MAX_LAYERS};

/// Its part of the shader.
pub const PART: Part = Part {
    constants: &[
        ("LIT_LEAST_UP", Value::F32(LEAST_UP)),
        ("LIT_FIRST_WEIGHT", Value::F32(WEIGHTS[0])),
        ("LIT_SECOND_WEIGHT", Value::F32(WEIGHTS[1])),
        ("LIT_CUMULUS", Value::Int(LayerKind::Cumulus as i32)),
        ("LIT_CIRRUS", Value::Int(LayerKind::Cirrus as i32)),
        ("LIT_BENDS", Value::Vec4(BENDS)),
        ("LIT_FIBRE_LEVEL", Value::F32(FIBRE_LEVEL)),
        ("LIT_ROLLS", Value::Vec4(ROLLS)),
        ("LIT_ROLL_LEVELS", Value::Vec2(ROLL_LEVELS)),
        ("LIT_STEPS", Value::Vec3(Vec3::from_array(STEPS))),
        ("LIT_APART", Value::Vec3(Vec3::from_array(APART))),
        ("LIT_RISES", Value::Vec3(Vec3::from_array(RISES))),
        ("LIT_SHARES", Value::Vec3(Vec3::from_array(SHARES))),
        ("LIT_OWN", Value::F32(OWN)),
        ("LIT_RELIEF", Value::F32(RELIEF)),
        ("LIT_RELIEF_FULL", Value::F32(RELIEF_FULL)),
        ("LIT_EVENED_RELIEF", Value::F32(EVENED_RELIEF)),
        (
            "LIT_LAYERS_AN_ITERATION",
            Value::Int(LAYERS_AN_ITERATION as i32),
        ),
    ],
    structs: &[],
    wgsl: include_str!("map.wgsl"),
};

/// Texels a side.
pub const SIDE: u32 = 256;
/// The least square of a normal's upward part.
pub const LEAST_UP: f32 = 0.04;
/// Weights of the two reads, the larger first; together 1.
pub const WEIGHTS: [f32; 2] = [0.6, 0.4];

/// How far the fibres of cirrus are bent, in tiles: across by waves of one and of half a tile, along by waves of one and of a third.
pub const BENDS: [f32; 4] = [0.10, 0.05, 0.09, 0.04];
/// Level at which fibres are read, two tiles of them to one of the map: finer ones would be stairs of its texels overhead. The mean of ranks is no rank,
/// so they are made even again by their spread ([`spreads`]).
pub const FIBRE_LEVEL: f32 = 2.0;
/// Height of an overcast where its rolls have their mean, what rolls and the amount of cloud add, and how round its least height is. Numbers here
/// and below are chosen by eye.
pub const ROLLS: [f32; 4] = [0.5, 1.5, 0.5, 0.1];
/// Levels at which lumps and fibres are read as rolls: bands of one to two kilometres.
pub const ROLL_LEVELS: [f32; 2] = [1.0, 2.0];
/// Places towards the sun, in steps, and how far each is from the one before.
pub const STEPS: [f32; 3] = [1.0, 2.5, 5.5];
pub const APART: [f32; 3] = [1.0, 1.5, 3.0];
/// How high the ray has risen there, as heights of clouds.
pub const RISES: [f32; 3] = [0.12, 0.3, 0.66];
/// What the light passes of the heights there over the ray, and of the place's own.
pub const SHARES: [f32; 3] = [0.55, 0.8, 1.2];
pub const OWN: f32 = 0.5;
/// What a slope towards the sun takes of that, the height, as 1 over it, from which all of it counts, and what an overcast takes of it.
pub const RELIEF: f32 = 0.25;
pub const RELIEF_FULL: f32 = 4.0;
pub const EVENED_RELIEF: f32 = 0.7;

/// Standard deviations of the ranks of fibres and of lumps, as coarse and as smooth as a layer of cirrus reads them; `layers` is the pack's texture.
pub fn spreads(layers: &Texture) -> Vec2 {
    let image = |kind: LayerKind, level: f32| {
        let level = (level as usize).min(layers.levels.len() - 1);
        layers.image(level, kind as u32)
    };
    let fibres = splined_spread(&image(LayerKind::Cirrus, FIBRE_LEVEL));
    let second_level = look(LayerKind::Cirrus).second_level;
    let (_, lumps) = image(LayerKind::Cumulus, second_level).mean_and_spread(RANK);
    Vec2::new(fibres, lumps).max(Vec2::splat(1.0 / 255.0))
}

/// The channel of the rank.
const RANK: usize = 3;

/// Standard deviation of the ranks of a tile between whose texels the cubic B-spline lies, over four places a texel.
fn splined_spread(image: &Image) -> f32 {
    let side = image.width as usize;
    // Weights of four texels, at a quarter between the middle two and at three.
    let near = [27.0, 235.0, 121.0, 1.0].map(|share| share / 384.0);
    let weights = [near, [near[3], near[2], near[1], near[0]]];
    let rank = |x: usize, y: usize| {
        let texel = (y % side) * side + x % side;
        f64::from(image.texels[texel * image.channels + RANK])
    };
    let (mut sum, mut squares) = (0.0, 0.0);
    for texel in 0..side * side {
        for (across, down) in [(0, 0), (1, 0), (0, 1), (1, 1)] {
            let row = |y: usize| -> f64 {
                let texels = (0..4).zip(weights[across]);
                texels.map(|(x, w)| w * rank(texel % side + x, y)).sum()
            };
            let rows = (0..4).zip(weights[down]);
            let value: f64 = rows.map(|(y, w)| w * row(texel / side + y)).sum();
            sum += value;
            squares += value * value;
        }
    }
    let count = 4.0 * (side * side) as f64;
    let mean = sum / count;
    (squares / count - mean * mean).max(0.0).sqrt() as f32
}

/// The pass on a device.
#[derive(Debug)]
pub(crate) struct Pass {
    /// What it draws: an array of [`MAX_LAYERS`], and what [`array_layers`](crate::device::layouts::array_layers) adds.
    pub map: Map,
    /// The pack's layers.
    source: wgpu::BindGroup,
    /// Of each iteration.
    drawing: Vec<wgpu::RenderPipeline>,
    /// Group 1 of the dome.
    pub group: wgpu::BindGroup,
}

impl Pass {
    /// `layers` is the pack's texture.
    pub fn new(context: &Context, shader: &Shader, layers: &wgpu::Texture) -> Pass {
        let (device, layouts) = (&context.device, &context.layouts);
        let pipelines = |entry: &str| {
            let iterations = 0..MAX_LAYERS / LAYERS_AN_ITERATION;
            let pipeline = |iteration: usize| {
                let first = (iteration * LAYERS_AN_ITERATION) as f64;
                let targets = &[FORMAT; LAYERS_AN_ITERATION];
                let constants = &[("FIRST_LAYER", first)];
                let own = &layouts.layers;
                context.off_screen_with(shader, entry, own, targets, constants)
            };
            iterations.map(pipeline).collect()
        };
        let averaging = pipelines("fs_lit_level");
        let map = Map::new(device, layouts, averaging, [SIDE, MAX_LAYERS as u32]);
        Pass {
            source: layouts.layers_group(device, layers),
            drawing: pipelines("fs_lit_map"),
            group: layouts.lit_group(device, layers, &map.texture),
            map,
        }
    }

    /// Records the passes of the first `count` layers.
    pub fn draw(&self, encoder: &mut wgpu::CommandEncoder, shared: &wgpu::BindGroup, count: usize) {
        let iterations = self.drawing.iter().enumerate();
        for drawing in iterations.take(count.div_ceil(LAYERS_AN_ITERATION)) {
            self.map
                .record(encoder, shared, drawing, Some(&self.source));
        }
    }
}
