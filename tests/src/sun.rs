//! Twin of sun.wgsl.

use glam::Vec3;
use welkin_runtime::clear_sky::sun::HORIZON;
use welkin_runtime::frame::Uniforms;

use crate::texture::{Texture, smoothstep};
use crate::vector::xyz;

/// Radiance of the sun's square along a unit direction.
pub fn radiance(uniforms: &Uniforms, texture: &Texture, direction: Vec3) -> Vec3 {
    let sun = &uniforms.sun;
    let place = [direction.dot(xyz(sun.right)), -direction.dot(xyz(sun.up))];
    let inside = |place: [f32; 2]| place[0].abs().max(place[1].abs()) < 1.0;
    if sun.up[3] == 0.0 || direction.dot(xyz(sun.towards)) <= 0.0 || !inside(place) {
        return Vec3::ZERO;
    }
    let uv = |place: [f32; 2]| place.map(|p| 0.5 + 0.5 * p);
    let mut radiance = xyz(sun.glow) * texture.sample(uv(place), sun.glow[3])[1];
    let inner = place.map(|p| p * sun.right[3]);
    if inside(inner) {
        radiance += xyz(sun.disc) * texture.sample(uv(inner), sun.disc[3])[0];
    }
    radiance * smoothstep(-HORIZON, HORIZON, direction.y)
}
