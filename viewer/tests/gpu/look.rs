//! What `welkin-view look` prints and draws.

// The lint's exception for tests does not reach their helpers.
#![allow(clippy::unwrap_used)]

use crate::common::{pack, run, view};

/// Each hour and cover has its number, so has motion, or none without clouds, and what is beyond the bounds is told and makes the program fail.
#[test]
fn structure_and_motion_are_told_and_a_page_shows_them() {
    let place = tempfile::tempdir().unwrap();
    let folder = place.path().join("page");
    let mut command = view(&["look", "--method", "octaves", "--motion=2", "-o"]);
    command.arg(&folder).arg(pack());
    let output = run(command);
    let text = String::from_utf8(output.stdout).unwrap();
    let rows: Vec<Vec<&str>> = text
        .lines()
        .map(|l| l.split_whitespace().collect())
        .collect();
    let (told, rows): (Vec<_>, Vec<_>) = rows.iter().skip(1).partition(|row| row[0] == "beyond");
    let hours: Vec<&str> = rows.iter().map(|row| row[1]).collect();
    assert_eq!(
        hours,
        ["noon", "sunset", "storm", "zenith", "motion"],
        "{text}"
    );
    let mut beyond = 0;
    for row in &rows {
        let within = match row[1] {
            "zenith" => 0.0..0.305,
            // The second number has no bound.
            "motion" => 0.0..2.005,
            _ => 0.095..0.285,
        };
        let columns = match row[1] {
            "zenith" => 3,
            "motion" => 4,
            _ => 5,
        };
        assert_eq!(row.len(), columns, "{text}");
        for number in row[2..].iter().filter(|number| **number != "-") {
            let number: f32 = number.parse().unwrap();
            assert!((0.01..5.0).contains(&number), "{text}");
            beyond += usize::from(!within.contains(&number));
        }
    }
    // Numbers that are rounded to a bound may be on either side of it.
    assert!(told.len() >= beyond, "{text}");
    assert_eq!(
        output.status.code(),
        Some(i32::from(!told.is_empty())),
        "{text}"
    );
    let page = std::fs::read_to_string(folder.join("index.html")).unwrap();
    assert!(page.contains("In 2 seconds the largest change"), "{page}");
    for scene in [
        "noon", "sunset", "away", "storm", "dawn", "night", "zenith", "horizon",
    ] {
        let file = format!("octaves-{scene}.png");
        assert!(page.contains(&format!("src=\"{file}\"")), "{file}");
        let picture = image::open(folder.join(&file)).unwrap();
        assert_eq!((picture.width(), picture.height()), (1280, 720));
    }
}
