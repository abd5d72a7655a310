//! Twin of sun.wgsl.

use glam::Vec3;
use welkin_runtime::internals::clear_sky::sun::HORIZON;
use welkin_runtime::internals::frame::Uniforms;

use crate::texture::{Texture, smoothstep};

/// Radiance of the sun's square along a unit direction.
pub fn radiance(uniforms: &Uniforms, texture: &Texture, direction: Vec3) -> Vec3 {
    let sun = &uniforms.sun;
    let place = [direction.dot(sun.right), -direction.dot(sun.up)];
    let inside = |place: [f32; 2]| place[0].abs().max(place[1].abs()) < 1.0;
    if sun.is_shown == 0.0 || direction.dot(sun.direction) <= 0.0 || !inside(place) {
        return Vec3::ZERO;
    }
    let uv = |place: [f32; 2]| place.map(|p| 0.5 + 0.5 * p);
    let mut radiance = sun.glow * texture.sample(uv(place), sun.glow_lod)[1];
    let inner = place.map(|p| p * sun.glow_to_disc);
    if inside(inner) {
        radiance += sun.disc * texture.sample(uv(inner), sun.disc_lod)[0];
    }
    radiance * smoothstep(-HORIZON, HORIZON, direction.y)
}
