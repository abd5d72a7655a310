//! Recipes at the ends of what is legal: each bakes into a pack that `check` calls sound, or is refused by its key.

#![allow(clippy::unwrap_used, reason = "a test may stop where it fails")]

use std::collections::BTreeMap;
use std::ops::ControlFlow;

use welkin_baker::{BakeError, DEFAULT_RECIPE, Inputs, Recipe, bake_from, recipe_key, verify};
use welkin_pack::Pack;
use welkin_pack::check::{Finding, Outcome};

/// The default recipe with textures as small as they may be.
const SMALL: &str = "clouds.size = 64\ngalaxy.size = 32\nsky.suns = 16\nfbm.size = 64\n\
    flares.size = 64\nlayers.size = 64\nsprites.size = 128\nfield.sections = 0\n";

fn pack(more: &str) -> Pack {
    let (key, _) = more.split_once(" =").unwrap();
    let small = SMALL.lines().filter(|line| !line.starts_with(key));
    let text = format!("{}\n{more}", small.collect::<Vec<_>>().join("\n"));
    let resolved = Recipe::parse("r.toml", &text)
        .unwrap()
        .resolve(None)
        .unwrap();
    let nothing = BTreeMap::new();
    bake_from(&resolved, Inputs::Memory(&nothing), &|_| {
        ControlFlow::Continue(())
    })
    .unwrap()
}

#[test]
fn what_is_legal_at_an_end_of_its_range_is_sound() {
    for recipe in [
        "sun.noon_elevation_deg = 5",
        "sun.noon_elevation_deg = 15",
        "sun.size = 16",
        "sky.width = 64",
        "sky.height = 64",
        "sky.suns = 64",
        "sky.haze = 0",
        "sky.haze = 10",
        "sky.most_haze = 1.11",
        "sky.most_haze = 40",
        "sky.haze = 10\nsky.most_haze = 40",
        "sky.haze = 10\nsky.most_haze = 10.2",
        "sky.haze = 0\nsky.most_haze = 0.1",
        "stars.count = 20",
        "stars.count = 1",
        "clouds.photo.mean = 0.05",
        "clouds.photo.mean = 0.4",
        "clouds.photo.mean = 0.61",
        "clouds.photo.mean = 0.59\nclouds.noise.mean = 0.26",
        "clouds.noise.mean = 0.05",
        "clouds.noise.mean = 0.52",
        "clouds.photo.mean = 0.16\nclouds.noise.mean = 0.64",
    ] {
        if let Err(error) = verify(&pack(recipe)) {
            panic!("{recipe}: {error}");
        }
    }
}

/// Their neighbours differ by less than a step of a byte.
#[test]
fn the_largest_clouds_of_8_bits_are_sound() {
    let sizes: &[u32] = if cfg!(debug_assertions) {
        &[1024]
    } else {
        &[2048, 4096]
    };
    for size in sizes {
        if let Err(error) = verify(&pack(&format!("clouds.size = {size}"))) {
            panic!("{size}: {error}");
        }
    }
}

#[test]
fn every_rule_is_told_by_a_key_that_a_recipe_has() {
    let finding = |rule: &'static str, subject: &str| Finding {
        rule,
        severity: welkin_pack::check::Severity::Error,
        subject: subject.to_string(),
        outcome: Outcome::Failed,
        figure: Some(0.0),
        expected: String::new(),
        note: String::new(),
    };
    let report = verify(&pack("seed = 3")).unwrap();
    for found in &report.findings {
        let key = recipe_key(&finding(found.rule, &found.subject));
        // A key that the default recipe spells out; tables of a list have no key of their own there.
        let leaf = key.rsplit('.').next().unwrap();
        assert!(
            DEFAULT_RECIPE.contains(&format!("{leaf} = "))
                || DEFAULT_RECIPE.contains(&format!("[{key}]")),
            "{} of {}: {key}",
            found.rule,
            found.subject
        );
    }
    assert_eq!(
        recipe_key(&finding("smooth", "clouds.photo")),
        "clouds.photo.file"
    );
    assert_eq!(
        recipe_key(&finding("sky-dusk", "horizon / zenith")),
        "sky.haze"
    );
}

/// A picture that a recipe may name and that shows no clouds: noise of single texels, of which a small texture keeps too
/// much.
#[test]
fn what_is_not_sound_is_told_by_its_key() {
    let mut bits = 1_u64;
    let picture = image::GrayImage::from_fn(128, 128, |_, _| {
        bits = bits.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
        image::Luma([(bits >> 56) as u8])
    });
    let mut png = std::io::Cursor::new(Vec::new());
    picture.write_to(&mut png, image::ImageFormat::Png).unwrap();
    let files = BTreeMap::from([("noise.png".to_string(), png.into_inner())]);
    let text = format!("{SMALL}clouds.photo.file = \"noise.png\"\n");
    let resolved = Recipe::parse("r.toml", &text)
        .unwrap()
        .resolve(None)
        .unwrap();
    let inputs = Inputs::Memory(&files);
    let pack = bake_from(&resolved, inputs, &|_| ControlFlow::Continue(())).unwrap();
    let error = verify(&pack).unwrap_err();
    let told = error.to_string();
    assert!(
        told.starts_with("the pack would not be sound: smooth: clouds.photo is"),
        "{told}"
    );
    assert!(
        told.ends_with("change `clouds.photo.file` in the recipe"),
        "{told}"
    );
    let BakeError::Unsound { faults } = error else {
        panic!("{told}")
    };
    assert!(
        faults
            .iter()
            .all(|fault| fault.key.starts_with("clouds.photo")),
        "{faults:#?}"
    );
}
