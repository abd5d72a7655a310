//! A device without a window, and pictures read back from it.

use std::sync::OnceLock;

use glam::Vec3;
use welkin_pack::role::Wrap;
use welkin_pack::{Image, Pack};
use welkin_runtime::{Camera, Sky, SkyConfig, SkyParams};

use crate::texture::Texture;

/// An open device.
#[derive(Debug)]
pub struct Gpu {
    /// The device, with no more than WebGL2's limits.
    pub device: wgpu::Device,
    /// Its queue.
    pub queue: wgpu::Queue,
    /// Whether it is Mesa's software driver, which drew the golden pictures.
    pub is_llvmpipe: bool,
}

/// The device of this test program. Mesa's software Vulkan will do.
///
/// # Panics
/// If there is no adapter: a test without one must not pass.
pub fn gpu() -> &'static Gpu {
    static GPU: OnceLock<Gpu> = OnceLock::new();
    GPU.get_or_init(|| Gpu::open(wgpu::Backends::from_env().unwrap_or_default()))
}

impl Gpu {
    /// Opens a device of one of these backends.
    ///
    /// # Panics
    /// If there is no adapter: a test without one must not pass.
    pub fn open(backends: wgpu::Backends) -> Gpu {
        let instance = wgpu::Instance::new(wgpu::InstanceDescriptor {
            backends,
            ..wgpu::InstanceDescriptor::new_without_display_handle_from_env()
        });
        let adapter =
            pollster::block_on(instance.request_adapter(&wgpu::RequestAdapterOptions::default()))
                .unwrap_or_else(|e| {
                    panic!("no graphics adapter: {e}; `make gpu-tools` installs software ones")
                });
        let limits = wgpu::Limits::downlevel_webgl2_defaults().using_resolution(adapter.limits());
        let descriptor = wgpu::DeviceDescriptor {
            required_limits: limits,
            ..Default::default()
        };
        let (device, queue) = pollster::block_on(adapter.request_device(&descriptor))
            .expect("a device with WebGL2's limits");
        Gpu {
            device,
            queue,
            is_llvmpipe: adapter.get_info().name.starts_with("llvmpipe"),
        }
    }

    /// A colour target that can be drawn to and read back.
    pub fn target(
        &self,
        format: wgpu::TextureFormat,
        size: [u32; 2],
        sample_count: u32,
    ) -> wgpu::Texture {
        let copied = if sample_count == 1 {
            wgpu::TextureUsages::COPY_SRC
        } else {
            wgpu::TextureUsages::empty()
        };
        self.device.create_texture(&wgpu::TextureDescriptor {
            label: Some("target"),
            size: wgpu::Extent3d {
                width: size[0],
                height: size[1],
                depth_or_array_layers: 1,
            },
            mip_level_count: 1,
            sample_count,
            dimension: wgpu::TextureDimension::D2,
            format,
            usage: wgpu::TextureUsages::RENDER_ATTACHMENT | copied,
            view_formats: &[],
        })
    }

    /// One pass over `target`, cleared to red (a colour that no sky has), resolved into it where it has more samples.
    pub fn pass(
        &self,
        target: &wgpu::Texture,
        samples: Option<&wgpu::Texture>,
        depth: Option<(&wgpu::Texture, f32)>,
        draw: impl FnOnce(&mut wgpu::RenderPass<'_>),
    ) {
        let view =
            |texture: &wgpu::Texture| texture.create_view(&wgpu::TextureViewDescriptor::default());
        let resolved = view(target);
        let drawn = samples.map_or_else(|| resolved.clone(), view);
        let depth_view = depth.map(|(texture, clear)| (view(texture), clear));
        let mut encoder = self
            .device
            .create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            color_attachments: &[Some(wgpu::RenderPassColorAttachment {
                view: &drawn,
                depth_slice: None,
                resolve_target: samples.map(|_| &resolved),
                ops: wgpu::Operations {
                    load: wgpu::LoadOp::Clear(wgpu::Color::RED),
                    store: wgpu::StoreOp::Store,
                },
            })],
            depth_stencil_attachment: depth_view.as_ref().map(|(view, clear)| {
                wgpu::RenderPassDepthStencilAttachment {
                    view,
                    depth_ops: Some(wgpu::Operations {
                        load: wgpu::LoadOp::Clear(*clear),
                        store: wgpu::StoreOp::Store,
                    }),
                    stencil_ops: None,
                }
            }),
            ..Default::default()
        });
        draw(&mut pass);
        drop(pass);
        self.queue.submit([encoder.finish()]);
    }

    /// The texels of a target as RGBA floats, row by row from the top: stored values, 0..1 where it is unorm.
    ///
    /// # Panics
    /// As [`Gpu::read_level`].
    pub fn read(&self, target: &wgpu::Texture) -> Vec<[f32; 4]> {
        self.read_level(target, 0, 0)
    }

    /// The same of one level of one layer.
    ///
    /// # Panics
    /// On formats other than 8-bit R, RG and RGBA and floats of RGBA, and if the device is lost.
    pub fn read_level(&self, target: &wgpu::Texture, level: u32, layer: u32) -> Vec<[f32; 4]> {
        let texel_bytes = target
            .format()
            .block_copy_size(None)
            .expect("a colour format");
        let size = wgpu::Extent3d {
            depth_or_array_layers: 1,
            ..target.size().mip_level_size(level, target.dimension())
        };
        let row_bytes = size.width * texel_bytes;
        let stride = row_bytes.next_multiple_of(wgpu::COPY_BYTES_PER_ROW_ALIGNMENT);
        let Gpu { device, queue, .. } = self;
        let buffer = device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("read back"),
            size: u64::from(stride) * u64::from(size.height),
            usage: wgpu::BufferUsages::MAP_READ | wgpu::BufferUsages::COPY_DST,
            mapped_at_creation: false,
        });
        let layout = wgpu::TexelCopyBufferLayout {
            offset: 0,
            bytes_per_row: Some(stride),
            rows_per_image: None,
        };
        let from = wgpu::TexelCopyTextureInfo {
            mip_level: level,
            origin: wgpu::Origin3d {
                z: layer,
                ..wgpu::Origin3d::ZERO
            },
            ..target.as_image_copy()
        };
        let to = wgpu::TexelCopyBufferInfo {
            buffer: &buffer,
            layout,
        };
        let mut encoder = device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        encoder.copy_texture_to_buffer(from, to, size);
        queue.submit([encoder.finish()]);
        buffer.slice(..).map_async(wgpu::MapMode::Read, |result| {
            result.expect("the buffer maps")
        });
        device
            .poll(wgpu::PollType::wait_indefinitely())
            .expect("the device answers");
        let mapped = buffer
            .slice(..)
            .get_mapped_range()
            .expect("the buffer is mapped");
        let rows = mapped
            .chunks_exact(stride as usize)
            .map(|row| &row[..row_bytes as usize]);
        rows.flat_map(|row| row.chunks_exact(texel_bytes as usize))
            .map(texel)
            .collect()
    }

    /// A sky without depth or multisampling.
    ///
    /// # Panics
    /// If it cannot be made.
    pub fn sky(&self, pack: &Pack, target_format: wgpu::TextureFormat) -> Sky {
        let config = SkyConfig {
            target_format,
            depth: None,
            sample_count: 1,
        };
        Sky::new(&self.device, &self.queue, config, pack).expect("the sky is made")
    }

    /// Prepares a frame: its off-screen passes are drawn.
    pub fn prepare(&self, sky: &mut Sky, params: &SkyParams, camera: &Camera, seconds: f64) {
        let Gpu { device, queue, .. } = self;
        let mut encoder = device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        sky.prepare(queue, &mut encoder, params, camera, seconds);
        queue.submit([encoder.finish()]);
    }

    /// One frame, read back.
    pub fn render(
        &self,
        sky: &mut Sky,
        format: wgpu::TextureFormat,
        params: &SkyParams,
        camera: &Camera,
        seconds: f64,
    ) -> Vec<[f32; 4]> {
        let target = self.target(format, camera.viewport_px, 1);
        self.prepare(sky, params, camera, seconds);
        self.pass(&target, None, None, |pass| sky.draw(pass));
        self.read(&target)
    }
}

/// A pipeline of a test's own WGSL, by the names of its vertex and its fragment stage: nothing but triangles into one target.
pub fn pipeline(
    wgsl: &str,
    [vertex, fragment]: [&str; 2],
    format: wgpu::TextureFormat,
) -> wgpu::RenderPipeline {
    let device = &gpu().device;
    let module = device.create_shader_module(wgpu::ShaderModuleDescriptor {
        label: None,
        source: wgpu::ShaderSource::Wgsl(wgsl.into()),
    });
    device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
        label: None,
        layout: None,
        vertex: wgpu::VertexState {
            module: &module,
            entry_point: Some(vertex),
            compilation_options: Default::default(),
            buffers: &[],
        },
        primitive: wgpu::PrimitiveState::default(),
        depth_stencil: None,
        multisample: wgpu::MultisampleState::default(),
        fragment: Some(wgpu::FragmentState {
            module: &module,
            entry_point: Some(fragment),
            compilation_options: Default::default(),
            targets: &[Some(format.into())],
        }),
        multiview_mask: None,
        cache: None,
    })
}

/// [`Gpu::target`] on the device of this test program.
pub fn target(format: wgpu::TextureFormat, size: [u32; 2], sample_count: u32) -> wgpu::Texture {
    gpu().target(format, size, sample_count)
}

/// [`Gpu::pass`] on the device of this test program.
pub fn pass(
    target: &wgpu::Texture,
    samples: Option<&wgpu::Texture>,
    depth: Option<(&wgpu::Texture, f32)>,
    draw: impl FnOnce(&mut wgpu::RenderPass<'_>),
) {
    gpu().pass(target, samples, depth, draw);
}

/// [`Gpu::read`] on the device of this test program.
pub fn read(target: &wgpu::Texture) -> Vec<[f32; 4]> {
    gpu().read(target)
}

/// [`Gpu::read_level`] on the device of this test program.
pub fn read_level(target: &wgpu::Texture, level: u32, layer: u32) -> Vec<[f32; 4]> {
    gpu().read_level(target, level, layer)
}

/// [`Gpu::sky`] on the device of this test program.
pub fn sky(pack: &Pack, target_format: wgpu::TextureFormat) -> Sky {
    gpu().sky(pack, target_format)
}

/// [`Gpu::prepare`] on the device of this test program.
pub fn prepare(sky: &mut Sky, params: &SkyParams, camera: &Camera, seconds: f64) {
    gpu().prepare(sky, params, camera, seconds);
}

/// [`Gpu::render`] on the device of this test program.
pub fn render(
    sky: &mut Sky,
    format: wgpu::TextureFormat,
    params: &SkyParams,
    camera: &Camera,
    seconds: f64,
) -> Vec<[f32; 4]> {
    gpu().render(sky, format, params, camera, seconds)
}

fn texel(bytes: &[u8]) -> [f32; 4] {
    match bytes.len() {
        1 | 2 => [0, 1, 2, 3].map(|c| f32::from(bytes.get(c).copied().unwrap_or(0)) / 255.0),
        4 => [0, 1, 2, 3].map(|c| f32::from(bytes[c]) / 255.0),
        16 => [0, 4, 8, 12]
            .map(|c| f32::from_le_bytes([bytes[c], bytes[c + 1], bytes[c + 2], bytes[c + 3]])),
        8 => [0, 1, 2, 3]
            .map(|c| half::f16::from_le_bytes([bytes[2 * c], bytes[2 * c + 1]]).to_f32()),
        n => panic!("texels of {n} bytes are not read back here"),
    }
}

/// The layers of the cloud map of the prepared frame with their levels, if its method draws one.
pub fn read_map(sky: &Sky) -> Vec<Texture> {
    let Some(map) = sky.cloud_map() else {
        return Vec::new();
    };
    let image = |level: u32, layer: u32| Image {
        width: map.width() >> level,
        height: map.height() >> level,
        channels: 4,
        texels: read_level(map, level, layer).concat(),
    };
    let layer = |layer: u32| {
        let levels = (0..map.mip_level_count()).map(|level| image(level, layer));
        Texture::from_levels(levels.collect(), Wrap::Repeat)
    };
    (0..map.depth_or_array_layers()).map(layer).collect()
}

/// The first three channels of texels.
pub fn rgb(texels: &[[f32; 4]]) -> Vec<Vec3> {
    texels.iter().map(|t| Vec3::new(t[0], t[1], t[2])).collect()
}
