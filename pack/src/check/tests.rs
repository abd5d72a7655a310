//! Plants one fault at a time and sees that its rule, and no other error, fires.

mod catalogue;
mod field;
mod forgeries;
mod layers;
mod methods;
mod sizes;
mod sky;
mod skybox;
mod sprites;
mod stars;
mod texture;

use std::fs;
use std::path::Path;

use super::{Outcome, RULES, Report, Severity, check, check_memory};
use crate::image::Image;
use crate::ktx;
use crate::manifest::{MANIFEST_FILE, Manifest};
use crate::pack::Pack;
use crate::role::Role;
use crate::test_pack::{Stream, half_float_pack, pack, with, with_texture, write};
use crate::texture::Texture;

fn check_pack(pack: &Pack) -> Report {
    let folder = tempfile::tempdir().unwrap();
    write(pack, folder.path());
    check_both(folder.path())
}

/// Checks a folder, and sees that its files in memory give the same report.
fn check_both(folder: &Path) -> Report {
    let report = check(folder).unwrap();
    let files = fs::read_dir(folder).unwrap().map(|entry| {
        let path = entry.unwrap().path();
        let name = path.file_name().unwrap().to_str().unwrap();
        (name.to_string(), fs::read(&path).unwrap())
    });
    let memory = check_memory(&folder.display().to_string(), &files.collect());
    assert_eq!(memory.unwrap(), report);
    report
}

/// The rules that report errors.
fn errors(report: &Report) -> Vec<&'static str> {
    let mut rules: Vec<_> = report
        .findings
        .iter()
        .filter(|f| f.is_error())
        .map(|f| f.rule)
        .collect();
    rules.dedup();
    rules
}

fn assert_only(rule: &str, pack: &Pack) {
    assert_errors(&[rule], pack);
}

/// The rules that report errors are these.
fn assert_errors(rules: &[&str], pack: &Pack) {
    let report = check_pack(pack);
    let lines: Vec<String> = report.problems().map(ToString::to_string).collect();
    assert_eq!(errors(&report), rules, "{lines:#?}");
}

fn each_texel(image: &mut Image, change: impl Fn(u32, u32, &mut [f32])) {
    for y in 0..image.height {
        for x in 0..image.width {
            change(x, y, image.texel_mut(x, y));
        }
    }
}

#[test]
fn a_sound_pack_passes_every_rule() {
    for pack in [pack(), half_float_pack()] {
        let report = check_pack(&pack);
        let lines: Vec<String> = report.problems().map(ToString::to_string).collect();
        assert!(lines.is_empty(), "{lines:#?}");
        for rule in RULES {
            let passed = |f: &&super::Finding| f.rule == rule.id && f.outcome == Outcome::Passed;
            assert!(
                report.findings.iter().any(|f| passed(&f)),
                "{} was not looked at",
                rule.id
            );
        }
    }
}

#[test]
fn every_rule_has_a_test_here_and_a_place_in_the_documentation() {
    // Without white space, so that the formatter may break lines where it likes.
    let tests = concat!(
        include_str!("tests.rs"),
        include_str!("tests/catalogue.rs"),
        include_str!("tests/field.rs"),
        include_str!("tests/forgeries.rs"),
        include_str!("tests/layers.rs"),
        include_str!("tests/methods.rs"),
        include_str!("tests/sky.rs"),
        include_str!("tests/skybox.rs"),
        include_str!("tests/sprites.rs"),
        include_str!("tests/stars.rs"),
    );
    let tests: String = tests.split_whitespace().collect();
    let documentation = include_str!("../../docs/checks.md");
    for rule in RULES {
        let planted = [
            format!("assert_only(\"{}\"", rule.id),
            format!("[\"{}\"", rule.id),
            format!(",\"{}\"]", rule.id),
        ];
        assert!(
            planted.iter().any(|text| tests.contains(text)),
            "{}",
            rule.id
        );
        let severity = if rule.severity == Severity::Error {
            "error"
        } else {
            "warning"
        };
        let row = format!("| `{}` | {severity} | {}", rule.id, rule.asks);
        assert!(documentation.contains(&row), "docs/checks.md lacks: {row}");
    }
}

/// Writes a pack with its manifest changed, sealed again if asked.
fn check_with_manifest(seal_again: bool, change: impl FnOnce(&mut Manifest)) -> Report {
    let pack = pack();
    let folder = tempfile::tempdir().unwrap();
    write(&pack, folder.path());
    let mut manifest = pack.manifest().clone();
    change(&mut manifest);
    let mut json = manifest.to_json();
    if !seal_again {
        json = json.replace("\"name\": \"test\"", "\"name\": \"best\"");
    }
    fs::write(folder.path().join(MANIFEST_FILE), json).unwrap();
    check_both(folder.path())
}

#[test]
fn an_edited_manifest_breaks_the_seal() {
    assert_eq!(errors(&check_with_manifest(false, |_| ())), ["seal"]);
}

#[test]
fn a_wrong_entry_breaks_the_manifest() {
    let report = check_with_manifest(true, |m| {
        m.textures[1].channels[0].name = "brightness".to_string()
    });
    assert_eq!(errors(&report), ["manifest"]);
    let fbm = Role::ALL
        .iter()
        .position(|role| *role == Role::Fbm)
        .unwrap();
    for layers in [0, 9] {
        let report = check_with_manifest(true, |m| m.textures[fbm].layers = layers);
        assert_eq!(errors(&report), ["manifest"]);
    }
    let report = check_with_manifest(true, |m| m.textures[fbm].width = 128);
    assert_eq!(errors(&report), ["manifest"]);
}

#[test]
fn a_missing_role_is_an_error_unless_it_is_optional() {
    let without = |role| check_with_manifest(true, |m| m.textures.retain(|t| t.role != role));
    assert_eq!(errors(&without(Role::Sun)), ["roles"]);
    assert_eq!(errors(&without(Role::Skybox)), Vec::<&str>::new());
    assert_eq!(errors(&without(Role::Catalogue)), Vec::<&str>::new());
}

#[test]
fn a_wrong_texel_hash_is_an_error() {
    let report = check_with_manifest(true, |m| m.textures[2].texels_blake3 = "0".repeat(64));
    assert_eq!(errors(&report), ["texel-hash"]);
}

#[test]
fn wrong_statistics_are_an_error() {
    let report = check_with_manifest(true, |m| m.textures[0].channels[1].mean += 0.001);
    assert_eq!(errors(&report), ["statistics"]);
}

#[test]
fn a_wrong_size_is_a_wrong_layout() {
    let report = check_with_manifest(true, |m| {
        let galaxy = &mut m.textures[2];
        (galaxy.width, galaxy.height, galaxy.levels) = (64, 64, 7);
    });
    assert_eq!(errors(&report), ["layout"]);
}

#[test]
fn missing_levels_are_a_wrong_entry() {
    for (role, levels) in [(Role::Galaxy, 1), (Role::Clouds, 6), (Role::Sprites, 1)] {
        let fewer = with_texture(role, |t| t.levels.truncate(levels));
        assert_only("manifest", &fewer);
    }
    let more = with_texture(Role::Sprites, |t| {
        let bytes = t.level_bytes(3);
        t.levels.push(vec![0; bytes]);
    });
    assert_only("manifest", &more);
}

#[test]
fn a_damaged_file_breaks_its_hash() {
    let folder = tempfile::tempdir().unwrap();
    write(&pack(), folder.path());
    let path = folder.path().join("galaxy.ktx2");
    let mut bytes = fs::read(&path).unwrap();
    let last = bytes.len() - 1;
    bytes[last] ^= 1;
    fs::write(&path, bytes).unwrap();
    assert_eq!(errors(&check_both(folder.path())), ["file-hash"]);
    fs::remove_file(&path).unwrap();
    assert_eq!(errors(&check_both(folder.path())), ["file-hash"]);
}

#[test]
fn a_broken_container_with_a_true_hash_is_an_error() {
    let pack = pack();
    let folder = tempfile::tempdir().unwrap();
    write(&pack, folder.path());
    let mut bytes = pack.files()[2].1.clone();
    bytes[12] = 200; // a vkFormat that no role has
    let mut manifest = pack.manifest().clone();
    manifest.textures[2].file_blake3 = blake3::hash(&bytes).to_hex().to_string();
    fs::write(folder.path().join("galaxy.ktx2"), bytes).unwrap();
    fs::write(folder.path().join(MANIFEST_FILE), manifest.to_json()).unwrap();
    assert_eq!(errors(&check_both(folder.path())), ["container"]);
}

#[test]
fn a_manifest_that_is_not_there_or_not_json_cannot_be_checked() {
    let folder = tempfile::tempdir().unwrap();
    assert!(check(folder.path()).is_err());
    fs::write(folder.path().join(MANIFEST_FILE), "{").unwrap();
    assert!(check(folder.path()).is_err());
}

/// Changes bytes of one level only, leaving the others as they were.
fn change_level(texture: &mut Texture, level: usize, change: impl Fn(usize, &mut [u8])) {
    let bytes = texture.format.bytes_per_texel();
    texture.levels[level]
        .chunks_exact_mut(bytes)
        .enumerate()
        .for_each(|(i, t)| change(i, t));
}

#[test]
fn a_level_with_another_mean_is_an_error() {
    let brighter = |t: &mut Texture| change_level(t, 2, |_, t| t[0] = t[0].saturating_add(4));
    assert_errors(
        &["mip-mean", "level-mean"],
        &with_texture(Role::Galaxy, brighter),
    );
}

#[test]
fn seams_are_errors_on_both_axes_and_small_levels_have_those_of_level_0() {
    // A ramp across the tile that does not come back: it adds a step at the edge alone.
    let ramp = |along_x: bool| {
        with(Role::Clouds, move |image| {
            let size = image.width as f32;
            each_texel(image, |x, y, t| {
                let along = if along_x { x } else { y } as f32 / size;
                t[1] = (t[1] + 0.35 * (along - 0.5)).clamp(0.0, 1.0);
            });
        })
    };
    for along_x in [true, false] {
        // It may change the mean too.
        let rules = errors(&check_pack(&ramp(along_x)));
        assert!(rules.contains(&"seam"), "{rules:?}");
    }
    let small = with_texture(Role::Clouds, |t| {
        change_level(t, 2, |i, t| {
            t[2] = (f32::from(t[2]) * 0.6 + (i % 16) as f32 * 6.0 + 6.0) as u8
        });
    });
    assert!(errors(&check_pack(&small)).contains(&"level-mean"));
}

#[test]
fn texel_noise_is_not_smooth() {
    let rough = with(Role::Clouds, |image| {
        let mut stream = Stream::new(3);
        image
            .texels
            .chunks_exact_mut(4)
            .for_each(|t| t[0] = (t[0] + 0.2 * stream.unit() - 0.1).clamp(0.0, 1.0));
    });
    assert_only("smooth", &rough);
}

#[test]
fn a_flat_channel_has_no_spread() {
    let flat = with(Role::Clouds, |image| {
        each_texel(image, |_, _, t| t[2] = 0.5 + 0.05 * (t[2] - 0.5))
    });
    assert_errors(&["cloud-spread", "cloud-clear"], &flat);
}

#[test]
fn thick_channels_shut_the_sky() {
    let thick = with(Role::Clouds, |image| {
        each_texel(image, |_, _, t| {
            t[0] = libm::powf(t[0], 0.25);
            t[1] = libm::powf(t[1], 0.4);
        });
    });
    assert_errors(&["cloud-cover", "cloud-mean"], &thick);
}

#[test]
fn channels_that_never_make_an_overcast_are_an_error() {
    let thin = with(Role::Clouds, |image| {
        each_texel(image, |_, _, t| {
            t[0] = (1.2 * t[0] - 0.4).max(0.0);
            t[1] = (1.5 * t[1] - 0.6).max(0.0);
        });
    });
    assert!(errors(&check_pack(&thin)).contains(&"cloud-cover"));
}

#[test]
fn thin_and_thick_clouds_are_sound_if_cover_can_shut_and_open_the_sky() {
    for [photo, noise] in [[2.0, 1.0], [0.5, 1.0], [1.0, 0.5], [1.0, 2.0]] {
        let pack = with(Role::Clouds, |image| {
            each_texel(image, |_, _, t| {
                t[0] = libm::powf(t[0], photo);
                t[1] = libm::powf(t[1], noise);
            });
        });
        // The mean is not the one that the manifest tells.
        let rules = errors(&check_pack(&pack));
        assert!(
            !rules.contains(&"cloud-cover"),
            "{photo} {noise}: {rules:?}"
        );
    }
}

fn with_gradient(curve: impl Fn(f32) -> f32) -> Pack {
    with(Role::Clouds, |image| {
        let last = (image.height - 1) as f32;
        each_texel(image, |_, y, t| t[3] = curve(y as f32 / last));
    })
}

#[test]
fn faults_of_the_gradient_each_have_a_rule() {
    let wavy =
        with_gradient(|v| (v + 0.05 * libm::sinf(v * 4.0 * std::f32::consts::TAU)).clamp(0.0, 1.0));
    assert_only("gradient-monotone", &wavy);
    assert_only(
        "gradient-step",
        &with_gradient(|v| if v < 0.5 { v * 0.8 } else { 0.2 + v * 0.8 }),
    );
    assert_only("gradient-ends", &with_gradient(|v| 0.1 + v * 0.9));
    let uneven = with(Role::Clouds, |image| image.texel_mut(5, 20)[3] += 0.2);
    assert_only("gradient-monotone", &uneven);
}

#[test]
fn a_galaxy_that_is_dark_or_everywhere_is_an_error() {
    let faint = with(Role::Galaxy, |image| {
        image.texels.iter_mut().for_each(|v| *v *= 0.2);
    });
    assert_only("galaxy-brightness", &faint);
    for value in [0.0, 0.8] {
        let even = with(Role::Galaxy, |image| image.texels.fill(value));
        assert_errors(&["galaxy-brightness", "galaxy-band"], &even);
    }
}

#[test]
fn a_pack_in_memory_is_found_as_its_files_are() {
    for pack in [
        pack(),
        half_float_pack(),
        with(Role::Sun, |image| image.texels.fill(0.0)),
    ] {
        let of_files = check_pack(&pack).findings.into_iter();
        let files = [
            "seal",
            "manifest",
            "roles",
            "file-hash",
            "container",
            "layout",
            "texel-hash",
            "statistics",
            "field-file",
        ];
        let rest: Vec<_> = of_files.filter(|f| !files.contains(&f.rule)).collect();
        assert_eq!(super::check_pack(&pack).findings, rest);
    }
}

#[test]
fn faults_of_the_sun_each_have_a_rule() {
    let hollow = with(Role::Sun, |image| {
        let middle = image.width / 2;
        image.texel_mut(middle, middle)[0] = 0.2;
    });
    assert_errors(&["sun-disc", "sun-round"], &hollow);
    for size in [16, 32] {
        let black = with(Role::Sun, |image| *image = Image::new(size, size, 2));
        assert_only("sun-disc", &black);
    }
    let square = with(Role::Sun, |image| {
        each_texel(image, |_, _, t| t[1] = t[1].max(0.05))
    });
    assert_only("sun-border", &square);
}

#[test]
fn the_report_lists_every_rule_with_its_figure_as_json() {
    let report = check_pack(&pack());
    let json: serde_json::Value = serde_json::from_str(&report.to_json()).unwrap();
    assert_eq!(json["sound"], true);
    let findings = json["findings"].as_array().unwrap();
    assert_eq!(findings.len(), report.findings.len());
    let seam = findings.iter().find(|f| f["rule"] == "seam").unwrap();
    assert!(seam["figure"].is_f64() && seam["outcome"] == "passed" && seam["severity"] == "error");
}

#[test]
fn containers_decode_as_they_were_encoded() {
    for (name, bytes) in pack().files() {
        if name.ends_with(".ktx2") {
            assert!(ktx::decode(name, bytes).is_ok());
        }
    }
}
