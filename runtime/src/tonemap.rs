//! The last step: radiance to what a display shows.
//!
//! # Theory
//! Radiance times exposure goes through a tone curve, is encoded for the target and dithered. Curves are those of
//! [`Tonemap`], a file each: [`neutral`], [`agx`], [`filmic`]. In and out are linear BT.709; the range of the display is 0..1.
//!
//! # Changes versus the paper
//! The paper writes display-referred colours. Dither is ours: half a step of noise, so that an 8-bit
//! target shows no bands. AgX has it before its last power, which is nearly the target's own: a step is a step there.
//!
//! # Practice
//! A float target gets radiance, by default as it is ([`crate::View::set_scale`]), and none of this. The curve is a branch over a uniform: all pixels of a frame take the same side, so a
//! GPU pays for the one that is used. Compiled in, a change of the curve would make every pipeline anew that draws colour.

pub mod agx;
pub mod filmic;
pub mod neutral;

use glam::Vec3;

use crate::geometry::part::{Part, Value};
use crate::geometry::uniforms::uniforms;
use crate::params::{SkyParams, Tonemap};

/// The largest half float.
const LARGEST_HALF: f32 = 65504.0;

/// Its part of the shader.
pub const PART: Part = Part {
    constants: &[
        ("LARGEST_HALF", Value::F32(LARGEST_HALF)),
        ("TONEMAP_NEUTRAL", Value::U32(Tonemap::Neutral as u32)),
        ("TONEMAP_AGX", Value::U32(Tonemap::Agx as u32)),
        ("TONEMAP_AGX_PUNCHY", Value::U32(Tonemap::AgxPunchy as u32)),
        ("TONEMAP_FILMIC", Value::U32(Tonemap::Filmic as u32)),
        ("FILMIC_SHOULDER", Value::F32(filmic::SHOULDER)),
        ("FILMIC_KNEE", Value::F32(filmic::KNEE)),
        ("NEUTRAL_START", Value::F32(neutral::START)),
        ("NEUTRAL_FADING", Value::F32(neutral::FADING)),
        ("AGX_INSET", Value::F32(agx::INSET)),
        ("AGX_WEIGHTS", Value::Vec3(agx::WEIGHTS)),
        ("AGX_STOPS", Value::F32(agx::STOPS)),
        ("AGX_X6", Value::F32(agx::SIGMOID[0])),
        ("AGX_X5", Value::F32(agx::SIGMOID[1])),
        ("AGX_X4", Value::F32(agx::SIGMOID[2])),
        ("AGX_X3", Value::F32(agx::SIGMOID[3])),
        ("AGX_X2", Value::F32(agx::SIGMOID[4])),
        ("AGX_X1", Value::F32(agx::SIGMOID[5])),
        ("AGX_X0", Value::F32(agx::SIGMOID[6])),
        ("AGX_PUNCHY_X7", Value::F32(agx::CONTRAST[0])),
        ("AGX_PUNCHY_X6", Value::F32(agx::CONTRAST[1])),
        ("AGX_PUNCHY_X5", Value::F32(agx::CONTRAST[2])),
        ("AGX_PUNCHY_X4", Value::F32(agx::CONTRAST[3])),
        ("AGX_PUNCHY_X3", Value::F32(agx::CONTRAST[4])),
        ("AGX_PUNCHY_X2", Value::F32(agx::CONTRAST[5])),
        ("AGX_POWER_X6", Value::F32(agx::DISPLAY[0])),
        ("AGX_POWER_X5", Value::F32(agx::DISPLAY[1])),
        ("AGX_POWER_X4", Value::F32(agx::DISPLAY[2])),
        ("AGX_POWER_X3", Value::F32(agx::DISPLAY[3])),
        ("AGX_POWER_X2", Value::F32(agx::DISPLAY[4])),
        ("AGX_OUTSET", Value::F32(agx::OUTSET.0)),
        ("AGX_OUTSET_WEIGHTS", Value::Vec3(agx::OUTSET.1)),
        ("AGX_PUNCHY_OUTSET", Value::F32(agx::PUNCHY_OUTSET.0)),
        ("AGX_PUNCHY_WEIGHTS", Value::Vec3(agx::PUNCHY_OUTSET.1)),
        ("AGX_BLACK", Value::F32(agx::BLACK)),
    ],
    structs: &[TonemapUniforms::WGSL],
    wgsl: concat!(
        include_str!("tonemap/neutral.wgsl"),
        include_str!("tonemap/agx.wgsl"),
        include_str!("tonemap/filmic.wgsl"),
        include_str!("tonemap.wgsl"),
    ),
};

uniforms! {
    /// The last step.
    TonemapUniforms {
        /// Factor on the radiance; of a float target that of [`crate::View::set_scale`].
        exposure: f32,
        /// Size of the dither, 0 for none.
        dither: f32,
        /// Number of the curve.
        curve: u32,
        /// Where a radiance of 1 lies between the first stop of AgX and the last, exposed.
        agx_start: f32,
    }
}

/// The last step's share of the uniforms. `step` is that of the target's encoding.
pub fn uniforms(params: &SkyParams, step: f32) -> TonemapUniforms {
    TonemapUniforms {
        exposure: params.exposure_factor(),
        dither: if params.dither { step } else { 0.0 },
        curve: params.tonemap as u32,
        agx_start: (params.exposure_factor().max(f32::MIN_POSITIVE).log2() - agx::FIRST)
            / agx::STOPS,
    }
}

/// Radiance, exposed, as linear colour of the display, each 0..1: what the shader computes before it encodes.
pub fn displayed(radiance: Vec3, tonemap: Tonemap) -> Vec3 {
    let radiance = radiance.max(Vec3::ZERO);
    let colour = match tonemap {
        Tonemap::Neutral => neutral::neutral(radiance),
        Tonemap::Agx => agx::agx(radiance),
        Tonemap::AgxPunchy => agx::punchy(radiance),
        Tonemap::Filmic => filmic::filmic(radiance),
        Tonemap::None => radiance,
    };
    colour.min(Vec3::ONE)
}

/// Linear to sRGB, IEC 61966-2-1.
pub fn srgb_encoded(linear: Vec3) -> Vec3 {
    linear.map(|linear| {
        if linear <= 0.003_130_8 {
            linear * 12.92
        } else {
            1.055 * linear.powf(1.0 / 2.4) - 0.055
        }
    })
}
