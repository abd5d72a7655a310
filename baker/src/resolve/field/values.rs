//! Values that only the field has: lists of numbers, names of a set, tables of colour.

use std::ops::Range;

use toml::Value;
use welkin_pack::field::{COLOUR_LEVELS, CloudKind, ColourLevel};

use crate::error::RecipeError;
use crate::field::light;
use crate::recipe::Recipe;
use crate::recipe::tables::Entry;

impl Recipe {
    /// A value that must be there; `table` is where it is missed.
    pub(super) fn needed(
        &self,
        key: &str,
        entry: &Entry,
        table: Range<usize>,
        expected: &str,
    ) -> Result<(), RecipeError> {
        match entry {
            Some(_) => Ok(()),
            None => Err(self.refuse_at(key, table, "missing", expected)),
        }
    }

    /// One of a set of names.
    pub(super) fn choice<T>(
        &self,
        key: &str,
        entry: &Entry,
        table: Range<usize>,
        names: &[&str],
        from_name: impl Fn(&str) -> Option<T>,
    ) -> Result<T, RecipeError> {
        let expected = format!("one of \"{}\"", names.join("\", \""));
        let Some(value) = entry else {
            return Err(self.refuse_at(key, table, "missing", expected));
        };
        let found = value.get_ref().as_str().and_then(from_name);
        found.ok_or_else(|| self.refuse(key, value, expected))
    }

    /// `N` numbers within a range, or the default where the recipe says nothing.
    pub(super) fn reals<const N: usize>(
        &self,
        key: &str,
        entry: &Entry,
        default: [f32; N],
        [min, max]: [f32; 2],
    ) -> Result<[f32; N], RecipeError> {
        let Some(value) = entry else {
            return Ok(default);
        };
        let found = numbers(value.get_ref());
        let found = found.filter(|n: &[f32; N]| n.iter().all(|n| (min..=max).contains(n)));
        found.ok_or_else(|| {
            let expected = format!("a list of {N} numbers from {min} to {max}");
            self.refuse(key, value, expected)
        })
    }

    /// The least and the largest of something.
    pub(super) fn span(
        &self,
        key: &str,
        entry: &Entry,
        default: [f32; 2],
        range: [f32; 2],
    ) -> Result<[f32; 2], RecipeError> {
        let [least, most] = self.reals(key, entry, default, range)?;
        match entry {
            Some(value) if least > most => {
                Err(self.refuse(key, value, "the least first, then the largest"))
            }
            _ => Ok([least, most]),
        }
    }

    /// Five colour levels, or those of the kind.
    pub(super) fn levels(
        &self,
        key: &str,
        entry: &Entry,
        kind: CloudKind,
    ) -> Result<[ColourLevel; COLOUR_LEVELS], RecipeError> {
        let Some(value) = entry else {
            return Ok(light::levels(kind));
        };
        let rows: Option<Vec<ColourLevel>> = value
            .get_ref()
            .as_array()
            .and_then(|rows| rows.iter().map(level).collect());
        let levels = rows.and_then(|rows| <[ColourLevel; COLOUR_LEVELS]>::try_from(rows).ok());
        let rising = |l: &[ColourLevel; COLOUR_LEVELS]| {
            l.windows(2).all(|pair| pair[0].height <= pair[1].height)
        };
        levels.filter(rising).ok_or_else(|| {
            let expected = "five lists of height (0 to 1, lowest first), red, green, blue (0 to 16) and opacity (0 to 1)";
            self.refuse(key, value, expected)
        })
    }
}

fn numbers<const N: usize>(value: &Value) -> Option<[f32; N]> {
    let values = value.as_array()?.iter().map(|v| match v {
        Value::Float(f) => Some(*f as f32),
        Value::Integer(i) => Some(*i as f32),
        _ => None,
    });
    values.collect::<Option<Vec<f32>>>()?.try_into().ok()
}

fn level(value: &Value) -> Option<ColourLevel> {
    let [height, red, green, blue, alpha] = numbers(value)?;
    let shares = [height, alpha].iter().all(|v| (0.0..=1.0).contains(v));
    let colours = [red, green, blue].iter().all(|v| (0.0..=16.0).contains(v));
    (shares && colours).then_some(ColourLevel {
        height,
        rgba: [red, green, blue, alpha],
    })
}
