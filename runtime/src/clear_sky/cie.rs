//! The fifteen standard skies: how the luminance of overcast, partly cloudy and clear skies is distributed.
//!
//! CIE S 011/E:2003 (ISO 15469:2004), "Spatial distribution of daylight, CIE standard general sky". The standard tells
//! luminance relative to the zenith, by the equation of [`crate::clear_sky::perez`] with an indicatrix that is 1 at a right angle
//! to the sun; it tells no colour.

use crate::params::STANDARD_SKIES;

/// A sky of the standard.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StandardSky {
    /// As the standard describes it.
    pub name: &'static str,
    /// a, b, c, d, e.
    pub numbers: [f32; 5],
}

const fn sky(name: &'static str, numbers: [f32; 5]) -> StandardSky {
    StandardSky { name, numbers }
}

/// Type 1 to 15 of CIE S 011/E:2003 (ISO 15469:2004), table 1.
pub const SKIES: [StandardSky; STANDARD_SKIES as usize] = [
    sky(
        "CIE Standard Overcast Sky, steep luminance gradation towards zenith, azimuthal uniformity",
        [4.0, -0.70, 0.0, -1.0, 0.0],
    ),
    sky(
        "Overcast, with steep luminance gradation and slight brightening towards the sun",
        [4.0, -0.70, 2.0, -1.5, 0.15],
    ),
    sky(
        "Overcast, moderately graded with azimuthal uniformity",
        [1.1, -0.8, 0.0, -1.0, 0.0],
    ),
    sky(
        "Overcast, moderately graded and slight brightening towards the sun",
        [1.1, -0.8, 2.0, -1.5, 0.15],
    ),
    sky("Sky of uniform luminance", [0.0, -1.0, 0.0, -1.0, 0.0]),
    sky(
        "Partly cloudy sky, no gradation towards zenith, slight brightening towards the sun",
        [0.0, -1.0, 2.0, -1.5, 0.15],
    ),
    sky(
        "Partly cloudy sky, no gradation towards zenith, brighter circumsolar region",
        [0.0, -1.0, 5.0, -2.5, 0.30],
    ),
    sky(
        "Partly cloudy sky, no gradation towards zenith, distinct solar corona",
        [0.0, -1.0, 10.0, -3.0, 0.45],
    ),
    sky(
        "Partly cloudy, with the obscured sun",
        [-1.0, -0.55, 2.0, -1.5, 0.15],
    ),
    sky(
        "Partly cloudy, with brighter circumsolar region",
        [-1.0, -0.55, 5.0, -2.5, 0.30],
    ),
    sky(
        "White-blue sky with distinct solar corona",
        [-1.0, -0.55, 10.0, -3.0, 0.45],
    ),
    sky(
        "CIE Standard Clear Sky, low illuminance turbidity",
        [-1.0, -0.32, 10.0, -3.0, 0.45],
    ),
    sky(
        "CIE Standard Clear Sky, polluted atmosphere",
        [-1.0, -0.32, 16.0, -3.0, 0.30],
    ),
    sky(
        "Cloudless turbid sky with broad solar corona",
        [-1.0, -0.15, 16.0, -3.0, 0.30],
    ),
    sky(
        "White-blue turbid sky with broad solar corona",
        [-1.0, -0.15, 24.0, -2.8, 0.15],
    ),
];

pub use crate::params::LAST_OVERCAST;
