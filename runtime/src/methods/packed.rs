//! The packed method, as the runtime sees it.

use glam::Vec3;
use welkin_pack::Role;

use super::interface::{CloudMethod, MapFrame, MapPass, MethodFrame, Shown};
use crate::clouds::packed::{self, UPPER_HEIGHT_M, coverage, map, paper};
use crate::clouds::shadow::Layers;
use crate::clouds::shared::{LOW_HEIGHT_M, MeanCloud};
use crate::device::context::{Context, Shader};
use crate::device::layouts::Layouts;
use crate::device::map::texture_bytes;
use crate::frame::Uniforms;
use crate::geometry::part::Part;
use crate::pack_data::PackData;
use crate::params::{Shading, SkyParams};

pub(super) struct Packed;

impl CloudMethod for Packed {
    fn role(&self) -> Role {
        Role::Clouds
    }

    fn parts(&self) -> &'static [Part] {
        &[packed::VEIL, packed::PART, map::PART, paper::PART]
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
        let pass = map::Pass::new(context, shader, context.clouds_texels);
        Some(Box::new(pass))
    }

    fn write(&self, uniforms: &mut Uniforms, frame: &MethodFrame<'_>) {
        let sun = frame.light.sun_direction;
        uniforms.packed = packed::uniforms(frame.params, &frame.view, sun);
    }

    fn shadow_layers(&self, frame: &MethodFrame<'_>, _uniforms: &Uniforms) -> Layers {
        Layers::of_dome(frame.light.sun_direction, [LOW_HEIGHT_M, UPPER_HEIGHT_M])
    }

    fn overcast(&self, params: &SkyParams, uniforms: &Uniforms, pack: &PackData) -> Vec3 {
        let (packed, clouds) = (&uniforms.packed, &uniforms.clouds);
        match params.shading {
            Shading::Scattered => packed::overcast(packed, clouds, pack.cloud_means),
            Shading::Paper => paper::overcast(packed, clouds, pack.cloud_means),
        }
    }

    fn mean(&self, params: &SkyParams, uniforms: &Uniforms, pack: &PackData) -> MeanCloud {
        let (packed, clouds) = (&uniforms.packed, &uniforms.clouds);
        coverage::mean(packed, clouds, params.shading, &pack.cloud_texels)
    }

    fn covered(&self, shown: &Shown<'_>, opacity: f32) -> f32 {
        let (packed, shading) = (&shown.uniforms.packed, shown.params.shading);
        shown.texels.packed.covered(packed, shading, opacity)
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
        // The paper's shading does not read it.
        if frame.params.shading == Shading::Scattered {
            self.draw(encoder, shared, frame.uniforms.packed.photo_step);
        }
    }

    fn group(&self) -> &wgpu::BindGroup {
        &self.group
    }

    fn texture(&self) -> &wgpu::Texture {
        self.texture()
    }

    fn bytes(&self) -> u64 {
        texture_bytes(self.texture())
    }
}
