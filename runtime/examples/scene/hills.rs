//! Hills under the sky: lit by it, in the shadows of its clouds, seen through its air.

use welkin_runtime::glam::{Mat4, Vec3};
use welkin_runtime::wgpu::util::DeviceExt;
use welkin_runtime::{SkyConfig, SkyLight, air, light, shadow, wgpu};

/// Corners of the triangles of scene.wgsl: six a cell.
const VERTICES: u32 = 6 * 320 * 512;

/// The hills on a device.
pub struct Hills {
    pipeline: wgpu::RenderPipeline,
    sampler: wgpu::Sampler,
    /// For skies without shadows of single clouds.
    no_shadow: wgpu::TextureView,
}

impl Hills {
    /// For the same pass as the sky's; its depth is reversed.
    pub fn new(device: &wgpu::Device, config: &SkyConfig) -> Hills {
        let text = [
            light::WGSL,
            air::WGSL,
            shadow::WGSL,
            include_str!("scene.wgsl"),
        ]
        .join("\n");
        let module = device.create_shader_module(wgpu::ShaderModuleDescriptor {
            label: Some("hills"),
            source: wgpu::ShaderSource::Wgsl(text.into()),
        });
        let pipeline = device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
            label: Some("hills"),
            layout: None,
            vertex: wgpu::VertexState {
                module: &module,
                entry_point: Some("vs_scene"),
                compilation_options: Default::default(),
                buffers: &[],
            },
            primitive: wgpu::PrimitiveState::default(),
            depth_stencil: config.depth.map(|depth| wgpu::DepthStencilState {
                format: depth.format,
                depth_write_enabled: Some(true),
                depth_compare: Some(wgpu::CompareFunction::Greater),
                stencil: Default::default(),
                bias: Default::default(),
            }),
            multisample: wgpu::MultisampleState {
                count: config.sample_count,
                ..Default::default()
            },
            fragment: Some(wgpu::FragmentState {
                module: &module,
                entry_point: Some("fs_scene"),
                compilation_options: Default::default(),
                targets: &[Some(config.target_format.into())],
            }),
            multiview_mask: None,
            cache: None,
        });
        let (_, no_shadow) = super::target(device, wgpu::TextureFormat::R8Unorm, [1, 1], 1);
        Hills {
            sampler: device.create_sampler(&wgpu::SamplerDescriptor {
                mag_filter: wgpu::FilterMode::Linear,
                min_filter: wgpu::FilterMode::Linear,
                ..Default::default()
            }),
            no_shadow,
            pipeline,
        }
    }

    /// What a view of them draws with: matrices of the sky's world (metres; east, up, south), and the light of a moment.
    pub fn view(
        &self,
        device: &wgpu::Device,
        clip_from_world: Mat4,
        eye: Vec3,
        light: &SkyLight,
        shadow: Option<shadow::Shadow<'_>>,
    ) -> wgpu::BindGroup {
        let mut frame = clip_from_world.to_cols_array().to_vec();
        frame.extend(eye.extend(1.0).to_array());
        frame.extend(shadow.as_ref().map_or([0.0; 4], |shadow| shadow.area()));
        frame.extend(light.uniform());
        frame.extend(light.air.uniform());
        let buffer = device.create_buffer_init(&wgpu::util::BufferInitDescriptor {
            label: Some("hills"),
            contents: bytemuck::cast_slice(&frame),
            usage: wgpu::BufferUsages::UNIFORM,
        });
        let map = shadow.map(|shadow| shadow.texture.create_view(&Default::default()));
        let entry = |binding, resource| wgpu::BindGroupEntry { binding, resource };
        device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("hills"),
            layout: &self.pipeline.get_bind_group_layout(0),
            entries: &[
                entry(0, buffer.as_entire_binding()),
                entry(
                    1,
                    wgpu::BindingResource::TextureView(map.as_ref().unwrap_or(&self.no_shadow)),
                ),
                entry(2, wgpu::BindingResource::Sampler(&self.sampler)),
            ],
        })
    }

    /// Draws a view.
    pub fn draw(&self, pass: &mut wgpu::RenderPass<'_>, view: &wgpu::BindGroup) {
        pass.set_pipeline(&self.pipeline);
        pass.set_bind_group(0, view, &[]);
        pass.draw(0..VERTICES, 0..1);
    }
}
