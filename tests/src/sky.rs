//! Twin of sky.wgsl.

use glam::{Vec2, Vec3};
use welkin_runtime::clear_sky::gradient::{GROUND_FALL, GROUND_FLOOR};
use welkin_runtime::frame::Uniforms;

use crate::perez;
use crate::texture::Texture;
use crate::vector::xyz;

/// Radiance of the clear sky along a unit direction.
pub fn radiance(uniforms: &Uniforms, texture: &Texture, direction: Vec3) -> Vec3 {
    let sky = &uniforms.sky;
    let [u, base, scale, _] = sky.gradient;
    let v = base + scale * libm::sqrtf(direction.y.max(0.0));
    let from_sun = direction.dot(xyz(sky.sun)) - 1.0;
    // The narrow lobe is the wide one's twelfth power.
    let lobe = |lobe: [f32; 4], power: f32| xyz(lobe) * libm::exp2f(power * sky.wide[3] * from_sun);
    let [east, south, ..] = uniforms.clouds.gradient;
    let side = 0.5 + 0.5 * Vec2::new(direction.x, direction.z).dot(Vec2::new(east, south));
    let band = xyz(sky.band) * (side * side * libm::exp2f(-sky.band[3] * direction.y.abs()));
    let light =
        xyz(texture.sample([u, v], 0.0)) + lobe(sky.wide, 1.0) + lobe(sky.narrow, 12.0) + band;
    let light = perez::light(&uniforms.perez, direction, light);
    let light = light.lerp(xyz(sky.overcast), sky.overcast[3]);
    let below = (-direction.y).max(0.0);
    light * (GROUND_FLOOR + (1.0 - GROUND_FLOOR) / (1.0 + GROUND_FALL * below))
}
