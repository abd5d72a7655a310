//! The octaves method, as the runtime sees it.

use glam::Vec3;
use welkin_pack::Role;

use super::interface::{CloudMethod, MapFrame, MapPass, MethodFrame, Shown};
use crate::clouds::octaves::{self, coverage, map};
use crate::clouds::photo;
use crate::clouds::shadow::Layers;
use crate::clouds::shared::{self, MeanCloud};
use crate::device::context::{Context, Shader};
use crate::device::layouts::Layouts;
use crate::device::map::texture_bytes;
use crate::frame::Uniforms;
use crate::geometry::part::Part;
use crate::pack_data::PackData;
use crate::params::{Shading, SkyParams};

pub(super) struct Octaves;

impl CloudMethod for Octaves {
    fn role(&self) -> Role {
        Role::Octaves
    }

    fn parts(&self) -> &'static [Part] {
        &[photo::PART, octaves::PART, map::PART]
    }

    fn own_layout<'a>(&self, layouts: &'a Layouts) -> Option<&'a wgpu::BindGroupLayout> {
        Some(&layouts.texture)
    }

    fn map(
        &self,
        context: &Context,
        shader: &Shader,
        params: &SkyParams,
    ) -> Option<Box<dyn MapPass>> {
        let pass = map::Pass::new(context, shader, params.octaves.count);
        Some(Box::new(pass))
    }

    fn write(&self, uniforms: &mut Uniforms, frame: &MethodFrame<'_>) {
        let (azimuth, sun) = (uniforms.clouds.sun_azimuth, frame.light.sun_direction);
        uniforms.octaves = octaves::uniforms(frame.params, &frame.view, azimuth, sun.y);
    }

    fn shadow_layers(&self, frame: &MethodFrame<'_>, _uniforms: &Uniforms) -> Layers {
        Layers::of_dome(frame.light.sun_direction, octaves::HEIGHTS_M)
    }

    fn overcast(&self, params: &SkyParams, uniforms: &Uniforms, _pack: &PackData) -> Vec3 {
        match params.shading {
            Shading::Scattered => coverage::mean(&uniforms.octaves, &uniforms.clouds).radiance(),
            Shading::Paper => octaves::paper_overcast(&uniforms.octaves, &uniforms.clouds),
        }
    }

    fn mean(&self, params: &SkyParams, uniforms: &Uniforms, _pack: &PackData) -> MeanCloud {
        let (octaves, clouds) = (&uniforms.octaves, &uniforms.clouds);
        match params.shading {
            Shading::Scattered => coverage::mean(octaves, clouds),
            Shading::Paper => MeanCloud::of_shares(
                clouds,
                coverage::mean_opacity(octaves),
                shared::shares_of_grey(octaves::paper_grey(octaves)),
            ),
        }
    }

    fn covered(&self, shown: &Shown<'_>, opacity: f32) -> f32 {
        coverage::covered(&shown.uniforms.octaves, opacity)
    }
}

impl MapPass for map::Pass {
    fn ensure(&mut self, context: &Context, params: &SkyParams) {
        self.resize(&context.device, &context.layouts, params.octaves.count);
    }

    fn record(
        &mut self,
        queue: &wgpu::Queue,
        encoder: &mut wgpu::CommandEncoder,
        shared: &wgpu::BindGroup,
        frame: &MapFrame<'_>,
    ) {
        let states = frame.pack.octave_states(frame.params, frame.seconds);
        self.draw(queue, encoder, shared, &states);
    }

    fn group(&self) -> &wgpu::BindGroup {
        &self.map.group
    }

    fn texture(&self) -> &wgpu::Texture {
        self.map.texture()
    }

    fn bytes(&self) -> u64 {
        texture_bytes(&self.states) + texture_bytes(self.texture())
    }
}
