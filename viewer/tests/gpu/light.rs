//! Image-based light by the program, run as its users run it: of a pack's sky, and of a panorama.

// The lint's exception for tests does not reach their helpers.
#![allow(clippy::unwrap_used)]

use std::f64::consts::PI;
use std::fs;
use std::path::Path;
use std::process::Command;

use serde_json::Value;
use welkin_pack::{Texture, ktx};
use welkin_viewer::export::cube::{texel_direction, texel_solid_angle};
use welkin_viewer::export::harmonics::{COUNT, Harmonics};

use crate::common::{done, failed, pack, render_to, run, view};

/// `welkin-view cube` of a panorama into this place.
fn cube(panorama: &Path, output: &Path, words: &[&str]) -> Command {
    let mut command = view(&["cube"]);
    command.arg(panorama).arg("-o").arg(output).args(words);
    command
}

/// A texture, what its key/value data says, and the JSON beside it.
struct Files {
    texture: Texture,
    texts: Vec<(String, String)>,
    json: Value,
    harmonics: Harmonics,
}

/// Both files, the container by the crate `ktx2`.
fn files(texture: &Path) -> Files {
    let bytes = fs::read(texture).unwrap();
    let reader = ktx2::Reader::new(&bytes[..]).unwrap();
    let texts = reader.key_value_data().map(|(key, value)| {
        let text = std::str::from_utf8(value).unwrap();
        (key.to_string(), text.trim_end_matches('\0').to_string())
    });
    let json = fs::read_to_string(texture.with_extension("json")).unwrap();
    let json: Value = serde_json::from_str(&json).unwrap();
    let number = |value: &Value| value.as_f64().unwrap();
    let coefficients = &json["irradiance"]["coefficients"];
    Files {
        texture: ktx::decode("sky.ktx2", &bytes).unwrap(),
        texts: texts.collect(),
        harmonics: Harmonics {
            coefficients: std::array::from_fn::<_, COUNT, _>(|i| {
                [0, 1, 2].map(|channel| number(&coefficients[i][channel]))
            }),
        },
        json,
    }
}

/// Radiance of a texel.
fn radiance(texture: &Texture, level: usize, face: usize, at: [u32; 2]) -> [f64; 3] {
    let image = texture.image(level, face as u32);
    let texel = image.texel(at[0], at[1]);
    [0, 1, 2].map(|i| f64::from(texel[i]))
}

/// Face, place, unit direction and solid angle of every texel of a level.
fn places(side: u32) -> impl Iterator<Item = (usize, [u32; 2], [f64; 3], f64)> {
    let all = (0..6).flat_map(move |face| (0..side * side).map(move |i| (face, i)));
    all.map(move |(face, i)| {
        let at = [i % side, i / side];
        let direction = texel_direction(face, at, side).as_dvec3().normalize();
        (face, at, direction.to_array(), texel_solid_angle(at, side))
    })
}

/// Irradiance by the sum over all texels of level 0, and what a plane would have that faced all of them.
fn brute_force(texture: &Texture, normal: [f64; 3]) -> ([f64; 3], [f64; 3]) {
    let (mut sum, mut all) = ([0.0; 3], [0.0; 3]);
    let images = [0, 1, 2, 3, 4, 5].map(|face| texture.image(0, face));
    for (face, at, direction, angle) in places(texture.width) {
        let cosine: f64 = direction.iter().zip(normal).map(|(d, n)| d * n).sum();
        let texel = images[face].texel(at[0], at[1]);
        for i in 0..3 {
            all[i] += angle * f64::from(texel[i]);
            sum[i] += angle * cosine.max(0.0) * f64::from(texel[i]);
        }
    }
    (sum, all)
}

const NORMALS: [[f64; 3]; 6] = [
    [0.0, 1.0, 0.0],
    [1.0, 0.0, 0.0],
    [0.0, 0.0, -1.0],
    [-0.6, 0.8, 0.0],
    [0.36, 0.48, 0.8],
    [0.0, -1.0, 0.0],
];

#[test]
fn a_real_sky_has_its_irradiance_and_its_levels() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("sky.ktx2");
    for words in [
        &["--time", "0.45", "--cover", "0.3"][..],
        &["--time", "0.742", "--sunset", "1", "--method", "lit"],
        &["--time", "0.45", "--cover", "1"],
        &["--time", "0.02"],
    ] {
        let map = ["--cubemap", "64", "--prefiltered"];
        done(render_to(&file, &[&map[..], words].concat()));
        let Files {
            texture,
            texts,
            json,
            harmonics,
        } = files(&file);
        assert_eq!(
            (texture.width, texture.layers, texture.levels.len()),
            (64, 6, 4)
        );
        assert_eq!(
            json["source"],
            pack().file_name().unwrap().to_str().unwrap()
        );
        assert_eq!(json["texture"], "sky.ktx2");
        let text = |key: &str| &texts.iter().find(|(k, _)| k == key).unwrap().1;
        assert_eq!(text("KTXorientation"), "rd");
        let scale: f64 = text("welkinRadianceScale").parse().unwrap();
        assert_eq!(json["radiance_scale"], scale);
        for normal in NORMALS {
            let (exact, all) = brute_force(&texture, normal);
            let found = harmonics.irradiance(normal);
            for i in 0..3 {
                let off = (found[i] - scale * exact[i]) / (scale * all[i]);
                // What nine terms of a light alone leave out, of all lights: `harmonics/tests.rs`. Half floats are rounded.
                assert!(
                    (-0.041..0.095).contains(&off),
                    "{words:?} {normal:?}: {off}"
                );
                println!(
                    "{words:?} {normal:?} {i}: {:+.2} %",
                    100.0 * (found[i] / (scale * exact[i]) - 1.0)
                );
            }
        }
        // The last level is the irradiance over π: within 3 %, as `prefilter/tests.rs` says, and half a step of a half float.
        for (face, at, direction, _) in places(8).step_by(37) {
            let (exact, _) = brute_force(&texture, direction);
            let found = radiance(&texture, 3, face, at);
            for (found, exact) in found.iter().zip(exact) {
                assert!((found * PI / exact - 1.0).abs() < 0.031, "{words:?}");
            }
        }
    }
}

#[test]
fn a_panorama_of_a_sky_is_the_light_of_that_sky() {
    let folder = tempfile::tempdir().unwrap();
    let place = |name: &str| folder.path().join(name);
    let sky = ["--time", "0.4", "--cover", "0.2"];
    let map = ["--cubemap", "64", "--prefiltered"];
    done(render_to(&place("sky.ktx2"), &[&map[..], &sky].concat()));
    let wanted = files(&place("sky.ktx2"));
    for (name, azimuth) in [("north.exr", "0"), ("east.hdr", "90")] {
        let panorama = ["--equirect", "1024", "--azimuth", azimuth];
        done(render_to(&place(name), &[&panorama[..], &sky].concat()));
        let words = ["--size", "64", "--azimuth", azimuth];
        assert_eq!(done(cube(&place(name), &place("cube.ktx2"), &words)), "");
        let found = files(&place("cube.ktx2"));
        assert_eq!(found.json["source"], name);
        assert_eq!(found.json["levels"], wanted.json["levels"]);
        assert_eq!(found.texture.levels.len(), wanted.texture.levels.len());
        for normal in NORMALS {
            let pair = [&found, &wanted].map(|files| files.harmonics.irradiance(normal));
            for (found, wanted) in pair[0].iter().zip(pair[1]) {
                // The sun is drawn with 2x2 pixels a texel for the one and with 4 of 512 a side for the other: 2 % of its light, 2 % where it
                // is resampled, and 1/256 of RGBE.
                assert!(
                    (found / wanted - 1.0).abs() < 0.045,
                    "{name} {normal:?}: {found} {wanted}"
                );
            }
        }
    }
}

#[test]
fn the_number_of_threads_changes_no_byte() {
    let folder = tempfile::tempdir().unwrap();
    let place = |name: &str| folder.path().join(name);
    done(render_to(
        &place("sky.exr"),
        &["--equirect", "256", "--time", "0.4"],
    ));
    let with = |threads: &str| {
        let file = place("cube.ktx2");
        let mut command = cube(&place("sky.exr"), &file, &["--size", "64"]);
        command.env("RAYON_NUM_THREADS", threads);
        done(command);
        [file.clone(), file.with_extension("json")].map(|file| fs::read(file).unwrap())
    };
    assert!(with("1") == with("3"));
}

#[test]
fn inputs_stay_and_outputs_come_whole_or_not_at_all() {
    let folder = tempfile::tempdir().unwrap();
    let place = |name: &str| folder.path().join(name);
    let names = || {
        let entries = folder.path().read_dir().unwrap();
        let names = entries.map(|e| e.unwrap().file_name().into_string().unwrap());
        let mut names: Vec<_> = names.collect();
        names.sort();
        names
    };
    done(render_to(&place("sky.hdr"), &["--equirect", "32"]));
    let bytes = fs::read(place("sky.hdr")).unwrap();
    // A panorama whose name is that of the texture, or of the JSON.
    for (input, output) in [("a.ktx2", "a.ktx2"), ("b.json", "b.ktx2")] {
        fs::write(place(input), &bytes).unwrap();
        failed(
            &run(cube(&place(input), &place(output), &[])),
            1,
            &[input, "is read"],
        );
        assert!(fs::read(place(input)).unwrap() == bytes);
    }
    // Where a folder stands in the way of the one, the other is not written either.
    fs::create_dir(place("c.json")).unwrap();
    failed(
        &run(cube(&place("sky.hdr"), &place("c.ktx2"), &["--size", "16"])),
        1,
        &["c.json", "is not a file"],
    );
    let light = ["--cubemap", "16", "--prefiltered"];
    failed(
        &run(render_to(&place("c.ktx2"), &light)),
        1,
        &["c.json", "is not a file"],
    );
    failed(
        &run(cube(
            &place("sky.hdr"),
            &place("none/d.ktx2"),
            &["--size", "16"],
        )),
        1,
        &["cannot be written"],
    );
    let inside = pack().join("light.ktx2");
    failed(&run(render_to(&inside, &light)), 1, &["light.ktx2"]);
    assert!(!inside.exists());
    // What is no panorama.
    fs::write(place("text.hdr"), "no light").unwrap();
    done(render_to(&place("frame.hdr"), &["--size", "40x30"]));
    for (input, told) in [
        ("none.hdr", "cannot be read"),
        ("text.hdr", "unknown"),
        ("frame.hdr", "twice as wide as high"),
    ] {
        failed(
            &run(cube(&place(input), &place("d.ktx2"), &[])),
            1,
            &[input, told],
        );
    }
    assert_eq!(
        names(),
        [
            "a.ktx2",
            "b.json",
            "c.json",
            "frame.hdr",
            "sky.hdr",
            "text.hdr"
        ]
    );
    // Those that are there are replaced.
    for _ in 0..2 {
        done(cube(&place("sky.hdr"), &place("e.ktx2"), &["--size", "16"]));
    }
    assert_eq!(files(&place("e.ktx2")).texture.width, 16);
}
