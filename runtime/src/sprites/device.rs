//! What sprites need on a device: textures, buffers, groups.

use wgpu::util::DeviceExt;

use super::exposures::{Exposures, Span};
use super::instances::{INSTANCES_PER_ROW, Instance};
use super::outline;
use super::pipelines::{GroupLayouts, STRIDE, SpriteBlock, one_of};
use super::scene::{AMOUNTS_SIDE, Draw, Scene};
use super::station::SpriteView;
use crate::device::upload::written;

/// How often a block is drawn in a frame, at most.
pub const BLOCKS_A_SLOT: usize = 5;

/// The uniforms of blocks, one after another.
#[derive(Debug)]
pub struct Blocks {
    /// On the device.
    pub buffer: wgpu::Buffer,
    /// As they will be there.
    pub bytes: Vec<u8>,
    exposed: Span,
}

impl Blocks {
    /// Room for those of a frame.
    pub fn new(device: &wgpu::Device, slots: usize, exposed: Span) -> Blocks {
        // Every block on the screen, in at most three pictures of a ring, and on the ground.
        let most = BLOCKS_A_SLOT * slots;
        Blocks {
            buffer: uniform_buffer(device, "blocks of sprites", most as u64 * STRIDE),
            bytes: Vec::with_capacity(most * STRIDE as usize),
            exposed,
        }
    }

    /// Adds a block; gives its offset, or none if there is no room.
    pub fn add(&mut self, draw: &Draw) -> Option<u32> {
        let offset = self.bytes.len();
        if offset + STRIDE as usize > self.bytes.capacity() {
            return None;
        }
        let block = SpriteBlock {
            origin: draw.origin,
            opacity: draw.opacity,
            first: draw.first,
            vertices_log2: draw.vertices.ilog2(),
            section: draw.section,
            exposed_per_m: self.exposed.per_m,
            exposed_base_m: self.exposed.base_m,
            ..Default::default()
        };
        self.bytes.extend_from_slice(bytemuck::bytes_of(&block));
        self.bytes.resize(offset + STRIDE as usize, 0);
        Some(offset as u32)
    }
}

/// Writes how far each cloud has formed.
pub fn write_amounts(queue: &wgpu::Queue, texture: &wgpu::Texture, amounts: &[u8]) {
    queue.write_texture(
        texture.as_image_copy(),
        amounts,
        wgpu::TexelCopyBufferLayout {
            offset: 0,
            bytes_per_row: Some(AMOUNTS_SIDE),
            rows_per_image: None,
        },
        texture.size(),
    );
}

/// Rows of 256 clouds.
pub fn amounts_texture(device: &wgpu::Device, rows: u32) -> wgpu::Texture {
    let size = [AMOUNTS_SIDE, rows.max(1)];
    written(
        device,
        "amounts of clouds",
        wgpu::TextureFormat::R8Unorm,
        size,
    )
}

/// Rows of 256 sprites.
pub fn instances_texture(device: &wgpu::Device, rows: u32) -> wgpu::Texture {
    let size = [TEXELS * INSTANCES_PER_ROW, rows];
    written(device, "sprites", wgpu::TextureFormat::Rgba32Uint, size)
}

/// Texels of an instance.
const TEXELS: u32 = size_of::<Instance>() as u32 / 16;

/// Writes whole rows of instances.
pub fn upload(queue: &wgpu::Queue, texture: &wgpu::Texture, row: u32, sprites: &[Instance]) {
    queue.write_texture(
        wgpu::TexelCopyTextureInfo {
            origin: wgpu::Origin3d { x: 0, y: row, z: 0 },
            ..texture.as_image_copy()
        },
        bytemuck::cast_slice(sprites),
        wgpu::TexelCopyBufferLayout {
            offset: 0,
            bytes_per_row: Some(INSTANCES_PER_ROW * size_of::<Instance>() as u32),
            rows_per_image: None,
        },
        wgpu::Extent3d {
            width: TEXELS * INSTANCES_PER_ROW,
            height: sprites.len() as u32 / INSTANCES_PER_ROW,
            depth_or_array_layers: 1,
        },
    );
}

/// Empty textures for both halves of a grid of exposures.
pub fn exposure_textures(device: &wgpu::Device, exposures: &Exposures) -> [wgpu::Texture; 2] {
    let [width, height, depth_or_array_layers] = exposures.cells;
    ["exposures from the sides", "exposures from above"].map(|label| {
        device.create_texture(&wgpu::TextureDescriptor {
            label: Some(label),
            size: wgpu::Extent3d {
                width,
                height,
                depth_or_array_layers,
            },
            mip_level_count: 1,
            sample_count: 1,
            dimension: wgpu::TextureDimension::D3,
            format: wgpu::TextureFormat::Rgba8Unorm,
            usage: wgpu::TextureUsages::TEXTURE_BINDING | wgpu::TextureUsages::COPY_DST,
            view_formats: &[],
        })
    })
}

/// Writes a grid of exposures.
pub fn write_exposures(queue: &wgpu::Queue, textures: &[wgpu::Texture; 2], exposures: &Exposures) {
    let [width, height, _] = exposures.cells;
    for (texture, texels) in textures.iter().zip([&exposures.sides, &exposures.above]) {
        queue.write_texture(
            texture.as_image_copy(),
            bytemuck::cast_slice(texels),
            wgpu::TexelCopyBufferLayout {
                offset: 0,
                bytes_per_row: Some(4 * width),
                rows_per_image: Some(height),
            },
            texture.size(),
        );
    }
}

/// Triangles of as many outlines and boxes as a slot has room for.
pub fn index_buffers(device: &wgpu::Device, scene: &Scene) -> [wgpu::Buffer; 2] {
    let room = scene.rows_a_slot() * INSTANCES_PER_ROW;
    let outlines = outline::indices(room, outline::STRIP);
    let boxes = outline::indices(room, outline::BOX_STRIP);
    [outlines, boxes].map(|indices| {
        device.create_buffer_init(&wgpu::util::BufferInitDescriptor {
            label: Some("triangles of sprites"),
            contents: bytemuck::cast_slice(&indices),
            usage: wgpu::BufferUsages::INDEX,
        })
    })
}

/// An empty buffer of uniforms.
pub fn uniform_buffer(device: &wgpu::Device, label: &str, size: u64) -> wgpu::Buffer {
    device.create_buffer(&wgpu::BufferDescriptor {
        label: Some(label),
        size,
        usage: wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::COPY_DST,
        mapped_at_creation: false,
    })
}

/// Group 1 of sprites.
pub fn sprites_group(
    device: &wgpu::Device,
    groups: &GroupLayouts,
    [sheet, amounts, instances]: [&wgpu::Texture; 3],
    exposed: &[wgpu::Texture; 2],
    [views, blocks, outlines]: [&wgpu::Buffer; 3],
) -> wgpu::BindGroup {
    let [sheet, amounts, instances] =
        [sheet, amounts, instances].map(|t| t.create_view(&Default::default()));
    let [sides, above] = exposed
        .each_ref()
        .map(|t| t.create_view(&Default::default()));
    let entry = |binding, resource| wgpu::BindGroupEntry { binding, resource };
    device.create_bind_group(&wgpu::BindGroupDescriptor {
        label: Some("sprites"),
        layout: &groups.sprites,
        entries: &[
            entry(3, wgpu::BindingResource::TextureView(&sheet)),
            entry(4, wgpu::BindingResource::TextureView(&amounts)),
            entry(5, one_of(views, size_of::<SpriteView>())),
            entry(6, one_of(blocks, size_of::<SpriteBlock>())),
            entry(10, outlines.as_entire_binding()),
            entry(11, wgpu::BindingResource::TextureView(&instances)),
            entry(12, wgpu::BindingResource::TextureView(&sides)),
            entry(13, wgpu::BindingResource::TextureView(&above)),
        ],
    })
}
