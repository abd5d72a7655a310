//! `welkin bake`: what it makes, keeps and replaces.

use std::fs;
use std::path::Path;

use super::{Desk, Run, SMALL_RECIPE, contents, default_pack, run, welkin};

fn bake(recipe: &Path, pack: &Path, more: &[&str]) -> Run {
    run(welkin()
        .arg("bake")
        .arg(recipe)
        .arg("-o")
        .arg(pack)
        .args(more))
}

#[test]
fn with_no_recipe_it_bakes_the_default_pack_in_an_empty_folder() {
    let desk = Desk::new();
    let run = run(welkin()
        .args(["bake", "-o", "packs/default"])
        .current_dir(desk.path("")));
    assert_eq!(run.done(), "");
    assert_eq!(desk.names(), ["packs"]);
    assert_eq!(
        contents(&desk.path("packs/default")),
        contents(default_pack())
    );
}

#[test]
fn an_existing_pack_is_kept_without_force_and_replaced_with_it() {
    let desk = Desk::new();
    let pack = desk.small_pack();
    let recipe = desk.path("small.toml");
    let before = contents(&pack);
    bake(&recipe, &pack, &["--seed", "2"]).failed(1, &["pack", "already exists", "--force"]);
    assert_eq!(contents(&pack), before);
    bake(&recipe, &pack, &["--seed", "2", "--force"]).done();
    assert_ne!(contents(&pack), before);
    bake(&recipe, &pack, &["--force"]).done();
    assert_eq!(contents(&pack), before);
    assert_eq!(desk.names(), ["pack", "small.toml"]);
}

#[test]
fn force_replaces_no_folder_that_is_not_a_pack() {
    let desk = Desk::new();
    let recipe = desk.write("small.toml", SMALL_RECIPE);
    let folder = desk.path("letters");
    fs::create_dir(&folder).unwrap();
    fs::write(folder.join("dear.txt"), "dear").unwrap();
    let before = contents(&folder);
    bake(&recipe, &folder, &["--force"]).failed(1, &["letters", "not a pack"]);
    assert_eq!(contents(&folder), before);
    assert_eq!(desk.names(), ["letters", "small.toml"]);
}

#[test]
fn a_failed_bake_keeps_the_pack_that_force_would_have_replaced() {
    let desk = Desk::new();
    let pack = desk.small_pack();
    let before = contents(&pack);
    let recipe = desk.write("broken.toml", "[clouds.photo]\nfile = \"none.png\"\n");
    bake(&recipe, &pack, &["--force"]).failed(1, &["none.png", "cannot be read"]);
    assert_eq!(contents(&pack), before);
}

#[test]
fn a_pack_that_check_would_refuse_never_appears() {
    let desk = Desk::new();
    let mut bits = 1_u64;
    let noise = image::GrayImage::from_fn(128, 128, |_, _| {
        bits = bits.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
        image::Luma([(bits >> 56) as u8])
    });
    noise.save(desk.path("noise.png")).unwrap();
    let text = "clouds.size = 64\nclouds.photo.file = \"noise.png\"\n";
    let recipe = desk.write("noise.toml", text);
    let pictures = desk.path("pictures");
    let more = ["--png", pictures.to_str().unwrap()];
    bake(&recipe, &desk.path("pack"), &more).failed(
        1,
        &[
            "not be sound",
            "smooth",
            "change `clouds.photo.file` in the recipe",
        ],
    );
    assert_eq!(desk.names(), ["noise.png", "noise.toml"]);
}

#[test]
fn threads_do_not_change_a_byte_and_seeds_do() {
    let desk = Desk::new();
    let recipe = desk.write("small.toml", SMALL_RECIPE);
    let bytes = |name: &str, more: &[&str]| {
        let pack = desk.path(name);
        bake(&recipe, &pack, more).done();
        contents(&pack)
    };
    let one = bytes("one", &["--threads", "1"]);
    assert_eq!(one, bytes("eight", &["--threads", "8"]));
    let other = bytes("other", &["--seed", "18446744073709551615"]);
    assert_ne!(one["clouds.ktx2"], other["clouds.ktx2"]);
    assert_ne!(one["stars.ktx2"], other["stars.ktx2"]);
}

#[test]
fn seeds_and_threads_out_of_range_are_wrong_usage() {
    let desk = Desk::new();
    let pack = desk.path("pack");
    let bake =
        |option: &str, value: &str| run(welkin().args(["bake", option, value, "-o"]).arg(&pack));
    for seed in ["-1", "1.5", "one", "18446744073709551616"] {
        bake("--seed", seed).failed(
            2,
            &["--seed", "whole number from 0 to 18446744073709551615"],
        );
    }
    for threads in ["0", "-1", "1025", "x", "-inf"] {
        let parts = ["--threads", "whole number from 1 to 1024"];
        bake("--threads", threads).failed(2, &parts);
    }
    assert!(desk.names().is_empty());
}

#[test]
fn side_files_hold_every_channel_as_stored_and_as_made() {
    let desk = Desk::new();
    let (recipe, pack) = (desk.write("small.toml", SMALL_RECIPE), desk.path("pack"));
    let (png, exr) = (desk.path("png"), desk.path("exr"));
    let side = [
        "--png",
        png.to_str().unwrap(),
        "--exr",
        exr.to_str().unwrap(),
    ];
    bake(&recipe, &pack, &side).done();
    let stems = |folder: &Path| -> Vec<String> {
        contents(folder)
            .into_keys()
            .map(|n| n.rsplit_once('.').unwrap().0.to_string())
            .collect()
    };
    assert_eq!(stems(&png), stems(&exr));
    // Two layers of the smooth noise: the small recipe's lattice has no room for more.
    assert_eq!(
        stems(&png).len(),
        4 + 4 + 1 + 4 + 2 + 4 + 2 * 4 + 1 + 3 * 4 + 4
    );

    let pack = welkin_pack::Pack::open(&pack).unwrap();
    let stored = &pack.texture(welkin_pack::Role::Clouds).unwrap().levels[0];
    let stored: Vec<u8> = stored.iter().skip(1).step_by(4).copied().collect();
    let grey = image::open(png.join("clouds.noise.png"))
        .unwrap()
        .into_luma8();
    assert_eq!(grey.into_raw(), stored);
    // Quantising the floats by hand, to the nearest of 255 steps, must give the stored bytes.
    let floats = super::look::read_exr(&exr.join("clouds.noise.exr"));
    let quantised: Vec<u8> = floats.iter().map(|v| (v * 255.0).round() as u8).collect();
    assert_eq!(quantised, stored);
    assert_eq!(desk.names(), ["exr", "pack", "png", "small.toml"]);
}

#[test]
fn side_folders_are_replaced_with_force_if_they_hold_side_files_only() {
    let desk = Desk::new();
    let (recipe, pack, png) = (
        desk.write("small.toml", SMALL_RECIPE),
        desk.path("pack"),
        desk.path("png"),
    );
    let side = ["--png", png.to_str().unwrap()];
    bake(&recipe, &pack, &side).done();
    let before = contents(&png);
    bake(&recipe, &desk.path("second"), &side).failed(1, &["png", "already exists"]);
    assert!(!desk.path("second").exists());
    bake(
        &recipe,
        &pack,
        &[side[0], side[1], "--force", "--seed", "5"],
    )
    .done();
    let after = contents(&png);
    assert!(before.keys().eq(after.keys()) && before != after);

    fs::write(png.join("holiday.png"), "mine").unwrap();
    bake(&recipe, &pack, &[side[0], side[1], "--force"])
        .failed(1, &["not replaced", "holiday.png"]);
    assert_eq!(contents(&png).len(), after.len() + 1);
    assert_eq!(desk.names(), ["pack", "png", "small.toml"]);
}

#[test]
fn pack_and_side_folders_must_differ() {
    let desk = Desk::new();
    let recipe = desk.write("small.toml", SMALL_RECIPE);
    let pack = desk.path("pack");
    bake(&recipe, &pack, &["--exr", pack.to_str().unwrap()]).failed(1, &["pack", "named twice"]);
    assert_eq!(desk.names(), ["small.toml"]);
}
