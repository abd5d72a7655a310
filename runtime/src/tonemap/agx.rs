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
//! Powers are polynomials, since a GPU has few of its slow functions at once: of them the logarithm alone is left. [`CONTRAST`], the sigmoid with the
//! look's power, is off by 0.22 of a byte at most, [`DISPLAY`] by 0.15, and both with the look's saturation between them by 0.6. Saturation and the inverse of the inset are one matrix: a factor on the channel itself, and the same weighted grey for all.
//!
//! # Practice
//! Blue does not turn violet as it fades: colours turn towards cyan by as much as the eye turns them towards violet. Without a look a sky
//! is paler than with the other curves, and a sunset soft; the look is about what a camera's own processing makes of them.

use glam::Vec3;

use crate::geometry::math::LUMINANCE;

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
/// What is added before the logarithm, as none is known of 0: black at every exposure.
pub const BLACK: f32 = 1e-30;

/// The power that AgX encodes with.
pub const GAMMA: f32 = 2.2;
/// It as `x^2` times a polynomial, from the fourth power down to the constant: the least greatest error of the encoded colour.
pub const DISPLAY: [f32; 5] = [
    -0.924_013_3,
    2.569_847_8,
    -2.738_732_3,
    1.598_779_6,
    0.492_827_83,
];

/// Wrensch's look "Punchy": the power that his encoded colours are raised to.
pub const PUNCHY_POWER: f32 = 1.35;
/// The sigmoid raised to it, as `x^2` times a polynomial, from the fifth power down to the constant: the least greatest error.
pub const CONTRAST: [f32; 6] = [
    21.237_953,
    -49.660_62,
    30.538_71,
    1.286_269,
    -2.918_155_7,
    0.522_128_6,
];
/// How far it takes them from their luminance.
pub const PUNCHY_SATURATION: f32 = 1.4;

/// What takes encoded colours to the display's: the factor on a channel itself, and the weights of the grey that is added to each.
pub const OUTSET: (f32, Vec3) = outset(1.0);
/// The same with the look's saturation before it.
pub const PUNCHY_OUTSET: (f32, Vec3) = outset(PUNCHY_SATURATION);

const fn outset(saturation: f32) -> (f32, Vec3) {
    // s c + (1 - s) l, then (x - i w) / (1 - i), with the luminance l of c and the weighted grey w of x.
    let own = saturation / (1.0 - INSET);
    let mut weights = [0.0; 3];
    let mut i = 0;
    while i < 3 {
        let flat = (1.0 - saturation) * LUMINANCE.to_array()[i];
        weights[i] = flat - own * INSET * WEIGHTS.to_array()[i];
        i += 1;
    }
    (own, Vec3::from_array(weights))
}

/// Radiance, each 0 or more, as linear colour of the display.
pub fn agx(radiance: Vec3) -> Vec3 {
    display(shares(radiance).map(|x| sigmoid(x).max(0.0)), OUTSET)
}

/// The same with more contrast and more colour.
pub fn punchy(radiance: Vec3) -> Vec3 {
    display(shares(radiance).map(contrast), PUNCHY_OUTSET)
}

/// Where inset radiance lies between the first stop and the last, each 0..1.
fn shares(radiance: Vec3) -> Vec3 {
    let inset = (1.0 - INSET) * radiance + (radiance.dot(INSET * WEIGHTS) + BLACK);
    let stops = inset.map(f32::log2);
    ((stops - FIRST) / STOPS).clamp(Vec3::ZERO, Vec3::ONE)
}

/// Undoes inset and power.
fn display(encoded: Vec3, (own, weights): (f32, Vec3)) -> Vec3 {
    let shown = own * encoded + encoded.dot(weights);
    shown.clamp(Vec3::ZERO, Vec3::ONE).map(powered)
}

/// The sigmoid with the look's power, of the share of the stops.
pub fn contrast(share: f32) -> f32 {
    share * share * polynomial(&CONTRAST, share)
}

/// An encoded colour, 0..1, to the power of [`GAMMA`].
pub fn powered(shown: f32) -> f32 {
    shown * shown * polynomial(&DISPLAY, shown)
}

/// The sigmoid of the share of the stops, 0..1.
pub fn sigmoid(share: f32) -> f32 {
    polynomial(&SIGMOID, share)
}

/// From the highest power down.
fn polynomial(factors: &[f32], x: f32) -> f32 {
    factors.iter().fold(0.0, |sum, factor| sum * x + factor)
}
