use welkin_runtime::params::{Lightning, WeatherParams};

use crate::cli::{Cli, Command};

fn read(args: &[&str]) -> Result<WeatherParams, String> {
    let words = ["welkin-view", "render", "pack", "-o", "f.png"];
    match Cli::read(words.iter().chain(args)).map(|cli| cli.command) {
        Ok(Some(Command::Render(render))) => {
            let params = render.view().params;
            assert_eq!(params.check(), Ok(()), "{args:?}");
            Ok(params.weather)
        }
        Ok(other) => panic!("{args:?}: {other:?}"),
        Err(error) => Err(error.to_string()),
    }
}

#[test]
fn weather_is_fair_unless_it_is_asked_for() {
    assert_eq!(read(&[]), Ok(WeatherParams::default()));
}

#[test]
fn every_method_has_weather() {
    for method in welkin_runtime::Method::ALL.map(welkin_runtime::Method::name) {
        let args = [
            "--method",
            method,
            "--rays",
            "0.3",
            "--rain",
            "0.4",
            "--lightning",
            "1,2",
        ];
        let weather = read(&args).unwrap();
        assert_eq!(
            [weather.rays, weather.rain, weather.lightning.strength],
            [0.3, 0.4, 1.0]
        );
    }
}

#[test]
fn lightning_strikes_where_and_when_it_is_told() {
    let of = |text: &str| read(&["--lightning", text]).unwrap().lightning;
    let flash = |place_m, start_s, strength| Lightning {
        place_m,
        start_s,
        strength,
    };
    assert_eq!(of("4,-2,0"), flash([4000.0, -2000.0], 0.0, 1.0));
    assert_eq!(of("-0.5, 2.25, 10"), flash([-500.0, 2250.0], 10.0, 1.0));
    assert_eq!(of("-1000,1000,-3.5,0.25"), flash([-1e6, 1e6], -3.5, 0.25));
    assert_eq!(of("0,0,1e9,0").start_s, 1e9);
}

#[test]
fn a_flash_without_a_start_shows_in_the_frame() {
    for at in ["0", "3.5", "1e9"] {
        let flash = read(&["--lightning", "4,-2", "--at", at])
            .unwrap()
            .lightning;
        assert_eq!(flash.strength, 1.0);
        let shown =
            welkin_runtime::internals::weather::lightning::brightness(&flash, at.parse().unwrap());
        let later =
            welkin_runtime::internals::weather::lightning::brightness(&flash, flash.start_s + 0.5);
        // As bright as a flash of this strength gets, but for its rise, and far from its end.
        assert!(shown > 0.5 && shown > 2.0 * later, "{shown} {later}");
    }
}

#[test]
fn lightning_that_is_nowhere_or_never_is_refused_with_what_was_found_and_expected() {
    for (text, told) in [
        (
            "",
            "expected two to four numbers EAST_KM,SOUTH_KM[,START_S[,STRENGTH]]",
        ),
        ("4", "expected two to four numbers"),
        ("1,2,3,1,5", "expected two to four numbers"),
        (
            "1001,0",
            "EAST_KM is \"1001\", expected a number from -1000 to 1000 kilometres",
        ),
        (
            "0,-1000.5",
            "SOUTH_KM is \"-1000.5\", expected a number from -1000 to 1000 kilometres",
        ),
        (",", "EAST_KM is \"\", expected a number"),
        ("0,nan", "SOUTH_KM is \"nan\", expected a number"),
        (
            "0,0,soon",
            "START_S is \"soon\", expected a number from -1000000000 to 1000000000 seconds",
        ),
        ("0,0,inf", "START_S is \"inf\", expected a number"),
        (
            "0,0,0,1.5",
            "STRENGTH is \"1.5\", expected a number from 0 to 1",
        ),
        (
            "0,0,0,-1",
            "STRENGTH is \"-1\", expected a number from 0 to 1",
        ),
    ] {
        let error = read(&["--lightning", text]).unwrap_err();
        assert!(
            error.contains("--lightning") && error.contains(told),
            "{text}: {error}"
        );
    }
}
