//! A star of a catalogue.

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
    /// Its light over that of a star of magnitude 0. N. Pogson, "Magnitudes of Thirty-six of the Minor Planets for the first day of each month of the year 1857", 1856.
    pub fn light(&self) -> f64 {
        libm::exp10(-0.4 * self.magnitude)
    }

    /// The temperature of a black body of its colour, in kelvin, 2000 to 30000; of a star without one, that of the sun's colour, 0.65.
    ///
    /// F. J. Ballesteros, "New insights into black bodies", EPL 97, 2012, (14).
    pub fn temperature_k(&self) -> f64 {
        // The bluest stars have -0.4; below -0.5 the formula has poles.
        let x = 0.92 * self.colour_index.unwrap_or(0.65).clamp(-0.4, 4.0);
        (4600.0 * (1.0 / (x + 1.7) + 1.0 / (x + 0.62))).clamp(2000.0, 30_000.0)
    }
}

/// The most stars that a catalogue may have: to the eleventh magnitude there are fewer than a million.
pub const MAX_STARS: usize = 1_000_000;
