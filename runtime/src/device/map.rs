//! A map: the small texture that a method draws off screen each frame, and its levels.
//!
//! # Practice
//! The map is drawn, then each level is averaged from the one above it: one pass each, down to 32 texels, for the dome
//! names the level that it reads. A map tiles.

use crate::device::context::{Context, Shader};
use crate::device::layouts::{Layouts, array_layers};
use crate::geometry::part::Part;

/// Its part of the shader.
pub const PART: Part = Part {
    constants: &[],
    structs: &[],
    wgsl: include_str!("map.wgsl"),
};

/// Levels end at this many texels a side: a pixel of the smallest pictures covers no more.
pub const LEAST_SIDE: u32 = 32;

/// A map on the device: a plane, or an array of which several layers are drawn at once.
#[derive(Debug)]
pub(crate) struct Map {
    /// The map itself.
    pub texture: wgpu::Texture,
    /// The targets of each level: one a layer.
    levels: Vec<Vec<wgpu::TextureView>>,
    /// Each level as what the next one is made from.
    sources: Vec<wgpu::BindGroup>,
    /// What averages the levels of each set of layers that is drawn at once.
    averaging: Vec<wgpu::RenderPipeline>,
}

/// Of every map.
pub(crate) const FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba8Unorm;

impl Map {
    /// An empty map of texels a side, a power of two, and layers, 1 for a plane. `averaging` makes its levels: a pipeline for each set of
    /// layers that is drawn at once.
    pub fn new(
        device: &wgpu::Device,
        layouts: &Layouts,
        averaging: Vec<wgpu::RenderPipeline>,
        [side, drawn]: [u32; 2],
    ) -> Map {
        let count = (side / LEAST_SIDE).ilog2() + 1;
        let is_plane = drawn == 1;
        let layers = if is_plane { 1 } else { array_layers(drawn) };
        let texture = target(device, "map", FORMAT, [side, side, layers], count);
        let view = |level: u32, layers: std::ops::Range<u32>, dimension| {
            texture.create_view(&wgpu::TextureViewDescriptor {
                dimension: Some(dimension),
                base_mip_level: level,
                mip_level_count: Some(1),
                base_array_layer: layers.start,
                array_layer_count: Some(layers.len() as u32),
                ..Default::default()
            })
        };
        let plane = wgpu::TextureViewDimension::D2;
        let targets = |level: u32| {
            (0..drawn)
                .map(|layer| view(level, layer..layer + 1, plane))
                .collect()
        };
        let source = |level: u32| {
            if is_plane {
                return layouts.texture_group(device, &view(level, 0..1, plane));
            }
            let all = view(level, 0..layers, wgpu::TextureViewDimension::D2Array);
            layouts.array_group(device, &all)
        };
        Map {
            levels: (0..count).map(targets).collect(),
            sources: (0..count - 1).map(source).collect(),
            averaging,
            texture,
        }
    }

    /// Draws level 0 of one set of layers by `pipeline` from `source`, if it needs one, then the levels below it.
    pub fn record(
        &self,
        encoder: &mut wgpu::CommandEncoder,
        shared: &wgpu::BindGroup,
        (set, pipeline): (usize, &wgpu::RenderPipeline),
        source: Option<&wgpu::BindGroup>,
    ) {
        let at_once = self.levels[0].len() / self.averaging.len();
        let averaging = &self.averaging[set];
        let passes = [(pipeline, source)]
            .into_iter()
            .chain(self.sources.iter().map(|above| (averaging, Some(above))));
        for (level, (pipeline, source)) in self.levels.iter().zip(passes) {
            let targets = &level[set * at_once..][..at_once];
            match source {
                Some(source) => draw_into(encoder, targets, pipeline, [shared, source]),
                None => draw_into(encoder, targets, pipeline, [shared]),
            }
        }
    }
}

/// A plane, and what draws it from an array of textures.
#[derive(Debug)]
pub(crate) struct Plane {
    map: Map,
    source: wgpu::BindGroup,
    pipeline: wgpu::RenderPipeline,
    /// Group 1 of the dome.
    pub group: wgpu::BindGroup,
}

impl Plane {
    /// An empty plane of `side` texels a side, a power of two, that an entry point draws from an array.
    pub fn new(
        context: &Context,
        shader: &Shader,
        (entry, side): (&str, u32),
        source: &wgpu::Texture,
    ) -> Plane {
        let (device, layouts) = (&context.device, &context.layouts);
        let averaging = context.off_screen(shader, "fs_level", &layouts.texture, FORMAT);
        let map = Map::new(device, layouts, vec![averaging], [side, 1]);
        Plane {
            source: layouts.layers_group(device, source),
            pipeline: context.off_screen(shader, entry, &layouts.layers, FORMAT),
            group: plane_group(device, layouts, &map),
            map,
        }
    }

    /// Another array to draw it from.
    pub fn set_source(&mut self, device: &wgpu::Device, layouts: &Layouts, source: &wgpu::Texture) {
        self.source = layouts.layers_group(device, source);
    }

    /// Makes it anew if it is of another size.
    pub fn resize(&mut self, device: &wgpu::Device, layouts: &Layouts, side: u32) {
        if self.map.texture.width() != side {
            let averaging = self.map.averaging.clone();
            self.map = Map::new(device, layouts, averaging, [side, 1]);
            self.group = plane_group(device, layouts, &self.map);
        }
    }

    /// Draws it and its levels.
    pub fn record(&self, encoder: &mut wgpu::CommandEncoder, shared: &wgpu::BindGroup) {
        let pipeline = (0, &self.pipeline);
        self.map
            .record(encoder, shared, pipeline, Some(&self.source));
    }

    /// The map itself.
    pub fn texture(&self) -> &wgpu::Texture {
        &self.map.texture
    }
}

fn plane_group(device: &wgpu::Device, layouts: &Layouts, map: &Map) -> wgpu::BindGroup {
    layouts.texture_group(device, &map.texture.create_view(&Default::default()))
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
