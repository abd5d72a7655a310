//! Catalogues of stars: places, magnitudes and colours, from files of four layouts.
//!
//! | layout | known by | places | magnitude, colour |
//! |---|---|---|---|
//! | GeoJSON of d3-celestial | a `{` at the start | points of right ascension -180 to 180 and declination, in degrees | `mag`, `bv` of the properties |
//! | HYG (D. Nash, version 1 to 4) | columns `ra`, `dec`, `mag` and `ci` | `ra` in hours, `dec` in degrees | `mag`, `ci` |
//! | table of one's own | named columns, between commas, semicolons or tabs | `ra_deg` or `ra_hours`, `dec_deg` | `mag`, and `bv` if it has it |
//! | Bright Star Catalogue (D. Hoffleit, W. H. Warren, fifth edition, CDS V/50) | lines with numbers in its columns | hours, minutes, seconds; degrees, minutes, seconds of J2000 | bytes 103 to 107, 110 to 114 |
//!
//! Places are those of J2000. A row of the sun is left out, and so are those of the Bright Star Catalogue that never were stars.

mod bsc;
mod error;
mod geojson;
mod numbers;
mod star;
mod table;

pub use error::CatalogueError;
pub use star::{MAX_STARS, Star};

/// The stars of a catalogue, in its order. `file` is its name in errors.
///
/// # Errors
/// [`CatalogueError`], with file, place, column, what was found and what was expected.
pub fn read(file: &str, bytes: &[u8]) -> Result<Vec<Star>, CatalogueError> {
    let text = std::str::from_utf8(bytes).map_err(|error| CatalogueError::Layout {
        file: file.to_string(),
        found: format!("bytes that are no UTF-8 at {}", error.valid_up_to()),
    })?;
    // Editors put a mark before it.
    let text = text.trim_start_matches('\u{feff}');
    let first = text.lines().find(|line| !line.trim().is_empty());
    let stars = match first {
        None => Vec::new(),
        Some(line) if line.trim_start().starts_with('{') => geojson::read(file, text)?,
        Some(line) if bsc::is_one(line) => bsc::read(file, text)?,
        Some(_) => table::read(file, text)?,
    };
    match (1..=MAX_STARS).contains(&stars.len()) {
        true => Ok(stars),
        false => Err(CatalogueError::Count {
            file: file.to_string(),
            found: stars.len(),
        }),
    }
}

#[cfg(test)]
mod tests;
