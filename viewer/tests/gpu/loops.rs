//! `welkin-view render --loop`, run as its users run it.

// The lint's exception for tests does not reach their helpers.
#![allow(clippy::unwrap_used)]

use std::fs;

use crate::common::{done, files, render_to};

/// Root of the mean square difference of two pictures.
fn apart(one: &[u8], other: &[u8]) -> f64 {
    let [one, other] = [one, other].map(|png| image::load_from_memory(png).unwrap().into_rgb8());
    let pairs = one.as_raw().iter().zip(other.as_raw());
    let square = pairs.map(|(a, b)| (f64::from(*a) - f64::from(*b)).powi(2));
    (square.sum::<f64>() / one.as_raw().len() as f64).sqrt()
}

#[test]
fn the_last_frame_of_a_loop_goes_on_into_the_first() {
    let folder = tempfile::tempdir().unwrap();
    let [place, parts] = ["loop", "parts"].map(|name| folder.path().join(name));
    for method in ["packed", "octaves", "fbm", "lit", "sprites"] {
        let view = [
            "--method", method, "--size", "64x48", "--at", "5", "--speed", "1",
        ];
        let words = [&view[..], &["--loop", "8", "--fps", "3"]].concat();
        done(render_to(&place, &words));
        let frames = files(&place);
        let frames: Vec<&Vec<u8>> = frames.values().collect();
        assert_eq!(frames.len(), 24);
        let changes: Vec<f64> = frames
            .windows(2)
            .map(|pair| apart(pair[0], pair[1]))
            .collect();
        let around = apart(frames[23], frames[0]);
        let [least, most] =
            [f64::min, f64::max].map(|of| changes.iter().copied().reduce(of).unwrap());
        // Both sides of the seam only drift, and so do few others.
        assert!(
            (0.9 * least..=most).contains(&around),
            "{method}: {around} {changes:?}"
        );
        // The sky at --at, and without a loop the last frame is far from it.
        let alone = folder.path().join("alone.png");
        done(render_to(&alone, &view));
        assert!(&fs::read(&alone).unwrap() == frames[0], "{method}");
        let later = [&view[..4], &["--speed", "1", "--at", "12.666666666666666"]].concat();
        done(render_to(&alone, &later));
        assert!(
            apart(&fs::read(&alone).unwrap(), frames[0]) > 1.5 * most,
            "{method}"
        );
        // And it is drawn in parts as any sequence.
        if method == "sprites" {
            for shard in ["1/2", "2/2"] {
                done(render_to(
                    &parts,
                    &[&words[..], &["--shard", shard]].concat(),
                ));
            }
            assert!(files(&parts) == files(&place));
        }
    }
}

#[test]
fn loops_are_of_maps_and_of_radiance_too() {
    let folder = tempfile::tempdir().unwrap();
    for (name, words, last) in [
        ("a", &["--equirect", "32"][..], "frame-000002.exr"),
        ("b", &["--cubemap", "16"], "frame-000002.ktx2"),
        (
            "c",
            &["--size", "8x8", "--format", "hdr"],
            "frame-000002.hdr",
        ),
    ] {
        let place = folder.path().join(name);
        let moving = ["--speed", "1", "--loop", "30", "--fps", "0.1"];
        done(render_to(&place, &[words, &moving].concat()));
        let made = files(&place);
        let mut different: Vec<_> = made.values().collect();
        different.sort();
        different.dedup();
        assert!(
            different.len() == 3 && made.contains_key(last),
            "{:?}",
            made.keys()
        );
    }
}
