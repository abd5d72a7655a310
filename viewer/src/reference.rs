//! Reference passes: full-screen passes that only read the pack's cloud texture.
//!
//! A sky is dear or cheap only beside something else on the same GPU. These passes cost what one and
//! what four trilinear samples a pixel cost there, at the scales at which a sky reads its clouds.

use welkin_pack::{Format, Pack, Role};
use welkin_runtime::SkyError;
use wgpu::util::DeviceExt;

use crate::gpu::{Gpu, GpuError};

/// The shader, with the entry points `corner`, `one_sample` and `four_samples`.
pub const SHADER: &str = include_str!("../shaders/reference.wgsl");

/// A pass that reads the clouds and does nothing else.
#[derive(Debug)]
pub struct ReferencePass {
    pipeline: wgpu::RenderPipeline,
    bind_group: wgpu::BindGroup,
}

impl ReferencePass {
    /// The pass of one fragment entry point of [`SHADER`], for targets of `format`.
    ///
    /// # Errors
    /// [`GpuError::Sky`] if the pack has no clouds.
    pub fn new(
        gpu: &Gpu,
        pack: &Pack,
        format: wgpu::TextureFormat,
        entry_point: &str,
    ) -> Result<ReferencePass, GpuError> {
        let clouds = upload_clouds(gpu, pack)?;
        let pipeline = full_screen_pipeline(gpu, SHADER, format, entry_point);
        let sampler = gpu.device.create_sampler(&wgpu::SamplerDescriptor {
            label: Some("trilinear"),
            address_mode_u: wgpu::AddressMode::Repeat,
            address_mode_v: wgpu::AddressMode::Repeat,
            mag_filter: wgpu::FilterMode::Linear,
            min_filter: wgpu::FilterMode::Linear,
            mipmap_filter: wgpu::MipmapFilterMode::Linear,
            ..Default::default()
        });
        let view = clouds.create_view(&Default::default());
        let entries = [
            wgpu::BindingResource::TextureView(&view),
            wgpu::BindingResource::Sampler(&sampler),
        ];
        let bind_group = gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("reference"),
            layout: &pipeline.get_bind_group_layout(0),
            entries: &[0, 1].map(|i| wgpu::BindGroupEntry {
                binding: i as u32,
                resource: entries[i].clone(),
            }),
        });
        Ok(ReferencePass {
            pipeline,
            bind_group,
        })
    }

    /// Draws over the whole target.
    pub fn draw(&self, pass: &mut wgpu::RenderPass<'_>) {
        pass.set_pipeline(&self.pipeline);
        pass.set_bind_group(0, &self.bind_group, &[]);
        pass.draw(0..3, 0..1);
    }
}

/// A pipeline for one triangle over the target, whose vertex entry point is called `corner`.
pub(crate) fn full_screen_pipeline(
    gpu: &Gpu,
    shader: &str,
    format: wgpu::TextureFormat,
    entry_point: &str,
) -> wgpu::RenderPipeline {
    let module = gpu
        .device
        .create_shader_module(wgpu::ShaderModuleDescriptor {
            label: Some(entry_point),
            source: wgpu::ShaderSource::Wgsl(shader.into()),
        });
    gpu.device
        .create_render_pipeline(&wgpu::RenderPipelineDescriptor {
            label: Some(entry_point),
            layout: None,
            vertex: wgpu::VertexState {
                module: &module,
                entry_point: Some("corner"),
                compilation_options: Default::default(),
                buffers: &[],
            },
            primitive: Default::default(),
            depth_stencil: None,
            multisample: Default::default(),
            fragment: Some(wgpu::FragmentState {
                module: &module,
                entry_point: Some(entry_point),
                compilation_options: Default::default(),
                targets: &[Some(format.into())],
            }),
            multiview_mask: None,
            cache: None,
        })
}

fn upload_clouds(gpu: &Gpu, pack: &Pack) -> Result<wgpu::Texture, GpuError> {
    let clouds = pack
        .texture(Role::Clouds)
        .ok_or(SkyError::MissingTexture { role: Role::Clouds })?;
    let format = match clouds.format {
        Format::Rgba16Float => wgpu::TextureFormat::Rgba16Float,
        // The role allows these two formats, and the pack was checked when it was opened.
        _ => wgpu::TextureFormat::Rgba8Unorm,
    };
    let descriptor = wgpu::TextureDescriptor {
        label: Some("clouds"),
        size: wgpu::Extent3d {
            width: clouds.width,
            height: clouds.height,
            depth_or_array_layers: 1,
        },
        mip_level_count: clouds.levels.len() as u32,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format,
        usage: wgpu::TextureUsages::TEXTURE_BINDING,
        view_formats: &[],
    };
    let order = wgpu::util::TextureDataOrder::LayerMajor;
    Ok(gpu
        .device
        .create_texture_with_data(&gpu.queue, &descriptor, order, &clouds.levels.concat()))
}

#[cfg(test)]
mod tests {
    use super::SHADER;

    #[test]
    fn the_shader_is_valid_and_has_its_entry_points() {
        let module = naga::front::wgsl::parse_str(SHADER).unwrap();
        let (flags, capabilities) = (
            naga::valid::ValidationFlags::all(),
            naga::valid::Capabilities::empty(),
        );
        naga::valid::Validator::new(flags, capabilities)
            .validate(&module)
            .unwrap();
        let names: Vec<&str> = module
            .entry_points
            .iter()
            .map(|e| e.name.as_str())
            .collect();
        assert_eq!(names, ["corner", "one_sample", "four_samples"]);
    }
}
