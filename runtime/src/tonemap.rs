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

use bytemuck::{Pod, Zeroable};

use crate::geometry::part::{Part, Value};
use crate::params::SkyParams;

/// Its part of the shader.
pub const PART: Part = Part {
    constants: &[
        ("TONE_SHOULDER", Value::F32(SHOULDER)),
        ("TONE_KNEE", Value::F32(KNEE)),
    ],
    wgsl: include_str!("tonemap.wgsl"),
};

/// The last step.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Pod, Zeroable)]
pub struct TonemapUniforms {
    /// x: exposure; y: size of the dither, 0 for none.
    pub display: [f32; 4],
}

/// `a`: how hard the shoulder is.
pub const SHOULDER: f32 = 0.5;
/// `b`: how far 1 stays below white, `(1 + a) / (1 + b + a) = 0.86`.
pub const KNEE: f32 = 0.244;

/// The last step's share of the uniforms. `step` is that of the target's encoding.
pub fn uniforms(params: &SkyParams, step: f32) -> TonemapUniforms {
    let dither = if params.dither { step } else { 0.0 };
    TonemapUniforms {
        display: [params.exposure, dither, 0.0, 0.0],
    }
}
