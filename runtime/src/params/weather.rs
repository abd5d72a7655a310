//! Weather that any method can have: rays, rain, lightning.

use super::range::{ParamError, Ranged};

/// Weather over the clouds of any method; all of it off by default.
///
/// Rays and streaks of rain want a target that can be blended with, which 32-bit floats mostly cannot: on such a one they are left out. What
/// draws weather is made when a frame first has it, or a flash is told; an application that must not wait then prepares a frame with them while it loads.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
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
pub struct Lightning {
    /// Its brightness, 0 (off) to 1.
    pub strength: f32,
    /// The second at which it begins, as [`crate::Sky::prepare`] counts them, -1e9..=1e9.
    pub start_s: f64,
    /// Metres to the east and to the south of the world's origin, -1e6..=1e6.
    pub place_m: [f32; 2],
}

/// Every number that has a range.
pub(super) fn numbers(weather: &mut WeatherParams) -> [Ranged<'_>; 5] {
    const UNIT: [f32; 2] = [0.0, 1.0];
    const PLACE_M: [f32; 2] = [-1e6, 1e6];
    let Lightning {
        strength,
        place_m: [east, south],
        ..
    } = &mut weather.lightning;
    [
        ("weather.rays", &mut weather.rays, 0.0, UNIT),
        ("weather.rain", &mut weather.rain, 0.0, UNIT),
        ("weather.lightning.strength", strength, 0.0, UNIT),
        ("weather.lightning.place_m[0]", east, 0.0, PLACE_M),
        ("weather.lightning.place_m[1]", south, 0.0, PLACE_M),
    ]
}

/// What [`Lightning::start_s`] may be: beyond it, 64 bits do not tell microseconds any more.
const START_S: std::ops::RangeInclusive<f64> = -1e9..=1e9;

/// The start of a flash in its range.
pub(super) fn clamped_start(seconds: f64) -> f64 {
    if seconds.is_nan() {
        return 0.0;
    }
    seconds.clamp(*START_S.start(), *START_S.end())
}

/// Tells a start of a flash that is out of its range.
pub(super) fn check_start(seconds: f64) -> Result<(), ParamError> {
    if START_S.contains(&seconds) {
        return Ok(());
    }
    Err(ParamError {
        key: "weather.lightning.start_s",
        found: seconds.to_string(),
        expected: format!("a number from {} to {}", START_S.start(), START_S.end()),
    })
}
