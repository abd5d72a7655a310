//! The last step: radiance to what a display shows.
//!
//! # Theory
//! The curve is a ratio of quadratics, `y = (x + a x^2) / (1 + b x + a x^2)`, for each channel: slope 1 in
//! the dark, so that colours of the sky keep their saturation; 0.86 (sRGB 0.93) at 1, the white of a sunlit
//! cloud; cut off at 1, which it meets at `x = 1 / b`.
//!
//! # Changes versus the paper
//! The paper writes display-referred colours. Dither is ours: half a step of noise, so that an 8-bit
//! target shows no bands.
//!
//! # Practice
//! A float target gets raw radiance, and none of this.

use glam::Vec2;

use crate::geometry::part::{Part, Value};
use crate::geometry::uniforms::uniforms;
use crate::params::SkyParams;

/// Its part of the shader.
pub const PART: Part = Part {
    constants: &[
        ("TONE_SHOULDER", Value::F32(SHOULDER)),
        ("TONE_KNEE", Value::F32(KNEE)),
    ],
    structs: &[TonemapUniforms::WGSL],
    wgsl: include_str!("tonemap.wgsl"),
};

uniforms! {
    /// The last step.
    TonemapUniforms {
        /// Factor on the radiance.
        exposure: f32,
        /// Size of the dither, 0 for none.
        dither: f32,
        /// Nothing.
        _pad: Vec2,
    }
}

/// `a`: how hard the shoulder is.
pub const SHOULDER: f32 = 0.5;
/// `b`: how far 1 stays below white, `(1 + a) / (1 + b + a) = 0.86`.
pub const KNEE: f32 = 0.244;

/// The last step's share of the uniforms. `step` is that of the target's encoding.
pub fn uniforms(params: &SkyParams, step: f32) -> TonemapUniforms {
    TonemapUniforms {
        exposure: params.exposure,
        dither: if params.dither { step } else { 0.0 },
        ..Default::default()
    }
}
