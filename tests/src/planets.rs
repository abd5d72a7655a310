//! Twin of planets.wgsl.

use glam::{Vec2, Vec3};
use welkin_runtime::internals::clear_sky::planets::{RADIUS_PX, REACH_PX, end};
use welkin_runtime::internals::frame::Uniforms;

/// Radiance of the planets at the pixel with centre `pixel`, which looks in a direction.
pub fn radiance(uniforms: &Uniforms, direction: Vec3, pixel: Vec2) -> Vec3 {
    let planets = uniforms.planets.places.iter().zip(uniforms.planets.lights);
    let light: Vec3 = planets
        .filter(|(place, _)| place.z == 1.0)
        .map(|(place, light)| {
            let away = pixel.distance(place.truncate().truncate());
            let profile = match away < REACH_PX {
                true => (1.0 + (away / RADIUS_PX).powi(2)).powf(-2.5) - end(),
                false => 0.0,
            };
            light.truncate() * profile.max(0.0)
        })
        .sum();
    let narrowing = direction.dot(uniforms.camera.clip_w.truncate());
    light * (1.0 + uniforms.stars.evenness * (narrowing.powi(-3) - 1.0))
}
