//! Why a catalogue was refused.

use welkin_pack::shown;

use super::star::MAX_STARS;

/// Why a catalogue was refused.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum CatalogueError {
    /// It is of no known layout.
    #[error(
        "{}: found {}, expected a catalogue of stars: GeoJSON with points, a table with a line of column names, or the Bright Star Catalogue",
        shown(.file), shown(.found)
    )]
    Layout {
        /// The catalogue.
        file: String,
        /// What is there.
        found: String,
    },
    /// A table lacks a column.
    #[error("{}: column {column} is missing; found {}, expected {expected}", shown(.file), shown(.found))]
    Column {
        /// The catalogue.
        file: String,
        /// What the column is for.
        column: &'static str,
        /// The columns that there are.
        found: String,
        /// What it may be called.
        expected: &'static str,
    },
    /// A number is none, or out of its range.
    #[error("{}: {place}, column {column}: found {}, expected {expected}", shown(.file), shown(.found))]
    Value {
        /// The catalogue.
        file: String,
        /// Line or feature, from 1.
        place: String,
        /// The column.
        column: &'static str,
        /// What is there.
        found: String,
        /// What it should be.
        expected: String,
    },
    /// It has no star, or too many.
    #[error("{}: found {found} stars, expected 1 to {MAX_STARS}", shown(.file))]
    Count {
        /// The catalogue.
        file: String,
        /// How many there are.
        found: usize,
    },
}
