//! Twin of sun.wgsl.

use glam::Vec3;
use welkin_runtime::internals::clear_sky::eclipse::SUN_RADIUS_RAD;
use welkin_runtime::internals::clear_sky::sun::{CORONA_END, GLARE_CORE, GLARE_END, HORIZON};
use welkin_runtime::internals::frame::Uniforms;

use crate::texture::{Texture, smoothstep};

/// Radiance of the sun's square and of its glare along a unit direction, where a share of its light comes through.
pub fn radiance(uniforms: &Uniforms, texture: &Texture, direction: Vec3, share: f32) -> Vec3 {
    let sun = &uniforms.sun;
    let cosine = direction.dot(uniforms.sky.sun_direction);
    if cosine <= sun.least_cosine {
        return Vec3::ZERO;
    }
    let away = 2.0 - 2.0 * f64::from(cosine.min(1.0)) + f64::from(GLARE_CORE);
    let mut glare = sun.glare * (libm::pow(away, -1.5) as f32 - GLARE_END).max(0.0);
    if sun.has_corona == 1.0 {
        let away_rad = direction.distance(uniforms.sky.sun_direction);
        let radii = f64::from(away_rad / SUN_RADIUS_RAD).max(1.0);
        let profile = 2.565 * libm::pow(radii, -17.0)
            + 1.425 * libm::pow(radii, -7.0)
            + 0.0532 * libm::pow(radii, -2.5);
        glare += sun.corona * (profile as f32 - CORONA_END).max(0.0);
    }
    let place = [direction.dot(sun.right), -direction.dot(sun.up)];
    let inside = |place: [f32; 2]| place[0].abs().max(place[1].abs()) < 1.0;
    if !inside(place) {
        return share * glare;
    }
    let uv = place.map(|p| 0.5 + 0.5 * p);
    let covered = texture.sample(uv, sun.lod)[0] * smoothstep(-HORIZON, HORIZON, direction.y);
    share * glare + disc_shown(uniforms, share * sun.disc) * covered
}

/// What the target shows of the light of a disc, of sun or moon.
pub fn disc_shown(uniforms: &Uniforms, light: Vec3) -> Vec3 {
    light * (uniforms.sun.brightest / light.max_element().max(1e-6)).min(1.0)
}
