//! The sprites method, as the dome sees it: over a clear dome of its own it draws what [`crate::sprites`] has.

use glam::Vec3;
use welkin_pack::Role;

use super::interface::{CloudMethod, MethodFrame, Shown};
use crate::clouds::shadow::Layers;
use crate::clouds::shared::MeanCloud;
use crate::clouds::{packed, shared};
use crate::frame::Uniforms;
use crate::geometry::part::Part;
use crate::pack_data::PackData;
use crate::params::SkyParams;
use crate::sprites::{self, pipelines, ring};

/// Radiance of separate clouds over that of a sheet.
const HEAPS: f32 = 0.7;

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
        &[packed::VEIL, pipelines::PART, ring::PART]
    }

    // Behind sprites there are none.
    fn is_often_opaque(&self) -> bool {
        false
    }

    fn write(&self, uniforms: &mut Uniforms, frame: &MethodFrame<'_>) {
        let (hours, flash) = (&frame.pack.hours, frame.flash);
        // Not those of the dome behind, which has a cover of its own.
        let clouds = shared::uniforms(frame.clamped, &frame.light, frame.view.texels);
        uniforms.sprites = sprites::uniforms(
            frame.clamped,
            &frame.view,
            &frame.light,
            &clouds,
            hours,
            flash,
        );
    }

    fn shadow_layers(&self, frame: &MethodFrame<'_>, _uniforms: &Uniforms) -> Layers {
        Layers::of_dome(frame.light.sun_direction, [packed::UPPER_HEIGHT_M])
    }

    fn shut(&self, params: &SkyParams) -> f32 {
        shared::overcast_weight(params.cover)
    }

    fn overcast_weight(&self, params: &SkyParams, viewer_m: f32, pack: &PackData) -> f32 {
        sprites::overcast_weight(params, viewer_m, pack.cloud_heights_m)
    }

    fn overcast(&self, _params: &SkyParams, uniforms: &Uniforms, _pack: &PackData) -> Vec3 {
        sprites::overcast(&uniforms.sprites)
    }

    // They have their own sides.
    fn facing(
        &self,
        _params: &SkyParams,
        _uniforms: &Uniforms,
        _direction: Vec3,
        _opacity: f32,
    ) -> f32 {
        1.0
    }

    // From the ground clouds in space hide more of the sky than they stand over.
    fn mean(&self, params: &SkyParams, uniforms: &Uniforms, pack: &PackData) -> MeanCloud {
        let open = 1.0 - params.cover * params.sprites.formation;
        // Single heaps show more of their dark bases than a sheet does: measured.
        let heaps = HEAPS + (1.0 - HEAPS) * shared::overcast_weight(params.cover);
        MeanCloud {
            opacity: 1.0 - open.powf(1.25),
            sunlit: Vec3::ZERO,
            skylit: self.overcast(params, uniforms, pack) * heaps,
        }
    }

    // The field's clouds are ranked by the fraction of the ground that they cover.
    fn covered(&self, shown: &Shown<'_>, _opacity: f32) -> f32 {
        shown.params.cover
    }
}
