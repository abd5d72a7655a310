//! AgX: sixteen and a half stops on a soft curve, with colours that fade as they grow bright.
//!
//! # Theory
//! T. Sobotka, AgX, 2022 (an OpenColorIO configuration): BT.709 is inset, so that no colour is of one channel alone; the logarithm of each
//! channel from 10 stops below middle grey to 6.5 above goes through a sigmoid; the inset is undone. B. Wrensch, "Minimal AgX
//! Implementation", 2023, gives the matrices as numbers and the sigmoid as a polynomial of degree 6, with a mean squared error of 3.67e-6.
//!
//! # Changes versus the publications
//! The inset matrix takes every colour a fifth of the way to a weighted grey, but for its last digits. It is written so, with the
//! weights rounded to sum to 1: greys stay grey exactly, its inverse is exact, and matrices are one dot product each. The polynomial
//! is his with more digits: those that he prints have twice the error. Below a share of 0.02, where it is negative, it is cut off at 0. The
//! pure power of 2.2 that ends AgX's own display encoding is undone, as the target has sRGB's.
//!
//! Of Wrensch's looks there is one, [`punchy`]: its power makes middle grey 0.8 stops darker than AgX alone, which exposure has to make up for.
//!
//! # Practice
//! Blue does not turn violet as it fades: colours turn towards cyan by as much as the eye turns them towards violet. Without a look a sky
//! is paler than with the other curves, and a sunset soft; the look is about what a camera's own processing makes of them.

use glam::Vec3;

use crate::geometry::math::luminance;

/// How far colours go to the grey of [`WEIGHTS`].
pub const INSET: f32 = 0.2;
/// Shares of red, green and blue in that grey: elements of Wrensch's matrix beside its diagonal over [`INSET`].
pub const WEIGHTS: Vec3 = Vec3::new(0.2118, 0.3922, 0.396);
/// The first stop of the curve, as a logarithm to the base 2: 10 below a middle grey of 0.18.
pub const FIRST: f32 = -12.473_931;
/// From the first stop to the last, 6.5 above middle grey.
pub const STOPS: f32 = 16.5;
/// The sigmoid, from the sixth power down to the constant: least squares over 4096 shares of Sobotka's.
pub const SIGMOID: [f32; 7] = [
    15.500_181,
    -40.142_227,
    31.967_827,
    -6.867_842_7,
    0.429_202_38,
    0.119_226_1,
    -0.002_330_625,
];
/// The power that AgX encodes with.
pub const GAMMA: f32 = 2.2;
/// What logarithms and powers are taken of at least: black, as neither is known of 0.
pub const BLACK: f32 = 1e-8;

/// Wrensch's look "Punchy": the power that his encoded colours are raised to.
pub const PUNCHY_POWER: f32 = 1.35;
/// How far it takes them from their luminance.
pub const PUNCHY_SATURATION: f32 = 1.4;

/// Radiance, each 0 or more, as linear colour of the display. It may be below 0 or above 1 by a little.
pub fn agx(radiance: Vec3) -> Vec3 {
    display(encoded(radiance))
}

/// The same with more contrast and more colour.
pub fn punchy(radiance: Vec3) -> Vec3 {
    let powered = |x: f32| x.max(BLACK).powf(PUNCHY_POWER);
    let contrasted = encoded(radiance).map(powered);
    let grey = Vec3::splat(luminance(contrasted));
    display(grey + (contrasted - grey) * PUNCHY_SATURATION)
}

/// What the sigmoid makes of inset radiance.
fn encoded(radiance: Vec3) -> Vec3 {
    let inset = radiance + (radiance.dot(WEIGHTS) - radiance) * INSET;
    let stops = inset.max(Vec3::splat(BLACK)).map(f32::log2);
    let share = ((stops - FIRST) / STOPS).clamp(Vec3::ZERO, Vec3::ONE);
    share.map(|x| sigmoid(x).max(0.0))
}

/// Undoes inset and power.
fn display(shown: Vec3) -> Vec3 {
    let outset = (shown - INSET * shown.dot(WEIGHTS)) / (1.0 - INSET);
    outset.max(Vec3::splat(BLACK)).map(|x| x.powf(GAMMA))
}

/// The sigmoid of the share of the stops, 0..1.
pub fn sigmoid(share: f32) -> f32 {
    SIGMOID.iter().fold(0.0, |sum, factor| sum * share + factor)
}
