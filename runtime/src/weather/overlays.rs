//! What weather draws over the sky of a method: rays and rain, made when they first come.

use super::rain::{RainUniforms, vertices};
use super::rays::{self, RayUniforms};
use crate::device::context::{Context, Dome, Shader};
use crate::device::pipeline::Overlay;
use crate::params::{Method, Shading, SkyModel};

/// Rays and rain over the sky of a method.
#[derive(Debug, Default)]
pub(crate) struct Overlays {
    /// Of both.
    shader: Option<Shader>,
    rays: Option<rays::Pass>,
    rain: Option<wgpu::RenderPipeline>,
}

/// How much of both a frame shows.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Shown {
    pub rays: bool,
    /// Vertices of the rain, 0 without.
    pub rain: u32,
}

/// What a frame shows.
pub(crate) fn shown(rays: &RayUniforms, rain: &RainUniforms) -> Shown {
    Shown {
        rays: rays.opacity > 0.0,
        rain: vertices(rain),
    }
}

impl Overlays {
    /// Records what a frame shows, if the target can show it; `own` is layout and group 1 of the dome, if it has one.
    pub fn record(
        &mut self,
        context: &Context,
        (method, shading): (Method, Shading),
        shown: Shown,
        encoder: &mut wgpu::CommandEncoder,
        shared: &wgpu::BindGroup,
        own: Option<(&wgpu::BindGroupLayout, &wgpu::BindGroup)>,
    ) {
        if !context.blends || (!shown.rays && shown.rain == 0) {
            return;
        }
        // Clear sky is not asked for.
        let dome = Dome {
            method,
            shading,
            sky: SkyModel::Table,
            weather: true,
            sea: false,
        };
        let shader = self.shader.get_or_insert_with(|| Shader::new(dome));
        if shown.rain > 0 {
            let new = || context.overlay(shader, None, &Overlay::RAIN);
            self.rain.get_or_insert_with(new);
        }
        if shown.rays {
            let new = || rays::Pass::new(context, shader, own.map(|own| own.0));
            let pass = self.rays.get_or_insert_with(new);
            pass.record(encoder, shared, own.map(|own| own.1));
        }
    }

    /// Draws what was recorded: rays, and rain before them.
    pub fn draw(&self, pass: &mut wgpu::RenderPass<'_>, shown: Shown) {
        if let Some(rays) = self.rays.as_ref().filter(|_| shown.rays) {
            pass.set_pipeline(&rays.overlay);
            pass.set_bind_group(1, rays.group(), &[]);
            pass.draw(0..3, 0..1);
        }
        if let Some(rain) = self.rain.as_ref().filter(|_| shown.rain > 0) {
            pass.set_pipeline(rain);
            pass.draw(0..shown.rain, 0..1);
        }
    }

    /// Bytes of the textures that are drawn.
    pub fn bytes(&self) -> u64 {
        self.rays.as_ref().map_or(0, rays::Pass::bytes)
    }
}
