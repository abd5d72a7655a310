//! Recipes of fields that are refused, each with its key, what was found and what was expected.

use welkin_baker::{BakeError, ModelSource, RecipeError};
use welkin_pack::field::{Category, CloudKind};

use super::{resolve, settings, try_field};

fn refused(text: &str) -> String {
    match resolve(text) {
        Err(error) => error.to_string(),
        Ok(resolved) => panic!("{text:?} gave {:?}", resolved.field),
    }
}

const BOX: &str = "[[field.models]]\nkind = \"cumulus\"\n[[field.models.boxes]]\ncentre_m = [0, 100, 0]\nsize_m = [600, 200, 600]\n";

#[test]
fn nothing_said_is_the_default_field_and_no_sections_are_none() {
    let default = settings("");
    assert_eq!(default, settings("[field]\n"));
    assert_eq!(default.layers.len(), 2);
    assert!(default.hours.len() >= 8);
    assert_eq!(resolve("[field]\nsections = 0\n").unwrap().field, None);
    // What is said takes the place of the default.
    let layers = settings("[[field.clouds]]\nkind = \"stratus\"\n").layers;
    assert_eq!((layers.len(), layers[0].kind), (1, CloudKind::Stratus));
    let boxes = settings(BOX);
    assert!(boxes.layers.is_empty());
    let ModelSource::Boxes(boxes) = &boxes.models[0].source else {
        panic!("boxes");
    };
    assert_eq!(
        (boxes[0].sprites, boxes[0].category),
        (12, Category::Cumulus)
    );
}

#[test]
fn values_out_of_range_are_refused_by_key() {
    let layer = |line: &str| format!("[[field.clouds]]\nkind = \"cumulus\"\n{line}\n");
    let of_box = |line: &str| format!("{BOX}{line}\n");
    for (text, expected) in [
        ("[field]\nsections = 9\n".to_string(), "sky.toml:2:12: field.sections is 9, expected an integer from 0 to 8"),
        ("[field]\nmost_sprites = 1000000\n".to_string(), "field.most_sprites is 1000000, expected an integer from 1 to 65536"),
        (layer("cover = 1.5"), "sky.toml:3:9: field.clouds[0].cover is 1.5, expected a number from 0 to 1"),
        (layer("cover = nan"), "field.clouds[0].cover is nan, expected a number from 0 to 1"),
        (layer("top_m = 1020"), "field.clouds[0].top_m is 1020, expected a number from 1050 to 20050"),
        (layer("base_m = inf"), "field.clouds[0].base_m is inf"),
        (layer("density = 0"), "field.clouds[0].density is 0, expected a number from 0.25 to 4"),
        (layer("cull = 0"), "field.clouds[0].cull is 0, expected a number from 0.05 to 1"),
        (layer("levels = [[0, 1, 1, 1, 1]]"), "field.clouds[0].levels is [[0, 1, 1, 1, 1]], expected five lists"),
        (layer("levels = [[1,1,1,1,1],[0,1,1,1,1],[0,1,1,1,1],[0,1,1,1,1],[0,1,1,1,1]]"), "lowest first"),
        ("[[field.clouds]]\nkind = \"nimbus\"\n".to_string(), "field.clouds[0].kind is \"nimbus\", expected one of \"cumulus\", \"congestus\""),
        ("[[field.clouds]]\ncover = 0.5\n".to_string(), "field.clouds[0].kind is missing"),
        (of_box("sprites = 0"), "field.models[0].boxes[0].sprites is 0, expected an integer from 1 to 100"),
        (of_box("sprites = 1000000"), "field.models[0].boxes[0].sprites is 1000000"),
        (of_box("category = \"nimbus\""), "field.models[0].boxes[0].category is \"nimbus\", expected one of \"stratus\", \"cumulus\", \"wispy\""),
        (of_box("width_m = [300, 200]"), "field.models[0].boxes[0].width_m is [300, 200], expected the least first"),
        (of_box("height_m = [nan, 200]"), "field.models[0].boxes[0].height_m is [nan, 200], expected a list of 2 numbers"),
        (of_box("rotation_deg = [0, 361]"), "rotation_deg is [0, 361], expected a list of 2 numbers from -180 to 180"),
        (of_box("cull = 1.0\nheight_m = [800, 800]"), "boxes[0].cull is 800 m of the sprites' mean height, expected at most the longest side of the box, 600 m"),
        (of_box("flat_bottom = 1"), "flat_bottom is 1, expected true or false"),
        (BOX.replace("[600, 200, 600]", "[600, 0, 600]"), "size_m is [600, 0, 600], expected a list of 3 numbers from 1 to 20000"),
        (BOX.replace("centre_m = [0, 100, 0]\n", ""), "field.models[0].boxes[0].centre_m is missing"),
        ("[[field.models]]\nkind = \"cumulus\"\n".to_string(), "field.models[0] is without boxes, expected either `file`"),
        (format!("{BOX}[[field.models]]\nkind = \"cumulus\"\nfile = \"\"\n"), "field.models[1].file is \"\""),
        ("[field]\nclouds = []\n".to_string(), "field is without a cloud"),
        ("[[field.clouds]]\nkind = \"cirrus\"\ncover = 0.0\n".to_string(), "field.clouds[0].cover is 0.0, expected over 0, up to 1, in one layer at least, or `sections = 0`"),
        ("[field]\nhours = []\n".to_string(), "field.hours is empty"),
        ("[[field.hours]]\ntime = 0.5\n".to_string(), "field.hours[0].colour is missing"),
        ("[[field.hours]]\ncolour = [1, 1, 1]\n".to_string(), "field.hours[0].time is missing"),
        ("[field]\nhours = [{ time = 0.5, colour = [1, 1, 1] }, { time = 0.5, colour = [1, 1, 1] }]\n".to_string(), "field.hours[1].time is 0.5, expected over 0.5"),
        ("[field]\nhours = [{ time = 0.5, colour = [1, -1, 1] }]\n".to_string(), "field.hours[0].colour is [1, -1, 1]"),
        ("[field]\nhours = [{ time = 0.5, colour = [1, 1, 1], least = 0.5, most = 0.4 }]\n".to_string(), "field.hours[0].most is 0.4, expected a number from 0.5 to 1"),
    ] {
        let error = refused(&text);
        assert!(error.contains(expected), "{error}");
    }
}

#[test]
fn unknown_keys_are_refused() {
    for text in [
        "[field]\nsection = 3\n",
        "[[field.clouds]]\nkinds = 3\n",
        "[[field.models]]\nfiles = 3\n",
    ] {
        assert!(
            matches!(resolve(text), Err(RecipeError::Syntax { .. })),
            "{text}"
        );
    }
}

#[test]
fn a_file_that_is_not_there_or_not_a_model_is_refused() {
    let model = |file: &str| format!("[[field.models]]\nkind = \"cumulus\"\nfile = \"{file}\"\n");
    match try_field(&model("nowhere.glb")) {
        Err(BakeError::Read { key, .. }) => assert_eq!(key, "field.models[0].file"),
        other => panic!("{other:?}"),
    }
    match try_field(&model("cumulus.toml")) {
        Err(BakeError::Model { file, key, .. }) => {
            assert!(file.ends_with("cumulus.toml"));
            assert_eq!(key, "glTF");
        }
        other => panic!("{other:?}"),
    }
}

#[test]
fn a_field_that_would_be_too_large_is_refused_before_it_is_made() {
    let copies = BOX.replace("kind", "copies = 256\nkind") + "sprites = 100\n";
    let error = try_field(&copies).unwrap_err().to_string();
    let expected =
        "field.models[0]: the field needs 25600 sprites, expected at most 16384; lower its cover";
    assert!(error.starts_with(expected), "{error}");
    assert!(try_field(&format!("[field]\nmost_sprites = 25600\n{copies}")).is_ok());
    let layer = "[field]\nmost_sprites = 500\n[[field.clouds]]\nkind = \"cumulus\"\ncover = 1.0\n";
    match try_field(layer) {
        Err(BakeError::Field {
            key, found, limit, ..
        }) => {
            assert_eq!((key.as_str(), limit), ("field.clouds[0]", 500));
            assert!((501..=900).contains(&found));
        }
        other => panic!("{other:?}"),
    }
}

#[test]
fn memory_is_bounded_by_what_the_recipe_says() {
    let most = |sprites: u32| settings(&format!("[field]\nmost_sprites = {sprites}\n")).bound();
    let (few, many) = (most(1000), most(65_536));
    assert_eq!((few.sprites, few.boxes, few.clouds), (1000, 1000, 1000));
    assert_eq!(
        (many.sprites, many.boxes, many.clouds),
        (65_536, 16_384, 4096)
    );
    // The figures of docs/field.md, on machines of 64 bits.
    if cfg!(target_pointer_width = "64") {
        assert_eq!(few.bytes, 1000 * (112 + 128 + 336));
        assert_eq!(many.bytes, 65_536 * 112 + 16_384 * 128 + 4096 * 336);
    }
}
