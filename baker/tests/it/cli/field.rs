//! The field of clouds: what `bake` says before it takes memory, and what `info` tells.

use std::fs;

use serde_json::Value;

use super::{Desk, SMALL_RECIPE, contents, default_pack, run, welkin};

/// Bakes a small recipe with this field.
fn bake(desk: &Desk, field: &str) -> super::Run {
    let recipe = desk.write("sky.toml", format!("{SMALL_RECIPE}{field}"));
    let pack = desk.path("pack");
    run(welkin().arg("bake").arg(&recipe).arg("-o").arg(pack))
}

fn info(pack: &std::path::Path) -> (String, Value) {
    let text = run(welkin().arg("info").arg(pack)).done();
    let json = run(welkin().args(["info", "--json"]).arg(pack)).done();
    (text, serde_json::from_str(&json).unwrap())
}

#[test]
fn info_tells_the_clouds_of_each_kind() {
    let (text, all) = info(default_pack());
    let (field, entry) = (&all["field"], &all["manifest"]["field"]);
    for (key, of_entry) in [
        ("bytes", "file_bytes"),
        ("sections", "sections"),
        ("boxes", "boxes"),
        ("sprites", "sprites"),
    ] {
        assert!(
            field[key].is_u64() && field[key] == entry[of_entry],
            "{key}"
        );
    }
    let on_disk = fs::metadata(default_pack().join("field.glb"))
        .unwrap()
        .len();
    assert_eq!(field["bytes"], on_disk);
    let kinds = field["kinds"].as_array().unwrap();
    let names: Vec<&str> = kinds.iter().map(|k| k["kind"].as_str().unwrap()).collect();
    assert_eq!(names, ["cumulus", "stratocumulus"]);
    for key in ["clouds", "boxes", "sprites"] {
        let sum: u64 = kinds.iter().map(|k| k[key].as_u64().unwrap()).sum();
        assert_eq!(entry[key], sum, "{key}");
    }
    let sprites = kinds[1]["sprites"].as_u64().unwrap();
    assert!(text.contains("field  3x3 sections"), "{text}");
    assert!(
        text.contains(&format!("boxes, {sprites} sprites, from cover 0.3")),
        "{text}"
    );
}

#[test]
fn a_recipe_without_sections_leaves_the_field_out() {
    let desk = Desk::new();
    bake(&desk, "[field]\nsections = 0\n").done();
    let pack = desk.path("pack");
    assert!(!contents(&pack).contains_key("field.glb"));
    let (text, all) = info(&pack);
    assert!(!text.contains("field"), "{text}");
    assert_eq!(
        (&all["field"], &all["manifest"]["field"]),
        (&Value::Null, &Value::Null)
    );
}

#[test]
fn memory_is_said_before_it_is_taken() {
    let desk = Desk::new();
    let defaults = bake(&desk, "[field]\nsections = 1\n");
    assert!(
        !defaults.stderr.contains("the field may have"),
        "{defaults:?}"
    );
    fs::remove_dir_all(desk.path("pack")).unwrap();
    let large = bake(&desk, "[field]\nsections = 1\nmost_sprites = 65536\n");
    let said = "the field may have 65536 sprites, 16384 boxes and 4096 clouds, which take ";
    assert!(large.stderr.starts_with(said), "{large:?}");
    large.done();
}

#[test]
fn a_field_over_its_limit_leaves_nothing() {
    let desk = Desk::new();
    let field = "[field]\nsections = 8\nmost_sprites = 2000\n";
    let parts = [
        "field.clouds[0]: the field needs 20",
        "sprites, expected at most 2000; lower its cover",
    ];
    bake(&desk, field).failed(1, &parts);
    assert_eq!(desk.names(), ["sky.toml"]);
}

#[test]
fn a_model_is_an_input_of_the_pack() {
    let desk = Desk::new();
    let heap = concat!(
        env!("CARGO_MANIFEST_DIR"),
        "/../assets-src/models/heap.gltf"
    );
    let bytes = fs::read(heap).unwrap();
    desk.write("heap.gltf", &bytes);
    let field =
        "[field]\nsections = 1\n[[field.models]]\nkind = \"cumulus\"\nfile = \"heap.gltf\"\n";
    bake(&desk, field).done();
    let (_, all) = info(&desk.path("pack"));
    let inputs = &all["manifest"]["inputs"];
    assert_eq!(inputs[0]["key"], "field.models[0].file");
    assert_eq!(
        inputs[0]["blake3"],
        blake3::hash(&bytes).to_hex().to_string()
    );
    assert_eq!(all["field"]["kinds"][0]["boxes"], 6);
}

#[test]
fn a_model_that_is_not_fit_is_told_by_node_and_property() {
    let desk = Desk::new();
    let heap = concat!(
        env!("CARGO_MANIFEST_DIR"),
        "/../assets-src/models/heap.gltf"
    );
    let text = fs::read_to_string(heap).unwrap();
    desk.write(
        "heap.gltf",
        text.replacen("\"sprites\": 14", "\"sprites\": 0", 1),
    );
    let field = "[[field.models]]\nkind = \"cumulus\"\nfile = \"heap.gltf\"\n";
    let parts = ["heap.gltf: node \"base\": sprites is 0, expected an integer from 1 to 100"];
    bake(&desk, field).failed(1, &parts);
    assert_eq!(desk.names(), ["heap.gltf", "sky.toml"]);
}
