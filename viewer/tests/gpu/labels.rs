//! `welkin-view render --jobs --labels`, run as its users run it: labels agree with their pictures.

// The lint's exception for tests does not reach their helpers.
#![allow(clippy::unwrap_used)]

use std::fs;
use std::path::Path;

use exr::prelude::read_first_rgba_layer_from_file;
use serde_json::{Value, json};

use crate::common::{done, failed, files, render_to, run};

/// Jobs of these lines, into the folder `out`.
fn draw(parent: &Path, lines: &[Value], words: &[&str]) -> Vec<Value> {
    let file = parent.join("jobs.jsonl");
    let text: String = lines.iter().map(|line| format!("{line}\n")).collect();
    fs::write(&file, text).unwrap();
    let mut command = render_to(&parent.join("out"), &["--jobs"]);
    command.arg(&file).args(words);
    done(command);
    let index = fs::read_to_string(parent.join("out/index.jsonl")).unwrap();
    index
        .lines()
        .map(|line| serde_json::from_str(line).unwrap())
        .collect()
}

fn grey(file: &Path) -> Vec<u8> {
    let picture = image::open(file).unwrap();
    assert_eq!(picture.color(), image::ColorType::L8);
    picture.into_bytes()
}

fn radiance(file: &Path) -> (usize, Vec<[f32; 3]>) {
    let image = read_first_rgba_layer_from_file(
        file,
        |size, _| (size.width(), vec![[0.0; 3]; size.area()]),
        |(width, pixels): &mut (usize, Vec<[f32; 3]>), at, (r, g, b, _): (f32, f32, f32, f32)| {
            pixels[at.y() * *width + at.x()] = [r, g, b];
        },
    );
    image.unwrap().layer_data.channel_data.pixels
}

#[test]
fn where_there_is_no_opacity_the_picture_is_the_cloudless_one_and_elsewhere_it_is_not() {
    let parent = tempfile::tempdir().unwrap();
    for method in ["packed", "octaves", "fbm", "lit", "sprites"] {
        let job = |name: &str, cover: f32| {
            // Impostors hold bytes, whose light and opacity are rounded apart. Little cover, which leaves the clear sky as it is; towards the sun, and no lens that would scatter its light.
            json!({ "name": format!("{method}-{name}"), "size": [96, 64], "format": "exr",
                "settings": { "method": method, "ring": 0, "cover": cover, "time": 0.42, "azimuth": 140, "elevation": 40, "fov": 90 } })
        };
        let words = ["--labels", "opacity,mask"];
        draw(
            parent.path(),
            &[job("clouds", 0.4), job("clear", 0.0)],
            &words,
        );
        let place = |name: &str| parent.path().join("out").join(format!("{method}-{name}"));
        let opacity = grey(&place("clouds.opacity.png"));
        let mask = grey(&place("clouds.mask.png"));
        assert!(
            grey(&place("clear.opacity.png"))
                .iter()
                .all(|byte| *byte == 0)
        );
        let [(_, clouds), (_, clear)] =
            ["clouds.exr", "clear.exr"].map(|name| radiance(&place(name)));
        let mut counts = [0; 2];
        for (((opacity, mask), clouds), clear) in opacity.iter().zip(&mask).zip(&clouds).zip(&clear)
        {
            assert_eq!(*mask, if *opacity >= 26 { 255 } else { 0 }, "{opacity}");
            match opacity {
                0 => {
                    counts[0] += 1;
                    assert_eq!(clouds, clear, "{method}");
                }
                26.. => {
                    counts[1] += 1;
                    assert_ne!(clouds, clear, "{method}");
                }
                _ => {}
            }
        }
        assert!(
            counts.iter().all(|count| *count > 100),
            "{method}: {counts:?}"
        );
    }
}

#[test]
fn behind_a_shut_sky_nothing_shows() {
    let parent = tempfile::tempdir().unwrap();
    let job = |stars: bool| {
        json!({ "name": format!("stars-{stars}"), "size": [96, 64], "format": "exr",
            "settings": { "method": "packed", "cover": 0.6, "density": 1, "time": 0, "moon": 0, "elevation": 50, "stars": stars } })
    };
    draw(
        parent.path(),
        &[job(true), job(false)],
        &["--labels", "opacity"],
    );
    let place = |name: &str| parent.path().join("out").join(name);
    let opacity = grey(&place("stars-true.opacity.png"));
    assert_eq!(opacity, grey(&place("stars-false.opacity.png")));
    let [(_, with), (_, without)] =
        ["stars-true.exr", "stars-false.exr"].map(|name| radiance(&place(name)));
    let mut counts = [0; 2];
    for ((opacity, with), without) in opacity.iter().zip(&with).zip(&without) {
        match opacity {
            255 => {
                counts[0] += 1;
                assert_eq!(with, without);
            }
            0 => counts[1] += usize::from(with != without),
            _ => {}
        }
    }
    assert!(counts.iter().all(|count| *count > 20), "{counts:?}");
}

#[test]
fn the_sun_is_where_the_label_says_and_clouds_hide_it() {
    let parent = tempfile::tempdir().unwrap();
    let view = |name: &str, cover: f32, azimuth: f32| {
        json!({ "name": name, "size": [120, 80], "format": "exr",
            "settings": { "method": "lit", "cover": cover, "density": 1, "time": 0.6, "azimuth": azimuth, "elevation": 35, "fov": 60 } })
    };
    let map = json!({ "name": "map", "equirect": 128, "settings": { "cover": 0, "time": 0.6, "azimuth": 90 } });
    let night = json!({ "name": "night", "size": [32, 16], "settings": { "time": 0.02, "azimuth": 0, "cover": 0 } });
    let dated = json!({ "name": "dated", "size": [32, 16], "settings": { "date": "2026-03-03T00:00:00Z", "cover": 0 } });
    let jobs = [
        view("clear", 0.0, 225.0),
        view("shut", 1.0, 225.0),
        view("away", 0.0, 45.0),
        map,
        night,
        dated,
    ];
    let index = draw(parent.path(), &jobs, &["--labels", "sun"]);
    let line = |name: &str| {
        index
            .iter()
            .find(|line| line["name"] == json!(name))
            .unwrap()
    };
    for name in ["clear", "map"] {
        let sun = &line(name)["sun"];
        assert_eq!(
            (&sun["visible"], &sun["opacity"]),
            (&json!(true), &json!(0.0)),
            "{name}"
        );
        let (width, pixels) = radiance(&parent.path().join("out").join(format!("{name}.exr")));
        let brightest = (0..pixels.len())
            .max_by(|a, b| pixels[*a][1].total_cmp(&pixels[*b][1]))
            .unwrap();
        let at = [brightest % width, brightest / width];
        for axis in 0..2 {
            let told = sun["pixel"][axis].as_f64().unwrap();
            assert!(
                (told - 0.5 - at[axis] as f64).abs() <= 1.0,
                "{name}: {told} {at:?}"
            );
        }
        let [azimuth, elevation] =
            ["azimuth_deg", "elevation_deg"].map(|key| sun[key].as_f64().unwrap());
        assert!((180.0..270.0).contains(&azimuth) && (20.0..60.0).contains(&elevation));
        let direction = [0, 1, 2].map(|i| sun["direction"][i].as_f64().unwrap());
        assert!((direction[1] - elevation.to_radians().sin()).abs() < 1e-5);
        assert!(
            (direction[0] - elevation.to_radians().cos() * azimuth.to_radians().sin()).abs() < 1e-5
        );
    }
    let shut = &line("shut")["sun"];
    assert_eq!(shut["visible"], json!(false));
    assert!(
        shut["opacity"].as_f64().unwrap() > 0.5 && shut["pixel"] == line("clear")["sun"]["pixel"]
    );
    for name in ["away", "night"] {
        let sun = &line(name)["sun"];
        assert_eq!(
            (&sun["visible"], &sun["pixel"]),
            (&json!(false), &Value::Null),
            "{name}"
        );
    }
    // Without a date it is light without a disc.
    assert_eq!(line("night")["moon"]["visible"], json!(false));
    assert!(line("dated")["moon"]["elevation_deg"].is_f64());
    for (file, _) in files(&parent.path().join("out")) {
        assert!(!file.contains("opacity"), "{file} was not asked for");
    }
}

#[test]
fn oktas_are_told_as_asked_and_as_drawn_and_light_is_that_of_the_library() {
    let parent = tempfile::tempdir().unwrap();
    let job = |name: &str, oktas: f32, at: f32| json!({ "name": name, "size": [8, 8], "oktas": oktas, "settings": { "method": "fbm", "at": at, "density": 0.8 } });
    let jobs = [
        job("none", 0.0, 0.0),
        job("half", 4.0, 0.0),
        job("later", 4.0, 9000.0),
        job("all", 8.0, 0.0),
    ];
    let index = draw(parent.path(), &jobs, &["--labels", "oktas,light"]);
    let drawn: Vec<f64> = index
        .iter()
        .map(|line| line["oktas"]["drawn"].as_f64().unwrap())
        .collect();
    let asked: Vec<f64> = index
        .iter()
        .map(|line| line["oktas"]["asked"].as_f64().unwrap())
        .collect();
    assert_eq!(asked, [0.0, 4.0, 4.0, 8.0]);
    assert_eq!((drawn[0], drawn[3]), (0.0, 8.0));
    // The small pack's few clouds scatter more than a real one's; still a half is neither none nor all.
    assert!(
        (1.0..7.0).contains(&drawn[1]) && (1.0..7.0).contains(&drawn[2]),
        "{drawn:?}"
    );
    assert_ne!(drawn[1], drawn[2]);
    let light = |i: usize, key: &str| index[i]["light"][key][1].as_f64().unwrap();
    assert!(
        light(0, "sun_irradiance") == light(0, "sun_clear_irradiance")
            && light(0, "sun_irradiance") > 1.0
    );
    assert!(light(3, "sun_irradiance") < 0.2 * light(3, "sun_clear_irradiance"));
    assert_eq!(index[0]["light"]["ambient"].as_array().unwrap().len(), 9);
}

#[test]
fn other_labels_are_added_to_pictures_that_are_there() {
    let parent = tempfile::tempdir().unwrap();
    let jobs = [json!({ "name": "a", "size": [16, 8] })];
    draw(parent.path(), &jobs, &[]);
    let out = parent.path().join("out");
    let before = files(&out);
    let index = draw(parent.path(), &jobs, &["--labels", "mask,sun,mask"]);
    assert_eq!(index.len(), 1);
    assert_eq!(index[0]["labels"], json!(["mask", "sun"]));
    assert!(files(&out)["a.png"] == before["a.png"]);
    let after = files(&out);
    assert_eq!(
        after.keys().collect::<Vec<_>>(),
        ["a.mask.png", "a.png", "index.jsonl"]
    );
    draw(parent.path(), &jobs, &["--labels", "mask,sun"]);
    assert!(files(&out) == after);
    // A label that was lost is drawn again, and one of someone else's stays.
    fs::remove_file(out.join("a.mask.png")).unwrap();
    draw(parent.path(), &jobs, &["--labels", "mask,sun"]);
    assert!(files(&out) == after);
    fs::write(out.join("a.opacity.png"), "mine").unwrap();
    let mut command = render_to(&out, &["--labels", "opacity", "--jobs"]);
    command.arg(parent.path().join("jobs.jsonl"));
    failed(&run(command), 1, &["a.opacity.png", "--force"]);
    assert_eq!(fs::read(out.join("a.opacity.png")).unwrap(), b"mine");
    let mut command = render_to(&out, &["--labels", "depth", "--jobs", "-"]);
    command.stdin(std::process::Stdio::null());
    failed(&run(command), 2, &["depth", "opacity"]);
    fs::write(parent.path().join("jobs.jsonl"), "{\"cubemap\": 16}").unwrap();
    let mut command = render_to(&out, &["--labels", "mask", "--jobs"]);
    command.arg(parent.path().join("jobs.jsonl"));
    failed(&run(command), 1, &["line 1", "cubemap", "mask", "equirect"]);
}
