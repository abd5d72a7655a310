//! The sun: a square that always faces the screen.
//!
//! # Theory
//! Roden and Parberry, section 2: "a simple flat square". A pixel's place on it is the dot product of its
//! direction with the screen's axes, made perpendicular to the sun.
//!
//! # Changes versus the paper
//! Disc and glow are two channels drawn at their own sizes from one texture; the colour of both
//! follows the time of day.
//!
//! # Practice
//! One or two texture reads, only inside the square; none at night.

use glam::Vec3;

use crate::clear_sky::gradient;
use crate::clear_sky::light::Light;
use crate::geometry::camera::Rays;
use crate::geometry::math::smoothstep;
use crate::geometry::part::{Part, Value};
use crate::geometry::uniforms::uniforms;

/// Its part of the shader.
pub const PART: Part = Part {
    constants: &[("SUN_HORIZON", Value::F32(HORIZON))],
    structs: &[SunUniforms::WGSL],
    wgsl: include_str!("sun.wgsl"),
};

uniforms! {
    /// The sun's square.
    SunUniforms {
        /// The screen's right about the sun, over the glow's half side.
        right: Vec3,
        /// The glow's half side over the disc's.
        glow_to_disc: f32,
        /// The same as right, upwards.
        up: Vec3,
        /// 1 if there is a sun to draw, else 0.
        is_shown: f32,
        /// Radiance of the disc.
        disc: Vec3,
        /// Level of the texture for the disc.
        disc_lod: f32,
        /// Radiance of the glow.
        glow: Vec3,
        /// Level of the texture for the glow.
        glow_lod: f32,
        /// Unit direction towards what is drawn, the sun or the moon.
        direction: Vec3,
        /// Nothing.
        _pad: f32,
    }
}

/// Radius of the disc as it is drawn, in radians. The real sun's is 0.00465; pictures of skies show it
/// about twice as large, since glare hides its edge.
pub const DISC_RADIUS_RAD: f32 = 0.0095;
/// Half the side of the glow's square, as a sine.
const GLOW_HALF_SIDE: f32 = 0.21;
/// The sun sets into haze: over this sine of elevation, above and below the horizon, it fades.
pub const HORIZON: f32 = 0.012;

/// Radiance of the disc and of the glow's centre in white light.
const DISC_RADIANCE: f32 = 12.0;
const GLOW_RADIANCE: f32 = 1.1;

/// The sun's share of the uniforms. `texels` is the side of the texture, `pixel_rad` that of a pixel; `shown` is
/// whether it is drawn at all.
pub fn uniforms(
    light: &Light,
    rays: &Rays,
    texels: u32,
    levels: usize,
    pixel_rad: f32,
    shown: bool,
) -> SunUniforms {
    // Half the disc texture's side is its edge (see the role's channel meanings).
    let disc_half_side = 2.0 * DISC_RADIUS_RAD;
    let level = |half_side: f32| {
        let texel_rad = 2.0 * half_side / texels as f32;
        (pixel_rad / texel_rad)
            .log2()
            .clamp(0.0, levels.saturating_sub(1) as f32)
    };
    let (right, up) = facing_axes(light.sun_direction, rays);
    let is_shown = if shown && light.sun_direction.y > -GLOW_HALF_SIDE {
        1.0
    } else {
        0.0
    };
    let colour = light.sunlight;
    let set = smoothstep(-0.16, 0.0, light.sun_direction.y);
    SunUniforms {
        right: right / GLOW_HALF_SIDE,
        glow_to_disc: GLOW_HALF_SIDE / disc_half_side,
        up: up / GLOW_HALF_SIDE,
        is_shown,
        disc: colour * DISC_RADIANCE,
        disc_lod: level(disc_half_side),
        glow: colour * (GLOW_RADIANCE * set * (1.0 + gradient::low_sun(light))),
        glow_lod: level(GLOW_HALF_SIDE),
        direction: light.sun_direction,
        ..Default::default()
    }
}

/// Two unit vectors perpendicular to the sun's direction and to each other, the first along the
/// screen's right as far as it can be.
fn facing_axes(sun: Vec3, rays: &Rays) -> (Vec3, Vec3) {
    let flattened = |axis: Vec3| axis - sun * axis.dot(sun);
    let right = flattened(rays.right.normalize());
    // A sun exactly at the side of the screen leaves nothing of the right axis: take another.
    let right = if right.length_squared() > 1e-6 {
        right
    } else {
        flattened(rays.forward.normalize())
    };
    let right = right.normalize();
    (right, right.cross(sun))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::camera::Camera;

    #[test]
    fn the_square_faces_the_screen_wherever_the_sun_is() {
        let rays = Camera::looking(0.4, 0.2, 1.0, [64, 48]).rays();
        for sun in [
            Vec3::Y,
            Vec3::NEG_Y,
            rays.right.normalize(),
            -rays.right.normalize(),
            rays.forward.normalize(),
        ] {
            let (right, up) = facing_axes(sun, &rays);
            assert!(right.is_normalized() && up.is_normalized());
            assert!(
                right.dot(up).abs() < 1e-5
                    && right.dot(sun).abs() < 1e-5
                    && up.dot(sun).abs() < 1e-5
            );
        }
        let (right, up) = facing_axes(rays.forward.normalize(), &rays);
        assert!(
            right.dot(rays.right) > 0.0 && up.dot(rays.up) > 0.0,
            "not mirrored"
        );
    }
}
