use welkin_controls::{Group, Input, KEYS, Key, Settings};
use welkin_runtime::Method;
use welkin_runtime::params::{FbmParams, SkyModel, Tonemap};

use super::*;
use crate::cli::{Cli, Command};

const BEGINNING: [&str; 5] = ["welkin-view", "render", "pack", "-o", "f.png"];

fn error_of(args: &[&str]) -> String {
    match Cli::read(BEGINNING.iter().chain(args)) {
        Ok(_) => panic!("{args:?} was accepted"),
        Err(error) => error.to_string(),
    }
}

fn render_args(args: &[&str]) -> Box<RenderArgs> {
    match Cli::read(BEGINNING.iter().chain(args)).map(|cli| cli.command) {
        Ok(Some(Command::Render(render))) => render,
        other => panic!("{args:?}: {other:?}"),
    }
}

fn params(args: &[&str]) -> SkyParams {
    render_args(args).view().params
}

#[test]
fn no_option_is_the_default_sky() {
    assert_eq!(params(&[]), SkyParams::default());
    for method in Method::ALL {
        let defaults = SkyParams {
            method,
            ..SkyParams::default()
        };
        assert_eq!(params(&["--method", method.name()]), defaults);
    }
}

#[test]
fn shares_outside_their_range_are_refused_by_name() {
    for option in [
        "--cover",
        "--height",
        "--density",
        "--sunset",
        "--speed",
        "--time",
        "--flare",
        "--skybox",
        "--upper",
        "--sharpness",
        "--rays",
        "--rain",
    ] {
        for value in ["1.01", "-0.1", "nan", "inf", "half", ""] {
            let error = error_of(&[option, value]);
            assert!(error.contains(option), "{error}");
            assert!(error.contains("expected a number from 0 to 1"), "{error}");
        }
    }
}

#[test]
fn oktas_are_eighths_and_stand_in_place_of_cover() {
    for value in ["8.5", "-1", "nan", "inf", "half", ""] {
        let error = error_of(&["--oktas", value]);
        assert!(error.contains("--oktas"), "{error}");
        assert!(
            error.contains("expected a number from 0 to 8 oktas"),
            "{error}"
        );
    }
    let error = error_of(&["--oktas", "4", "--cover", "0.5"]);
    assert!(
        error.contains("--oktas") && error.contains("--cover"),
        "{error}"
    );
    for (text, oktas) in [("0", 0.0), ("2.5", 2.5), ("8", 8.0)] {
        assert_eq!(render_args(&["--oktas", text]).oktas, Some(oktas));
    }
    assert_eq!(render_args(&[]).oktas, None);
}

#[test]
fn numbers_with_units_outside_their_range_are_refused() {
    for (option, range, values) in [
        (
            "--azimuth",
            "-360 to 360 degrees",
            ["361", "-360.5", "nan", "inf", "east"],
        ),
        (
            "--elevation",
            "-90 to 90 degrees",
            ["-91", "90.1", "nan", "inf", ""],
        ),
        (
            "--fov",
            "1 to 150 degrees",
            ["0.5", "151", "nan", "inf", "-60"],
        ),
        (
            "--at",
            "0 to 1000000000 seconds",
            ["-1", "2e9", "nan", "inf", "now"],
        ),
        (
            "--east",
            "-1000000 to 1000000 metres",
            ["1000001", "-2e6", "nan", "inf", "far"],
        ),
        (
            "--north",
            "-1000000 to 1000000 metres",
            ["1000001", "-2e6", "nan", "inf", ""],
        ),
        (
            "--up",
            "-1000000 to 1000000 metres",
            ["1000001", "-2e6", "nan", "inf", "1m"],
        ),
        (
            "--formation-interval",
            "0.1 to 86400 seconds",
            ["0", "86401", "nan", "inf", "-60"],
        ),
    ] {
        for value in values {
            let error = error_of(&["--method", "octaves", option, value]);
            assert!(
                error.contains(option) && error.contains(range),
                "{value}: {error}"
            );
        }
    }
}

#[test]
fn the_octaves_are_a_whole_number_from_1_to_8() {
    for value in ["0", "9", "-1", "2.5", "nan", "four", ""] {
        let error = error_of(&["--method", "octaves", "--octaves", value]);
        assert!(
            error.contains("--octaves") && error.contains("from 1 to 8"),
            "{error}"
        );
    }
}

#[test]
fn domes_and_colours_are_three_shares() {
    for (method, option) in [
        ("octaves", "--domes"),
        ("fbm", "--lit"),
        ("fbm", "--shaded"),
    ] {
        for value in [
            "1,1", "1,1,1,1", "1,1,1.5", "-1,0,0", "nan,0,0", "0,inf,0", "1;1;1", ",,", "",
        ] {
            let error = error_of(&["--method", method, option, value]);
            assert!(error.contains(option), "{error}");
            assert!(error.contains("three numbers from 0 to 1"), "{error}");
        }
    }
}

#[test]
fn sizes_are_two_positive_numbers() {
    for value in [
        "0x10", "10x0", "10", "10x", "axb", "-1x4", "99999x10", "10x10x10",
    ] {
        assert!(
            error_of(&["--size", value]).contains("WIDTHxHEIGHT"),
            "{value}"
        );
    }
    assert_eq!(render_args(&["--size", "640x480"]).size, [640, 480]);
}

#[test]
fn an_unknown_method_or_palette_is_answered_with_those_that_there_are() {
    let error = error_of(&["--method", "volumes"]);
    assert!(
        error.contains("--method") && error.contains("packed, octaves, fbm, lit, sprites"),
        "{error}"
    );
    let error = error_of(&["--method", "fbm", "--palette", "pink"]);
    assert!(
        error.contains("--palette") && error.contains("fair, stormy"),
        "{error}"
    );
}

#[test]
fn options_of_another_method_are_refused_and_say_whose_they_are() {
    for (option, value, owners) in [
        ("--upper", "0.5", vec!["packed", "sprites"]),
        ("--octaves", "4", vec!["octaves"]),
        ("--formation-interval", "60", vec!["octaves", "lit"]),
        ("--domes", "1,1,1", vec!["octaves"]),
        ("--sharpness", "0.5", vec!["octaves", "fbm"]),
        ("--palette", "fair", vec!["fbm"]),
        ("--lit", "1,1,1", vec!["fbm"]),
        ("--shaded", "0,0,0", vec!["fbm"]),
        ("--layers", "cumulus", vec!["lit"]),
        ("--dome-radius", "20000", vec!["lit"]),
        ("--flattening", "0.5", vec!["lit"]),
        ("--k1", "0.5", vec!["lit"]),
        ("--k2", "0.5", vec!["lit"]),
        ("--m", "2", vec!["lit"]),
        ("--behind", "fbm", vec!["sprites"]),
        ("--behind-cover", "0.5", vec!["sprites"]),
        ("--sight", "40000", vec!["sprites"]),
        ("--ring", "0", vec!["sprites"]),
        ("--billboards", "9000", vec!["sprites"]),
        ("--formation", "0.5", vec!["sprites"]),
    ] {
        for method in Method::ALL.map(Method::name) {
            let args = ["--method", method, option, value];
            if owners.contains(&method) {
                render_args(&args);
                continue;
            }
            let error = error_of(&args);
            let told = format!(
                "{option} belongs to --method {}, and --method {method} does not use it",
                owners.join(" or ")
            );
            assert!(
                error.contains(&told) && error.contains("Usage: welkin-view render"),
                "{error}"
            );
        }
    }
}

/// An option of one method that is missing among the owners would be taken, and ignored, by the others.
#[test]
fn every_option_of_one_method_is_refused_by_the_others() {
    for key in KEYS.iter().filter(|key| key.group != Group::Air) {
        let Some(option) = key.option().filter(|_| key.input != Input::Switch) else {
            continue;
        };
        let sharing = KEYS.iter().filter(|other| other.option() == Some(option));
        let owners: Vec<Method> = sharing.flat_map(|key| key.methods).copied().collect();
        for method in Method::ALL.iter().filter(|method| !owners.contains(method)) {
            let option = format!("--{option}");
            let text = another_text(key);
            let error = error_of(&["--method", method.name(), &option, &text]);
            assert!(
                error.contains(&format!("{option} belongs to --method")),
                "{error}"
            );
        }
    }
}

#[test]
fn options_of_sprites_reach_the_sky_and_have_their_ranges() {
    let given = params(&[
        "--method",
        "sprites",
        "--behind",
        "lit",
        "--behind-cover",
        "0.3",
        "--sight",
        "40000",
        "--ring",
        "8000",
        "--billboards",
        "20000",
        "--formation",
        "0.6",
    ]);
    let mut wanted = SkyParams::default().sprites;
    (wanted.behind, wanted.behind_cover) = (Method::Lit, 0.3);
    (wanted.distance_m, wanted.ring_radius_m) = (40_000.0, 8000.0);
    (wanted.billboards_beyond_m, wanted.formation) = (20_000.0, 0.6);
    assert_eq!(given.sprites, wanted);
    for (option, value, expected) in [
        ("--ring", "100", "0 or a number from 4000 to 60000 metres"),
        ("--sight", "1", "8000 to 60000 metres"),
        ("--billboards", "NaN", "2000 to 60000 metres"),
        ("--formation", "2", "0 to 1"),
    ] {
        let error = error_of(&["--method", "sprites", option, value]);
        assert!(
            error.contains(option) && error.contains(expected),
            "{error}"
        );
    }
}

#[test]
fn options_reach_the_view() {
    let args = render_args(&[
        "--cover",
        "0.1",
        "--height",
        "0.2",
        "--density",
        "0.3",
        "--sunset",
        "0.4",
        "--speed",
        "0.5",
        "--time",
        "0.6",
        "--upper",
        "0.7",
        "--flare",
        "0.8",
        "--skybox",
        "0.9",
        "--starburst",
        "--no-sun",
        "--no-stars",
        "--at",
        "8",
        "--azimuth",
        "-90",
        "--size",
        "64x48",
        "--east",
        "10",
        "--north",
        "-20",
        "--up",
        "30",
    ]);
    let view = args.view();
    let wanted = SkyParams {
        cover: 0.1,
        height: 0.2,
        density: 0.3,
        sunset: 0.4,
        speed: 0.5,
        time: 0.6,
        upper_layer: 0.7,
        flare: 0.8,
        starburst: true,
        skybox: 0.9,
        sun: false,
        stars: false,
        ..SkyParams::default()
    };
    assert_eq!(view.params, wanted);
    assert_eq!(view.seconds, 8.0);
    assert_eq!(view.camera.viewport_px, [64, 48]);
    // +X is east, +Y up, and north is -Z.
    assert_eq!(view.camera.position_m.to_array(), [10.0, 30.0, 20.0]);
    // West is -X.
    assert!(view.camera.rays().forward.x < -0.8);
}

#[test]
fn options_of_octaves_reach_the_view() {
    let args = [
        "--method",
        "octaves",
        "--octaves",
        "6",
        "--sharpness",
        "0.3",
        "--formation-interval",
        "12.5",
        "--domes",
        "0,0.5,1",
    ];
    let mut wanted = SkyParams::default().octaves;
    (wanted.count, wanted.sharpness) = (6, 0.3);
    (wanted.formation_interval_s, wanted.domes) = (12.5, [0.0, 0.5, 1.0]);
    assert_eq!(params(&args).octaves, wanted);
}

#[test]
fn colours_and_sharpness_override_the_palette() {
    let fbm = |args: &[&str]| params(&[&["--method", "fbm"], args].concat()).fbm;
    assert_eq!(fbm(&[]), FbmParams::FAIR);
    assert_eq!(fbm(&["--palette", "stormy"]), FbmParams::STORMY);
    let args = [
        "--palette",
        "stormy",
        "--lit",
        "0.9,0.8,0.7",
        "--sharpness",
        "0.6",
    ];
    let wanted = FbmParams {
        lit: [0.9, 0.8, 0.7],
        sharpness: 0.6,
        ..FbmParams::STORMY
    };
    assert_eq!(fbm(&args), wanted);
    assert_eq!(fbm(&["--shaded", "0,0,0.1"]).shaded, [0.0, 0.0, 0.1]);
}

/// What the command line takes, the sky takes as it is.
#[test]
fn the_ends_of_every_range_are_in_the_sky_s_ranges() {
    let ends = |method: &str, numbers: &[(&str, [&str; 2])]| {
        for end in [0, 1] {
            let mut args = vec!["--method", method];
            args.extend(
                numbers
                    .iter()
                    .flat_map(|(option, range)| [option, range[end]]),
            );
            let params = params(&args);
            assert_eq!(params.check(), Ok(()), "{args:?}");
        }
    };
    const UNIT: [&str; 2] = ["0", "1"];
    const THREE: [&str; 2] = ["0,0,0", "1,1,1"];
    let shares = [
        "--cover",
        "--height",
        "--density",
        "--sunset",
        "--speed",
        "--time",
        "--flare",
        "--skybox",
    ];
    let shares = shares.map(|option| (option, UNIT));
    ends("packed", &[&shares[..], &[("--upper", UNIT)]].concat());
    let octaves = [
        ("--octaves", ["1", "8"]),
        ("--sharpness", UNIT),
        ("--formation-interval", ["0.1", "86400"]),
        ("--domes", THREE),
    ];
    ends("octaves", &octaves);
    ends(
        "fbm",
        &[("--sharpness", UNIT), ("--lit", THREE), ("--shaded", THREE)],
    );
}

/// A text for a setting that is not the usual one.
fn another_text(key: &Key) -> String {
    match key.input {
        Input::Slider { whole: true, .. } => "3".to_string(),
        Input::Slider { low, high, .. } => ((low + (high - low) * 0.625) as f32).to_string(),
        Input::Switch => (key.text(&Settings::default()) == "false").to_string(),
        Input::Choice { choices, .. } => choices[choices.len() - 1].to_string(),
        Input::Numbers { optional: true, .. } => "-0.5,-0.5,9,-2.5,0.5".to_string(),
        Input::Numbers { .. } | Input::Colour => "0.25,0.5,0.75".to_string(),
        Input::Layers => "cumulus:0.5:0.8:-20:5,cirrus:0.25:4".to_string(),
        Input::Text { .. } if key.name == "date" => "2026-06-21T18:30:00Z".to_string(),
        Input::Text { .. } => "-4,2.5,10,0.5".to_string(),
    }
}

#[test]
fn settings_become_options_that_give_the_same_picture() {
    // All at once, and each alone: some stand in place of others.
    let alone = KEYS.iter().map(std::slice::from_ref);
    for changed in alone.chain([KEYS]) {
        for (method, sky) in Method::ALL
            .iter()
            .flat_map(|m| SkyModel::ALL.map(|s| (m, s)))
        {
            let mut settings = Settings::default();
            for key in changed {
                key.set(&mut settings, &another_text(key)).unwrap();
            }
            settings.params.method = *method;
            settings.params.sky = sky;
            let options = settings.options();
            let words: Vec<&str> = options.iter().map(String::as_str).collect();
            let args = render_args(&words);
            let given = args.settings.settings;
            let shown = Settings {
                params: args.params(),
                view: given.view,
                at_s: given.at_s,
                ..settings
            };
            let frame = Settings {
                params: settings.frame_params(),
                ..settings
            };
            for key in KEYS.iter().filter(|key| key.applies(&frame)) {
                assert_eq!(
                    key.text(&shown),
                    key.text(&frame),
                    "{} by {words:?}",
                    key.name
                );
            }
        }
    }
}

#[test]
fn curve_and_exposure_are_taken_for_pictures_and_refused_for_radiance() {
    let toned = params(&["--tonemap", "neutral", "--exposure-ev", "-1.5"]);
    assert_eq!((toned.tonemap, toned.exposure_ev), (Tonemap::Neutral, -1.5));
    assert!(error_of(&["--tonemap", "aces"]).contains("[possible values: neutral, agx,"));
    assert!(error_of(&["--exposure-ev", "17"]).contains("expected a number from -16 to 16 stops"));
    let read = |args: &[&str]| Cli::read(["welkin-view", "render", "pack"].iter().chain(args));
    for option in [["--tonemap", "agx"], ["--exposure-ev", "1"]] {
        for output in [
            &["-o", "sky.exr"][..],
            &["-o", "sky.hdr", "--equirect", "64"],
            &["-o", "sky.ktx2", "--cubemap", "64"],
            &["-o", "faces", "--cubemap", "64"],
        ] {
            let Err(error) = read(&[output, &option].concat()) else {
                panic!("{output:?} {option:?} was accepted");
            };
            let told = format!(
                "{} is for pictures, and {} would hold",
                option[0], output[1]
            );
            assert!(error.to_string().contains(&told), "{error}");
        }
        for output in [
            &["-o", "sky.png", "--equirect", "64"][..],
            &["-o", "faces", "--cubemap", "64", "--format", "png"],
            &["-o", "frames", "--frames", "2"],
        ] {
            assert!(read(&[output, &option].concat()).is_ok(), "{output:?}");
        }
    }
}
