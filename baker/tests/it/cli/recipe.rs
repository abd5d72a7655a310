//! Recipes that are wrong: the message names the file, the place, the key, and what was expected.

use super::{Desk, run, welkin};

fn refused(text: &[u8], parts: &[&str]) {
    let desk = Desk::new();
    let recipe = desk.write("sky.toml", text);
    let run = run(welkin()
        .arg("bake")
        .arg(&recipe)
        .arg("-o")
        .arg(desk.path("pack")));
    run.failed(1, &[&["sky.toml"], parts].concat());
    assert_eq!(desk.names(), ["sky.toml"]);
}

#[test]
fn an_unknown_key_is_refused_with_its_place() {
    refused(b"seed = 1\n[clouds]\nsise = 64\n", &["3:1", "sise"]);
    refused(b"[moon]\nsize = 64\n", &["1:2", "moon"]);
}

#[test]
fn a_wrong_type_is_refused_with_its_place() {
    refused(b"seed = \"one\"\n", &["1:8", "seed", "\"one\"", "integer"]);
    refused(b"[clouds]\nsize = 64.0\n", &["2:8", "clouds.size", "64.0"]);
    refused(b"[clouds]\nphoto = 3\n", &["2:9"]);
}

#[test]
fn sizes_that_are_no_power_of_two_in_range_are_refused() {
    for size in ["0", "3", "100000", "-64", "32", "8192", "99999999999999"] {
        let text = format!("[clouds]\nsize = {size}\n");
        refused(
            text.as_bytes(),
            &["2:8", "clouds.size", size, "a power of two from 64 to 4096"],
        );
    }
}

#[test]
fn a_negative_seed_is_refused() {
    refused(b"seed = -1\n", &["1:8", "seed", "-1", "an integer from 0"]);
}

#[test]
fn what_is_not_toml_is_refused() {
    refused(b"[clouds\n", &["1:"]);
    refused(b"\xff\xfe", &["cannot be read", "UTF-8"]);
    refused(
        &b"# a long comment\n".repeat(70_000),
        &["larger than 1048576 bytes"],
    );
}

#[test]
fn a_recipe_that_is_not_there_is_told_by_name() {
    let desk = Desk::new();
    let bake = |name: &str| {
        run(welkin()
            .arg("bake")
            .arg(desk.path(name))
            .arg("-o")
            .arg(desk.path("pack")))
    };
    bake("none.toml").failed(1, &["none.toml", "cannot be read"]);
    bake("").failed(1, &["cannot be read"]);
    assert!(desk.names().is_empty());
}
