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

use crate::uniforms::TonemapUniforms;
use crate::{SkyParams, shader::Output};

/// `a`: how hard the shoulder is.
pub const SHOULDER: f32 = 0.5;
/// `b`: how far 1 stays below white, `(1 + a) / (1 + b + a) = 0.86`.
pub const KNEE: f32 = 0.244;

/// What a target wants to be given, if it can show a sky at all.
pub fn output(format: wgpu::TextureFormat) -> Option<Output> {
    use wgpu::TextureFormat as F;
    match format {
        F::Rgba16Float | F::Rgba32Float | F::Rg11b10Ufloat => Some(Output::Radiance),
        F::Rgba8UnormSrgb | F::Bgra8UnormSrgb => Some(Output::Display),
        F::Rgba8Unorm | F::Bgra8Unorm | F::Rgb10a2Unorm | F::Rgba16Unorm => Some(Output::Encoded),
        _ => None,
    }
}

/// One step of the target's encoding.
pub fn step(format: wgpu::TextureFormat) -> f32 {
    match format {
        wgpu::TextureFormat::Rgb10a2Unorm => 1.0 / 1023.0,
        wgpu::TextureFormat::Rgba16Unorm => 1.0 / 65535.0,
        _ => 1.0 / 255.0,
    }
}

/// The last step's share of the uniforms. `step` is that of the target's encoding.
pub fn uniforms(params: &SkyParams, step: f32) -> TonemapUniforms {
    let dither = if params.dither { step } else { 0.0 };
    TonemapUniforms {
        display: [params.exposure, dither, 0.0, 0.0],
    }
}
