//! Twin of clear_sky/gradient.wgsl.

use glam::{Vec3, Vec3Swizzles};
use welkin_runtime::internals::clear_sky::gradient::{GROUND_FALL, GROUND_FLOOR};
use welkin_runtime::internals::frame::Uniforms;

use crate::perez;
use crate::texture::Texture;

/// Radiance of the clear sky along a unit direction.
pub fn radiance(uniforms: &Uniforms, texture: &Texture, direction: Vec3) -> Vec3 {
    let sky = &uniforms.sky;
    let v = sky.horizon_v + sky.elevation_v * libm::sqrtf(direction.y.max(0.0));
    let from_sun = direction.dot(sky.sun_direction) - 1.0;
    // The narrow lobe is the wide one's twelfth power.
    let lobe = |lobe: Vec3, power: f32| lobe * libm::exp2f(power * sky.wide_sharpness * from_sun);
    let side = 0.5 + 0.5 * direction.xz().dot(uniforms.clouds.sun_azimuth);
    let fade = libm::exp2f(-sky.band_sharpness * direction.y.abs());
    let band = sky.band * (side * side * fade);
    let light = Vec3::from_slice(&texture.sample([sky.time_u, v], 0.0))
        + lobe(sky.wide, 1.0)
        + lobe(sky.narrow, 12.0)
        + band;
    let light = perez::light(&uniforms.perez, direction, light);
    let light = light.lerp(sky.overcast, sky.overcast_weight);
    let below = (-direction.y).max(0.0);
    light * (GROUND_FLOOR + (1.0 - GROUND_FLOOR) / (1.0 + GROUND_FALL * below))
}
