//! The sun: a square that always faces the screen.
//!
//! # Theory
//! Roden and Parberry, section 2: "a simple flat square". A pixel's place on it is the dot product of its
//! direction with the screen's axes, made perpendicular to the sun. Its disc has its real size and the radiance that follows from
//! its irradiance: `L = E / omega`, `omega = pi r^2` for so small a disc of radius r.
//!
//! # Changes versus the paper
//! There is no painted glow: the light about the sun is the sky's aureole, and on a display what a lens scatters ("glare"), as every
//! photograph of the sun has it: `L = k 10 E / theta^3` with theta in degrees, the inner part of the veil that the eye has by J. J. Vos,
//! "On the cause of disability glare and its dependence on glare angle, age and ocular pigmentation", 2003, of which a lens has a share k,
//! chosen; it is taken off by its value 25 degrees from the sun and ends there. A float target gets the light that comes from there, without it. Where a pixel is larger than the disc, the disc is drawn as
//! large as the pixel and as much dimmer, so that its light stays the same. A display, which shows no light beyond some times white, gets no more of it: so the pixels of its edge, which
//! it covers in part, are as bright as their part, and the disc is round.
//!
//! In a total eclipse the corona is around the moon's disc: a soft ring without rays.
//!
//! # Practice
//! One texture read, only inside the square; a root within 25 degrees. By day it is some 60,000 times as bright as white: what is below 65504 at every hour fits half
//! floats.

use glam::Vec3;

use crate::clear_sky::light::{Light, SUN_RADIUS_RAD};
use crate::geometry::camera::Rays;
use crate::geometry::math::smoothstep;
use crate::geometry::part::{Part, Value};
use crate::geometry::uniforms::uniforms;

/// Its part of the shader.
pub const PART: Part = Part {
    constants: &[
        ("SUN_HORIZON", Value::F32(HORIZON)),
        ("SUN_GLARE_CORE", Value::F32(GLARE_CORE)),
        ("SUN_GLARE_END", Value::F32(GLARE_END)),
        ("SUN_CORONA_END", Value::F32(CORONA_END)),
    ],
    structs: &[SunUniforms::WGSL],
    wgsl: include_str!("sun.wgsl"),
};

uniforms! {
    /// The sun's square.
    SunUniforms {
        /// The screen's right about the sun, over half the square's side.
        right: Vec3,
        /// Cosine of the angle from the sun from which on there is nothing of it; 1 and more without a sun.
        least_cosine: f32,
        /// The same as right, upwards.
        up: Vec3,
        /// Level of the texture.
        lod: f32,
        /// Radiance of the middle of the disc.
        disc: Vec3,
        /// The brightest that is shown of it.
        brightest: f32,
        /// What the lens scatters, over the inverse cube of the angle in radians.
        glare: Vec3,
        /// 1 if the corona is seen.
        has_corona: f32,
        /// Radiance that the corona's profile is multiplied by.
        corona: Vec3,
        /// Nothing.
        _pad: f32,
    }
}

/// The sun sets behind a horizon of this half width, as a sine: its own radius.
pub const HORIZON: f32 = SUN_RADIUS_RAD;

/// Mean of the disc over its middle: that of `2/5 + 3/5 mu` (A. S. Eddington, "The Internal Constitution of the Stars", 1926, section 226).
const MEAN_DISC: f32 = 0.8;

/// The least radius of the disc as it is drawn, in pixels.
const LEAST_RADIUS_PX: f32 = 1.0;

/// What a lens scatters of what an eye does.
const GLARE: f32 = 0.1;
/// The square of the angle within which it grows no more: the disc's radius.
pub const GLARE_CORE: f32 = SUN_RADIUS_RAD * SUN_RADIUS_RAD;
/// Cosine of 25 degrees from the sun, where it ends: by then it is below a thousandth of the sky there.
const GLARE_END_COSINE: f32 = 0.906_307_8;
/// Its inverse cube there, in 1 / rad^3: what is taken off it everywhere, so that it ends without an edge.
pub const GLARE_END: f32 = 12.325;

/// The brightest that a display shows of the disc, exposed: every tone curve has come to white there.
const BRIGHTEST: f32 = 12.0;
/// Beyond what a target of radiance holds.
const NO_DISPLAY: f32 = 1e9;

/// Shares of the sun's light that the moon covers between which the corona comes out: before, the rest outshines it.
const CORONA_COVERED: [f32; 2] = [0.98, 1.0];
/// The most radiance of an eclipsed disc: half floats end at 65504, and sky and glare come on top.
const MOST_ECLIPSED: f32 = 60_000.0;
/// The share of the sun's light at whose end its disc fades.
const LAST_LIGHT: f32 = 0.01;
/// The corona's radiance over the disc's mean, at r radii of the sun from its middle: `1e-6 (2.565 r^-17 + 1.425 r^-7 + 0.0532 r^-2.5)`.
///
/// S. Baumbach, "Strahlung, Ergiebigkeit und Elektronendichte der Sonnenkorona", Astronomische Nachrichten 263, 1937, as C. W. Allen, "Astrophysical
/// Quantities", has it.
const CORONA: f32 = 1e-6;
/// Where it ends, in radii of the sun.
const CORONA_REACH: f32 = 8.0;
/// What it is there: that is taken off everywhere.
pub const CORONA_END: f32 = 2.945_7e-4;

/// The sun's share of the uniforms. `texels` is the side of the texture, `pixel_rad` that of a pixel; `shown` is
/// whether it is drawn at all, `exposure` that of a display, which has a lens. A target of radiance has none.
pub fn uniforms(
    light: &Light,
    rays: &Rays,
    texels: u32,
    levels: usize,
    pixel_rad: f32,
    shown: bool,
    exposure: Option<f32>,
) -> SunUniforms {
    let lens = exposure.is_some();
    let radius = SUN_RADIUS_RAD.max(LEAST_RADIUS_PX * pixel_rad);
    // Half the texture's side is the disc's edge (see the role's channel meanings).
    let half_side = 2.0 * radius;
    let texel_rad = 2.0 * half_side / texels as f32;
    let lod = (pixel_rad / texel_rad)
        .log2()
        .clamp(0.0, levels.saturating_sub(1) as f32);
    let (right, up) = facing_axes(light.sun_direction, rays);
    let corona = smoothstep(CORONA_COVERED[0], CORONA_COVERED[1], light.eclipsed);
    // A pixel at the moon's edge is covered in part, and must not show a sun that is all behind it.
    let left = ((1.0 - light.eclipsed) / LAST_LIGHT).min(1.0);
    let disc = light.disc * (left / (radius * radius * MEAN_DISC));
    // Eyes that have got used to what an eclipse leaves see the disc brighter than half floats are.
    let most = match light.eclipsed > 0.0 {
        true => MOST_ECLIPSED,
        false => f32::INFINITY,
    };
    let is_shown = shown && light.sun_direction.y > -2.0 * SUN_RADIUS_RAD;
    // What lights the ground is the radiance of a white surface, E / pi. The horizon hides the disc itself.
    SunUniforms {
        right: right / half_side,
        least_cosine: if is_shown {
            // The corners of the square, which lie beyond the glare where pixels are large.
            let corner = (1.0 - 2.0 * half_side * half_side).max(0.0).sqrt();
            let corner = corner.min(if lens { GLARE_END_COSINE } else { 1.0 });
            let corona_rad = CORONA_REACH * SUN_RADIUS_RAD;
            corner.min(if corona > 0.0 { corona_rad.cos() } else { 1.0 })
        } else {
            2.0
        },
        up: up / half_side,
        lod,
        disc: disc * (most / disc.max_element().max(1e-6)).min(1.0),
        brightest: exposure.map_or(NO_DISPLAY, |exposure| BRIGHTEST / exposure.max(1e-6)),
        glare: light.ground_sunlight
            * (if is_shown && lens {
                glare_of_white()
            } else {
                0.0
            }),
        has_corona: f32::from(u8::from(corona > 0.0)),
        corona: light.disc * (CORONA * corona / (SUN_RADIUS_RAD * SUN_RADIUS_RAD)),
        ..Default::default()
    }
}

/// The glare of a sun that makes a white surface's radiance 1, at one radian.
fn glare_of_white() -> f32 {
    let degrees_a_radian = 1.0_f32.to_degrees();
    GLARE * 10.0 * std::f32::consts::PI / degrees_a_radian.powi(3)
}

/// Two unit vectors perpendicular to the direction of sun or moon and to each other, the first along the
/// screen's right as far as it can be.
pub(super) fn facing_axes(direction: Vec3, rays: &Rays) -> (Vec3, Vec3) {
    let flattened = |axis: Vec3| axis - direction * axis.dot(direction);
    let right = flattened(rays.right.normalize());
    // One exactly at the side of the screen leaves nothing of the right axis: take another.
    let right = if right.length_squared() > 1e-6 {
        right
    } else {
        flattened(rays.forward.normalize())
    };
    let right = right.normalize();
    (right, right.cross(direction))
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
