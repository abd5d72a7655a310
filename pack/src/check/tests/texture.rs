//! One texture alone, before it is in any pack.

use crate::check::{Finding, Outcome, RULES, Report, check_texture};
use crate::format::{Format, Shape};
use crate::pack::Pack;
use crate::role::Role;
use crate::test_pack::{half_float_pack, pack};
use crate::texture::Texture;

fn textures(pack: &Pack) -> Vec<(Role, Texture)> {
    let entries = pack.manifest().textures.iter();
    let texture = |role| pack.texture(role).unwrap().clone();
    entries.map(|e| (e.role, texture(e.role))).collect()
}

fn texture(role: Role) -> Texture {
    pack().texture(role).unwrap().clone()
}

/// The rules that lean on what a manifest says: without one they are skipped, or ask less.
const LEAN_ON_A_MANIFEST: [&str; 3] = ["cloud-waves", "cloud-band", "cloud-mean"];

fn leans_on_a_manifest(finding: &Finding) -> bool {
    LEAN_ON_A_MANIFEST.contains(&finding.rule)
}

fn broken(report: &Report) -> Vec<&'static str> {
    let mut rules: Vec<_> = report.problems().map(|f| f.rule).collect();
    rules.dedup();
    rules
}

#[test]
fn a_sound_texture_passes_alone_as_in_a_pack() {
    let about_texels = RULES.iter().skip_while(|rule| rule.id != "finite");
    let about_texels: Vec<&str> = about_texels.map(|rule| rule.id).collect();
    for pack in [pack(), half_float_pack()] {
        let mut in_the_pack = super::check_pack(&pack).findings;
        in_the_pack.retain(|f| about_texels.contains(&f.rule) && !f.subject.starts_with("field"));
        in_the_pack.retain(|f| !leans_on_a_manifest(f));
        for (role, texture) in textures(&pack) {
            let report = check_texture(role, &texture);
            assert_eq!(broken(&report), [""; 0], "{role:?}");
            assert_eq!(report.findings[0].rule, "layout");
            assert!(report.findings.len() > 1, "{role:?}");
            let others = report.findings[1..].iter();
            for finding in others.filter(|f| !leans_on_a_manifest(f)) {
                let place = in_the_pack.iter().position(|f| f == finding);
                in_the_pack.remove(place.expect("a finding of the pack"));
            }
        }
        assert_eq!(in_the_pack, []);
    }
}

#[test]
fn level_0_alone_is_judged_and_nothing_is_said_of_levels_that_are_not_there() {
    for pack in [pack(), half_float_pack()] {
        for (role, mut texture) in textures(&pack) {
            let whole = check_texture(role, &texture);
            texture.levels.truncate(1);
            let alone = check_texture(role, &texture);
            assert_eq!(broken(&alone), [""; 0], "{role:?}");
            let rules =
                |report: &Report| report.findings.iter().map(|f| f.rule).collect::<Vec<_>>();
            assert_eq!(rules(&alone), rules(&whole), "{role:?}");
            let skipped = |f: &&Finding| f.outcome == Outcome::Skipped && !leans_on_a_manifest(f);
            let skipped: Vec<_> = alone.findings.iter().filter(skipped).collect();
            let has_levels = pack.texture(role).unwrap().levels.len() > 1;
            assert_eq!(skipped.is_empty(), !has_levels, "{role:?}");
            assert!(
                skipped
                    .iter()
                    .all(|f| f.figure.is_none() && f.note.contains("level 0 alone"))
            );
        }
    }
}

#[test]
fn a_fault_of_level_0_is_found_without_the_other_levels() {
    let mut stars = texture(Role::Stars);
    stars.levels.truncate(1);
    for (i, texel) in stars.levels[0].chunks_exact_mut(4).enumerate() {
        if i % 7 == 0 && texel[0] == 0 {
            texel[3] = 9;
        }
    }
    assert_eq!(broken(&check_texture(Role::Stars, &stars)), ["star-empty"]);

    let mut skybox = texture(Role::Skybox);
    skybox.levels.truncate(1);
    // A half float that is not a number: it must not become 0 on its way to the rules.
    skybox.levels[0][8..10].copy_from_slice(&0x7e00_u16.to_le_bytes());
    assert!(!check_texture(Role::Skybox, &skybox).is_sound());
}

#[test]
fn a_stored_level_that_lies_is_found() {
    let mut galaxy = texture(Role::Galaxy);
    galaxy.levels[2].fill(255);
    let report = check_texture(Role::Galaxy, &galaxy);
    assert!(
        broken(&report).contains(&"mip-mean"),
        "{:?}",
        broken(&report)
    );
}

/// A change of a texture, and what the layout is then said to be.
type Fault = (&'static str, fn(&mut Texture));

#[test]
fn another_layout_is_the_only_finding() {
    let faults: [Fault; 9] = [
        (
            "format is rg8unorm, expected rgba8unorm or rgba16float",
            |t| t.format = Format::Rg8Unorm,
        ),
        ("shape is cube, expected 2d", |t| t.shape = Shape::Cube),
        ("width is 48, expected a power of two from 4 to 8192", |t| {
            t.width = 48
        }),
        ("height is 32, expected 64, as the width", |t| t.height = 32),
        ("layers is 2, expected 1", |t| t.layers = 2),
        ("layers is 0, expected 1", |t| t.layers = 0),
        ("levels is 3, expected 7, or level 0 alone", |t| {
            t.levels.truncate(3)
        }),
        ("levels is 0, expected 7, or level 0 alone", |t| {
            t.levels.clear()
        }),
        ("level 1 is 4095 bytes, expected 4096 bytes", |t| {
            t.levels[1].pop();
        }),
    ];
    for (expected, fault) in faults {
        let mut clouds = texture(Role::Clouds);
        fault(&mut clouds);
        let report = check_texture(Role::Clouds, &clouds);
        let notes: Vec<&str> = report.findings.iter().map(|f| f.note.as_str()).collect();
        assert_eq!(notes, [format!("clouds: {expected}")]);
        assert_eq!(broken(&report), ["layout"]);
    }
}
