//! Numbers of a catalogue, each in its range.

use std::ops::RangeInclusive;

use super::error::CatalogueError;
use super::star::Star;

/// Where a star stands in a file, for errors.
#[derive(Clone, Copy)]
pub struct Place<'a> {
    pub file: &'a str,
    /// `line` or `feature`.
    pub unit: &'static str,
    /// From 1.
    pub number: usize,
}

impl Place<'_> {
    /// What is wrong there.
    pub fn wrong(&self, column: &'static str, found: &str, expected: String) -> CatalogueError {
        CatalogueError::Value {
            file: self.file.to_string(),
            place: format!("{} {}", self.unit, self.number),
            column,
            found: match found {
                "" => "nothing".to_string(),
                found => format!("\"{found}\""),
            },
            expected,
        }
    }

    /// A number in a range.
    pub fn number(
        &self,
        column: &'static str,
        text: &str,
        range: RangeInclusive<f64>,
    ) -> Result<f64, CatalogueError> {
        let text = text.trim();
        // What is no number is in no range.
        let number = text.parse().ok().filter(|number| range.contains(number));
        let expected = || format!("a number from {} to {}", range.start(), range.end());
        number.ok_or_else(|| self.wrong(column, text, expected()))
    }

    /// B-V, which need not be there.
    pub fn colour_index(
        &self,
        column: &'static str,
        text: &str,
    ) -> Result<Option<f64>, CatalogueError> {
        match text.trim() {
            "" => Ok(None),
            text => self.number(column, text, COLOUR_INDICES).map(Some),
        }
    }
}

/// The brightest star has -1.5, the sun -26.7; the faintest that were ever seen 31.
pub const MAGNITUDES: RangeInclusive<f64> = -30.0..=35.0;
const COLOUR_INDICES: RangeInclusive<f64> = -1.0..=10.0;

/// Brighter than any star but the sun.
const SUN: f64 = -20.0;

/// A star, unless it is the sun.
pub fn star(
    right_ascension_deg: f64,
    declination_deg: f64,
    magnitude: f64,
    colour_index: Option<f64>,
) -> Option<Star> {
    let star = Star {
        right_ascension_deg: right_ascension_deg.rem_euclid(360.0),
        declination_deg,
        magnitude,
        colour_index,
    };
    (magnitude > SUN).then_some(star)
}
