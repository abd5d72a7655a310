//! The clear sky of [`crate::params::SkyModel::Gradient`]: the pack's day gradient and the light scattered around the sun.
//!
//! # Theory
//! The gradient holds radiance over elevation and time, away from the sun. Haze throws light forward:
//! two lobes `exp2(k (cos gamma - 1))` about the sun stand for its narrow and its wide part (gamma the
//! angle to the sun), a usual stand-in for the Henyey-Greenstein phase function that needs no root. In
//! twilight the light comes from below the horizon: a band along it, strongest on the sun's side.
//!
//! # Changes versus the paper
//! Roden and Parberry blend one blue gradient with the night; this one knows the time of day. Under an overcast
//! sky there is no blue left to see on the horizon either: it takes the mean colour of the clouds.
//!
//! # Practice
//! One bilinear texture read, an exponential and a square root a pixel; in twilight one exponential more.

use glam::{Vec2, Vec3};
use welkin_pack::Image;

use crate::clear_sky::light::Light;
use crate::geometry::math::smoothstep;
use crate::geometry::part::{Part, Value};
use crate::geometry::uniforms::uniforms;

/// Its part of the shader.
pub const PART: Part = Part {
    constants: &[
        ("GROUND_FLOOR", Value::F32(GROUND_FLOOR)),
        ("GROUND_FALL", Value::F32(GROUND_FALL)),
    ],
    structs: &[SkyUniforms::WGSL],
    wgsl: include_str!("gradient.wgsl"),
};

uniforms! {
    /// Clear sky.
    SkyUniforms {
        /// Unit direction towards the sun.
        sun_direction: Vec3,
        /// Weight of the night sky.
        night: f32,
        /// Radiance of the wide lobe towards the sun.
        wide: Vec3,
        /// How fast the wide lobe falls with the angle to the sun.
        wide_sharpness: f32,
        /// Radiance of the narrow lobe, the twelfth power of the wide one.
        narrow: Vec3,
        /// u of the time in the day gradient.
        time_u: f32,
        /// Radiance of the twilight band on the horizon.
        band: Vec3,
        /// How fast the band fades upwards.
        band_sharpness: f32,
        /// Radiance of an overcast sky.
        overcast: Vec3,
        /// How far the sky is overcast.
        overcast_weight: f32,
        /// v of the horizon in the day gradient.
        horizon_v: f32,
        /// What the root of the sine of the elevation is multiplied by to be added to it.
        elevation_v: f32,
        /// Nothing.
        _pad: Vec2,
    }
}

/// Radiance far below the horizon, as a share of that on the horizon.
pub const GROUND_FLOOR: f32 = 0.3;
/// How fast the haze below the horizon darkens, over the sine of the depression.
pub const GROUND_FALL: f32 = 9.0;

/// Sharpness of the wide lobe: it halves at 29 degrees from the sun. The narrow one is its twelfth power and halves at 8.
const WIDE_SHARPNESS: f32 = 8.0;
/// Radiance of the lobes towards the sun in white sunlight.
const WIDE_STRENGTH: f32 = 0.10;
const NARROW_STRENGTH: f32 = 0.30;
/// What a sun on the horizon adds to both: its light comes through more haze.
const LOW_SUN: f32 = 0.30;

/// How fast the twilight band fades over the sine of the elevation: it halves at 7 degrees.
const BAND_SHARPNESS: f32 = 8.0;
/// Colour and strength of the band at its height, with the sun just under the horizon.
const BAND: Vec3 = Vec3::new(0.55, 0.21, 0.05);

/// The clear sky's share of the uniforms.
///
/// `night` is the share of the night sky that is drawn, `overcast` the radiance of an overcast sky, `overcast_weight` how overcast it is.
pub fn uniforms(
    light: &Light,
    sky: &Image,
    time: f32,
    night: f32,
    overcast: Vec3,
    overcast_weight: f32,
) -> SkyUniforms {
    let (width, height) = (sky.width as f32, sky.height as f32);
    let sun_up = light.sun_direction.y;
    let lobes = light.sunlight * smoothstep(-0.10, 0.05, sun_up);
    let low = LOW_SUN * low_sun(light);
    let twilight = smoothstep(-0.24, 0.0, sun_up) * (1.0 - smoothstep(0.0, 0.30, sun_up));
    SkyUniforms {
        sun_direction: light.sun_direction,
        night,
        wide: lobes * (WIDE_STRENGTH + low),
        wide_sharpness: WIDE_SHARPNESS,
        narrow: lobes * (NARROW_STRENGTH + low),
        // Texel coordinates to texture coordinates: half a texel in, so that rows never wrap.
        time_u: (time - time.floor()) + 0.5 / width,
        band: BAND * twilight,
        band_sharpness: BAND_SHARPNESS,
        overcast,
        overcast_weight,
        horizon_v: 0.5 / height,
        elevation_v: (height - 1.0) / height,
        ..Default::default()
    }
}

/// 1 for a sun on the horizon or below it, 0 for one that is 20 degrees up.
pub(crate) fn low_sun(light: &Light) -> f32 {
    1.0 - smoothstep(0.0, 0.34, light.sun_direction.y)
}
