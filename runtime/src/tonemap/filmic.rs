//! Hable's filmic curve without a toe: the curve of every Welkin so far.
//!
//! # Theory
//! J. Hable, "Uncharted 2: HDR Lighting", GDC 2010: `y = (x (A x + C B) + D E) / (x (A x + B) + D F) - E / F`, for each channel by itself.
//!
//! # Changes versus the talk
//! `E` is 0, so that there is no toe; `C B` and `D F` are 1. What is left is `y = (x + A x^2) / (1 + B x + A x^2)`: slope 1 in the dark, so
//! that colours of the sky keep their saturation; 0.86 (sRGB 0.93) at 1, the white of a sunlit cloud. Instead of a division by the
//! curve's value at a white point it is cut off at 1, which it meets at `x = 1 / (1 - B)`.
//!
//! # Practice
//! The cheapest after none. As each channel is bent by itself, bright blues go towards cyan, and bright oranges towards yellow.

use glam::Vec3;

/// `A`: how hard the shoulder is.
pub const SHOULDER: f32 = 0.5;
/// `B`: how far 1 stays below white, `(1 + A) / (1 + B + A) = 0.86`.
pub const KNEE: f32 = 0.244;

/// Radiance, each 0 or more, as linear colour of the display. It goes on above 1.
pub fn filmic(radiance: Vec3) -> Vec3 {
    let shoulder = radiance * radiance * SHOULDER;
    (radiance + shoulder) / (1.0 + radiance * KNEE + shoulder)
}
