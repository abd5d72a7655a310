//! The packed method, as the runtime sees it.

use glam::Vec3;
use welkin_pack::Role;

use super::interface::{CloudMethod, MethodFrame, Shown};
use crate::clouds::packed;
use crate::frame::Uniforms;
use crate::geometry::part::Part;
use crate::pack_data::PackData;
use crate::params::SkyParams;

pub(super) struct Packed;

impl CloudMethod for Packed {
    fn role(&self) -> Role {
        Role::Clouds
    }

    fn parts(&self) -> &'static [Part] {
        &[packed::PART]
    }

    // Hardly ever, and to ask costs more than it saves.
    fn is_often_opaque(&self) -> bool {
        false
    }

    fn write(&self, uniforms: &mut Uniforms, frame: &MethodFrame<'_>) {
        uniforms.packed = packed::uniforms(frame.params, &frame.view);
    }

    fn overcast(&self, uniforms: &Uniforms, pack: &PackData) -> Vec3 {
        packed::overcast(&uniforms.packed, &uniforms.clouds, pack.cloud_means)
    }

    fn mean(&self, _params: &SkyParams, uniforms: &Uniforms, pack: &PackData) -> (f32, Vec3) {
        packed::coverage::mean(&uniforms.packed, &uniforms.clouds, &pack.cloud_texels)
    }

    fn covered(&self, shown: &Shown<'_>, opacity: f32) -> f32 {
        shown.texels.packed.covered(&shown.uniforms.packed, opacity)
    }
}
