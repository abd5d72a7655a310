//! The pipelines: configuration, variants, and the states that put the sky behind a scene.

use crate::device::config::{DepthConfig, SkyConfig};
use crate::device::layouts::Layouts;
use crate::geometry::dome::Vertex;

/// What a frame needs beyond the clear sky and one layer of clouds.
///
/// By day no star shows, the upper layer is mostly off, and weather is rare. A branch over a uniform would do for a GPU; a
/// software rasteriser runs both of its sides, and takes twice the time. So each is a pipeline: four, and four of a shader with weather that are
/// made when a frame first has any. So it is with the sea.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Variant {
    /// Stars and galaxy.
    pub night: bool,
    /// The thin upper layer.
    pub upper_layer: bool,
    /// Haze of rain, or a flash.
    pub weather: bool,
    /// A sea below the horizon.
    pub sea: bool,
}

impl Variant {
    /// Every variant of a shader with weather or without, and with a sea or without, at its [`Variant::index`].
    pub fn all(weather: bool, sea: bool) -> [Variant; 4] {
        [0, 1, 2, 3].map(|index| Variant {
            night: index & 1 > 0,
            upper_layer: index & 2 > 0,
            weather,
            sea,
        })
    }

    /// Which shader it is of, of four.
    pub fn shader(self) -> usize {
        usize::from(self.weather) + 2 * usize::from(self.sea)
    }

    /// Place in [`Variant::all`].
    pub fn index(self) -> usize {
        usize::from(self.night) + 2 * usize::from(self.upper_layer)
    }

    /// The shader's overridable constants.
    fn constants(self, dome_mesh: bool) -> [(&'static str, f64); 3] {
        let number = |on: bool| f64::from(u8::from(on));
        [
            ("NIGHT", number(self.night)),
            ("UPPER_LAYER", number(self.upper_layer)),
            ("DOME_MESH", number(dome_mesh)),
        ]
    }
}

/// What a pipeline draws, and how.
pub(crate) struct Drawing<'a> {
    /// Of the vertex and the fragment shader.
    pub entries: [&'a str; 2],
    /// The layout of group 1, if it has one.
    pub own: Option<&'a wgpu::BindGroupLayout>,
    /// The shader's overridable constants.
    pub constants: &'a [(&'a str, f64)],
    pub vertices: &'a [Option<wgpu::VertexBufferLayout<'a>>],
    pub primitive: wgpu::PrimitiveState,
    pub depth: Option<wgpu::DepthStencilState>,
    pub multisample: wgpu::MultisampleState,
    pub targets: &'a [Option<wgpu::ColorTargetState>],
}

impl<'a> Drawing<'a> {
    /// A triangle over targets without depth, of one sample.
    pub fn new(
        entries: [&'a str; 2],
        own: Option<&'a wgpu::BindGroupLayout>,
        targets: &'a [Option<wgpu::ColorTargetState>],
    ) -> Drawing<'a> {
        Drawing {
            entries,
            own,
            constants: &[],
            vertices: &[],
            primitive: wgpu::PrimitiveState::default(),
            depth: None,
            multisample: wgpu::MultisampleState::default(),
            targets,
        }
    }

    /// Makes it of a shader.
    pub fn pipeline(
        &self,
        device: &wgpu::Device,
        layouts: &Layouts,
        module: &wgpu::ShaderModule,
    ) -> wgpu::RenderPipeline {
        let [vertex, fragment] = self.entries;
        device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
            label: Some(fragment),
            layout: Some(&layouts.pipeline_layout(device, self.own)),
            vertex: wgpu::VertexState {
                module,
                entry_point: Some(vertex),
                compilation_options: Default::default(),
                buffers: self.vertices,
            },
            primitive: self.primitive,
            depth_stencil: self.depth.clone(),
            multisample: self.multisample,
            fragment: Some(wgpu::FragmentState {
                module,
                entry_point: Some(fragment),
                compilation_options: wgpu::PipelineCompilationOptions {
                    constants: self.constants,
                    ..Default::default()
                },
                targets: self.targets,
            }),
            multiview_mask: None,
            cache: None,
        })
    }
}

/// The pipeline of the sky itself, for the triangle over the screen or for the dome's mesh; `own` is the layout of its group 1. `over` another sky
/// its colour is premultiplied.
pub(crate) fn screen(
    config: &SkyConfig,
    own: Option<&wgpu::BindGroupLayout>,
    dome_mesh: bool,
    over: bool,
    variant: Variant,
    make: impl FnOnce(&Drawing<'_>) -> wgpu::RenderPipeline,
) -> wgpu::RenderPipeline {
    let vertices = [Some(wgpu::VertexBufferLayout {
        array_stride: size_of::<Vertex>() as u64,
        step_mode: wgpu::VertexStepMode::Vertex,
        attributes: &wgpu::vertex_attr_array![0 => Float32x3],
    })];
    let strip = wgpu::PrimitiveState {
        topology: wgpu::PrimitiveTopology::TriangleStrip,
        strip_index_format: Some(wgpu::IndexFormat::Uint16),
        ..Default::default()
    };
    let constants = variant.constants(dome_mesh);
    let targets = [Some(wgpu::ColorTargetState {
        format: config.target_format,
        blend: over.then_some(wgpu::BlendState::PREMULTIPLIED_ALPHA_BLENDING),
        write_mask: wgpu::ColorWrites::ALL,
    })];
    let flat = Drawing {
        constants: &constants,
        depth: config.depth.map(depth_state),
        multisample: multisample_state(config),
        ..Drawing::new(["vs_screen", "fs_sky"], own, &targets)
    };
    match dome_mesh {
        false => make(&flat),
        true => make(&Drawing {
            entries: ["vs_dome", "fs_sky"],
            vertices: &vertices,
            primitive: strip,
            ..flat
        }),
    }
}

/// What is drawn over the sky and the scene before it. Opacity of the target stays as it is.
pub(crate) struct Overlay {
    /// Of the vertex and the fragment shader.
    pub entries: [&'static str; 2],
    pub topology: wgpu::PrimitiveTopology,
    /// What is left of the colour behind.
    pub behind: wgpu::BlendFactor,
}

impl Overlay {
    /// The flare is added by its own opacity (`glBlendFunc(GL_SRC_ALPHA, GL_ONE)`).
    pub const FLARE: Overlay = Overlay {
        entries: ["vs_flare", "fs_flare"],
        topology: wgpu::PrimitiveTopology::TriangleStrip,
        behind: wgpu::BlendFactor::One,
    };
    /// Rays lie over what is behind them: a triangle over the screen.
    pub const RAYS: Overlay = Overlay::over(["vs_screen", "fs_rays"]);
    /// And so does rain: two triangles a drop.
    pub const RAIN: Overlay = Overlay::over(["vs_rain", "fs_rain"]);

    const fn over(entries: [&'static str; 2]) -> Overlay {
        Overlay {
            entries,
            topology: wgpu::PrimitiveTopology::TriangleList,
            behind: wgpu::BlendFactor::OneMinusSrcAlpha,
        }
    }
}

/// The pipeline of an overlay; `own` is the layout of its group 1, if it has one.
pub(crate) fn overlay(
    config: &SkyConfig,
    own: Option<&wgpu::BindGroupLayout>,
    drawn: &Overlay,
    make: impl FnOnce(&Drawing<'_>) -> wgpu::RenderPipeline,
) -> wgpu::RenderPipeline {
    let component = |src_factor, dst_factor| wgpu::BlendComponent {
        src_factor,
        dst_factor,
        operation: wgpu::BlendOperation::Add,
    };
    let blend = wgpu::BlendState {
        color: component(wgpu::BlendFactor::SrcAlpha, drawn.behind),
        alpha: component(wgpu::BlendFactor::Zero, wgpu::BlendFactor::One),
    };
    let targets = [Some(wgpu::ColorTargetState {
        format: config.target_format,
        blend: Some(blend),
        write_mask: wgpu::ColorWrites::ALL,
    })];
    make(&Drawing {
        primitive: wgpu::PrimitiveState {
            topology: drawn.topology,
            ..Default::default()
        },
        depth: config.depth.map(|depth| wgpu::DepthStencilState {
            depth_compare: Some(wgpu::CompareFunction::Always),
            ..depth_state(depth)
        }),
        multisample: multisample_state(config),
        ..Drawing::new(drawn.entries, own, &targets)
    })
}

pub(crate) fn multisample_state(config: &SkyConfig) -> wgpu::MultisampleState {
    wgpu::MultisampleState {
        count: config.sample_count,
        ..Default::default()
    }
}

/// The sky lies exactly at the far plane: what was cleared to it and nothing nearer lets it through.
pub(crate) fn depth_state(depth: DepthConfig) -> wgpu::DepthStencilState {
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
        for shader in 0..4 {
            let (weather, sea) = (shader & 1 > 0, shader & 2 > 0);
            for (index, variant) in Variant::all(weather, sea).into_iter().enumerate() {
                assert_eq!((variant.index(), variant.shader()), (index, shader));
            }
        }
    }
}
