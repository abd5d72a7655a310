//! Khronos PBR Neutral: what a display can show stays as it is, and what is too bright goes over to white along its own hue.
//!
//! # Theory
//! Khronos Group, "PBR Neutral Tone Mapper Specification", 2024. With `x` the least channel, `f = x - x^2 / (4 F90)` up to `x = 2 F90`, and
//! `F90` from there on; `p` the greatest channel less `f`. Up to `p = Ks` the colour is `c - f`. Beyond, the greatest becomes
//! `p_n = 1 - (1 - Ks)^2 / (p + 1 - 2 Ks)`, and the colour `(c - f) p_n / p` is mixed with the white of `p_n` by `g = 1 / (Kd (p - p_n) + 1)`.
//!
//! # Changes versus the specification
//! None. It asks for radiance that is not negative, which the caller sees to.
//!
//! # Practice
//! All that it does lies in the plane of the colour and of white, so a hue stays the same to the last digit: in any chromaticity diagram
//! colours move on the straight line through white. The `f` stands for the light that a glossy surface reflects of a white room; a sky
//! has none, and is darker by up to 0.04, more saturated for it, and dark by night.

use glam::Vec3;

/// `F90` of the specification, a share of white: reflection at normal incidence of what has a refractive index of 1.5.
pub const REFLECTED: f32 = 0.04;
/// `Ks`: where highlights begin to be compressed, a share of white.
pub const START: f32 = 0.8 - REFLECTED;
/// `Kd`: how fast compressed colours fade.
pub const FADING: f32 = 0.15;

/// Radiance, each 0 or more, as linear colour of the display.
pub fn neutral(radiance: Vec3) -> Vec3 {
    let least = radiance.min_element();
    let offset = if least <= 2.0 * REFLECTED {
        least - least * least / (4.0 * REFLECTED)
    } else {
        REFLECTED
    };
    let colour = radiance - offset;
    let peak = colour.max_element();
    if peak <= START {
        return colour;
    }
    let shown = 1.0 - (1.0 - START) * (1.0 - START) / (peak + 1.0 - 2.0 * START);
    let kept = 1.0 / (FADING * (peak - shown) + 1.0);
    shown + kept * (colour * (shown / peak) - shown)
}
