//! What every pipeline is made from, and the pipelines that were made.

use std::collections::HashMap;
use std::sync::{Mutex, OnceLock, PoisonError};

use super::config::SkyConfig;
use super::layouts::Layouts;
use super::pipeline::{Drawing, Overlay, Variant, overlay, screen};
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
    /// Whether a sea takes the place of the ground.
    pub sea: bool,
}

/// The shader of a dome. It is compiled when a pipeline is made of it that was not made before.
#[derive(Clone, Debug)]
pub(crate) struct Shader {
    dome: Dome,
    module: OnceLock<wgpu::ShaderModule>,
}

impl Shader {
    pub fn new(dome: Dome) -> Shader {
        Shader {
            dome,
            module: OnceLock::new(),
        }
    }
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
    /// The pipelines by what they are made of: all views of a sky draw with the same.
    pub made: Mutex<HashMap<String, wgpu::RenderPipeline>>,
}

impl Context {
    /// The texture of the pack that this method alone reads.
    pub fn own_texture(&self, method: Method) -> Option<&wgpu::Texture> {
        self.own[method as usize].as_ref()
    }

    /// A pipeline, unless it was made before.
    pub fn pipeline(&self, shader: &Shader, drawing: &Drawing<'_>) -> wgpu::RenderPipeline {
        let (dome, entries) = (shader.dome, drawing.entries);
        let key = format!(
            "{dome:?} {entries:?} {:?} {:?}",
            drawing.constants, drawing.targets
        );
        let mut made = self.made.lock().unwrap_or_else(PoisonError::into_inner);
        let pipeline = made.entry(key).or_insert_with(|| {
            let module = shader.module.get_or_init(|| self.module(dome));
            drawing.pipeline(&self.device, &self.layouts, module)
        });
        pipeline.clone()
    }

    /// The pipelines of a dome; `own` is the layout of its group 1, if it has one.
    pub fn pipelines(
        &self,
        shader: &Shader,
        own: Option<&wgpu::BindGroupLayout>,
    ) -> [wgpu::RenderPipeline; 4] {
        let pipeline = |variant: Variant| {
            let (mesh, over) = (self.mesh, self.build.over);
            screen(&self.config, own, mesh, over, variant, |drawing| {
                self.pipeline(shader, drawing)
            })
        };
        Variant::all(shader.dome.weather, shader.dome.sea).map(pipeline)
    }

    /// The pipeline of what is drawn over the sky; `own` is the layout of its group 1.
    pub fn overlay(
        &self,
        shader: &Shader,
        own: Option<&wgpu::BindGroupLayout>,
        drawn: &Overlay,
    ) -> wgpu::RenderPipeline {
        overlay(&self.config, own, drawn, |drawing| {
            self.pipeline(shader, drawing)
        })
    }

    /// A pipeline that fills a whole target; `own` is the layout of its group 1, if it has one.
    pub fn off_screen<'a>(
        &self,
        shader: &Shader,
        entry: &str,
        own: impl Into<Option<&'a wgpu::BindGroupLayout>>,
        format: wgpu::TextureFormat,
    ) -> wgpu::RenderPipeline {
        self.off_screen_with(shader, entry, own, &[format], &[])
    }

    /// The same of several targets, with overridable constants.
    pub fn off_screen_with<'a>(
        &self,
        shader: &Shader,
        entry: &str,
        own: impl Into<Option<&'a wgpu::BindGroupLayout>>,
        formats: &[wgpu::TextureFormat],
        constants: &[(&str, f64)],
    ) -> wgpu::RenderPipeline {
        let targets: Vec<_> = formats.iter().map(|&format| Some(format.into())).collect();
        let drawing = Drawing {
            constants,
            ..Drawing::new(["vs_map", entry], own.into(), &targets)
        };
        self.pipeline(shader, &drawing)
    }

    fn module(&self, dome: Dome) -> wgpu::ShaderModule {
        let text = (self.compose)(self.build, dome);
        let source = wgpu::ShaderSource::Wgsl(text.into());
        let label = Some(dome.method.name());
        self.device
            .create_shader_module(wgpu::ShaderModuleDescriptor { label, source })
    }
}
