//! What `welkin-view render` knows of the methods, of sun, stars, flare and skybox: every option says something.

// The lint's exception for tests does not reach their helpers.
#![allow(clippy::unwrap_used)]

use std::path::{Path, PathBuf};

use crate::common::{RECIPE, bake, failed, pack, render, render_of, run, view};

const METHODS: [&str; 5] = ["packed", "octaves", "fbm", "lit", "sprites"];

/// Draws a frame with these words, and one with each of the options beside them: they differ.
fn each_option_changes(words: &[&str], options: &[&[&str]]) {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("frame.png");
    let without = render(&file, words);
    for option in options {
        let with = render(&file, &[words, option].concat());
        // Compared here, since bytes of pictures say nothing when they are printed.
        assert!(with != without, "{words:?} {option:?}");
    }
}

#[test]
fn every_method_draws_clouds_of_its_own_and_the_same_every_time() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("frame.png");
    let clear = ["--cover", "0"];
    let frames = METHODS.map(|method| {
        let words = ["--method", method, "--at", "100"];
        let frame = render(&file, &words);
        assert_eq!(render(&file, &words), frame, "{method}");
        assert_ne!(
            render(&file, &[&words[..], &clear].concat()),
            frame,
            "{method}"
        );
        frame
    });
    for (index, frame) in frames.iter().enumerate() {
        assert!(!frames[..index].contains(frame), "{}", METHODS[index]);
    }
}

#[test]
fn the_six_parameters_are_every_method_s() {
    for method in &METHODS[1..] {
        let day = ["--method", method, "--at", "60"];
        let options: [&[&str]; 5] = [
            &["--cover", "0.8"],
            &["--height", "0.3"],
            &["--density", "0.9"],
            &["--time", "0.35"],
            &["--speed", "1"],
        ];
        each_option_changes(&day, &options);
        each_option_changes(&day[..2], &[&["--at", "600"]]);
        let evening = ["--method", method, "--time", "0.74", "--azimuth", "270"];
        each_option_changes(&evening, &[&["--sunset", "1"]]);
    }
}

#[test]
fn options_of_sprites_change_their_clouds() {
    let options: [&[&str]; 8] = [
        &["--behind", "fbm", "--behind-cover", "0.6"],
        &["--behind", "lit", "--behind-cover", "0.6"],
        &["--sight", "8000"],
        &["--ring", "4000"],
        &["--billboards", "2000"],
        &["--formation", "0.6"],
        &["--upper", "1"],
        &["--up", "1200", "--north", "300"],
    ];
    each_option_changes(&["--method", "sprites", "--at", "30"], &options);
}

#[test]
fn options_of_octaves_change_its_clouds() {
    let options: [&[&str]; 5] = [
        &["--octaves", "2"],
        &["--octaves", "8"],
        &["--sharpness", "0.5"],
        &["--formation-interval", "7"],
        &["--domes", "1,0,0"],
    ];
    each_option_changes(&["--method", "octaves", "--at", "30"], &options);
}

#[test]
fn options_of_fbm_change_its_clouds() {
    let options: [&[&str]; 4] = [
        &["--palette", "stormy"],
        &["--lit", "1,0.5,0.5"],
        &["--shaded", "0,0,0.2"],
        &["--sharpness", "1"],
    ];
    each_option_changes(&["--method", "fbm"], &options);
}

#[test]
fn options_of_lit_change_its_clouds() {
    let options: [&[&str]; 6] = [
        &["--layers", "cumulus"],
        &["--layers", "stratocumulus,cirrus:1:3"],
        &[
            "--layers",
            "cumulus,cumulus,cumulus,cumulus,cumulus,cumulus",
        ],
        &["--dome-radius", "30000"],
        &["--flattening", "0.5"],
        &["--formation-interval", "7"],
    ];
    each_option_changes(&["--method", "lit", "--at", "30"], &options);
    // Numbers of the paper's light alone.
    let paper = ["--method", "lit", "--shading", "paper"];
    each_option_changes(&paper, &[&["--k1", "0.1"], &["--k2", "0.1"], &["--m", "6"]]);
    let night = ["--method", "lit", "--time", "0"];
    each_option_changes(&night, &[&["--moon", "0"]]);
}

#[test]
fn the_order_of_layers_is_that_of_their_heights() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("frame.png");
    let of = |layers: &str| render(&file, &["--method", "lit", "--layers", layers]);
    assert!(of("cirrus:0.4,cumulus:0.6") == of("cumulus:0.6,cirrus:0.4"));
    assert!(of("cirrus:0.4,cumulus:0.6") != of("cumulus:0.4,cirrus:0.6"));
}

#[test]
fn oktas_find_the_cover_of_every_method() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("frame.png");
    for method in METHODS {
        let with = |words: &[&str]| render(&file, &[&["--method", method][..], words].concat());
        assert_eq!(with(&["--oktas", "0"]), with(&["--cover", "0"]), "{method}");
        assert_eq!(with(&["--oktas", "8"]), with(&["--cover", "1"]), "{method}");
        assert_ne!(with(&["--oktas", "3"]), with(&["--oktas", "5"]), "{method}");
    }
}

#[test]
fn oktas_that_the_other_options_do_not_allow_are_told() {
    let folder = tempfile::tempdir().unwrap();
    let attempts: [(&[&str], &[&str]); 3] = [
        (
            &["--oktas", "4", "--method", "octaves", "--domes", "0,0,0"],
            &["--oktas 4", "at most 0.0 oktas"],
        ),
        (
            &["--oktas", "4", "--method", "lit", "--layers", "cirrus:0"],
            &["--oktas 4", "at most 0.0 oktas"],
        ),
        (
            &["--oktas", "0", "--upper", "1"],
            &["--oktas 0", "at least"],
        ),
    ];
    for (words, told) in attempts {
        let mut command = view(&["render", "-o"]);
        command.arg(folder.path().join("frame.png")).arg(pack());
        command.args(words);
        failed(&run(command), 1, told);
    }
    assert_eq!(folder.path().read_dir().unwrap().count(), 0);
}

#[test]
fn shadows_lie_where_clouds_are_before_the_sun() {
    let folder = tempfile::tempdir().unwrap();
    let [frame, file] = ["frame.png", "shadow.png"].map(|name| folder.path().join(name));
    let shadow = |words: &[&str]| {
        let asked = ["--method", "lit", "--shadow", file.to_str().unwrap()];
        render(&frame, &[&asked[..], words].concat());
        let read = image::open(&file).unwrap();
        assert_eq!(
            (read.color(), read.width(), read.height()),
            (image::ColorType::L8, 256, 256)
        );
        read.into_bytes()
    };
    let fair = shadow(&[]);
    let [lit, dark] =
        [|b: &&u8| **b > 200, |b: &&u8| **b < 50].map(|f| fair.iter().filter(f).count());
    assert!(lit > 1000 && dark > 1000, "{lit} {dark}");
    assert!(shadow(&["--cover", "0"]).iter().all(|b| *b == 255));
    assert!(shadow(&["--cover", "1"]).iter().all(|b| *b < 50));
    for option in [
        ["--shadow-extent", "500"],
        ["--at", "100"],
        ["--time", "0.4"],
        ["--east", "3000"],
    ] {
        assert!(shadow(&option) != fair, "{option:?}");
    }
    // A viewer who goes four texels to the east finds the same shadows four texels further west. Places round otherwise
    // there: by 1/256 of a texel where the filter's weights have 8 bits, so by 1 byte a read of the map and less of the
    // finer one, six in all with three layers of both.
    let walked = shadow(&["--east", "125"]);
    let furthest = |shift: usize| {
        let rows = walked.chunks(256).zip(fair.chunks(256));
        let pairs = rows.flat_map(|(w, f)| w.iter().zip(&f[shift..]));
        pairs.map(|(w, f)| w.abs_diff(*f)).max().unwrap()
    };
    assert!(furthest(4) <= 6 && furthest(0) > 100, "{}", furthest(4));
    // The frame is the same, whether shadows are asked for or not.
    let with = std::fs::read(&frame).unwrap();
    assert!(render(&frame, &["--method", "lit", "--east", "125"]) == with);
}

#[test]
fn a_flash_lights_the_clouds_of_every_method_while_it_lasts() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("frame.png");
    for method in METHODS {
        let night = ["--method", method, "--time", "0", "--at", "10"];
        each_option_changes(
            &night,
            &[&["--lightning", "0,3"], &["--lightning", "0,3,9.95,0.5"]],
        );
        let dark = render(&file, &night);
        // Over, not yet begun, without strength.
        for nothing in ["0,3,5", "0,3,11", "0,3,9.99,0"] {
            let flash = [&night[..], &["--lightning", nothing]].concat();
            assert!(render(&file, &flash) == dark, "{method} {nothing}");
        }
    }
}

#[test]
fn rays_and_rain_come_over_the_clouds_of_every_method() {
    for method in METHODS {
        let towards_the_sun = ["--method", method, "--elevation", "45", "--time", "0.4"];
        each_option_changes(&towards_the_sun, &[&["--rain", "1"], &["--rain", "0.3"]]);
        // Rays come of the clouds of a dome: of sprites, of that behind them.
        let dome: &[&str] = match method {
            "sprites" => &["--behind", "lit", "--behind-cover", "0.6"],
            _ => &[],
        };
        each_option_changes(&[&towards_the_sun, dome].concat(), &[&["--rays", "1"]]);
    }
    // Nothing else moves in still air by day. Drops are thin: it takes a narrow view for so few pixels to show them.
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("frame.png");
    let moves = |words: &[&str]| {
        let still = [&["--speed", "0", "--fov", "8"], words].concat();
        let later = [&still[..], &["--at", "0.1"]].concat();
        render(&file, &still) != render(&file, &later)
    };
    assert!(!moves(&[]) && moves(&["--rain", "1"]));
}

#[test]
fn sun_flare_and_stars_can_be_left_out() {
    let towards_the_sun = ["--cover", "0", "--azimuth", "180", "--elevation", "50"];
    each_option_changes(&towards_the_sun, &[&["--no-sun"], &["--flare", "0.5"]]);
    let with_flare = [&towards_the_sun[..], &["--flare", "1"]].concat();
    each_option_changes(&with_flare, &[&["--starburst"]]);
    // As many stars as a small texture has: a wide view of a clear night holds some.
    let night = ["--cover", "0", "--time", "0", "--fov", "120"];
    each_option_changes(&night, &[&["--no-stars"]]);
}

#[test]
fn clouds_move_when_the_viewer_does_and_the_sky_stays() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("frame.png");
    for method in METHODS {
        let words = ["--method", method];
        let places: [&[&str]; 2] = [&["--east", "-300"], &["--north", "300"]];
        each_option_changes(&words, &places);
        // Away from the ground, which is near.
        let clear = [&words[..], &["--cover", "0", "--elevation", "70"]].concat();
        let here = render(&file, &clear);
        assert_eq!(
            render(&file, &[&clear[..], places[0]].concat()),
            here,
            "{method}"
        );
    }
}

/// A pack with a red panorama around it.
fn pack_with_skybox(folder: &Path) -> PathBuf {
    let red = image::RgbImage::from_pixel(64, 32, image::Rgb([250, 10, 10]));
    red.save(folder.join("red.png")).unwrap();
    let recipe = format!("{RECIPE}[skybox]\nfile = \"red.png\"\n");
    bake("skybox", &recipe, Some(folder))
}

#[test]
fn a_skybox_stands_behind_the_clouds_as_far_as_it_is_told_to() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("frame.png");
    let pack_with_skybox = pack_with_skybox(folder.path());
    let redness = |words: &[&str]| {
        let words = [&["--cover", "0"], words].concat();
        let frame = render_of(&pack_with_skybox, &file, &words);
        let picture = image::load_from_memory(&frame).unwrap().into_rgb8();
        let sum =
            |channel: usize| -> i64 { picture.pixels().map(|p| i64::from(p.0[channel])).sum() };
        sum(0) - sum(2)
    };
    let [none, half, whole] =
        [["--skybox", "0"], ["--skybox", "0.5"], ["--skybox", "1"]].map(|s| redness(&s));
    // The day's sky is blue, the panorama red, and the half of both lies between.
    assert!(
        none < 0 && none < half && half < whole && whole > 0,
        "{none} {half} {whole}"
    );
    assert_eq!(redness(&[]), whole);
}

#[test]
fn a_skybox_that_the_pack_has_not_is_not_passed_over_in_silence() {
    let folder = tempfile::tempdir().unwrap();
    let mut command = view(&["render", "--skybox", "0.5", "-o"]);
    command.arg(folder.path().join("frame.png")).arg(pack());
    failed(&run(command), 1, &["has no skybox", "[skybox]"]);
    assert_eq!(folder.path().read_dir().unwrap().count(), 0);
}

#[test]
fn wrong_options_of_a_method_are_told_and_leave_nothing() {
    let folder = tempfile::tempdir().unwrap();
    let attempts: [(&[&str], &[&str]); 10] = [
        (
            &["--octaves", "4"],
            &[
                "--octaves belongs to --method octaves",
                "packed does not use it",
            ],
        ),
        (
            &["--method", "octaves", "--octaves", "9"],
            &["--octaves", "1 to 8"],
        ),
        (
            &["--method", "octaves", "--formation-interval", "0"],
            &["--formation-interval", "0.1 to 86400 seconds"],
        ),
        (
            &["--method", "octaves", "--palette", "stormy"],
            &["--palette belongs to --method fbm"],
        ),
        (
            &["--method", "fbm", "--lit", "1,nan,1"],
            &["--lit", "three numbers"],
        ),
        (
            &["--method", "lit", "--flattening", "0"],
            &["--flattening", "a number from 0.02 to 1"],
        ),
        (
            &["--method", "lit", "--layers", "cumulus,nimbus:0.5"],
            &["--layers", "nimbus", "stratocumulus, cumulus, cirrus"],
        ),
        (
            &["--method", "octaves", "--layers", "cumulus"],
            &["--layers belongs to --method lit"],
        ),
        (
            &["--lightning", "1,2,3,4"],
            &["--lightning", "STRENGTH is \"4\"", "0 to 1"],
        ),
        (&["--east", "nan"], &["--east", "metres"]),
    ];
    for (words, told) in attempts {
        let mut command = view(&["render", "-o"]);
        command.arg(folder.path().join("frame.png")).arg(pack());
        command.args(words);
        failed(&run(command), 2, told);
    }
    assert_eq!(folder.path().read_dir().unwrap().count(), 0);
}
