//! Tables with a line of column names: HYG, or one's own.

use super::error::CatalogueError;
use super::numbers::{MAGNITUDES, Place, star};
use super::star::Star;

/// Where the columns are that are read.
struct Columns {
    separator: char,
    ascension: usize,
    /// Degrees in a unit of the right ascension.
    ascension_deg: f64,
    declination: usize,
    magnitude: usize,
    colour_index: Option<usize>,
}

pub fn read(file: &str, text: &str) -> Result<Vec<Star>, CatalogueError> {
    let mut lines = text
        .lines()
        .enumerate()
        .filter(|(_, line)| !line.trim().is_empty() && !line.starts_with('#'));
    let Some((_, header)) = lines.next() else {
        return Ok(Vec::new());
    };
    let columns = Columns::of(file, header)?;
    let mut stars = Vec::new();
    for (index, line) in lines {
        let place = Place {
            file,
            unit: "line",
            number: index + 1,
        };
        let cells = cells(line, columns.separator);
        let cell = |column: usize| cells.get(column).map_or("", String::as_str);
        let most = 360.0 / columns.ascension_deg;
        let ascension = place.number("right ascension", cell(columns.ascension), -most..=most)?;
        let declination = place.number("declination", cell(columns.declination), -90.0..=90.0)?;
        let magnitude = place.number("magnitude", cell(columns.magnitude), MAGNITUDES)?;
        let index = match columns.colour_index {
            Some(column) => place.colour_index("B-V", cell(column))?,
            None => None,
        };
        let ascension_deg = ascension * columns.ascension_deg;
        stars.extend(star(ascension_deg, declination, magnitude, index));
    }
    Ok(stars)
}

impl Columns {
    fn of(file: &str, header: &str) -> Result<Columns, CatalogueError> {
        let separators = [',', ';', '\t'];
        let Some(separator) = separators.into_iter().find(|s| header.contains(*s)) else {
            return Err(CatalogueError::Layout {
                file: file.to_string(),
                found: format!("\"{}\"", header.chars().take(60).collect::<String>()),
            });
        };
        let names: Vec<String> = cells(header, separator)
            .iter()
            .map(|name| name.trim().to_lowercase())
            .collect();
        let of = |wanted: &[&str]| names.iter().position(|n| wanted.contains(&n.as_str()));
        let missing = |column, expected| CatalogueError::Column {
            file: file.to_string(),
            column,
            found: names.join(", "),
            expected,
        };
        // Of HYG alone a right ascension has no unit in its name: hours.
        let is_hyg = of(&["ra"]).is_some() && of(&["dec"]).is_some() && of(&["ci"]).is_some();
        let degrees = of(&["ra_deg", "right_ascension_deg"]);
        let hours = of(&["ra_hours", "right_ascension_hours"]).or(of(&["ra"]).filter(|_| is_hyg));
        let (ascension, ascension_deg) = match (degrees, hours) {
            (Some(column), _) => (column, 1.0),
            (None, Some(column)) => (column, 15.0),
            (None, None) => {
                let expected = "ra_deg or ra_hours, or ra, dec, mag and ci as HYG has them";
                return Err(missing("right ascension", expected));
            }
        };
        let declination = of(&["dec_deg", "declination_deg"])
            .or(of(&["dec"]).filter(|_| is_hyg))
            .ok_or_else(|| missing("declination", "dec_deg"))?;
        let magnitude = of(&["mag", "vmag", "magnitude"])
            .ok_or_else(|| missing("magnitude", "mag, vmag or magnitude"))?;
        Ok(Columns {
            separator,
            ascension,
            ascension_deg,
            declination,
            magnitude,
            colour_index: of(&["bv", "b-v", "ci", "colour_index"]),
        })
    }
}

/// The cells of a line (RFC 4180): a separator between quotation marks is text, two of them are one.
fn cells(line: &str, separator: char) -> Vec<String> {
    let mut cells = vec![String::new()];
    let mut is_quoted = false;
    let mut letters = line.chars().peekable();
    while let Some(letter) = letters.next() {
        let last = cells.len() - 1;
        match letter {
            '"' if is_quoted && letters.peek() == Some(&'"') => {
                letters.next();
                cells[last].push('"');
            }
            '"' => is_quoted = !is_quoted,
            _ if letter == separator && !is_quoted => cells.push(String::new()),
            _ => cells[last].push(letter),
        }
    }
    cells
}
