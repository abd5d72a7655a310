//! The pipeline: configuration, bindings, and the states that put the sky behind a scene.

use welkin_pack::Role;

use crate::dome::Vertex;
use crate::uniforms::Uniforms;
use crate::{DepthConfig, SkyConfig, SkyError, shader, tonemap};

/// Bindings of the textures, as uniforms.wgsl declares them.
pub(crate) const TEXTURES: [(u32, Role); 5] = [
    (3, Role::Clouds),
    (4, Role::Stars),
    (5, Role::Galaxy),
    (6, Role::Sky),
    (7, Role::Sun),
];

/// What a frame needs beyond the clear sky and one layer of clouds.
///
/// By day no star shows, and the upper layer is mostly off. A branch over a uniform would do for a GPU; a
/// software rasteriser runs both of its sides, and takes twice the time. So each of the four is a pipeline.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Variant {
    /// Stars and galaxy.
    pub night: bool,
    /// The thin upper layer.
    pub upper_layer: bool,
}

impl Variant {
    /// Every variant, at its [`Variant::index`].
    pub const ALL: [Variant; 4] = [
        Variant {
            night: false,
            upper_layer: false,
        },
        Variant {
            night: true,
            upper_layer: false,
        },
        Variant {
            night: false,
            upper_layer: true,
        },
        Variant {
            night: true,
            upper_layer: true,
        },
    ];

    /// The least that draws a frame.
    pub fn of(uniforms: &Uniforms) -> Variant {
        Variant {
            night: uniforms.sky.gradient[3] > 0.0,
            upper_layer: uniforms.clouds.shape[3] > 0.0,
        }
    }

    /// Place in [`Variant::ALL`].
    pub fn index(self) -> usize {
        usize::from(self.night) + 2 * usize::from(self.upper_layer)
    }

    /// The shader's overridable constants.
    fn constants(self) -> [(&'static str, f64); 2] {
        let number = |on: bool| f64::from(u8::from(on));
        [
            ("NIGHT", number(self.night)),
            ("UPPER_LAYER", number(self.upper_layer)),
        ]
    }
}

/// Looks at the configuration and chooses the shader's variant.
///
/// # Errors
/// [`SkyError::TargetFormat`], [`SkyError::DepthFormat`], [`SkyError::SampleCount`].
pub(crate) fn shader_text(
    config: &SkyConfig,
    features: wgpu::Features,
) -> Result<String, SkyError> {
    let format = config.target_format;
    let output = tonemap::output(format).ok_or(SkyError::TargetFormat { format })?;
    let usages = format.guaranteed_format_features(features).allowed_usages;
    if !usages.contains(wgpu::TextureUsages::RENDER_ATTACHMENT) {
        return Err(SkyError::TargetFormat { format });
    }
    let depth_format = config.depth.map(|d| d.format);
    if let Some(format) = depth_format.filter(|f| !f.has_depth_aspect()) {
        return Err(SkyError::DepthFormat { format });
    }
    for format in [Some(format), depth_format].into_iter().flatten() {
        let guaranteed = format.guaranteed_format_features(features).flags;
        if !guaranteed.sample_count_supported(config.sample_count) {
            return Err(SkyError::SampleCount {
                format,
                found: config.sample_count,
            });
        }
    }
    Ok(shader::compose(
        output,
        config.depth.is_some_and(|d| d.reversed),
    ))
}

/// The layout of group 0.
pub(crate) fn bind_group_layout(device: &wgpu::Device) -> wgpu::BindGroupLayout {
    let entry = |binding: u32, visibility: wgpu::ShaderStages, ty: wgpu::BindingType| {
        wgpu::BindGroupLayoutEntry {
            binding,
            visibility,
            ty,
            count: None,
        }
    };
    let uniform = wgpu::BindingType::Buffer {
        ty: wgpu::BufferBindingType::Uniform,
        has_dynamic_offset: false,
        min_binding_size: wgpu::BufferSize::new(size_of::<Uniforms>() as u64),
    };
    let sampler = wgpu::BindingType::Sampler(wgpu::SamplerBindingType::Filtering);
    let texture = |filterable: bool| wgpu::BindingType::Texture {
        sample_type: wgpu::TextureSampleType::Float { filterable },
        view_dimension: wgpu::TextureViewDimension::D2,
        multisampled: false,
    };
    let fragment = wgpu::ShaderStages::FRAGMENT;
    let mut entries = vec![
        entry(0, wgpu::ShaderStages::VERTEX_FRAGMENT, uniform),
        entry(1, fragment, sampler),
        entry(2, fragment, sampler),
    ];
    // Stars are records: they are loaded, never filtered.
    entries.extend(
        TEXTURES.map(|(binding, role)| entry(binding, fragment, texture(role != Role::Stars))),
    );
    device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
        label: Some("sky"),
        entries: &entries,
    })
}

/// Compiles the shader and builds a pipeline for each variant, for the triangle over the screen or for the
/// dome's mesh.
pub(crate) fn pipelines(
    device: &wgpu::Device,
    config: &SkyConfig,
    text: &str,
    layout: &wgpu::BindGroupLayout,
    dome_mesh: bool,
) -> [wgpu::RenderPipeline; 4] {
    let module = device.create_shader_module(wgpu::ShaderModuleDescriptor {
        label: Some("sky"),
        source: wgpu::ShaderSource::Wgsl(text.into()),
    });
    let layout = device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
        label: Some("sky"),
        bind_group_layouts: &[Some(layout)],
        ..Default::default()
    });
    let vertices = wgpu::VertexBufferLayout {
        array_stride: size_of::<Vertex>() as u64,
        step_mode: wgpu::VertexStepMode::Vertex,
        attributes: &wgpu::vertex_attr_array![0 => Float32x3],
    };
    let (entry, buffers, primitive) = if dome_mesh {
        (
            "vs_dome",
            &[Some(vertices)][..],
            wgpu::PrimitiveState {
                topology: wgpu::PrimitiveTopology::TriangleStrip,
                strip_index_format: Some(wgpu::IndexFormat::Uint16),
                ..Default::default()
            },
        )
    } else {
        ("vs_screen", &[][..], wgpu::PrimitiveState::default())
    };
    Variant::ALL.map(|variant| {
        device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
            label: Some("sky"),
            layout: Some(&layout),
            vertex: wgpu::VertexState {
                module: &module,
                entry_point: Some(entry),
                compilation_options: Default::default(),
                buffers,
            },
            primitive,
            depth_stencil: config.depth.map(depth_state),
            multisample: wgpu::MultisampleState {
                count: config.sample_count,
                ..Default::default()
            },
            fragment: Some(wgpu::FragmentState {
                module: &module,
                entry_point: Some("fs_sky"),
                compilation_options: wgpu::PipelineCompilationOptions {
                    constants: &variant.constants(),
                    ..Default::default()
                },
                targets: &[Some(config.target_format.into())],
            }),
            multiview_mask: None,
            cache: None,
        })
    })
}

/// The sky lies exactly at the far plane: what was cleared to it and nothing nearer lets it through.
fn depth_state(depth: DepthConfig) -> wgpu::DepthStencilState {
    wgpu::DepthStencilState {
        format: depth.format,
        depth_write_enabled: Some(false),
        depth_compare: Some(if depth.reversed {
            wgpu::CompareFunction::GreaterEqual
        } else {
            wgpu::CompareFunction::LessEqual
        }),
        stencil: wgpu::StencilState::default(),
        bias: wgpu::DepthBiasState::default(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_variant_stands_at_its_index() {
        for (index, variant) in Variant::ALL.into_iter().enumerate() {
            assert_eq!(variant.index(), index);
        }
    }
}
