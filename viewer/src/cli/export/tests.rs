use super::*;
use crate::cli::render::RenderArgs;
use crate::cli::{Cli, Command};

fn read(output: &str, args: &[&str]) -> Result<Box<RenderArgs>, String> {
    let words = ["welkin-view", "render", "pack", "-o", output];
    match Cli::read(words.iter().chain(args)).map(|cli| cli.command) {
        Ok(Some(Command::Render(render))) => Ok(render),
        Ok(other) => panic!("{args:?}: {other:?}"),
        Err(error) => Err(error.to_string()),
    }
}

fn shot(output: &str, args: &[&str]) -> Result<Shot, String> {
    read(output, args).and_then(|render| render.shot())
}

#[test]
fn what_is_drawn_follows_from_options_and_name() {
    for (output, args, wanted) in [
        ("f.png", &[][..], Shot::Frame(Format::Png)),
        ("f.HDR", &[], Shot::Frame(Format::Hdr)),
        (
            "f.exr",
            &["--equirect", "2048"],
            Shot::Equirect(2048, Format::Exr),
        ),
        (
            "f.hdr",
            &["--equirect", "32"],
            Shot::Equirect(32, Format::Hdr),
        ),
        (
            "f.png",
            &["--equirect", "8192"],
            Shot::Equirect(8192, Format::Png),
        ),
        ("f.ktx2", &["--cubemap", "16"], Shot::Ktx2(16)),
        (
            "f.ktx2",
            &["--cubemap", "512", "--format", "ktx2"],
            Shot::Ktx2(512),
        ),
        (
            "f.ktx2",
            &["--cubemap", "64", "--prefiltered"],
            Shot::Ktx2(64),
        ),
        (
            "sky",
            &["--cubemap", "2048"],
            Shot::Faces(2048, Format::Exr),
        ),
        (
            "sky",
            &["--cubemap", "512", "--format", "hdr"],
            Shot::Faces(512, Format::Hdr),
        ),
        (
            "sky",
            &["--cubemap", "512", "--format", "png"],
            Shot::Faces(512, Format::Png),
        ),
        ("sky", &["--frames", "9"], Shot::Frame(Format::Png)),
        (
            "sky.d",
            &["--frames", "9", "--format", "exr"],
            Shot::Frame(Format::Exr),
        ),
        (
            "sky",
            &["--frames", "9", "--equirect", "64"],
            Shot::Equirect(64, Format::Exr),
        ),
        ("sky", &["--frames", "9", "--cubemap", "64"], Shot::Ktx2(64)),
    ] {
        assert_eq!(shot(output, args), Ok(wanted), "{output} {args:?}");
    }
}

#[test]
fn numbers_outside_their_range_are_refused_with_the_range() {
    for (option, expected, values) in [
        (
            "--equirect",
            "an even number from 32 to 8192",
            ["30", "8194", "2047", "-2", "wide"],
        ),
        (
            "--cubemap",
            "a power of two from 16 to 2048",
            ["8", "4096", "500", "-16", "0"],
        ),
        (
            "--frames",
            "a whole number from 1 to 1000000",
            ["0", "1000001", "1.5", "", "all"],
        ),
    ] {
        for value in values {
            let error = read("sky", &[option, value]).unwrap_err();
            assert!(
                error.contains(option) && error.contains(expected),
                "{value}: {error}"
            );
        }
    }
    for value in ["0", "1001", "nan", "-1", "inf"] {
        let error = read("sky", &["--frames", "2", "--fps", value]).unwrap_err();
        assert!(
            error.contains("0.001 to 1000 frames a second"),
            "{value}: {error}"
        );
    }
    let error = read("sky", &["--frames", "2", "--shard", "3/2"]).unwrap_err();
    assert!(
        error.contains("--shard") && error.contains("PART/PARTS"),
        "{error}"
    );
}

#[test]
fn names_and_formats_that_do_not_suit_are_told_with_a_remedy() {
    for (output, args, told) in [
        ("f.gif", &["--equirect", "64"][..], ".exr and .hdr"),
        ("f.ktx2", &["--equirect", "64"], ".ktx2 is for --cubemap"),
        ("f.png", &["--format", "png"], "leave it out"),
        (
            "f.exr",
            &["--equirect", "64", "--format", "exr"],
            "leave it out",
        ),
        ("f.exr", &["--cubemap", "64"], "name a folder"),
        (
            "sky",
            &["--cubemap", "64", "--format", "ktx2"],
            "something.ktx2",
        ),
        (
            "f.ktx2",
            &["--cubemap", "64", "--format", "exr"],
            "name a folder",
        ),
        (
            "sky",
            &["--cubemap", "64", "--prefiltered"],
            "something.ktx2",
        ),
        (
            "sky",
            &["--cubemap", "64", "--prefiltered", "--frames", "2"],
            "one by one",
        ),
        ("f.ktx2", &["--prefiltered"], "--cubemap"),
        ("f.png", &["--frames", "2"], "name a folder"),
        (
            "f.ktx2",
            &["--frames", "2", "--cubemap", "64"],
            "name a folder",
        ),
        (
            "sky",
            &["--frames", "2", "--cubemap", "64", "--format", "exr"],
            "take --equirect",
        ),
        (
            "sky",
            &["--frames", "2", "--format", "ktx2"],
            "belongs to --cubemap",
        ),
    ] {
        let error = read(output, args).unwrap_err();
        assert!(
            error.contains(told) && error.contains("Usage:"),
            "{output} {args:?}: {error}"
        );
    }
}

#[test]
fn options_that_do_not_hold_everywhere_are_refused() {
    let maps = [
        ("f.exr", ["--equirect", "64"]),
        ("f.ktx2", ["--cubemap", "64"]),
    ];
    for (output, map) in maps {
        for option in [
            &["--size", "64x64"][..],
            &["--elevation", "0"],
            &["--fov", "90"],
            &["--flare", "0.5"],
            &["--starburst"],
            &["--rain", "0.5"],
            &["--method", "lit", "--shadow", "s.png"],
        ] {
            let error = read(output, &[&map[..], option].concat()).unwrap_err();
            let name = option.iter().rfind(|word| word.starts_with("--")).unwrap();
            let told = format!("{name} does not go with {}", map[0]);
            assert!(
                error.contains(&told) && error.contains("leave it out"),
                "{error}"
            );
        }
        // What holds is taken.
        let holds = [
            "--flare",
            "0",
            "--rain",
            "0",
            "--rays",
            "1",
            "--up",
            "1000",
            "--lightning",
            "1,2",
        ];
        assert!(read(output, &[&map[..], &holds].concat()).is_ok());
    }
    assert!(read("f.exr", &["--equirect", "64", "--azimuth", "90"]).is_ok());
    let error = read("f.ktx2", &["--cubemap", "64", "--azimuth", "90"]).unwrap_err();
    assert!(error.contains("axes of the world"), "{error}");
    let both = read("f.ktx2", &["--cubemap", "64", "--equirect", "64"]).unwrap_err();
    assert!(both.contains("cannot be used with"), "{both}");
}

#[test]
fn a_sequence_and_its_parts() {
    let args = ["--frames", "48", "--at", "10"];
    let of = |more: &[&str]| {
        let render = read("sky", &[&args[..], more].concat()).unwrap();
        render
            .export
            .sequence(render.settings.settings.at_s)
            .unwrap()
    };
    let defaults = Sequence {
        frames: 48,
        fps: USUAL_FPS,
        start_s: 10.0,
        looped: false,
        shard: Shard::WHOLE,
    };
    assert_eq!(of(&[]), defaults);
    let part = Sequence {
        fps: 23.976,
        shard: Shard { index: 2, count: 4 },
        ..defaults
    };
    assert_eq!(of(&["--fps", "23.976", "--shard", "2/4"]), part);
    assert_eq!(read("f.png", &[]).unwrap().export.sequence(0.0), None);
    for option in [["--fps", "24"], ["--shard", "1/2"]] {
        let error = read("f.png", &option).unwrap_err();
        assert!(error.contains("--frames"), "{error}");
    }
    let error = read("sky", &["--frames", "3", "--shard", "1/4"]).unwrap_err();
    assert!(error.contains("at most 3 parts"), "{error}");
    let shadow = ["--frames", "3", "--method", "lit", "--shadow", "s.png"];
    let error = read("sky", &shadow).unwrap_err();
    assert!(error.contains("--shadow names one picture"), "{error}");
}

#[test]
fn a_loop_is_a_sequence_of_whole_frames() {
    let of = |args: &[&str]| {
        let render = read("sky", args).unwrap();
        assert_eq!(render.shot(), Ok(Shot::Frame(Format::Png)));
        render.export.sequence(0.0).unwrap()
    };
    let minute = Sequence {
        frames: 1800,
        fps: 30.0,
        start_s: 0.0,
        looped: true,
        shard: Shard::WHOLE,
    };
    assert_eq!(of(&["--loop", "60"]), minute);
    let film = of(&["--loop", "10", "--fps", "23.976", "--shard", "2/4"]);
    assert_eq!((film.frames, film.shard.count, film.looped), (240, 4, true));
    assert!(shot("sky", &["--loop", "9", "--cubemap", "64"]).is_ok());
    assert!(shot("sky", &["--loop", "9", "--rain", "1"]).is_ok());
}

#[test]
fn what_cannot_begin_again_is_refused_with_what_can() {
    for (args, told) in [
        (&["--loop", "0.5"][..], "from 1 to 86400 seconds"),
        (&["--loop", "9", "--frames", "9"], "cannot be used with"),
        (
            &["--loop", "9", "--lightning", "1,2"],
            "leave it out, or take --frames",
        ),
        (&["--loop", "1", "--fps", "1"], "choose a longer loop"),
        (&["--loop", "80000"], "choose a shorter loop"),
        (&["--loop", "1", "--shard", "1/31"], "at most 30 parts"),
        (
            &["--loop", "1", "--method", "lit", "--shadow", "s.png"],
            "and --loop draws many",
        ),
        (
            &["--loop", "1", "--cubemap", "64", "--prefiltered"],
            "and --loop draws many",
        ),
    ] {
        let error = read("sky", args).unwrap_err();
        assert!(
            error.contains("--loop") && error.contains(told),
            "{args:?}: {error}"
        );
    }
    let error = read("sky.png", &["--loop", "1"]).unwrap_err();
    assert!(error.contains("--loop writes a folder"), "{error}");
}
