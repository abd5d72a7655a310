//! The commands that look into a pack: `check`, `info`, `preview`, `unpack`; and `photo`.

use std::fs;
use std::path::Path;

use exr::prelude::{FlatSamples, read_first_flat_layer_from_file};
use serde_json::Value;
use welkin_pack::manifest::{FractalNoise, Input};
use welkin_pack::{Overwrite, Pack, PackInfo, Role, Source};

use super::{Desk, contents, default_pack, run, welkin};

/// The samples of the only channel of an EXR, row by row.
pub fn read_exr(path: &Path) -> Vec<f32> {
    let image = read_first_flat_layer_from_file(path).expect("an EXR");
    let mut channels = image.layer_data.channel_data.list;
    match channels.pop().expect("a channel").sample_data {
        FlatSamples::F32(values) if channels.is_empty() => values,
        _ => panic!("{}: not one channel of floats", path.display()),
    }
}

fn json(text: &str) -> Value {
    serde_json::from_str(text).expect("JSON")
}

#[test]
fn check_says_that_the_default_pack_is_sound() {
    let text = run(welkin().arg("check").arg(default_pack())).done();
    assert!(
        text.lines().last().unwrap().starts_with("sound: "),
        "{text}"
    );
    let report = json(&run(welkin().args(["check", "--json"]).arg(default_pack())).done());
    assert_eq!(report["sound"], true);
    assert!(report["findings"].as_array().unwrap().len() > 20);
}

#[test]
fn check_tells_problems_from_what_it_cannot_read() {
    let desk = Desk::new();
    let pack = desk.small_pack();
    let mut bytes = fs::read(pack.join("galaxy.ktx2")).unwrap();
    *bytes.last_mut().unwrap() ^= 1;
    fs::write(pack.join("galaxy.ktx2"), bytes).unwrap();
    let damaged = run(welkin().args(["check", "--json"]).arg(&pack));
    assert_eq!(damaged.code, Some(1), "{damaged:?}");
    assert_eq!(json(&damaged.stdout)["sound"], false);

    fs::write(pack.join("pack.json"), "{").unwrap();
    run(welkin().arg("check").arg(&pack)).failed(2, &["pack.json"]);
    run(welkin().arg("check").arg(desk.path("none"))).failed(2, &["none"]);
}

/// Names that would clear the screen, or pass for another line.
#[test]
fn what_a_pack_says_of_itself_stays_on_its_line() {
    const EVIL: &str = "a\u{1b}[2J\nseed            9\u{202e}";
    const SHOWN: &str = r"a\u{1b}[2J\nseed            9\u{202e}";
    const NOISE: FractalNoise = FractalNoise {
        cells: 4,
        octaves: 5,
        gain: 0.5,
        mean: 0.26,
    };
    let desk = Desk::new();
    let folder = desk.small_pack();
    let baked = Pack::open(&folder).unwrap();
    let source = |role: Role| {
        let texture = baked.texture(role)?;
        Some(Source {
            role,
            format: texture.format,
            images: (0..texture.layers)
                .map(|layer| texture.image(0, layer))
                .collect(),
        })
    };
    let info = PackInfo {
        name: EVIL.to_string(),
        seed: 1,
        baker: EVIL.to_string(),
        recipe: EVIL.to_string(),
        inputs: vec![Input {
            key: EVIL.to_string(),
            blake3: "0".repeat(64),
        }],
        noon_elevation_rad: 1.0,
        aerosol_depths: [0.04, 0.24],
        noise: NOISE,
        detail: NOISE,
    };
    let evil = Pack::build(info, Role::ALL.into_iter().filter_map(source).collect()).unwrap();
    evil.save(&folder, Overwrite::Replace, &|| false).unwrap();
    for command in ["info", "check"] {
        let looked = run(welkin().arg(command).arg(&folder));
        for text in [&looked.stdout, &looked.stderr] {
            assert!(!text.contains(['\u{1b}', '\u{202e}']), "{command}: {text}");
            assert!(
                !text
                    .lines()
                    .any(|line| line.starts_with("seed            9"))
            );
        }
        if command == "info" {
            let lines = looked.done();
            for label in ["name            ", "baked by        "] {
                assert!(lines.contains(&format!("{label}{SHOWN}\n")), "{lines}");
            }
        }
    }
    let manifest = fs::read_to_string(folder.join("pack.json")).unwrap();
    // Where it is refused, the error quotes it: a role, a file, a version, text that is no JSON.
    for (from, to) in [
        ("\"clouds\"", "\"x\\u001b[2J\\ny\""),
        ("clouds.ktx2", "x\\u001b[2J\\ny"),
        ("{", "\u{1b}[2J{"),
    ] {
        let text = manifest.replacen(from, to, 1);
        fs::write(folder.join("pack.json"), text).unwrap();
        for command in ["info", "check", "unpack", "preview"] {
            let mut asked = welkin();
            asked.arg(command).arg(&folder);
            if matches!(command, "unpack" | "preview") {
                asked.arg("-o").arg(desk.path("out.png"));
            }
            let told = run(&mut asked);
            assert_ne!(told.code, Some(0), "{command} {to}");
            assert!(
                !(told.stdout + &told.stderr).contains('\u{1b}'),
                "{command} {to}"
            );
            assert!(told.stderr.lines().count() <= 1, "{}", told.stderr);
        }
    }
}

/// A recipe is quoted where it is wrong; so is the name of a file.
#[test]
fn what_a_recipe_says_stays_on_its_line() {
    let desk = Desk::new();
    for text in [
        "name = \"a\u{9b}2J\"",
        "name = \"a\\u001b[2J\\nb\"",
        "\"s\\u001b[2J\" = 1",
        "[sun]\nsize = \"\\u001b[2J\"",
        "seed = \u{1b}[2J",
        "[clouds.photo]\nfile = \"\\u001b[2J.png\"",
        "[skybox]\nfile = \"\\u001b[2J.hdr\"",
    ] {
        let recipe = desk.write("sky\u{1b}[2J.toml", text);
        let told = run(welkin()
            .arg("bake")
            .arg(recipe)
            .arg("-o")
            .arg(desk.path("pack")));
        assert_eq!(told.code, Some(1), "{told:?}");
        assert!(!told.stderr.contains(['\u{1b}', '\u{9b}']), "{told:?}");
        assert_eq!(told.stderr.lines().count(), 1, "{told:?}");
    }
}

#[test]
fn info_lists_every_channel_and_hash() {
    let text = run(welkin().arg("info").arg(default_pack())).done();
    let all = json(&run(welkin().args(["info", "--json"]).arg(default_pack())).done());
    let textures = all["manifest"]["textures"].as_array().unwrap();
    for texture in textures {
        assert!(text.contains(texture["texels_blake3"].as_str().unwrap()));
        for channel in texture["channels"].as_array().unwrap() {
            assert!(text.contains(channel["meaning"].as_str().unwrap()));
        }
    }
    let on_disk = |t: &Value| {
        fs::metadata(default_pack().join(t["file"].as_str().unwrap()))
            .unwrap()
            .len()
    };
    assert_eq!(all["bytes"], textures.iter().map(on_disk).sum::<u64>());
    assert_eq!(all["folder"], default_pack().to_str().unwrap());
}

#[test]
fn a_pack_that_cannot_be_opened_leaves_no_output() {
    let desk = Desk::new();
    let pack = desk.small_pack();
    fs::remove_file(pack.join("sun.ktx2")).unwrap();
    run(welkin().arg("info").arg(&pack)).failed(1, &["sun.ktx2"]);
    for command in ["preview", "unpack"] {
        run(welkin()
            .arg(command)
            .arg(&pack)
            .arg("-o")
            .arg(desk.path("out.png")))
        .failed(1, &["sun.ktx2"]);
    }
    assert_eq!(desk.names(), ["pack", "small.toml"]);
}

#[test]
fn the_preview_is_a_small_picture_with_something_on_it() {
    let desk = Desk::new();
    let sheet = desk.write("sheet.png", "an older file is replaced");
    run(welkin()
        .arg("preview")
        .arg(default_pack())
        .arg("-o")
        .arg(&sheet))
    .done();
    // 46 panels of 192x192 grey pixels, half of them noise that hardly compresses, and four skies in colour.
    let most = 46 / 2 * 192 * 192 + 4 * 192 * 48 * 3;
    assert!(fs::metadata(&sheet).unwrap().len() < most);
    let picture = image::open(&sheet).unwrap().into_rgb8();
    // Both black (a night sky) and white (letters, thick cloud), and the blue of the day.
    let has = |wanted: fn([u8; 3]) -> bool| picture.pixels().any(|p| wanted(p.0));
    assert!(
        has(|p| p == [0; 3])
            && has(|p| p.iter().all(|&c| c > 230))
            && has(|[r, _, b]| b > r.saturating_add(60))
    );
    assert_eq!(desk.names(), ["sheet.png"]);
}

#[test]
fn unpacked_channels_are_the_texels_of_the_pack() {
    let desk = Desk::new();
    let folder = desk.path("channels");
    run(welkin()
        .arg("unpack")
        .arg(default_pack())
        .arg("-o")
        .arg(&folder))
    .done();
    let pack = Pack::open(default_pack()).unwrap();
    let mut files = contents(&folder).len();
    let layers = pack.manifest().textures.iter().flat_map(|entry| {
        let texture = pack.texture(entry.role).unwrap();
        let layer = |i: u32| (entry.role, entry.role.layer_name(i), texture.image(0, i));
        match entry.role {
            // One below the other in one image.
            Role::Sky => vec![(Role::Sky, None, texture.stacked(0))],
            _ => (0..entry.layers).map(layer).collect(),
        }
    });
    for (role, layer, image) in layers {
        let layer = layer.map_or(String::new(), |name| format!(".{name}"));
        for (index, channel) in role.spec().channels.iter().enumerate() {
            let stored: Vec<f32> = image.channel(index).collect();
            let stem = format!("{}{layer}.{}", role.name(), channel.name);
            let found = match role {
                Role::Sky => read_exr(&folder.join(stem + ".exr")),
                _ => {
                    let grey = image::open(folder.join(stem + ".png"))
                        .unwrap()
                        .into_luma8();
                    assert_eq!(grey.dimensions(), (image.width, image.height));
                    grey.into_raw()
                        .iter()
                        .map(|&v| f32::from(v) / 255.0)
                        .collect()
                }
            };
            assert!(found == stored, "{}{layer}.{}", role.name(), channel.name);
            files -= 1;
        }
    }
    assert_eq!(files, 0, "there are files that are no channel");
    assert!(
        folder.join("fbm.2.steps1.png").is_file() && folder.join("octaves.octave4.png").is_file()
    );
    assert!(folder.join("layers.cirrus.rank.png").is_file());
    let before = contents(&folder);
    run(welkin()
        .arg("unpack")
        .arg(default_pack())
        .arg("-o")
        .arg(&folder))
    .failed(1, &["channels", "already exists"]);
    assert_eq!(contents(&folder), before);
}

#[test]
fn new_files_and_folders_are_as_open_as_the_umask_allows() {
    use std::os::unix::fs::PermissionsExt;
    let desk = Desk::new();
    let script = "umask 027; \"$1\" unpack \"$2\" -o dir && \"$1\" preview \"$2\" -o file.png";
    let mut shell = std::process::Command::new("sh");
    shell
        .args(["-c", script, "sh", env!("CARGO_BIN_EXE_welkin")])
        .arg(default_pack());
    run(shell.current_dir(desk.path(""))).done();
    let mode = |name: &str| fs::metadata(desk.path(name)).unwrap().permissions().mode() & 0o777;
    assert_eq!(
        [mode("dir"), mode("dir/sun.disc.png"), mode("file.png")],
        [0o750, 0o640, 0o640]
    );
}
