//! A map: the small texture that a method draws off screen each frame, and its levels.
//!
//! # Practice
//! The map is drawn, then each level is averaged from the one above it: one pass each, down to 32 texels, for the dome
//! names the level that it reads. A map tiles.

use crate::device::layouts::Layouts;
use crate::geometry::part::Part;

/// Its part of the shader.
pub const PART: Part = Part {
    constants: &[],
    structs: &[],
    wgsl: include_str!("map.wgsl"),
};

/// Levels end at this many texels a side: a pixel of the smallest pictures covers no more.
pub const LEAST_SIDE: u32 = 32;

/// A map on the device.
#[derive(Debug)]
pub(crate) struct Map {
    texture: wgpu::Texture,
    levels: Vec<wgpu::TextureView>,
    /// Each level as what the next one is made from.
    sources: Vec<wgpu::BindGroup>,
    averaging: wgpu::RenderPipeline,
    /// Group 1 of the dome.
    pub group: wgpu::BindGroup,
}

impl Map {
    /// An empty map of `side` texels a side, a power of two.
    pub fn new(
        device: &wgpu::Device,
        module: &wgpu::ShaderModule,
        layouts: &Layouts,
        format: wgpu::TextureFormat,
        side: u32,
    ) -> Map {
        let averaging = layouts.off_screen(device, module, "fs_level", &layouts.texture, format);
        Map::with_pipeline(device, layouts, averaging, format, side)
    }

    /// An empty map of another size, by the same pipeline.
    pub fn resized(&self, device: &wgpu::Device, layouts: &Layouts, side: u32) -> Map {
        let format = self.texture.format();
        Map::with_pipeline(device, layouts, self.averaging.clone(), format, side)
    }

    fn with_pipeline(
        device: &wgpu::Device,
        layouts: &Layouts,
        averaging: wgpu::RenderPipeline,
        format: wgpu::TextureFormat,
        side: u32,
    ) -> Map {
        let count = (side / LEAST_SIDE).ilog2() + 1;
        let texture = target(device, "map", format, [side, side, 1], count);
        let view = |first: u32, count: u32| {
            texture.create_view(&wgpu::TextureViewDescriptor {
                base_mip_level: first,
                mip_level_count: Some(count),
                ..Default::default()
            })
        };
        let levels: Vec<_> = (0..count).map(|level| view(level, 1)).collect();
        let sources = levels
            .iter()
            .map(|level| layouts.texture_group(device, level))
            .collect();
        Map {
            sources,
            averaging,
            group: layouts.texture_group(device, &view(0, count)),
            levels,
            texture,
        }
    }

    /// The map itself.
    pub fn texture(&self) -> &wgpu::Texture {
        &self.texture
    }

    /// Draws level 0 by `pipeline` from `source`, then the levels below it.
    pub fn record(
        &self,
        encoder: &mut wgpu::CommandEncoder,
        shared: &wgpu::BindGroup,
        pipeline: &wgpu::RenderPipeline,
        source: &wgpu::BindGroup,
    ) {
        draw(encoder, &self.levels[0], pipeline, [shared, source]);
        for (level, above) in self.levels.iter().skip(1).zip(&self.sources) {
            draw(encoder, level, &self.averaging, [shared, above]);
        }
    }
}

/// A texture that is drawn into and read. `size` is width, height and layers.
pub(crate) fn target(
    device: &wgpu::Device,
    label: &str,
    format: wgpu::TextureFormat,
    [width, height, depth_or_array_layers]: [u32; 3],
    mip_level_count: u32,
) -> wgpu::Texture {
    device.create_texture(&wgpu::TextureDescriptor {
        label: Some(label),
        size: wgpu::Extent3d {
            width,
            height,
            depth_or_array_layers,
        },
        mip_level_count,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format,
        usage: wgpu::TextureUsages::RENDER_ATTACHMENT
            | wgpu::TextureUsages::TEXTURE_BINDING
            | wgpu::TextureUsages::COPY_SRC,
        view_formats: &[],
    })
}

/// One pass of one triangle over a whole target.
pub(crate) fn draw<const N: usize>(
    encoder: &mut wgpu::CommandEncoder,
    target: &wgpu::TextureView,
    pipeline: &wgpu::RenderPipeline,
    groups: [&wgpu::BindGroup; N],
) {
    draw_layer(encoder, (target, 0), pipeline, groups);
}

/// The same over a layer of an array, whose number the shader is told.
pub(crate) fn draw_layer<const N: usize>(
    encoder: &mut wgpu::CommandEncoder,
    (target, layer): (&wgpu::TextureView, u32),
    pipeline: &wgpu::RenderPipeline,
    groups: [&wgpu::BindGroup; N],
) {
    let targets = std::slice::from_ref(target);
    draw_instance(encoder, targets, layer, pipeline, groups);
}

/// The same over several targets at once.
pub(crate) fn draw_into<const N: usize>(
    encoder: &mut wgpu::CommandEncoder,
    targets: &[wgpu::TextureView],
    pipeline: &wgpu::RenderPipeline,
    groups: [&wgpu::BindGroup; N],
) {
    draw_instance(encoder, targets, 0, pipeline, groups);
}

fn draw_instance<const N: usize>(
    encoder: &mut wgpu::CommandEncoder,
    targets: &[wgpu::TextureView],
    instance: u32,
    pipeline: &wgpu::RenderPipeline,
    groups: [&wgpu::BindGroup; N],
) {
    let attachment = |view| {
        Some(wgpu::RenderPassColorAttachment {
            view,
            depth_slice: None,
            resolve_target: None,
            ops: wgpu::Operations {
                load: wgpu::LoadOp::Clear(wgpu::Color::BLACK),
                store: wgpu::StoreOp::Store,
            },
        })
    };
    let attachments: Vec<_> = targets.iter().map(attachment).collect();
    let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
        label: Some("sky, off screen"),
        color_attachments: &attachments,
        ..Default::default()
    });
    pass.set_pipeline(pipeline);
    for (index, group) in groups.into_iter().enumerate() {
        pass.set_bind_group(index as u32, group, &[]);
    }
    pass.draw(0..3, instance..instance + 1);
}

/// Bytes of a texture with all its levels and layers.
pub(crate) fn texture_bytes(texture: &wgpu::Texture) -> u64 {
    let texel = u64::from(texture.format().block_copy_size(None).unwrap_or(0));
    let level = |level: u32| {
        let size = texture.size().mip_level_size(level, texture.dimension());
        u64::from(size.width) * u64::from(size.height) * u64::from(size.depth_or_array_layers)
    };
    texel * (0..texture.mip_level_count()).map(level).sum::<u64>()
}
