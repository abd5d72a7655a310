//! `welkin-view render` for environment maps and sequences, run as its users run it.

// The lint's exception for tests does not reach their helpers.
#![allow(clippy::unwrap_used)]

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use exr::prelude::read_first_rgba_layer_from_file;
use glam::Vec3;
use half::f16;
use welkin_runtime::SkyParams;
use welkin_runtime::internals::tonemap;
use welkin_runtime::params::Tonemap;

use crate::common::{done, failed, files, render_to, run};

/// Width, height and RGB of an EXR, row by row: the reader hands out its blocks in any order.
fn exr(file: &Path) -> (usize, usize, Vec<[f16; 3]>) {
    let image = read_first_rgba_layer_from_file(
        file,
        |size, _| (size.width(), vec![[f16::ZERO; 3]; size.area()]),
        |(width, pixels): &mut (usize, Vec<[f16; 3]>), at, (r, g, b, _): (f16, f16, f16, f16)| {
            pixels[at.y() * *width + at.x()] = [r, g, b];
        },
    )
    .unwrap();
    let size = image.layer_data.size;
    let (_, pixels) = image.layer_data.channel_data.pixels;
    (size.width(), size.height(), pixels)
}

#[test]
fn a_panorama_is_the_same_sky_in_every_format() {
    let folder = tempfile::tempdir().unwrap();
    let place = |name: &str| folder.path().join(name);
    let with_sun = ["--equirect", "128", "--time", "0.4", "--cover", "0"];
    done(render_to(&place("sun.exr"), &with_sun));
    // The sun is brighter than white.
    let (.., radiance) = exr(&place("sun.exr"));
    assert!(radiance.iter().any(|p| p[0].to_f32() > 1.0));
    // A lens would scatter its light over a picture for a display, and its edge moves by the rounding of angles.
    let words = [&with_sun[..], &["--no-sun"]].concat();
    for name in ["sky.exr", "sky.hdr"] {
        done(render_to(&place(name), &words));
    }
    let filmic = [&words[..], &["--tonemap", "filmic"]].concat();
    done(render_to(&place("sky.png"), &filmic));
    let (width, height, radiance) = exr(&place("sky.exr"));
    assert_eq!((width, height), (128, 64));
    let hdr = image::open(place("sky.hdr")).unwrap().into_rgb32f();
    let png = image::open(place("sky.png")).unwrap().into_rgb8();
    assert_eq!((hdr.dimensions(), png.dimensions()), ((128, 64), (128, 64)));
    for ((radiance, hdr), png) in radiance.iter().zip(hdr.pixels()).zip(png.pixels()) {
        let radiance = radiance.map(f16::to_f32);
        let brightest = radiance.into_iter().fold(0.0, f32::max);
        for channel in 0..3 {
            // Half a step of RGBE, at most a 256th of the brightest channel, and what half floats have rounded.
            assert!(
                (hdr.0[channel] - radiance[channel]).abs()
                    <= brightest * (1.0 / 256.0 + 1.0 / 2048.0),
                "{hdr:?} {radiance:?}"
            );
            // (x + a x^2) / (1 + b x + a x^2), and sRGB; half a step of dither and half a byte.
            let x = radiance[channel] * welkin_runtime::SkyParams::default().exposure;
            let toned = ((x + 0.5 * x * x) / (1.0 + 0.244 * x + 0.5 * x * x)).min(1.0);
            let encoded = if toned <= 0.003_130_8 {
                12.92 * toned
            } else {
                1.055 * toned.powf(1.0 / 2.4) - 0.055
            };
            assert!((encoded * 255.0 - f32::from(png.0[channel])).abs() < 1.01);
        }
    }
    // East in the middle is a quarter turn.
    done(render_to(
        &place("east.exr"),
        &[&words[..], &["--azimuth", "90"]].concat(),
    ));
    let (.., east) = exr(&place("east.exr"));
    let mut apart = 0.0_f32;
    for (row, turned) in radiance.chunks(128).zip(east.chunks(128)) {
        for (x, texel) in turned.iter().enumerate() {
            for (a, b) in row[(x + 32) % 128].iter().zip(texel) {
                apart = apart.max((a.to_f32() - b.to_f32()).abs() / (0.1 + a.to_f32()));
            }
        }
    }
    // The same samples, but for the rounding of angles: steps of half floats.
    assert!(apart < 0.01, "{apart}");
}

#[test]
fn a_panorama_is_exposed_automatically_where_that_is_asked_for() {
    let folder = tempfile::tempdir().unwrap();
    let mean = |name: &str, words: &[&str]| {
        let place = folder.path().join(name);
        done(render_to(&place, words));
        let picture = image::open(&place).unwrap().into_rgb8();
        let sum: u64 = picture.pixels().map(|p| u64::from(p.0[1])).sum();
        sum as f32 / (picture.width() * picture.height()) as f32
    };
    let evening = ["--equirect", "64", "--time", "0.75", "--cover", "0"];
    let automatic = [&evening[..], &["--auto-exposure"]].concat();
    assert!(mean("auto.png", &automatic) > 1.2 * mean("fixed.png", &evening));
}

#[test]
fn a_picture_of_a_panorama_has_the_curve_and_the_exposure_that_were_asked_for() {
    let folder = tempfile::tempdir().unwrap();
    let place = |name: &str| folder.path().join(name);
    let words = ["--equirect", "64", "--time", "0.4", "--cover", "0.3"];
    done(render_to(&place("sky.exr"), &words));
    let (.., radiance) = exr(&place("sky.exr"));
    for tonemap in Tonemap::ALL {
        let own = ["--tonemap", tonemap.name(), "--exposure-ev", "-1"];
        done(render_to(&place("sky.png"), &[&words[..], &own].concat()));
        let png = image::open(place("sky.png")).unwrap().into_rgb8();
        for (radiance, png) in radiance.iter().zip(png.pixels()) {
            let factor = 0.5 * SkyParams::default().exposure;
            let exposed = Vec3::from([0, 1, 2].map(|c| factor * radiance[c].to_f32()));
            let steps = tonemap::srgb_encoded(tonemap::displayed(exposed, tonemap)) * 255.0;
            // Half a step of dither and half a byte.
            let off = steps - Vec3::from(png.0.map(f32::from));
            assert!(
                off.abs().max_element() < 1.01,
                "{tonemap:?} {steps} {png:?}"
            );
        }
    }
}

#[test]
fn what_is_below_the_horizon_is_the_haze_of_the_ground() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("sky.exr");
    done(render_to(&file, &["--equirect", "64", "--time", "0.45"]));
    let (.., radiance) = exr(&file);
    let mean = |row: usize| {
        let row = &radiance[row * 64..(row + 1) * 64];
        row.iter().map(|p| p[1].to_f32()).sum::<f32>() / 64.0
    };
    // Darker the further down, but for the patches that a row passes, and never black.
    let zone = |rows: std::ops::Range<usize>| {
        let count = rows.len() as f32;
        rows.map(mean).sum::<f32>() / count
    };
    let zones = [16..18, 18..22, 22..32].map(zone);
    assert!(
        zones.is_sorted_by(|above, below| above > below),
        "{zones:?}"
    );
    assert!((17..32).all(|row| (0.2..1.0).contains(&(mean(row) / mean(16)))));
}

/// The container of a KTX2 file and its texels, by ktx-parse and zstddec.
fn ktx_parse(file: &Path) -> (serde_json::Value, Vec<u8>) {
    let folder = file.parent().unwrap();
    let script = Path::new(env!("CARGO_MANIFEST_DIR")).join("../tests/node/read.mjs");
    let output = Command::new("node")
        .arg(script)
        .args([folder, file])
        .output()
        .expect("node runs; `make tools` installs it");
    let stderr = String::from_utf8_lossy(&output.stderr);
    assert!(
        output.status.success(),
        "{stderr}; `make tools` installs ktx-parse"
    );
    let raw = PathBuf::from(format!("{}.raw", file.display()));
    (
        serde_json::from_slice(&output.stdout).unwrap(),
        fs::read(raw).unwrap(),
    )
}

#[test]
fn another_reader_finds_the_faces_of_the_ktx2_in_order() {
    let folder = tempfile::tempdir().unwrap();
    let (file, faces) = (folder.path().join("sky.ktx2"), folder.path().join("faces"));
    let words = ["--cubemap", "32", "--time", "0.3", "--method", "lit"];
    done(render_to(&file, &words));
    done(render_to(&faces, &words));
    let (container, texels) = ktx_parse(&file);
    let levels: Vec<usize> = (0..6)
        .map(|level| 6 * 8 * (32 >> level) * (32 >> level))
        .collect();
    for (key, wanted) in [
        ("vkFormat", serde_json::json!(97)), // VK_FORMAT_R16G16B16A16_SFLOAT
        ("width", 32.into()),
        ("height", 32.into()),
        ("layers", 0.into()),
        ("faces", 6.into()),
        ("levels", levels.into()),
        ("orientation", "rd".into()),
        ("transfer", 1.into()), // KHR_DF_TRANSFER_LINEAR
    ] {
        assert_eq!(container[key], wanted, "{key}");
    }
    let names = ["px", "nx", "py", "ny", "pz", "nz"];
    assert_eq!(
        files(&faces).into_keys().collect::<Vec<_>>(),
        ["nx.exr", "ny.exr", "nz.exr", "px.exr", "py.exr", "pz.exr"]
    );
    for (name, found) in names.into_iter().zip(texels.chunks(8 * 32 * 32)) {
        let (.., wanted) = exr(&faces.join(format!("{name}.exr")));
        let wanted: Vec<u8> = wanted
            .iter()
            .flat_map(|&[r, g, b]| [r, g, b, f16::ONE].map(f16::to_le_bytes).concat())
            .collect();
        assert!(found == wanted, "{name}");
    }
}

#[test]
fn a_folder_of_faces_is_replaced_and_another_is_not() {
    let folder = tempfile::tempdir().unwrap();
    let place = folder.path().join("sky");
    done(render_to(&place, &["--cubemap", "16"]));
    let png = ["--cubemap", "16", "--format", "png"];
    done(render_to(&place, &png));
    let made = files(&place);
    assert_eq!(
        made.keys().collect::<Vec<_>>(),
        ["nx.png", "ny.png", "nz.png", "px.png", "py.png", "pz.png"]
    );
    fs::write(place.join(".DS_Store"), "").unwrap();
    done(render_to(&place, &png));
    assert_eq!(files(&place), made);
    fs::write(place.join("thesis.txt"), "years").unwrap();
    failed(
        &run(render_to(&place, &png)),
        1,
        &["thesis.txt", "is not replaced"],
    );
    fs::remove_file(place.join("thesis.txt")).unwrap();
    assert_eq!(files(&place), made);
    failed(
        &run(render_to(&folder.path().join("none/sky"), &png)),
        1,
        &["none/sky", "cannot be written"],
    );
    assert_eq!(folder.path().read_dir().unwrap().count(), 1);
}

#[test]
fn parts_of_a_sequence_are_together_the_whole_byte_for_byte() {
    let folder = tempfile::tempdir().unwrap();
    let [whole, parts] = ["whole", "parts"].map(|name| folder.path().join(name));
    for method in ["packed", "sprites"] {
        // With sprites the viewer is among them, and the ring of pictures is there: what depends on frames before.
        let common = [
            "--method", method, "--size", "48x32", "--at", "5", "--frames", "5", "--fps", "0.05",
            "--up", "1200", "--speed", "1",
        ];
        let told = done(render_to(&whole, &common));
        assert!(told.contains("5 frames drawn"), "{told}");
        // At the same time, into one folder.
        let shards = ["2/3", "1/3", "3/3"].map(|shard| {
            let mut command = render_to(&parts, &[&common[..], &["--shard", shard]].concat());
            command.stderr(std::process::Stdio::null());
            command.spawn().unwrap()
        });
        for mut shard in shards {
            assert!(shard.wait().unwrap().success());
        }
        let frames = files(&whole);
        assert_eq!(
            frames.keys().collect::<Vec<_>>(),
            ["0", "1", "2", "3", "4"]
                .map(|k| format!("frame-00000{k}.png"))
                .iter()
                .collect::<Vec<_>>()
        );
        assert!(files(&parts) == frames, "{method}");
        // Each frame is that of its moment, drawn alone, and none is like another.
        let alone = folder.path().join("alone.png");
        let words = [
            "--method", method, "--size", "48x32", "--at", "65", "--up", "1200", "--speed", "1",
        ];
        done(render_to(&alone, &words));
        assert!(
            fs::read(&alone).unwrap() == frames["frame-000003.png"],
            "{method}"
        );
        let mut different: Vec<_> = frames.values().collect();
        different.sort();
        different.dedup();
        assert_eq!(different.len(), 5);
    }
}

#[test]
fn sequences_are_of_maps_and_other_formats_too() {
    let folder = tempfile::tempdir().unwrap();
    for (name, words, file) in [
        ("a", &["--equirect", "32"][..], "frame-000001.exr"),
        (
            "b",
            &["--equirect", "32", "--format", "hdr"],
            "frame-000001.hdr",
        ),
        ("c", &["--cubemap", "16"], "frame-000001.ktx2"),
        (
            "d",
            &["--size", "8x8", "--format", "exr"],
            "frame-000001.exr",
        ),
    ] {
        let place = folder.path().join(name);
        done(render_to(&place, &[words, &["--frames", "2"]].concat()));
        let made = files(&place);
        assert!(
            made.len() == 2 && made.contains_key(file),
            "{:?}",
            made.keys()
        );
    }
}

#[test]
fn frames_are_replaced_and_a_folder_with_something_else_is_left_alone() {
    let folder = tempfile::tempdir().unwrap();
    let place = folder.path().join("frames");
    let words = ["--size", "8x8", "--frames", "2"];
    fs::create_dir(&place).unwrap();
    fs::write(place.join("frame-000001.png"), "old").unwrap();
    fs::write(place.join("frame-000007.png"), "of a longer one").unwrap();
    done(render_to(&place, &words));
    let made = files(&place);
    assert_eq!(made.len(), 3);
    assert!(made["frame-000001.png"] != b"old" && made["frame-000007.png"] == b"of a longer one");
    fs::write(place.join("notes.txt"), "mine").unwrap();
    failed(
        &run(render_to(&place, &words)),
        1,
        &["notes.txt", "choose another folder"],
    );
    let file = folder.path().join("file");
    fs::write(&file, "mine").unwrap();
    failed(&run(render_to(&file, &words)), 1, &["is not a folder"]);
    assert_eq!(fs::read(&file).unwrap(), b"mine");
    failed(
        &run(render_to(&folder.path().join("none/frames"), &words)),
        1,
        &["none/frames", "cannot be written"],
    );
}

#[cfg(unix)]
#[test]
fn an_interrupted_sequence_leaves_whole_frames() {
    let folder = tempfile::tempdir().unwrap();
    let place = folder.path().join("frames");
    let mut command = render_to(&place, &["--size", "320x200", "--frames", "100000"]);
    command.stderr(std::process::Stdio::piped());
    let child = command.spawn().unwrap();
    // As soon as there is a frame, and long before there are all.
    while !place.join("frame-000001.png").exists() {
        std::thread::yield_now();
    }
    let killed = Command::new("kill")
        .args(["-INT", &child.id().to_string()])
        .status();
    assert!(killed.unwrap().success());
    let output: Output = child.wait_with_output().unwrap();
    failed(&output, 130, &["interrupted", "of 100000 frames"]);
    let made = files(&place);
    assert!(made.len() > 1 && made.len() < 100_000);
    for (name, bytes) in made {
        let picture = image::load_from_memory(&bytes).unwrap();
        assert_eq!((picture.width(), picture.height()), (320, 200), "{name}");
    }
}
