//! The fbm method, as the runtime sees it.

use glam::Vec3;
use welkin_pack::Role;

use super::interface::{CloudMethod, MapFrame, MapPass, MethodFrame, Shown};
use crate::clouds::fbm::{self, coverage, map, pack};
use crate::clouds::photo;
use crate::clouds::shadow::Layers;
use crate::clouds::shared::{LOW_HEIGHT_M, MeanCloud};
use crate::device::context::{Context, Shader};
use crate::device::layouts::Layouts;
use crate::device::map::texture_bytes;
use crate::frame::Uniforms;
use crate::geometry::part::Part;
use crate::pack_data::PackData;
use crate::params::{Method, SkyParams};

pub(super) struct Fbm;

impl CloudMethod for Fbm {
    fn role(&self) -> Role {
        Role::Fbm
    }

    fn uploads(&self) -> bool {
        true
    }

    fn parts(&self) -> &'static [Part] {
        &[photo::PART, fbm::PART, map::PART, pack::PART]
    }

    fn own_layout<'a>(&self, layouts: &'a Layouts) -> Option<&'a wgpu::BindGroupLayout> {
        Some(&layouts.texture)
    }

    fn map(
        &self,
        context: &Context,
        shader: &Shader,
        _params: &SkyParams,
    ) -> Option<Box<dyn MapPass>> {
        let octaves = context.own_texture(Method::Fbm)?;
        let pass = map::Pass::new(context, shader, octaves);
        Some(Box::new(pass))
    }

    fn write(&self, uniforms: &mut Uniforms, frame: &MethodFrame<'_>) {
        let (octaves, sun) = (&frame.pack.fbm, frame.light.sun_direction);
        uniforms.fbm = fbm::uniforms(frame.params, &frame.view, octaves, sun);
    }

    fn shadow_layers(&self, frame: &MethodFrame<'_>, _uniforms: &Uniforms) -> Layers {
        Layers::of_dome(frame.light.sun_direction, [LOW_HEIGHT_M])
    }

    fn overcast(&self, params: &SkyParams, uniforms: &Uniforms, _pack: &PackData) -> Vec3 {
        fbm::overcast(&uniforms.fbm, &uniforms.clouds, params.shading)
    }

    fn mean(&self, params: &SkyParams, uniforms: &Uniforms, pack: &PackData) -> MeanCloud {
        let spread = map::mean_and_spread(&pack.fbm).1;
        coverage::mean(&uniforms.fbm, &uniforms.clouds, params.shading, spread)
    }

    fn covered(&self, shown: &Shown<'_>, opacity: f32) -> f32 {
        coverage::covered(&shown.texels.fbm, &shown.uniforms.fbm, opacity)
    }
}

impl MapPass for map::Pass {
    fn record(
        &mut self,
        _queue: &wgpu::Queue,
        encoder: &mut wgpu::CommandEncoder,
        shared: &wgpu::BindGroup,
        frame: &MapFrame<'_>,
    ) {
        self.draw(encoder, shared, frame.uniforms.fbm.sun_step);
    }

    fn group(&self) -> &wgpu::BindGroup {
        &self.map.group
    }

    fn texture(&self) -> &wgpu::Texture {
        self.map.texture()
    }

    fn bytes(&self) -> u64 {
        texture_bytes(self.packing.texture()) + texture_bytes(self.texture())
    }
}
