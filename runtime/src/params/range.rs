//! Numbers in a range, and their text.

use std::fmt::Display;
use std::ops::RangeInclusive;
use std::str::FromStr;

/// A parameter out of its range.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("{key} is {found}, expected {expected}")]
pub struct ParamError {
    /// Name of the parameter, such as `octaves.formation_interval_s`.
    pub key: &'static str,
    /// As it is.
    pub found: String,
    /// As it should be.
    pub expected: String,
}

impl ParamError {
    /// An error if the value is not in the range; what is not a number is in no range.
    pub(super) fn unless<T: PartialOrd + Display>(
        key: &'static str,
        value: T,
        range: RangeInclusive<T>,
    ) -> Result<(), ParamError> {
        if range.contains(&value) {
            return Ok(());
        }
        let expected = format!("a number from {} to {}", range.start(), range.end());
        let found = value.to_string();
        Err(ParamError {
            key,
            found,
            expected,
        })
    }
}

/// A number in a range, from text. `unit` follows the range in the error.
///
/// # Errors
/// What was expected, beginning with that word.
pub fn within<T: FromStr + PartialOrd + Display>(
    text: &str,
    range: RangeInclusive<T>,
    unit: &str,
) -> Result<T, String> {
    parse(text, "number", range, unit)
}

/// A whole number in a range, from text.
///
/// # Errors
/// What was expected, beginning with that word.
pub fn whole_within<T: FromStr + PartialOrd + Display>(
    text: &str,
    range: RangeInclusive<T>,
) -> Result<T, String> {
    parse(text, "whole number", range, "")
}

fn parse<T: FromStr + PartialOrd + Display>(
    text: &str,
    kind: &str,
    range: RangeInclusive<T>,
    unit: &str,
) -> Result<T, String> {
    let (low, high) = (range.start(), range.end());
    match text.parse() {
        // Not a number is in no range.
        Ok(value) if range.contains(&value) => Ok(value),
        _ => Err(format!("expected a {kind} from {low} to {high}{unit}")),
    }
}

/// As many numbers as there are ranges, each in its own, from text with commas between them.
pub(super) fn between_commas<const N: usize>(
    text: &str,
    ranges: &[[f32; 2]; N],
) -> Option<[f32; N]> {
    let mut parts = text.split(',').map(|part| part.trim().parse::<f32>().ok());
    let mut numbers = [0.0; N];
    for (number, [low, high]) in numbers.iter_mut().zip(ranges) {
        *number = parts.next()??;
        if !(*low..=*high).contains(number) {
            return None;
        }
    }
    parts.next().is_none().then_some(numbers)
}

/// Numbers as text, with commas between them.
pub(super) fn comma_text(numbers: impl IntoIterator<Item = f32>) -> String {
    let texts: Vec<String> = numbers.into_iter().map(|n| n.to_string()).collect();
    texts.join(",")
}
