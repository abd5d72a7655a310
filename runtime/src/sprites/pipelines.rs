//! The pipelines and the bind groups of the sprites.

use glam::{Vec2, Vec3};
use welkin_pack::SheetCell;
use welkin_pack::field::MOST_DEPTH;

use super::outline::Outline;
use super::station::{self, RingUniforms, SpriteView};
use super::{formation, instances, locks};
use crate::clouds::shadow;
use crate::device::config::Output;
use crate::device::context::{Context, Shader};
use crate::device::layouts::{entry, texture};
use crate::device::map::target;
use crate::device::pipeline::{Drawing, depth_state, multisample_state};
use crate::geometry::part::{Part, Value};
use crate::geometry::uniforms::uniforms;
use crate::params::{SkyModel, SkyParams};

/// Bytes from one view or block to the next: what every device takes as an offset.
pub const STRIDE: u64 = 256;

/// Its part of the shader.
pub const PART: Part = Part {
    constants: &[
        ("SPRITE_RIM_OPAQUE", Value::F32(super::RIM_OPAQUE)),
        (
            "SPRITE_MOST_HALF_SIZE",
            Value::F32(instances::MOST_HALF_SIZE_M),
        ),
        ("SPRITE_MOST_AWAY", Value::F32(instances::MOST_AWAY_M)),
        ("SPRITE_MOST_DEPTH", Value::F32(MOST_DEPTH)),
        ("SPRITE_PHASE", Value::F32(super::PHASE)),
        ("SPRITE_BULGE", Value::F32(super::BULGE)),
        ("SPRITE_FRONT", Value::F32(super::FRONT)),
        ("SPRITE_SIDES", Value::F32(super::SIDES)),
        ("SPRITE_LEAST_SKY", Value::F32(super::LEAST_SKY)),
        ("SPRITES_A_ROW", Value::U32(instances::INSTANCES_PER_ROW)),
        ("SPRITE_FIRST_STAGE", Value::F32(formation::FIRST_STAGE)),
        ("SPRITE_LOCK", Value::F32(locks::LOCK)),
        ("SPRITE_NEAR", Value::F32(locks::NEAR)),
    ],
    structs: &[
        super::SpriteUniforms::WGSL,
        SpriteView::WGSL,
        SpriteBlock::WGSL,
    ],
    wgsl: include_str!("sprites.wgsl"),
};

uniforms! {
    /// A block of sprites, 16 square kilometres, in a buffer of its own.
    SpriteBlock {
        /// From the viewpoint to its north-west corner at the height of the field's sea level, m.
        origin: Vec3,
        /// Its opacity.
        opacity: f32,
        /// Number of its first sprite in the texture.
        first: u32,
        /// log2 of the vertices of each: 3 for outlines, 2 for boxes.
        vertices_log2: u32,
        /// From the corner of the field to that of its section, to the east and south, m.
        section: Vec2,
        /// 1 / size of the grid of exposures along the ground and upwards, 1 / m.
        exposed_per_m: Vec2,
        /// Height of its lower side, m.
        exposed_base_m: f32,
        /// Nothing.
        _pad: f32,
    }
}

/// What of a sprite or of the ring is left of the colour behind it: their own is multiplied by their opacity.
const OVER: wgpu::BlendComponent = wgpu::BlendComponent {
    src_factor: wgpu::BlendFactor::One,
    dst_factor: wgpu::BlendFactor::OneMinusSrcAlpha,
    operation: wgpu::BlendOperation::Add,
};

/// The opacity of a target stays what it was.
const KEEP: wgpu::BlendComponent = wgpu::BlendComponent {
    src_factor: wgpu::BlendFactor::Zero,
    dst_factor: wgpu::BlendFactor::One,
    operation: wgpu::BlendOperation::Add,
};

/// Layouts of group 1 of sprites and of the ring.
#[derive(Debug)]
pub(crate) struct GroupLayouts {
    /// Sheet, amounts, view, block, outlines, instances, exposures.
    pub sprites: wgpu::BindGroupLayout,
    /// View, ring, both rings' pictures.
    pub ring: wgpu::BindGroupLayout,
}

/// What lies behind sprites, and what they fade into far away.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Behind {
    pub sky: SkyModel,
    /// Whether a sea lies below the horizon.
    pub sea: bool,
}

impl Behind {
    /// How many there are.
    pub const COUNT: usize = 2 * SkyModel::ALL.len();

    pub fn of(params: &SkyParams) -> Behind {
        Behind {
            sky: params.sky,
            sea: params.sea,
        }
    }

    /// Its place among them.
    pub fn index(self) -> usize {
        2 * self.sky as usize + usize::from(self.sea)
    }
}

/// The pipelines before one of them.
#[derive(Debug)]
pub(crate) struct Pipelines {
    /// Sprites onto the target.
    pub sprites: wgpu::RenderPipeline,
    /// Sprites into a picture of the ring.
    pub picture: wgpu::RenderPipeline,
    /// The ring onto the target.
    pub ring: wgpu::RenderPipeline,
    /// Shadows onto the ground, once they were asked for.
    cast: Option<wgpu::RenderPipeline>,
    shader: Shader,
}

impl GroupLayouts {
    /// Makes both.
    pub fn new(device: &wgpu::Device) -> GroupLayouts {
        let layout = |entries: &[wgpu::BindGroupLayoutEntry]| {
            device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
                label: Some("sprites"),
                entries,
            })
        };
        let view = uniform(5, true, size_of::<SpriteView>());
        let plane = wgpu::TextureViewDimension::D2;
        let array = wgpu::TextureViewDimension::D2Array;
        GroupLayouts {
            sprites: layout(&[
                picture(3, plane),
                picture(4, plane),
                view,
                uniform(6, true, size_of::<SpriteBlock>()),
                uniform(10, false, OUTLINES_BYTES),
                entry(11, INSTANCES),
                picture(12, wgpu::TextureViewDimension::D3),
                picture(13, wgpu::TextureViewDimension::D3),
            ]),
            ring: layout(&[
                view,
                uniform(7, false, size_of::<RingUniforms>()),
                picture(8, array),
                picture(9, array),
            ]),
        }
    }
}

/// The texture of instances.
const INSTANCES: wgpu::BindingType = wgpu::BindingType::Texture {
    sample_type: wgpu::TextureSampleType::Uint,
    view_dimension: wgpu::TextureViewDimension::D2,
    multisampled: false,
};

fn picture(binding: u32, dimension: wgpu::TextureViewDimension) -> wgpu::BindGroupLayoutEntry {
    entry(binding, texture(true, dimension))
}

fn uniform(binding: u32, dynamic: bool, bytes: usize) -> wgpu::BindGroupLayoutEntry {
    entry(
        binding,
        wgpu::BindingType::Buffer {
            ty: wgpu::BufferBindingType::Uniform,
            has_dynamic_offset: dynamic,
            min_binding_size: wgpu::BufferSize::new(bytes as u64),
        },
    )
}

/// Bytes of the outlines of all cells.
pub const OUTLINES_BYTES: usize = SheetCell::COUNT as usize * size_of::<Outline>();

/// A part of a buffer of [`STRIDE`] bytes a thing.
pub(crate) fn one_of(buffer: &wgpu::Buffer, bytes: usize) -> wgpu::BindingResource<'_> {
    debug_assert!(bytes as u64 <= STRIDE);
    wgpu::BindingResource::Buffer(wgpu::BufferBinding {
        buffer,
        offset: 0,
        size: wgpu::BufferSize::new(bytes as u64),
    })
}

/// The format of the ring's pictures: it blends as the target does.
pub(crate) fn picture_format(output: Output) -> wgpu::TextureFormat {
    match output {
        Output::Encoded => wgpu::TextureFormat::Rgba8Unorm,
        Output::Radiance | Output::Display | Output::Opacity => wgpu::TextureFormat::Rgba8UnormSrgb,
    }
}

/// An array of the ring's pictures.
pub(crate) fn pictures(device: &wgpu::Device, output: Output) -> wgpu::Texture {
    let size = [station::SIDE, station::SIDE, station::PICTURES as u32];
    target(device, "ring of impostors", picture_format(output), size, 1)
}

impl Pipelines {
    /// Makes them of a shader.
    pub fn new(context: &Context, shader: &Shader, groups: &GroupLayouts) -> Pipelines {
        let (sprites, ring) = (&groups.sprites, &groups.ring);
        let screen = context.config.target_format;
        let picture = picture_format(context.build.output);
        let list = wgpu::PrimitiveTopology::TriangleList;
        let strip = wgpu::PrimitiveTopology::TriangleStrip;
        let on_screen = |entries, own, topology| {
            let targets = blended(screen, KEEP);
            let drawing = Drawing::new(entries, Some(own), &targets);
            context.pipeline(
                shader,
                &Drawing {
                    primitive: primitive(topology),
                    depth: context.config.depth.map(depth_state),
                    multisample: multisample_state(&context.config),
                    ..drawing
                },
            )
        };
        let pictured = blended(picture, OVER);
        let into_picture = Drawing {
            primitive: primitive(list),
            ..Drawing::new(["vs_ring_sprite", "fs_sprite"], Some(sprites), &pictured)
        };
        Pipelines {
            sprites: on_screen(["vs_sprite", "fs_sprite"], sprites, list),
            picture: context.pipeline(shader, &into_picture),
            ring: on_screen(["vs_ring", "fs_ring"], ring, strip),
            cast: None,
            shader: shader.clone(),
        }
    }

    /// Makes the pipeline of shadows on the ground if it is not there yet.
    pub fn load_cast(&mut self, context: &Context, groups: &GroupLayouts) {
        let component = wgpu::BlendComponent {
            src_factor: wgpu::BlendFactor::Zero,
            dst_factor: wgpu::BlendFactor::OneMinusSrc,
            operation: wgpu::BlendOperation::Add,
        };
        let targets = [Some(wgpu::ColorTargetState {
            format: shadow::FORMAT,
            blend: Some(wgpu::BlendState {
                color: component,
                alpha: component,
            }),
            write_mask: wgpu::ColorWrites::ALL,
        })];
        let entries = ["vs_sprite_cast", "fs_sprite_cast"];
        let drawing = Drawing {
            primitive: primitive(wgpu::PrimitiveTopology::TriangleList),
            ..Drawing::new(entries, Some(&groups.sprites), &targets)
        };
        let shader = &self.shader;
        self.cast
            .get_or_insert_with(|| context.pipeline(shader, &drawing));
    }

    /// That pipeline.
    pub fn cast(&self) -> Option<&wgpu::RenderPipeline> {
        self.cast.as_ref()
    }
}

fn primitive(topology: wgpu::PrimitiveTopology) -> wgpu::PrimitiveState {
    wgpu::PrimitiveState {
        topology,
        ..Default::default()
    }
}

/// A target that sprites are laid over; `alpha` is what becomes of its opacity.
fn blended(
    format: wgpu::TextureFormat,
    alpha: wgpu::BlendComponent,
) -> [Option<wgpu::ColorTargetState>; 1] {
    [Some(wgpu::ColorTargetState {
        format,
        blend: Some(wgpu::BlendState { color: OVER, alpha }),
        write_mask: wgpu::ColorWrites::ALL,
    })]
}
