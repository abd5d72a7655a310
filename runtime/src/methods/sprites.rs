//! The sprites method, as the dome sees it: over a clear dome of its own it draws what [`crate::sprites`] has.

use glam::Vec3;
use welkin_pack::Role;

use super::interface::{CloudMethod, MethodFrame, Shown};
use crate::clouds::packed;
use crate::frame::Uniforms;
use crate::geometry::part::Part;
use crate::pack_data::PackData;
use crate::params::SkyParams;
use crate::sprites::{self, pipelines, ring};

pub(super) struct Sprites;

impl CloudMethod for Sprites {
    fn role(&self) -> Role {
        Role::Sprites
    }

    fn uploads(&self) -> bool {
        true
    }

    fn parts(&self) -> &'static [Part] {
        // The dome shows the thin upper layer of the packed method.
        &[packed::PART, pipelines::PART, ring::PART]
    }

    // Behind sprites there are none.
    fn is_often_opaque(&self) -> bool {
        false
    }

    fn write(&self, uniforms: &mut Uniforms, frame: &MethodFrame<'_>) {
        let (hours, flash) = (&frame.pack.hours, frame.flash);
        uniforms.sprites =
            sprites::uniforms(frame.clamped, &frame.view, &frame.light, hours, flash);
    }

    fn overcast_weight(&self, params: &SkyParams, viewer_m: f32, pack: &PackData) -> f32 {
        sprites::overcast_weight(params, viewer_m, pack.cloud_heights_m)
    }

    fn overcast(&self, uniforms: &Uniforms, _pack: &PackData) -> Vec3 {
        sprites::overcast(&uniforms.sprites)
    }

    // The field's clouds are ranked by the fraction of the ground that they cover.
    fn covered(&self, shown: &Shown<'_>, _opacity: f32) -> f32 {
        shown.params.cover
    }
}
