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

use crate::device::layouts::{Layouts, array_layers};
use crate::device::map;
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
    wgsl: include_str!("lit_map.wgsl"),
};

/// Texels a side.
pub const SIDE: u32 = 256;
/// The least square of a normal's upward part.
pub const LEAST_UP: f32 = 0.04;
/// Weights of the two reads, the larger first; together 1.
pub const WEIGHTS: [f32; 2] = [0.6, 0.4];

const FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba8Unorm;

/// The pass on a device.
#[derive(Debug)]
pub(crate) struct Pass {
    texture: wgpu::Texture,
    /// The targets of each level: one a layer.
    levels: Vec<Vec<wgpu::TextureView>>,
    /// Each level as what the next one is made from.
    sources: Vec<wgpu::BindGroup>,
    /// The pack's layers.
    source: wgpu::BindGroup,
    /// Of each iteration.
    drawing: Vec<wgpu::RenderPipeline>,
    averaging: Vec<wgpu::RenderPipeline>,
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
        let count = (SIDE / map::LEAST_SIDE).ilog2() + 1;
        let size = [SIDE, SIDE, array_layers(MAX_LAYERS as u32)];
        let texture = map::target(device, "lit map", FORMAT, size, count);
        let view = |level: u32, layer: u32| {
            texture.create_view(&wgpu::TextureViewDescriptor {
                dimension: Some(wgpu::TextureViewDimension::D2),
                base_mip_level: level,
                mip_level_count: Some(1),
                base_array_layer: layer,
                array_layer_count: Some(1),
                ..Default::default()
            })
        };
        let array = |level: u32| {
            texture.create_view(&wgpu::TextureViewDescriptor {
                dimension: Some(wgpu::TextureViewDimension::D2Array),
                base_mip_level: level,
                mip_level_count: Some(1),
                ..Default::default()
            })
        };
        let pipelines = |entry: &str| {
            let iterations = 0..MAX_LAYERS / LAYERS_AN_ITERATION;
            iterations
                .map(|iteration| {
                    let first = (iteration * LAYERS_AN_ITERATION) as f64;
                    let targets = &[FORMAT; LAYERS_AN_ITERATION];
                    let constants = &[("FIRST_LAYER", first)];
                    layouts.off_screen_with(
                        device,
                        module,
                        entry,
                        &layouts.layers,
                        targets,
                        constants,
                    )
                })
                .collect()
        };
        Pass {
            levels: (0..count)
                .map(|level| {
                    (0..MAX_LAYERS as u32)
                        .map(|layer| view(level, layer))
                        .collect()
                })
                .collect(),
            sources: (0..count - 1)
                .map(|level| layouts.array_group(device, &array(level)))
                .collect(),
            source: layouts.layers_group(device, layers),
            drawing: pipelines("fs_lit_map"),
            averaging: pipelines("fs_lit_level"),
            group: layouts.lit_group(device, layers, &texture),
            texture,
        }
    }

    /// The map itself: an array of [`MAX_LAYERS`], and what [`array_layers`] adds.
    pub fn texture(&self) -> &wgpu::Texture {
        &self.texture
    }

    /// Records the passes of the first `count` layers.
    pub fn record(
        &self,
        encoder: &mut wgpu::CommandEncoder,
        shared: &wgpu::BindGroup,
        count: usize,
    ) {
        let iterations = count.div_ceil(LAYERS_AN_ITERATION);
        let pipelines = self.drawing.iter().zip(&self.averaging);
        for (iteration, (drawing, averaging)) in pipelines.enumerate().take(iterations) {
            let targets = |level: &'_ Vec<wgpu::TextureView>| -> Vec<wgpu::TextureView> {
                level[iteration * LAYERS_AN_ITERATION..][..LAYERS_AN_ITERATION].to_vec()
            };
            map::draw_into(
                encoder,
                &targets(&self.levels[0]),
                drawing,
                [shared, &self.source],
            );
            for (level, above) in self.levels.iter().skip(1).zip(&self.sources) {
                map::draw_into(encoder, &targets(level), averaging, [shared, above]);
            }
        }
    }

    /// Bytes of its texture.
    pub fn bytes(&self) -> u64 {
        map::texture_bytes(&self.texture)
    }
}
