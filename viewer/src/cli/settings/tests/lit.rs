use welkin_pack::LayerKind;
use welkin_runtime::SkyParams;
use welkin_runtime::params::MAX_LAYERS;
use welkin_runtime::params::{LitLayer, LitParams};

use crate::cli::{Cli, Command};

fn read(args: &[&str]) -> Result<SkyParams, String> {
    let words = [
        "welkin-view",
        "render",
        "pack",
        "-o",
        "f.png",
        "--method",
        "lit",
    ];
    match Cli::read(words.iter().chain(args)).map(|cli| cli.command) {
        Ok(Some(Command::Render(render))) => {
            let params = render.view().params;
            assert_eq!(params.check(), Ok(()), "{args:?}");
            Ok(params)
        }
        Ok(other) => panic!("{args:?}: {other:?}"),
        Err(error) => Err(error.to_string()),
    }
}

fn layers_of(text: &str) -> Vec<LitLayer> {
    let layers = read(&["--layers", text]).unwrap().lit.layers;
    let count = layers.iter().take_while(|l| l.share > 0.0).count();
    assert!(layers[count..].iter().all(|l| l.share == 0.0), "{text}");
    layers[..count].to_vec()
}

#[test]
fn a_layer_is_as_its_kind_where_it_is_not_told_otherwise() {
    for kind in LayerKind::ALL {
        assert_eq!(layers_of(kind.name()), [LitLayer::of(kind, 1.0)]);
        let share = format!("{}:0.25", kind.name());
        assert_eq!(layers_of(&share), [LitLayer::of(kind, 0.25)]);
        let height = LitLayer {
            height: 1.5,
            ..LitLayer::of(kind, 0.25)
        };
        assert_eq!(layers_of(&format!("{share}:1.5")), [height]);
        let moved = LitLayer {
            velocity_m_s: [-10.0, 2.5],
            ..height
        };
        assert_eq!(layers_of(&format!("{share}:1.5:-10:2.5")), [moved]);
    }
}

#[test]
fn one_to_six_layers_stand_between_commas() {
    let cumulus = LitLayer::of(LayerKind::Cumulus, 0.7);
    let cirrus = LitLayer::of(LayerKind::Cirrus, 0.3);
    assert_eq!(layers_of("cumulus:0.7,cirrus:0.3"), [cumulus, cirrus]);
    assert_eq!(layers_of("cumulus: 0.7 , cirrus:0.3"), [cumulus, cirrus]);
    assert_eq!(
        layers_of(&["cumulus"; MAX_LAYERS].join(",")).len(),
        MAX_LAYERS
    );
    // No share is no layer.
    assert!(layers_of("cirrus:0").is_empty());
}

#[test]
fn the_lowest_layer_is_the_first_in_whatever_order_they_are_told() {
    let heights = |text: &str| -> Vec<f32> { layers_of(text).iter().map(|l| l.height).collect() };
    assert_eq!(
        heights("cumulus:1:3,cumulus:1:0.5,cumulus:1:2"),
        [0.5, 2.0, 3.0]
    );
    assert_eq!(layers_of("cirrus,cumulus"), layers_of("cumulus,cirrus"));
}

#[test]
fn layers_that_do_not_exist_are_refused_with_what_was_found_and_expected() {
    const KINDS: &str = "expected one of stratocumulus, cumulus, cirrus";
    for (text, told) in [
        ("nimbus", "\"nimbus\" is no kind of cloud"),
        ("nimbus", KINDS),
        ("cumulus,Cirrus:0.5", "\"Cirrus\" is no kind of cloud"),
        ("", "\"\" is no kind of cloud"),
        ("cumulus,", KINDS),
        (":0.5", KINDS),
        (
            "cumulus,cumulus,cumulus,cumulus,cumulus,cumulus,cirrus",
            "7 layers, expected 1 to 6",
        ),
        (
            "cumulus:lots",
            "the share of cumulus is \"lots\", expected a number from 0 to 1",
        ),
        (
            "cirrus:1.1",
            "the share of cirrus is \"1.1\", expected a number from 0 to 1",
        ),
        ("cirrus:-0.1", "the share of cirrus is \"-0.1\""),
        ("cirrus:nan", "the share of cirrus is \"nan\""),
        ("cirrus:", "the share of cirrus is \"\""),
        (
            "cumulus:1:0",
            "the height of cumulus is \"0\", expected a number from 0.1 to 20 heights of the dome",
        ),
        ("cumulus:1:21", "the height of cumulus is \"21\""),
        ("cumulus:1:inf", "the height of cumulus is \"inf\""),
        (
            "cumulus:1:1:1:1:1",
            "\"cumulus:1:1:1:1:1\" has too many parts; expected KIND[:SHARE[:HEIGHT[:EAST:SOUTH]]]",
        ),
    ] {
        let error = read(&["--layers", text]).unwrap_err();
        assert!(
            error.contains("--layers") && error.contains(told),
            "{text}: {error}"
        );
    }
}

#[test]
fn dome_and_light_out_of_range_are_refused_with_the_range() {
    for (option, expected, values) in [
        (
            "--dome-radius",
            "a number from 1000 to 1000000 metres",
            ["999", "1000001", "nan"],
        ),
        (
            "--flattening",
            "a number from 0.02 to 1: the dome's height over its radius, 1 for a hemisphere",
            ["0", "-0.1", "1.01"],
        ),
        ("--k1", "a number from 0 to 1", ["-0.1", "1.1", "nan"]),
        ("--k2", "a number from 0 to 1", ["-0.1", "1.1", "inf"]),
        ("--m", "a number from 0.5 to 16", ["0.4", "17", "nan"]),
        ("--moon", "a number from 0 to 1", ["-0.1", "1.1", "full"]),
        (
            "--formation-interval",
            "with --method lit expected a number from 1 to 86400 seconds",
            ["0.1", "0.5", "0.99"],
        ),
    ] {
        for value in values {
            let error = read(&[option, value]).unwrap_err();
            assert!(error.contains(option) && error.contains(value), "{error}");
            assert!(error.contains(expected), "{error}");
        }
    }
}

#[test]
fn dome_and_light_reach_the_sky() {
    let args = [
        "--dome-radius",
        "20000",
        "--flattening",
        "0.3",
        "--k1",
        "0.1",
        "--k2",
        "0.2",
        "--m",
        "4",
        "--formation-interval",
        "12.5",
    ];
    let wanted = LitParams {
        radius_m: 20_000.0,
        flattening: 0.3,
        k1: 0.1,
        k2: 0.2,
        m: 4.0,
        formation_interval_s: 12.5,
        ..LitParams::default()
    };
    let params = read(&args).unwrap();
    assert_eq!(params.lit, wanted);
    // The interval of the other method that has one stays.
    assert_eq!(params.octaves, SkyParams::default().octaves);
}

#[test]
fn shadows_are_drawn_where_they_are_asked_for() {
    let extent = |args: &[&str]| read(args).unwrap().shadow_extent_m;
    assert_eq!(extent(&[]), 0.0);
    assert_eq!(extent(&["--shadow", "s.png"]), 8000.0);
    for (text, metres) in [("1", 1.0), ("2500.5", 2500.5), ("1000000", 1e6)] {
        assert_eq!(
            extent(&["--shadow", "s.PNG", "--shadow-extent", text]),
            metres
        );
    }
}

#[test]
fn shadows_that_cannot_be_written_are_refused() {
    for name in ["s.exr", "s", "s.jpg", ""] {
        let error = read(&["--shadow", name]).unwrap_err();
        assert!(error.contains("--shadow"), "{error}");
        assert!(
            name.is_empty() || error.contains("a name that ends in .png"),
            "{error}"
        );
    }
    for value in ["0", "0.9", "-5", "1000001", "nan", "far"] {
        let error = read(&["--shadow", "s.png", "--shadow-extent", value]).unwrap_err();
        assert!(
            error.contains("--shadow-extent") && error.contains(value),
            "{error}"
        );
        assert!(
            error.contains("a number from 1 to 1000000 metres"),
            "{error}"
        );
    }
    // It says nothing alone.
    let error = read(&["--shadow-extent", "500"]).unwrap_err();
    assert!(error.contains("--shadow <FILE.png>"), "{error}");
}

#[test]
fn the_ends_of_every_range_are_taken() {
    for args in [
        [
            "--dome-radius",
            "1000",
            "--flattening",
            "0.02",
            "--m",
            "0.5",
            "--formation-interval",
            "1",
        ],
        [
            "--dome-radius",
            "1000000",
            "--flattening",
            "1",
            "--m",
            "16",
            "--formation-interval",
            "86400",
        ],
    ] {
        read(&args).unwrap();
    }
    for end in ["0", "1"] {
        read(&["--k1", end, "--k2", end, "--moon", end]).unwrap();
    }
    read(&["--layers", "cirrus:0:0.1,cirrus:1:20"]).unwrap();
}
