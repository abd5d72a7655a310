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
//! # Practice
//! Two reads a texel and layer, 256x256 texels. Channels: R is `LT` (eq. 3), G the amount of
//! cloud before cover, B the opacity, A the shade.

use crate::device::layouts::Layouts;
use crate::device::map::{FORMAT, Map};
use crate::geometry::part::{Part, Value};
use crate::params::{LAYERS_AN_ITERATION, MAX_LAYERS};

/// Its part of the shader.
pub const PART: Part = Part {
    constants: &[
        ("LIT_LEAST_UP", Value::F32(LEAST_UP)),
        ("LIT_FIRST_WEIGHT", Value::F32(WEIGHTS[0])),
        ("LIT_SECOND_WEIGHT", Value::F32(WEIGHTS[1])),
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
    pub fn new(
        device: &wgpu::Device,
        module: &wgpu::ShaderModule,
        layouts: &Layouts,
        layers: &wgpu::Texture,
    ) -> Pass {
        let pipelines = |entry: &str| {
            let iterations = 0..MAX_LAYERS / LAYERS_AN_ITERATION;
            let pipeline = |iteration: usize| {
                let first = (iteration * LAYERS_AN_ITERATION) as f64;
                let targets = &[FORMAT; LAYERS_AN_ITERATION];
                let constants = &[("FIRST_LAYER", first)];
                let own = &layouts.layers;
                layouts.off_screen_with(device, module, entry, own, targets, constants)
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
