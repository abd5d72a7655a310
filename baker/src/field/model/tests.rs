//! Models that are read, and models that are refused.

use serde_json::{Value, json};
use welkin_pack::field::Category;

use super::*;

/// A model of nodes that each have a cube of side 2.
fn model(nodes: Value) -> Value {
    json!({
        "asset": {"version": "2.0"},
        "scenes": [{"nodes": [0]}],
        "nodes": nodes,
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "count": 8, "type": "VEC3",
            "min": [-1.0, -1.0, -1.0], "max": [1.0, 1.0, 1.0]}],
        "bufferViews": [{"buffer": 0, "byteLength": 96}],
        "buffers": [{"byteLength": 96, "uri": "cube.bin"}],
    })
}

fn read(model: &Value) -> Result<Vec<BoxSettings>, BakeError> {
    boxes(model.to_string().as_bytes(), "m.gltf")
}

/// One box with these properties.
fn with_extras(extras: Value) -> Value {
    model(json!([{"name": "b", "mesh": 0, "scale": [300, 100, 200], "extras": extras}]))
}

fn refused(model: &Value) -> String {
    read(model).unwrap_err().to_string()
}

#[test]
fn properties_of_a_node_are_those_of_its_box() {
    let boxes = read(&with_extras(json!({
        "sprites": 40.0, "width_m": [150, 250.5], "height_m": [90, 180], "category": "stratus",
        "rotation_deg": [-90, 45], "group": 7, "flat_bottom": 1, "cull": 0.2,
    })));
    let found = &boxes.unwrap()[0];
    assert_eq!(found.size_m, [600.0, 200.0, 400.0]);
    assert_eq!(
        (found.sprites, found.group, found.flat_bottom),
        (40, 7, true)
    );
    assert_eq!(
        (found.width_m, found.height_m),
        ([150.0, 250.5], [90.0, 180.0])
    );
    assert_eq!((found.category, found.cull), (Category::Stratus, 0.2));
    let quarter = std::f32::consts::FRAC_PI_2;
    assert!((found.rotation_rad[0] + quarter).abs() < 1e-6);
    assert!((found.rotation_rad[1] - 0.5 * quarter).abs() < 1e-6);
}

#[test]
fn a_box_is_the_bounds_after_the_transforms_of_all_nodes_above() {
    let root = std::f32::consts::FRAC_1_SQRT_2;
    // A quarter turn about the vertical above a box that is long in x.
    let boxes = read(&model(json!([
        {"children": [1, 2], "translation": [10, 500, 0], "rotation": [0, root, 0, root]},
        {"mesh": 0, "translation": [100, 0, 0], "scale": [300, 100, 50]},
        {"mesh": 0, "matrix": [50, 0, 0, 0, 0, 50, 0, 0, 0, 0, 50, 0, 0, 20, 0, 1]},
    ])));
    let boxes = boxes.unwrap();
    let near = |a: [f32; 3], b: [f32; 3]| (0..3).all(|i| (a[i] - b[i]).abs() < 1e-3);
    assert!(
        near(boxes[0].centre_m, [10.0, 500.0, -100.0]),
        "{:?}",
        boxes[0]
    );
    assert!(near(boxes[0].size_m, [100.0, 200.0, 600.0]));
    assert!(near(boxes[1].centre_m, [10.0, 520.0, 0.0]));
    assert!(near(boxes[1].size_m, [100.0; 3]));
}

#[test]
fn the_example_models_are_boxes() {
    let folder = concat!(env!("WELKIN_ASSETS"), "/models/");
    for (file, count, sprites) in [("heap.gltf", 6, 68), ("tower.glb", 9, 166)] {
        let bytes = std::fs::read(format!("{folder}{file}")).unwrap();
        let boxes = boxes(&bytes, file).unwrap();
        assert_eq!(boxes.len(), count);
        assert_eq!(boxes.iter().map(|b| b.sprites).sum::<u32>(), sprites);
        assert!(boxes[0].flat_bottom && boxes[0].centre_m[1] == 0.5 * boxes[0].size_m[1]);
    }
}

#[test]
fn bad_properties_are_refused_by_name() {
    for (extras, expected) in [
        (
            json!({"sprites": 0}),
            "m.gltf: node \"b\": sprites is 0, expected an integer from 1 to 100",
        ),
        (
            json!({"sprites": 1_000_000}),
            "node \"b\": sprites is 1000000, expected an integer from 1 to 100",
        ),
        (
            json!({"sprites": 2.5}),
            "sprites is 2.5, expected an integer",
        ),
        (
            json!({"sprites": "NaN"}),
            "sprites is \"NaN\", expected an integer",
        ),
        (
            json!({"width_m": [300, 200]}),
            "width_m is [300,200], expected two numbers from 1 to 10000, the least first",
        ),
        (
            json!({"width_m": [300]}),
            "width_m is [300], expected two numbers",
        ),
        (
            json!({"height_m": [0, 100]}),
            "height_m is [0,100], expected two numbers",
        ),
        (
            json!({"height_m": [100, 1e300]}),
            "height_m is [100,1e+300]",
        ),
        (
            json!({"category": "nimbus"}),
            "category is \"nimbus\", expected one of \"stratus\", \"cumulus\", \"wispy\"",
        ),
        (json!({"rotation_deg": [0, 720]}), "rotation_deg is [0,720]"),
        (
            json!({"group": -1}),
            "group is -1, expected an integer from 0 to 9999",
        ),
        (
            json!({"flat_bottom": "yes"}),
            "flat_bottom is \"yes\", expected true or false",
        ),
        (
            json!({"cull": 1.5}),
            "cull is 1.5, expected a number from 0 to 1",
        ),
        (
            json!({"cull": 1.0, "height_m": [700, 800]}),
            "cull is 750 m of the sprites' mean height, expected at most the longest side of the box, 600 m",
        ),
        (
            json!({"sprite": 10}),
            "extras is with a property `sprite`, expected none but sprites, width_m",
        ),
        (json!([1]), "node \"b\": extras is"),
    ] {
        let error = refused(&with_extras(extras));
        assert!(error.contains(expected), "{error}");
    }
    let infinite = with_extras(json!({"cull": 7777}))
        .to_string()
        .replace("7777", "1e999");
    assert!(boxes(infinite.as_bytes(), "m.gltf").is_err());
}

#[test]
fn models_without_boxes_are_refused() {
    let error = refused(&model(json!([{"name": "empty"}])));
    assert_eq!(
        error,
        "m.gltf: nodes is without a mesh, expected boxes: nodes of the scene that have a mesh"
    );
    let mut no_scene = with_extras(json!({}));
    no_scene["scenes"] = json!([]);
    assert!(refused(&no_scene).contains("scenes is none"));
    let mut no_bounds = with_extras(json!({}));
    no_bounds["accessors"][0]["min"] = json!(null);
    assert!(read(&no_bounds).is_err());
    let mut odd_bounds = with_extras(json!({}));
    odd_bounds["accessors"][0]["min"] = json!([1]);
    assert!(read(&odd_bounds).is_err());
    let flat = model(json!([{"mesh": 0, "scale": [100, 0, 100]}]));
    assert!(refused(&flat).contains("node 0: size is 0 m, expected 1 to 20000 m"));
    let far = model(json!([{"mesh": 0, "scale": [9, 9, 9], "translation": [0, 1e6, 0]}]));
    assert!(refused(&far).contains("middle is 1000000 m"));
    let nowhere = model(json!([{"mesh": 0, "scale": [3e38, 9, 9], "translation": [3e38, 0, 0]}]));
    assert!(refused(&nowhere).contains("bounds is without them"));
}

#[test]
fn files_that_are_no_models_are_refused() {
    for bytes in [
        &b""[..],
        b"name = 1",
        b"{}",
        b"glTF",
        b"glTF\x02\0\0\0\x05\0\0\0",
        b"glTF\x02\0\0\0\xff\0\0\0",
    ] {
        let error = boxes(bytes, "m.glb").unwrap_err().to_string();
        assert!(error.starts_with("m.glb: "), "{error}");
        assert!(
            error.contains("export it again") || error.contains("a scene"),
            "{error}"
        );
    }
    let folder = concat!(env!("WELKIN_ASSETS"), "/models/tower.glb");
    let bytes = std::fs::read(folder).unwrap();
    for length in 0..bytes.len() {
        assert!(boxes(&bytes[..length], "m.glb").is_err(), "{length}");
    }
    let mut draco = with_extras(json!({}));
    draco["extensionsRequired"] = json!(["KHR_draco_mesh_compression"]);
    assert!(refused(&draco).contains("without required extensions"));
}

#[test]
fn indices_of_what_is_not_there_are_refused() {
    let missing = r#"{"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],"meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}]}"#;
    let error = boxes(missing.as_bytes(), "m.gltf").unwrap_err().to_string();
    assert_eq!(
        error,
        "m.gltf: glTF is naming accessor 0 of 0, expected a whole glTF 2.0 file without required extensions; export it again"
    );
    // Every index of a document, made to name what is not there.
    let sound = json!({
        "asset": {"version": "2.0"},
        "scene": 0,
        "scenes": [{"nodes": [0]}],
        "nodes": [{"children": [1], "camera": 0, "skin": 0}, {"mesh": 0, "scale": [300, 100, 200]}],
        "cameras": [{"type": "perspective", "perspective": {"yfov": 1.0, "znear": 1.0}}],
        "skins": [{"joints": [1], "skeleton": 0, "inverseBindMatrices": 0}],
        "animations": [{"channels": [{"sampler": 0, "target": {"node": 0, "path": "scale"}}],
            "samplers": [{"input": 0, "output": 0}]}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0, "NORMAL": 0}, "indices": 0, "material": 0,
            "targets": [{"POSITION": 0}]}]}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "count": 8, "type": "VEC3",
            "min": [-1.0, -1.0, -1.0], "max": [1.0, 1.0, 1.0],
            "sparse": {"count": 1, "indices": {"bufferView": 0, "componentType": 5125}, "values": {"bufferView": 0}}}],
        "materials": [{"normalTexture": {"index": 0}}],
        "textures": [{"source": 0, "sampler": 0}],
        "images": [{"bufferView": 0, "mimeType": "image/png"}],
        "samplers": [{}],
        "bufferViews": [{"buffer": 0, "byteLength": 96}],
        "buffers": [{"byteLength": 96, "uri": "cube.bin"}],
    });
    assert_eq!(read(&sound).unwrap().len(), 1);
    let indices = [
        "/scene",
        "/scenes/0/nodes/0",
        "/nodes/0/children/0",
        "/nodes/0/camera",
        "/nodes/0/skin",
        "/nodes/1/mesh",
        "/skins/0/joints/0",
        "/skins/0/skeleton",
        "/skins/0/inverseBindMatrices",
        "/animations/0/channels/0/sampler",
        "/animations/0/channels/0/target/node",
        "/animations/0/samplers/0/input",
        "/animations/0/samplers/0/output",
        "/meshes/0/primitives/0/attributes/POSITION",
        "/meshes/0/primitives/0/attributes/NORMAL",
        "/meshes/0/primitives/0/indices",
        "/meshes/0/primitives/0/material",
        "/meshes/0/primitives/0/targets/0/POSITION",
        "/accessors/0/bufferView",
        "/accessors/0/sparse/indices/bufferView",
        "/accessors/0/sparse/values/bufferView",
        "/materials/0/normalTexture/index",
        "/textures/0/source",
        "/textures/0/sampler",
        "/images/0/bufferView",
        "/bufferViews/0/buffer",
    ];
    for place in indices {
        for index in [
            json!(1),
            json!(7),
            json!(u32::MAX),
            json!(u64::MAX),
            json!(-1),
            json!(0.5),
            json!("0"),
            json!(null),
        ] {
            let mut wrong = sound.clone();
            *wrong.pointer_mut(place).unwrap() = index.clone();
            // Some may be left out, or are there: whatever comes, it is no panic.
            let found = read(&wrong);
            if index == json!(7) {
                // The library does not follow the indices of an animation, and nor does a box.
                assert!(
                    found.is_err() || place.starts_with("/animations"),
                    "{place} {index}"
                );
            }
        }
    }
    // Everything left out or of another kind, one thing at a time.
    for place in places(&sound) {
        for other in [
            json!(null),
            json!([]),
            json!({}),
            json!(0),
            json!(-1),
            json!(1e300),
            json!("x"),
            json!(u64::MAX),
        ] {
            let mut wrong = sound.clone();
            *wrong.pointer_mut(&place).unwrap() = other;
            drop(read(&wrong));
        }
    }
}

/// Where every value of a document is.
fn places(value: &Value) -> Vec<String> {
    let below = |key: String, value: &Value| {
        let mut found = vec![format!("/{key}")];
        found.extend(
            places(value)
                .into_iter()
                .map(|place| format!("/{key}{place}")),
        );
        found
    };
    match value {
        Value::Object(map) => map.iter().flat_map(|(k, v)| below(k.clone(), v)).collect(),
        Value::Array(list) => list
            .iter()
            .enumerate()
            .flat_map(|(i, v)| below(i.to_string(), v))
            .collect(),
        _ => Vec::new(),
    }
}

/// Values that are short to write and long to keep.
#[test]
fn more_values_than_any_boxes_need_are_refused_before_they_are_read() {
    let many = vec![json!({}); MAX_VALUES];
    let mut document = with_extras(json!({}));
    document["materials"] = json!(many);
    let text = document.to_string();
    let told = |bytes: &[u8]| boxes(bytes, "m").unwrap_err().to_string();
    assert!(told(text.as_bytes()).contains("expected at most 262144; export the boxes alone"));
    let mut binary = b"glTF\x02\0\0\0".to_vec();
    binary.extend((20 + text.len() as u32).to_le_bytes());
    binary.extend((text.len() as u32).to_le_bytes());
    binary.extend(b"JSON");
    binary.extend(text.bytes());
    assert!(told(&binary).contains("expected at most 262144"));
}

#[test]
fn the_words_of_a_model_stay_on_their_line() {
    let node = model(
        json!([{"name": "a\u{1b}[2J\nb", "mesh": 0, "scale": [9, 9, 9], "extras": {"sprites": 0}}]),
    );
    let error = refused(&node);
    assert!(
        error.contains(r#"node "a\u{1b}[2J\nb": sprites is 0"#),
        "{error}"
    );
}

#[test]
fn nodes_within_themselves_do_not_go_on_for_ever() {
    let ring = model(json!([{"children": [1]}, {"children": [0]}]));
    assert!(refused(&ring).contains("none within itself"));
    // Each node names the next twice: 2^20 visits.
    let mut nodes: Vec<Value> = (0..20)
        .map(|i| json!({"children": [i + 1, i + 1]}))
        .collect();
    nodes.push(json!({"mesh": 0, "scale": [200, 200, 200]}));
    assert!(refused(&model(json!(nodes))).contains("over 4096"));
}

#[test]
fn too_many_groups_are_refused() {
    let node = |i: usize| json!({"mesh": 0, "scale": [200, 200, 200], "extras": {"group": i}});
    let mut nodes: Vec<Value> = vec![json!({"children": (1..=257).collect::<Vec<_>>()})];
    nodes.extend((0..257).map(node));
    assert!(refused(&model(json!(nodes))).contains("257 numbers, expected at most 256"));
}

/// A sprite as a modelling program may have it: a node of a square that faces the viewer.
fn square(node: Value) -> Value {
    let mut model = model(json!([node]));
    model["accessors"][0]["min"] = json!([-0.5, -0.5, 0.0]);
    model["accessors"][0]["max"] = json!([0.5, 0.5, 0.0]);
    model
}

#[test]
fn a_node_with_a_cell_is_a_sprite_where_it_was_put() {
    let half = libm::sincosf(0.25);
    let node = json!({
        "mesh": 0, "translation": [100, 40, -7.5], "scale": [300, 200, 1],
        "rotation": [0, 0, half.0, half.1], "extras": {"cell": 12, "group": 3},
    });
    let boxes = read(&square(node)).unwrap();
    assert_eq!(boxes.len(), 1);
    let own = &boxes[0];
    assert_eq!((own.group, own.cull, own.sprites), (3, 0.0, 1));
    let sprite = own.by_hand[0];
    let near = |a: f32, b: f32| (a - b).abs() < 1e-3;
    assert!(
        [0, 1, 2]
            .iter()
            .all(|&i| near(sprite.centre_m[i], [100.0, 40.0, -7.5][i]))
    );
    assert!(near(sprite.size_m[0], 300.0) && near(sprite.size_m[1], 200.0));
    assert!(near(sprite.rotation_rad, 0.5));
    assert_eq!(sprite.cell, 12);
}

#[test]
fn a_plane_that_was_stood_up_is_a_sprite_too() {
    let root = std::f32::consts::FRAC_1_SQRT_2;
    // A modelling program's plane lies; a quarter turn about x makes its back the upper side.
    let node = json!({
        "mesh": 0, "rotation": [root, 0, 0, root], "scale": [300, 1, 200], "extras": {"cell": 0},
    });
    let mut lying = model(json!([node]));
    lying["accessors"][0]["min"] = json!([-0.5, 0.0, -0.5]);
    lying["accessors"][0]["max"] = json!([0.5, 0.0, 0.5]);
    let sprite = read(&lying).unwrap()[0].by_hand[0];
    assert!((sprite.size_m[0] - 300.0).abs() < 1e-3 && (sprite.size_m[1] - 200.0).abs() < 1e-3);
    assert!(sprite.rotation_rad.abs() < 1e-6);
}

#[test]
fn sprites_that_are_not_sound_are_refused_by_name() {
    for (extras, expected) in [
        (
            json!({"cell": 16}),
            "cell is 16, expected an integer from 0 to 15",
        ),
        (json!({"cell": "puff"}), "cell is \"puff\""),
        (
            json!({"cell": 1, "sprites": 3}),
            "with a property `sprites`, expected none but cell, group",
        ),
        (json!({"cell": 1, "group": 10_000}), "group is 10000"),
    ] {
        let error = refused(&square(
            json!({"mesh": 0, "scale": [9, 9, 1], "extras": extras}),
        ));
        assert!(error.contains(expected), "{error}");
    }
    let none = square(json!({"mesh": 0, "scale": [0, 9, 1], "extras": {"cell": 1}}));
    assert!(refused(&none).contains("size is 0 m"));
}

#[test]
fn more_sprites_than_a_box_may_have_are_in_several() {
    let node = |i: usize| json!({"mesh": 0, "scale": [9, 9, 1], "translation": [i, 0, 0], "extras": {"cell": 4}});
    let mut nodes = square(json!({"children": (1..=250).collect::<Vec<_>>()}));
    let list = nodes["nodes"].as_array_mut().unwrap();
    list.extend((0..250).map(node));
    let boxes = read(&nodes).unwrap();
    let counts: Vec<u32> = boxes.iter().map(|b| b.sprites).collect();
    assert_eq!(counts, [100, 100, 50]);
    assert!(
        boxes
            .iter()
            .all(|b| b.category == Category::Wispy && b.group == 0)
    );
}
