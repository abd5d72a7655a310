//! The Bright Star Catalogue, fifth edition, as the CDS has it (V/50): a line a star, each number in its own bytes.

use super::error::CatalogueError;
use super::numbers::{MAGNITUDES, Place, star};
use super::star::Star;

/// Whether a line is one of it: a number of the catalogue in its first four bytes, and so long that it has a magnitude.
pub fn is_one(line: &str) -> bool {
    let number = bytes(line, 1, 4).trim();
    let digits = |text: &str| !text.is_empty() && text.bytes().all(|b| b.is_ascii_digit());
    let separators = [',', ';', '\t'];
    digits(number) && line.len() >= 80 && !line.contains(separators)
}

pub fn read(file: &str, text: &str) -> Result<Vec<Star>, CatalogueError> {
    let mut stars = Vec::new();
    for (index, line) in text.lines().enumerate() {
        // Novae and clusters keep their number, without a place.
        if line.bytes().skip(75).take(15).all(|byte| byte == b' ') {
            continue;
        }
        let place = Place {
            file,
            unit: "line",
            number: index + 1,
        };
        let number = |column, [first, last]: [usize; 2], most: f64| {
            place.number(column, bytes(line, first, last), 0.0..=most)
        };
        let hours = number("RAh, bytes 76-77", [76, 77], 23.0)?;
        let minutes = number("RAm, bytes 78-79", [78, 79], 59.0)?;
        let seconds = number("RAs, bytes 80-83", [80, 83], 60.0)?;
        let degrees = number("DEd, bytes 85-86", [85, 86], 90.0)?;
        let arc_minutes = number("DEm, bytes 87-88", [87, 88], 59.0)?;
        let arc_seconds = number("DEs, bytes 89-90", [89, 90], 60.0)?;
        let sign = match bytes(line, 84, 84) {
            "-" => -1.0,
            "+" => 1.0,
            other => return Err(place.wrong("DE-, byte 84", other, "+ or -".to_string())),
        };
        let magnitude = place.number("Vmag, bytes 103-107", bytes(line, 103, 107), MAGNITUDES)?;
        let index = place.colour_index("B-V, bytes 110-114", bytes(line, 110, 114))?;
        let ascension_deg = 15.0 * (hours + minutes / 60.0 + seconds / 3600.0);
        let declination = (degrees + arc_minutes / 60.0 + arc_seconds / 3600.0).min(90.0);
        stars.extend(star(ascension_deg, sign * declination, magnitude, index));
    }
    Ok(stars)
}

/// Bytes of a line, from 1 and with the last one; those that it has.
fn bytes(line: &str, first: usize, last: usize) -> &str {
    line.get(first - 1..last.min(line.len())).unwrap_or("")
}
