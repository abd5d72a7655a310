//! A star of a catalogue.

use welkin_pack::starlight::{light_of_magnitude, temperature_k};

/// A star of a catalogue, in the equatorial coordinates of J2000.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Star {
    /// Right ascension in degrees, 0 to 360.
    pub right_ascension_deg: f64,
    /// Declination in degrees, -90 to 90.
    pub declination_deg: f64,
    /// Visual magnitude.
    pub magnitude: f64,
    /// B-V, if the catalogue tells it.
    pub colour_index: Option<f64>,
}

impl Star {
    /// Its light over that of a star of magnitude 0.
    pub fn light(&self) -> f64 {
        light_of_magnitude(self.magnitude)
    }

    /// Its B-V; of a star without one, that of the sun, 0.65.
    pub fn shown_colour_index(&self) -> f64 {
        self.colour_index.unwrap_or(0.65)
    }

    /// The temperature of a black body of its colour, in kelvin, 2000 to 30000.
    pub fn temperature_k(&self) -> f64 {
        // The bluest stars have -0.4.
        temperature_k(self.shown_colour_index().clamp(-0.4, 4.0)).clamp(2000.0, 30_000.0)
    }
}

/// The most stars that a catalogue may have: to the eleventh magnitude there are fewer than a million.
pub const MAX_STARS: usize = 1_000_000;
