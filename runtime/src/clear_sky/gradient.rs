//! The clear sky of [`crate::SkyModel::Gradient`]: the pack's day gradient and the light scattered around the sun.
//!
//! # Theory
//! The gradient holds radiance over elevation and time, away from the sun. Haze throws light forward:
//! two lobes `exp2(k (cos gamma - 1))` about the sun stand for its narrow and its wide part (gamma the
//! angle to the sun), a usual stand-in for the Henyey-Greenstein phase function that needs no root. In
//! twilight the light comes from below the horizon: a band along it, strongest on the sun's side.
//!
//! # Changes versus the paper
//! Roden and Parberry blend one blue gradient with the night; this one knows the time of day. Under a shut
//! sky there is no blue left to see on the horizon either: it takes the mean colour of the clouds.
//!
//! # Practice
//! One bilinear texture read, an exponential and a square root a pixel; in twilight one exponential more.

use bytemuck::{Pod, Zeroable};
use glam::Vec3;
use welkin_pack::Image;

use crate::clear_sky::light::Light;
use crate::geometry::math::{smoothstep, vec4};
use crate::geometry::part::{Part, Value};

/// Its part of the shader.
pub const PART: Part = Part {
    constants: &[
        ("GROUND_FLOOR", Value::F32(GROUND_FLOOR)),
        ("GROUND_FALL", Value::F32(GROUND_FALL)),
    ],
    wgsl: include_str!("gradient.wgsl"),
};

/// Clear sky.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Pod, Zeroable)]
pub struct SkyUniforms {
    /// x: u of the time; y, z: `v = y + z * sqrt(sin elevation)`; w: share of the night sky.
    pub gradient: [f32; 4],
    /// xyz: unit direction towards the sun.
    pub sun: [f32; 4],
    /// rgb: radiance of the wide lobe towards the sun; w: its sharpness.
    pub wide: [f32; 4],
    /// rgb: radiance of the narrow lobe, the twelfth power of the wide one.
    pub narrow: [f32; 4],
    /// rgb: radiance of the twilight band on the horizon; w: how fast it fades upwards.
    pub band: [f32; 4],
    /// rgb: radiance of a shut sky; w: how far the sky is shut.
    pub overcast: [f32; 4],
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
/// `night` is the share of the night sky that is drawn, `overcast` the radiance of a shut sky and how far it is shut.
pub fn uniforms(
    light: &Light,
    sky: &Image,
    time: f32,
    night: f32,
    overcast: [f32; 4],
) -> SkyUniforms {
    let (width, height) = (sky.width as f32, sky.height as f32);
    // Texel coordinates to texture coordinates: half a texel in, so that rows never wrap.
    let u = (time - time.floor()) + 0.5 / width;
    let sun_up = light.sun_direction.y;
    let lobes = light.sunlight * smoothstep(-0.10, 0.05, sun_up);
    let low = LOW_SUN * low_sun(light);
    let twilight = smoothstep(-0.24, 0.0, sun_up) * (1.0 - smoothstep(0.0, 0.30, sun_up));
    SkyUniforms {
        gradient: [u, 0.5 / height, (height - 1.0) / height, night],
        sun: vec4(light.sun_direction, 0.0),
        wide: vec4(lobes * (WIDE_STRENGTH + low), WIDE_SHARPNESS),
        narrow: vec4(lobes * (NARROW_STRENGTH + low), 0.0),
        band: vec4(BAND * twilight, BAND_SHARPNESS),
        overcast,
    }
}

/// 1 for a sun on the horizon or below it, 0 for one that is 20 degrees up.
pub(crate) fn low_sun(light: &Light) -> f32 {
    1.0 - smoothstep(0.0, 0.34, light.sun_direction.y)
}
