//! The lit method, as the runtime sees it.

use glam::Vec3;
use welkin_pack::Role;

use super::interface::{CloudMethod, MapFrame, MapPass, MethodFrame, Shown};
use crate::clouds::lit::{self, SHADOW, coverage, light, map, paper};
use crate::clouds::shadow::Layers;
use crate::clouds::shared::MeanCloud;
use crate::clouds::{photo, shared};
use crate::device::context::{Context, Shader};
use crate::device::layouts::Layouts;
use crate::device::map::texture_bytes;
use crate::frame::Uniforms;
use crate::geometry::part::Part;
use crate::pack_data::PackData;
use crate::params::{Method, Shading, SkyParams};

pub(super) struct Lit;

impl CloudMethod for Lit {
    fn role(&self) -> Role {
        Role::Layers
    }

    fn uploads(&self) -> bool {
        true
    }

    fn parts(&self) -> &'static [Part] {
        &[photo::PART, lit::PART, paper::PART, map::PART, SHADOW]
    }

    fn own_layout<'a>(&self, layouts: &'a Layouts) -> Option<&'a wgpu::BindGroupLayout> {
        Some(&layouts.lit)
    }

    fn map(
        &self,
        context: &Context,
        shader: &Shader,
        _params: &SkyParams,
    ) -> Option<Box<dyn MapPass>> {
        let layers = context.own_texture(Method::Lit)?;
        Some(Box::new(map::Pass::new(context, shader, layers)))
    }

    fn write(&self, uniforms: &mut Uniforms, frame: &MethodFrame<'_>) {
        let params = frame.params;
        uniforms.lit = lit::uniforms(
            params,
            &frame.view,
            frame.light.sun_direction,
            &uniforms.clouds,
            frame.pack.cirrus_spreads,
        );
    }

    fn shadow_layers(&self, frame: &MethodFrame<'_>, uniforms: &Uniforms) -> Layers {
        let params = frame.params;
        let heights_m = lit::drawn(params).map(|(index, _)| lit::height_m(params, index));
        Layers::new(uniforms.lit.light_position, heights_m)
    }

    fn overcast(&self, params: &SkyParams, uniforms: &Uniforms, _pack: &PackData) -> Vec3 {
        match params.shading {
            Shading::Scattered => light::overcast(&uniforms.lit, &uniforms.clouds),
            Shading::Paper => paper::overcast(&uniforms.lit),
        }
    }

    fn facing(
        &self,
        params: &SkyParams,
        uniforms: &Uniforms,
        direction: Vec3,
        _opacity: f32,
    ) -> f32 {
        match params.shading {
            Shading::Scattered => {
                let cosine = direction.dot(uniforms.sky.sun_direction);
                shared::scattered_facing(&uniforms.clouds, cosine)
            }
            Shading::Paper => paper::facing(&uniforms.lit, direction),
        }
    }

    fn mean(&self, params: &SkyParams, uniforms: &Uniforms, _pack: &PackData) -> MeanCloud {
        let opacity = coverage::mean_opacity(&uniforms.lit);
        match params.shading {
            Shading::Scattered => {
                let shares = light::mean_shares(&uniforms.lit, &uniforms.clouds);
                MeanCloud::of_shares(&uniforms.clouds, opacity, shares)
            }
            Shading::Paper => paper::mean(&uniforms.lit, opacity),
        }
    }

    fn covered(&self, shown: &Shown<'_>, opacity: f32) -> f32 {
        coverage::covered(&shown.uniforms.lit, opacity)
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
        self.draw(encoder, shared, frame.uniforms.lit.count as usize);
    }

    fn group(&self) -> &wgpu::BindGroup {
        &self.group
    }

    fn texture(&self) -> &wgpu::Texture {
        &self.map.texture
    }

    fn bytes(&self) -> u64 {
        texture_bytes(&self.map.texture)
    }
}
