//! The file there and back, and files that lie.

use proptest::prelude::*;
use serde_json::{Value, json};

use super::document::INSTANCING;
use super::rotation::{quaternion, rotation};
use super::*;
use crate::field::{Field, ROTATION_STEPS, rounded_rotation};
use crate::test_field::field;

const FILE: &str = "field.glb";

fn bytes() -> Vec<u8> {
    encode(FILE, &field(), "test").unwrap()
}

#[test]
fn every_rotation_comes_back() {
    for step in -2047..=2048 {
        let angle = step as f32 * (std::f32::consts::TAU / ROTATION_STEPS);
        assert_eq!(rounded_rotation(angle), angle);
        for flat in [false, true] {
            assert_eq!(rotation(quaternion(angle, flat), flat), Some(angle));
        }
    }
    assert_eq!(rotation([0, 0, 0, 0], false), None);
    assert_eq!(rotation([1, 2, 3, 4], true), None);
}

#[test]
fn a_facing_quarter_turn_is_about_z_and_a_flat_one_about_y() {
    let half = (std::f64::consts::FRAC_1_SQRT_2 * 32767.0).round() as i16;
    let quarter = std::f32::consts::FRAC_PI_2;
    assert_eq!(quaternion(quarter, false), [0, 0, half, half]);
    // Laid down alone: a quarter turn about -X.
    assert_eq!(quaternion(0.0, true), [-half, 0, 0, half]);
    assert_eq!(quaternion(quarter, true).map(i16::abs), [16384; 4]);
}

/// What is wrong with the file after a change of its JSON.
fn blamed(change: impl FnOnce(&mut Value)) -> String {
    let bytes = bytes();
    let (json, bin) = container::split(FILE, &bytes).unwrap();
    let mut json: Value = serde_json::from_slice(json).unwrap();
    change(&mut json);
    let json = serde_json::to_vec(&json).unwrap();
    let bytes = container::join(json, bin.to_vec());
    read_whole(&bytes).unwrap_err().to_string()
}

fn read_whole(bytes: &[u8]) -> Result<Field, crate::PackError> {
    let field = decode(FILE, bytes)?;
    field.verify(FILE)?;
    Ok(field)
}

/// The accessor of an attribute of the sprites.
fn accessor<'a>(json: &'a mut Value, attribute: &str) -> &'a mut Value {
    let index = &json["nodes"][0]["extensions"][INSTANCING]["attributes"][attribute];
    let index = index.as_u64().unwrap() as usize;
    &mut json["accessors"][index]
}

fn clouds(json: &mut Value) -> &mut Value {
    &mut json["scenes"][0]["extras"]["welkin_field"]["clouds"]
}

#[test]
fn a_field_comes_back_as_it_was() {
    assert_eq!(read_whole(&bytes()).unwrap(), field());
}

#[test]
fn equal_tables_of_colour_are_stored_once() {
    let bytes = bytes();
    let (json, _) = container::split(FILE, &bytes).unwrap();
    let json: Value = serde_json::from_slice(json).unwrap();
    let levels = &json["scenes"][0]["extras"]["welkin_field"]["levels"];
    assert_eq!(levels.as_array().unwrap().len(), 2);
}

#[test]
fn a_file_that_was_cut_is_refused_wherever() {
    let bytes = bytes();
    for length in 0..bytes.len() {
        assert!(decode(FILE, &bytes[..length]).is_err(), "{length}");
    }
    let mut longer = bytes.clone();
    longer.push(0);
    assert!(decode(FILE, &longer).is_err());
}

#[test]
fn a_header_that_lies_about_the_length_is_refused() {
    for length in [0_u32, 11, 12, 20, u32::MAX] {
        let mut bytes = bytes();
        bytes[8..12].copy_from_slice(&length.to_le_bytes());
        let error = decode(FILE, &bytes).unwrap_err().to_string();
        assert!(
            error.starts_with(&format!("field.glb: length is {length}")),
            "{error}"
        );
        let mut bytes = self::bytes();
        bytes[12..16].copy_from_slice(&length.to_le_bytes());
        assert!(decode(FILE, &bytes).is_err());
    }
}

#[test]
fn counts_that_lie_are_refused_before_they_are_believed() {
    let error = blamed(|json| accessor(json, "TRANSLATION")["count"] = json!(u64::MAX));
    assert!(
        error.contains("count of sprites is 18446744073709551615, expected at most 65536"),
        "{error}"
    );
    let error = blamed(|json| accessor(json, "TRANSLATION")["count"] = json!(60_000));
    assert!(
        error.contains("sprites.TRANSLATION is 60000 elements at every 48 bytes"),
        "{error}"
    );
    let error = blamed(|json| accessor(json, "_CELL")["count"] = json!(3));
    assert!(
        error.contains("sprites._CELL is 3, expected 200"),
        "{error}"
    );
    let error = blamed(|json| {
        for (view, stride) in [(4, 1), (5, 1)] {
            json["bufferViews"][view]["byteStride"] = json!(stride);
        }
    });
    assert!(
        error.contains("byteStride 1, expected a multiple of 4 from 12 to 256"),
        "{error}"
    );
    let error = blamed(|json| json["bufferViews"][4]["byteOffset"] = json!(u64::MAX));
    assert!(error.contains("expected within"), "{error}");
    let error = blamed(|json| {
        let many = vec![json!({"kind": "cumulus", "rank": 0, "levels": 0, "groups": []}); 4097];
        *clouds(json) = json!(many);
    });
    assert!(
        error.contains("count of clouds is 4097, expected at most 4096"),
        "{error}"
    );
}

#[test]
fn accessors_of_another_type_are_refused() {
    let error = blamed(|json| accessor(json, "SCALE")["componentType"] = json!(5123));
    assert!(
        error.contains("sprites.SCALE is VEC3 of 5123, expected VEC3 of 5126"),
        "{error}"
    );
    let error = blamed(|json| accessor(json, "ROTATION")["normalized"] = json!(false));
    assert!(error.contains("sprites.ROTATION"), "{error}");
    let error = blamed(|json| accessor(json, "_BOX")["type"] = json!("VEC2"));
    assert!(error.contains("sprites._BOX is VEC2"), "{error}");
    let error = blamed(|json| accessor(json, "_BOX")["sparse"] = json!({"count": 1}));
    assert!(error.contains("sprites._BOX"), "{error}");
    let error = blamed(|json| {
        json["nodes"][0]["extensions"][INSTANCING]["attributes"]["_CELL"] = json!(999);
    });
    assert!(error.contains("sprites._CELL is accessor 999"), "{error}");
    let error = blamed(|json| json["nodes"][1]["name"] = json!("crates"));
    assert!(error.contains("a node `boxes`"), "{error}");
    let error = blamed(|json| json["scene"] = json!(7));
    assert!(error.contains("welkin_field"), "{error}");
}

#[test]
fn indices_and_names_that_are_not_there_are_refused() {
    let error = blamed(|json| clouds(json)[2]["levels"] = json!(2));
    assert!(
        error.contains("clouds[2].levels is 2, expected below 2"),
        "{error}"
    );
    let error = blamed(|json| clouds(json)[0]["kind"] = json!("nimbus"));
    assert!(
        error.contains("clouds[0].kind is nimbus, expected one of cumulus"),
        "{error}"
    );
    let error = blamed(|json| drop(clouds(json).as_array_mut().unwrap().pop()));
    assert!(error.contains("_CLOUD is 19, expected below 19"), "{error}");
    let error = blamed(|json| clouds(json)[0]["groups"] = json!([]));
    assert!(
        error.contains("clouds[0].boxes[0].group is 0, expected below 0"),
        "{error}"
    );
    let error = blamed(|json| clouds(json)[0]["colour"] = json!(1));
    assert!(error.contains("unknown field `colour`"), "{error}");
}

#[test]
fn what_gltf_asks_of_any_file_is_asked() {
    let error = blamed(|json| json["asset"]["version"] = json!("1.0"));
    assert!(
        error.contains("asset.version is 1.0, expected 2.0"),
        "{error}"
    );
    let error = blamed(|json| json["asset"]["version"] = json!("2"));
    assert!(error.contains("asset.version"), "{error}");
    let error = blamed(|json| json["asset"]["minVersion"] = json!("2.1"));
    assert!(error.contains("asset.minVersion is 2.1"), "{error}");
    let error = blamed(|json| {
        json["extensionsRequired"] = json!([INSTANCING, "KHR_draco_mesh_compression"])
    });
    assert!(error.contains("extensionsRequired is KHR_draco"), "{error}");
    let error = blamed(|json| json["extensionsUsed"] = json!([]));
    assert!(error.contains("extensionsUsed"), "{error}");
    let error = blamed(|json| drop(json.as_object_mut().unwrap().remove("buffers")));
    assert!(
        error.contains("buffers is 0 of them, expected one"),
        "{error}"
    );
    let error = blamed(|json| json["buffers"] = json!([]));
    assert!(error.contains("buffers is 0 of them"), "{error}");
    let error = blamed(|json| {
        json["buffers"]
            .as_array_mut()
            .unwrap()
            .push(json!({"byteLength": 4}))
    });
    assert!(error.contains("buffers is 2 of them"), "{error}");
    let error = blamed(|json| json["buffers"][0]["uri"] = json!("more.bin"));
    assert!(error.contains("buffers[0] is with a uri"), "{error}");
    for by in [-4, 4, i64::MAX] {
        let error = blamed(|json| {
            let length = &mut json["buffers"][0]["byteLength"];
            *length = json!(length.as_i64().unwrap().saturating_add(by));
        });
        assert!(error.contains("buffers[0].byteLength"), "{error}");
    }
    let error = blamed(|json| json["scenes"][0]["nodes"] = json!([0]));
    assert!(error.contains("a node `boxes` with"), "{error}");
    let error = blamed(|json| json["scenes"][0]["nodes"] = json!([0, 1, 0]));
    assert!(error.contains("one node `sprites` in the scene"), "{error}");
    let error = blamed(|json| accessor(json, "SCALE")["byteOffset"] = json!(13));
    assert!(error.contains("sprites.SCALE is at"), "{error}");
    let mut odd = bytes();
    odd[12..16].copy_from_slice(&1021_u32.to_le_bytes());
    let error = decode(FILE, &odd).unwrap_err().to_string();
    assert!(error.contains("chunk length is 1021"), "{error}");
    // A later minor version, and extensions that need not be known.
    let bytes = bytes();
    let (json, bin) = container::split(FILE, &bytes).unwrap();
    let mut json: Value = serde_json::from_slice(json).unwrap();
    json["asset"]["version"] = json!("2.1");
    json["extensionsRequired"] = json!([INSTANCING]);
    json["extensionsUsed"] = json!([INSTANCING, "KHR_lights_punctual"]);
    let json = serde_json::to_vec(&json).unwrap();
    assert!(read_whole(&container::join(json, bin.to_vec())).is_ok());
}

#[test]
fn lists_of_nothing_are_cut_short() {
    for key in [
        "nodes",
        "scenes",
        "buffers",
        "extensionsUsed",
        "extensionsRequired",
    ] {
        let entry = if key.starts_with("ext") {
            json!("")
        } else {
            json!({})
        };
        let error = blamed(|json| json[key] = json!(vec![entry; 1025]));
        assert!(error.contains("JSON is"), "{key}: {error}");
        let told = error.contains("a list of at most 1024 entries") || key == "buffers";
        assert!(told, "{key}: {error}");
    }
}

/// What is wrong after a change of one record of the sprites.
fn blamed_record(at: usize, value: &[u8]) -> String {
    let bytes = bytes();
    let (json, bin) = container::split(FILE, &bytes).unwrap();
    let document: Value = serde_json::from_slice(json).unwrap();
    let start = document["bufferViews"][4]["byteOffset"].as_u64().unwrap() as usize;
    let mut bin = bin.to_vec();
    bin[start + at..][..value.len()].copy_from_slice(value);
    let bytes = container::join(json.to_vec(), bin);
    read_whole(&bytes).unwrap_err().to_string()
}

#[test]
fn records_of_nonsense_are_refused() {
    let nan = f32::NAN.to_le_bytes();
    for (at, value, key) in [
        (0, &nan[..], "clouds[0].sprites.centre_m is NaN"),
        (
            12,
            &f32::INFINITY.to_le_bytes(),
            "clouds[0].sprites.size_m is inf",
        ),
        (
            12,
            &(-1.0_f32).to_le_bytes(),
            "clouds[0].sprites.size_m is -1",
        ),
        (20, &2.0_f32.to_le_bytes(), "sprites.SCALE is 2 in z"),
        (24, &[1, 0], "sprites.ROTATION is [1, 0, 0, 32767]"),
        (
            32,
            &[16, 0],
            "clouds[0].sprites[0].cell is 16, expected below 16",
        ),
        (32, &[0, 1], "sprites._CELL is 256"),
        (34, &[9, 0], "sprites._GROUP is 9"),
        (36, &[20, 0], "sprites._CLOUD is 20, expected below 20"),
        (
            38,
            &[2, 0],
            "clouds[0].sprites[0].cloud_box is 2, expected below 2",
        ),
    ] {
        let error = blamed_record(at, value);
        assert!(error.contains(key), "{key}: {error}");
    }
}

proptest! {
    #[test]
    fn no_bytes_make_the_reader_panic(
        changes in prop::collection::vec((any::<prop::sample::Index>(), any::<u8>()), 1..12),
        cut in any::<prop::sample::Index>(),
        cuts in any::<bool>(),
    ) {
        let mut bytes = bytes();
        for (at, value) in changes {
            let at = at.index(bytes.len());
            bytes[at] = value;
        }
        if cuts {
            bytes.truncate(cut.index(bytes.len()));
        }
        drop(read_whole(&bytes));
    }

    #[test]
    fn no_json_makes_the_reader_panic(
        path in prop::sample::select(vec!["/scene", "/accessors/3/count", "/accessors/4/byteOffset",
            "/bufferViews/4/byteLength", "/bufferViews/4/byteStride", "/bufferViews/4/byteOffset",
            "/accessors/5/bufferView", "/scenes/0/extras/welkin_field/sections"]),
        number in any::<u64>(),
    ) {
        let bytes = bytes();
        let (json, bin) = container::split(FILE, &bytes).unwrap();
        let mut json: Value = serde_json::from_slice(json).unwrap();
        *json.pointer_mut(path).unwrap() = json!(number);
        let json = serde_json::to_vec(&json).unwrap();
        drop(read_whole(&container::join(json, bin.to_vec())));
    }
}
