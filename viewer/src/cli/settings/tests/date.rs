//! The sky of a date and place at the command line.

use welkin_runtime::SkyParams;

use crate::cli::{Cli, Command};

fn read(args: &[&str]) -> Result<SkyParams, String> {
    let beginning = ["welkin-view", "render", "pack", "-o", "f.png"];
    match Cli::read(beginning.iter().chain(args)).map(|cli| cli.command) {
        Ok(Some(Command::Render(render))) => Ok(render.view().params),
        Ok(other) => panic!("{other:?}"),
        Err(error) => Err(error.to_string()),
    }
}

#[test]
fn a_date_and_a_place_reach_the_sky() {
    let given = [
        "--date",
        "2026-06-21T21:30+03:00",
        "--lat",
        "59.9",
        "--lon",
        "-30.3",
    ];
    let params = read(&given).unwrap();
    let date = params.date.unwrap();
    assert_eq!(date.to_string(), "2026-06-21T18:30:00Z");
    assert_eq!(
        (params.place.latitude_deg, params.place.longitude_deg),
        (59.9, -30.3)
    );
    assert_eq!(read(&[]).unwrap().date, None);
}

#[test]
fn what_is_wrong_is_told_with_what_would_be_right() {
    for (args, told) in [
        (
            &["--date", "noon"][..],
            "expected a moment such as 2026-06-21T18:30:00Z",
        ),
        (
            &["--date", "1850-01-01"],
            "expected a year from 1900 to 2099",
        ),
        (&["--date", "2026-02-29"], "expected a day from 01 to 28"),
        (
            &["--date", "2026-06-21", "--lat", "91"],
            "expected a number from -90 to 90 degrees",
        ),
        (
            &["--date", "2026-06-21", "--lon", "-181"],
            "expected a number from -180 to 180 degrees",
        ),
        // A place without a date says nothing, and two times contradict each other.
        (&["--lat", "59.9"], "--date"),
        (&["--lon", "30.3"], "--date"),
        (&["--date", "2026-06-21", "--time", "0.5"], "--time"),
    ] {
        let error = read(args).expect_err("refused");
        assert!(error.contains(told), "{args:?}: {error}");
    }
}
