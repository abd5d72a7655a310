//! What every program is made from.

use super::config::SkyConfig;
use super::layouts::Layouts;
use super::pipeline::{Overlay, Variant, overlay_pipeline, pipelines};
use super::shader::{Build, compose};
use crate::geometry::part::Part;
use crate::params::{Method, SkyModel};

/// What every program is made from.
#[derive(Debug)]
pub(crate) struct Common {
    pub device: wgpu::Device,
    pub config: SkyConfig,
    pub build: Build,
    /// The parts of the shader.
    pub parts: &'static [Part],
    pub layouts: Layouts,
    /// The octaves of [`Method::Fbm`] as the pack has them.
    pub fbm: wgpu::Texture,
    /// The layers of [`Method::Lit`].
    pub layers: wgpu::Texture,
    /// The sheet of [`Method::Sprites`].
    pub sheet: wgpu::Texture,
    /// Whether the sky is drawn on the dome's mesh.
    pub mesh: bool,
    /// Whether the target can be blended with.
    pub blends: bool,
}

impl Common {
    /// The shader of a dome with a sky model.
    pub fn module(&self, method: Method, sky: SkyModel) -> wgpu::ShaderModule {
        let build = Build {
            method,
            sky,
            ..self.build
        };
        let source = wgpu::ShaderSource::Wgsl(compose(build, self.parts).into());
        let label = Some(method.name());
        self.device
            .create_shader_module(wgpu::ShaderModuleDescriptor { label, source })
    }

    /// The pipelines of a dome; `own` is the layout of its group 1, if it has one.
    pub fn pipelines(
        &self,
        module: &wgpu::ShaderModule,
        own: Option<&wgpu::BindGroupLayout>,
        weather: bool,
    ) -> [wgpu::RenderPipeline; 4] {
        let (device, config, layouts) = (&self.device, &self.config, &self.layouts);
        let variants = Variant::all(weather);
        pipelines(device, config, module, layouts, own, self.mesh, variants)
    }

    /// The pipeline of what is drawn over the sky; `own` is the layout of its group 1.
    pub fn overlay(
        &self,
        module: &wgpu::ShaderModule,
        own: Option<&wgpu::BindGroupLayout>,
        overlay: &Overlay,
    ) -> wgpu::RenderPipeline {
        let (device, config) = (&self.device, &self.config);
        overlay_pipeline(device, config, module, &self.layouts, own, overlay)
    }
}
