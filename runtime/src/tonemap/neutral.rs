//! Khronos PBR Neutral: what a display can show stays as it is, and what is too bright goes over to white along its own hue.
//!
//! # Theory
//! Khronos Group, "PBR Neutral Tone Mapper Specification", 2024. With `p` the greatest channel, up to `p = Ks` the colour stays as it is.
//! Beyond, the greatest becomes `p_n = 1 - (1 - Ks)^2 / (p + 1 - 2 Ks)`, and the colour `c p_n / p` is mixed with the white of `p_n` by
//! `g = 1 / (Kd (p - p_n) + 1)`.
//!
//! # Changes versus the specification
//! It first takes `F90 = 0.04` from every colour, for the light that a glossy surface reflects of a white room. A sky has none, and
//! would lose its night: `F90` is 0 here.
//!
//! # Practice
//! All that it does lies in the plane of the colour and of white, so a hue stays the same to the last digit: in any chromaticity diagram
//! colours move on the straight line through white. It asks for radiance that is not negative, which the caller sees to.

use glam::Vec3;

/// `Ks`: where highlights begin to be compressed, a share of white.
pub const START: f32 = 0.8;
/// `Kd`: how fast compressed colours fade.
pub const FADING: f32 = 0.15;

/// Radiance, each 0 or more, as linear colour of the display.
pub fn neutral(radiance: Vec3) -> Vec3 {
    let peak = radiance.max_element();
    if peak <= START {
        return radiance;
    }
    let shown = 1.0 - (1.0 - START) * (1.0 - START) / (peak + 1.0 - 2.0 * START);
    let kept = 1.0 / (FADING * (peak - shown) + 1.0);
    shown + kept * (radiance * (shown / peak) - shown)
}
