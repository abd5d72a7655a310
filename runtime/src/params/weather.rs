//! Weather that any method can have: rays, rain, lightning.

/// Weather over the clouds of any method; all of it off by default.
///
/// Rays and streaks of rain want a target that can be blended with, which 32-bit floats mostly cannot: on such a one they are left out. What
/// draws weather is made when a frame first has it, or a flash is told; an application that must not wait then prepares a frame with them while it loads.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(default))]
pub struct WeatherParams {
    /// Strength of crepuscular rays, 0 (off) to 1. See [`crate::weather::rays`].
    pub rays: f32,
    /// Strength of rain, 0 (off) to 1. See [`crate::weather::rain`].
    pub rain: f32,
    /// A flash inside the clouds. See [`crate::weather::lightning`].
    pub lightning: Lightning,
}

/// A flash of lightning at a given time and place.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(default))]
pub struct Lightning {
    /// Its brightness, 0 (off) to 1.
    pub strength: f32,
    /// The second at which it begins, as [`crate::Sky::prepare`] counts them, -1e9..=1e9.
    pub start_s: f64,
    /// Metres to the east and to the south of the world's origin, -1e6..=1e6.
    pub place_m: [f32; 2],
}

/// The least and the largest [`Lightning::strength`].
pub const FLASH_STRENGTH: [f32; 2] = [0.0, 1.0];

/// The least and the largest [`Lightning::place_m`], along each axis.
pub const FLASH_PLACE_M: [f32; 2] = [-1e6, 1e6];

/// The least and the largest [`Lightning::start_s`]: beyond them, 64 bits do not tell microseconds any more.
pub const FLASH_START_S: [f64; 2] = [-1e9, 1e9];
