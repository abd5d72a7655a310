//! Functions that several passes share.

use glam::Vec3;

/// WGSL's smoothstep.
pub(crate) fn smoothstep(low: f32, high: f32, x: f32) -> f32 {
    let t = ((x - low) / (high - low)).clamp(0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}

/// What red, green and blue of linear BT.709 add to luminance. ITU-R BT.709-6, 2015, item 3.2.
pub const LUMINANCE: Vec3 = Vec3::new(0.2126, 0.7152, 0.0722);

/// Luminance of linear BT.709.
pub fn luminance(colour: Vec3) -> f32 {
    colour.dot(LUMINANCE)
}

/// Slope and bend of Page's approximation of the normal distribution: `share = (1 + tanh(slope z (1 + bend z^2))) / 2`, with
/// `sqrt(8 / pi) / 2` as the slope. E. Page, "Approximations to the Cumulative Normal Function and its Inverse for Use on a Pocket
/// Calculator", Applied Statistics 26(1), 1977. Its error is below 0.0002.
pub const NORMAL_SLOPE: f32 = 0.797_884_6;
/// See [`NORMAL_SLOPE`].
pub const NORMAL_BEND: f32 = 0.044_715;

/// The share of a normal distribution below z, by Page's approximation.
#[cfg(any(feature = "fbm", feature = "lit"))]
pub(crate) fn normal_share(z: f32) -> f32 {
    0.5 + 0.5 * (NORMAL_SLOPE * z * (1.0 + NORMAL_BEND * z * z)).tanh()
}

/// A hash of 64 bits: the finaliser of SplitMix64. G. L. Steele, D. Lea, C. H. Flood, "Fast Splittable Pseudorandom Number
/// Generators", OOPSLA 2014.
pub(crate) fn mix(value: u64) -> u64 {
    let z = value.wrapping_add(0x9E37_79B9_7F4A_7C15);
    let z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
    let z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
    z ^ (z >> 31)
}

/// Seconds that are not finite are 0.
pub(crate) fn finite(seconds: f64) -> f64 {
    if seconds.is_finite() { seconds } else { 0.0 }
}
