//! What every pipeline is made from.

use super::config::SkyConfig;
use super::layouts::Layouts;
use super::pipeline::{Overlay, Variant, overlay_pipeline, pipelines};
use super::shader::Build;
use crate::params::{Method, Shading, SkyModel};

/// What a shader draws.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Dome {
    /// Whose clouds.
    pub method: Method,
    /// How they are shaded.
    pub shading: Shading,
    /// Whose clear sky.
    pub sky: SkyModel,
    /// Whether rays, rain and lightning are compiled in.
    pub weather: bool,
}

/// What every pipeline is made from.
#[derive(Debug)]
pub(crate) struct Context {
    pub device: wgpu::Device,
    pub config: SkyConfig,
    pub build: Build,
    /// The text of the shader of a dome.
    pub compose: fn(Build, Dome) -> String,
    pub layouts: Layouts,
    /// The textures of the pack that one method alone reads, at its place in [`Method::ALL`].
    pub own: [Option<wgpu::Texture>; Method::ALL.len()],
    /// Texels a side of the packed texture.
    pub clouds_texels: u32,
    /// Whether the sky is drawn on the dome's mesh.
    pub mesh: bool,
    /// Whether the target can be blended with.
    pub blends: bool,
}

impl Context {
    /// The texture of the pack that this method alone reads.
    pub fn own_texture(&self, method: Method) -> Option<&wgpu::Texture> {
        self.own[method as usize].as_ref()
    }

    /// The shader of a dome.
    pub fn module(&self, dome: Dome) -> wgpu::ShaderModule {
        let text = (self.compose)(self.build, dome);
        let source = wgpu::ShaderSource::Wgsl(text.into());
        let label = Some(dome.method.name());
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
