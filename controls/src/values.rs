//! Numbers from text: one function a kind of value.
//!
//! # Errors
//! Every error is what was expected, beginning with that word and with the range.
#![allow(clippy::missing_errors_doc)]

use std::ops::RangeInclusive;
use std::str::FromStr;

use welkin_runtime::SkyParams;
use welkin_runtime::internals::clear_sky::cie;
use welkin_runtime::params::{CUSTOM, TURBIDITY};
use welkin_runtime::params::{FORMATION_INTERVAL_S, MAX_OCTAVES};

/// Farther than this from the origin, clouds that are kilometres high say nothing of the place any more.
const PLACE_RANGE_M: f64 = 1e6;

/// The last second: 31 years are longer than any animation, and still exact to a microsecond in 64 bits.
pub(crate) const LAST_SECOND: f64 = 1e9;

/// A number from 0 to 1.
pub fn unit(text: &str) -> Result<f32, String> {
    within(text, 0.0..=1.0, "").map(|v| v as f32)
}

/// An azimuth in degrees.
pub fn azimuth_deg(text: &str) -> Result<f32, String> {
    within(text, -360.0..=360.0, " degrees").map(|v| v as f32)
}

/// An elevation in degrees.
pub fn elevation_deg(text: &str) -> Result<f32, String> {
    within(text, -90.0..=90.0, " degrees").map(|v| v as f32)
}

/// A field of view in degrees.
pub fn fov_deg(text: &str) -> Result<f32, String> {
    within(text, 1.0..=150.0, " degrees").map(|v| v as f32)
}

/// A place along an axis, in metres.
pub fn place_m(text: &str) -> Result<f32, String> {
    within(text, -PLACE_RANGE_M..=PLACE_RANGE_M, " metres").map(|v| v as f32)
}

/// A place along an axis, in kilometres.
pub fn place_km(text: &str) -> Result<f32, String> {
    let range_km = PLACE_RANGE_M as f32 / 1e3;
    within(text, -range_km..=range_km, " kilometres")
}

/// A side of the ground in metres. The sky takes 0 for no shadow at all, and on less than a metre there is nothing to see.
pub fn shadow_extent_m(text: &str) -> Result<f32, String> {
    within(text, 1.0..=1e6, " metres")
}

/// Eighths of the sky.
pub fn oktas(text: &str) -> Result<f32, String> {
    within(text, 0.0..=8.0, " oktas").map(|v| v as f32)
}

/// A moment in seconds.
pub fn seconds(text: &str) -> Result<f64, String> {
    within(text, 0.0..=LAST_SECOND, " seconds")
}

/// Seconds in which clouds form, in single precision, as the sky takes it: so the ends of the range belong to it.
pub fn formation_interval_s(text: &str) -> Result<f32, String> {
    let [low, high] = FORMATION_INTERVAL_S;
    within(text, low..=high, " seconds")
}

/// A number that the sky takes where `set` puts it: the sky's own check tells the range.
pub fn of_sky<T: FromStr + From<f32> + Copy>(
    text: &str,
    set: impl FnOnce(&mut SkyParams, T),
    unit: &str,
) -> Result<T, String> {
    // What is no number is in no range.
    let value = text.parse().unwrap_or_else(|_| f32::NAN.into());
    let mut sky = SkyParams::default();
    set(&mut sky, value);
    match sky.check() {
        Ok(()) => Ok(value),
        Err(error) => Err(format!("expected {}{unit}", error.expected)),
    }
}

/// A number of octaves.
pub fn octaves(text: &str) -> Result<u32, String> {
    match text.parse() {
        Ok(count) if (1..=MAX_OCTAVES).contains(&count) => Ok(count),
        _ => Err(format!("expected a whole number from 1 to {MAX_OCTAVES}")),
    }
}

/// Haze of the air, in single precision, as the formation interval.
pub fn turbidity(text: &str) -> Result<f32, String> {
    let [low, high] = TURBIDITY;
    within(text, low..=high, "")
}

/// The number of a standard sky of ISO 15469.
pub fn cie_type(text: &str) -> Result<u8, String> {
    let last = cie::SKIES.len() as u8;
    match text.parse() {
        Ok(number) if (1..=last).contains(&number) => Ok(number),
        _ => Err(format!("expected a whole number from 1 to {last}")),
    }
}

/// Five numbers between commas, each in its range.
pub fn perez(text: &str) -> Result<[f32; 5], String> {
    between_commas(text, CUSTOM).ok_or_else(|| format!("expected five numbers: {}", perez_ranges()))
}

/// The ranges of [`perez`] in words.
pub fn perez_ranges() -> String {
    CUSTOM
        .map(|[low, high]| format!("{low} to {high}"))
        .join(", ")
}

/// Three numbers from 0 to 1, between commas.
pub fn three_units(text: &str) -> Result<[f32; 3], String> {
    between_commas(text, [[0.0, 1.0]; 3])
        .map(|numbers| numbers.map(|v: f64| v as f32))
        .ok_or_else(|| "expected three numbers from 0 to 1, such as 0.2,0.5,1".to_string())
}

/// Numbers between commas, each from the first to the second number of its range.
fn between_commas<T: FromStr + PartialOrd, const N: usize>(
    text: &str,
    ranges: [[T; 2]; N],
) -> Option<[T; N]> {
    let parts = text.split(',').map(|part| part.trim().parse().ok());
    let numbers: [T; N] = parts.collect::<Option<Vec<T>>>()?.try_into().ok()?;
    let inside = |(number, [low, high]): (&T, &[T; 2])| (low..=high).contains(&number);
    numbers.iter().zip(&ranges).all(inside).then_some(numbers)
}

/// A number in a range.
pub fn within<T: FromStr + PartialOrd + std::fmt::Display>(
    text: &str,
    range: RangeInclusive<T>,
    unit: &str,
) -> Result<T, String> {
    match text.parse() {
        // Not a number is in no range.
        Ok(value) if range.contains(&value) => Ok(value),
        _ => Err(format!(
            "expected a number from {} to {}{unit}",
            range.start(),
            range.end()
        )),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_ends_of_a_range_belong_to_it() {
        assert_eq!([unit("0"), unit("1")], [Ok(0.0), Ok(1.0)]);
        assert_eq!(
            [formation_interval_s("0.1"), formation_interval_s("86400")],
            FORMATION_INTERVAL_S.map(Ok)
        );
        assert_eq!([octaves("1"), octaves("8")], [Ok(1), Ok(MAX_OCTAVES)]);
        assert_eq!([place_m("-1e6"), place_m("1e6")], [Ok(-1e6), Ok(1e6)]);
    }

    #[test]
    fn three_numbers_stand_between_commas() {
        assert_eq!(three_units("0,0.5,1"), Ok([0.0, 0.5, 1.0]));
        assert_eq!(three_units("0.1, 0.2, 0.3"), Ok([0.1, 0.2, 0.3]));
    }
}
