use half::f16;

use super::super::cubemap::tests::{at_centres, rough_sky};
use super::*;

#[test]
fn the_scale_is_the_least_power_of_two_that_lets_the_brightest_fit() {
    for (brightest, wanted) in [
        (0.0, 1.0),
        (1.0, 1.0),
        (65504.0, 1.0),
        (65505.0, 2.0),
        (131_008.0, 2.0),
        (1e6, 16.0),
        (1e12, 16_777_216.0),
    ] {
        let light = Light {
            levels: vec![rough_sky(16, brightest)],
            harmonics: Harmonics::default(),
        };
        assert_eq!(light.radiance_scale(), wanted, "{brightest}");
    }
}

#[test]
fn another_reader_finds_the_levels_in_the_ktx2_and_radiance_is_scale_times_texel() {
    let light = Light::of(rough_sky(64, 300_000.0));
    let bytes = light.ktx2("sky.ktx2").unwrap();
    let reader = ktx2::Reader::new(&bytes[..]).unwrap();
    let header = reader.header();
    assert_eq!(header.format, Some(ktx2::Format::R16G16B16A16_SFLOAT));
    assert_eq!((header.pixel_width, header.pixel_height), (64, 64));
    assert_eq!((header.pixel_depth, header.layer_count), (0, 0));
    assert_eq!((header.face_count, header.level_count), (6, 4));
    assert_eq!(
        reader.transfer_function(),
        Some(ktx2::TransferFunction::Linear)
    );
    assert_eq!(reader.color_primaries(), Some(ktx2::ColorPrimaries::BT709));
    let texts: Vec<_> = reader
        .key_value_data()
        .map(|(key, value)| (key, std::str::from_utf8(value).unwrap()))
        .collect();
    assert_eq!(
        texts,
        [
            ("KTXorientation", "rd\0"),
            ("KTXwriter", &format!("{WRITER}\0")),
            ("welkinPerceptualRoughness", "0 0.33333334 0.6666667 1\0"),
            ("welkinRadianceScale", "8\0"),
        ]
    );
    for (level, stored) in reader.levels().enumerate() {
        let texels = zstd_free(&bytes, level, stored.uncompressed_byte_length as usize);
        let side = 64 >> level;
        assert_eq!(texels.len(), 6 * side * side * 8);
        let map = &light.levels[level];
        let wanted = map
            .faces
            .iter()
            .flat_map(|face| face.texels.chunks_exact(3));
        for (texel, wanted) in texels.chunks_exact(8).zip(wanted) {
            let value = |i: usize| f16::from_le_bytes([texel[2 * i], texel[2 * i + 1]]).to_f32();
            assert_eq!(value(3), 1.0);
            for (i, wanted) in wanted.iter().enumerate() {
                // Half floats have steps of 2^-11 of their value.
                assert!((8.0 * value(i) / wanted - 1.0).abs() < 1.0 / 2048.0);
            }
        }
    }
}

/// The texels of a level; the crate `ktx2` hands them out as they are stored, so our own reader inflates them.
fn zstd_free(bytes: &[u8], level: usize, length: usize) -> Vec<u8> {
    let texels = ktx::decode("sky.ktx2", bytes)
        .unwrap()
        .levels
        .swap_remove(level);
    assert_eq!(texels.len(), length);
    texels
}

#[test]
fn the_json_has_the_keys_that_it_is_documented_to_have() {
    let light = Light::of(at_centres(16, |_| [1.0, 2.0, 0.0]));
    let json = light.json("noon \"2\".hdr", "sky.ktx2").unwrap();
    let value: serde_json::Value = serde_json::from_str(&json).unwrap();
    let keys: Vec<_> = value.as_object().unwrap().keys().cloned().collect();
    let docs = include_str!("../../../docs/json.md");
    let (_, section) = docs.split_once("## Image-based light").unwrap();
    let documented = |key: &str| section.contains(&format!("`{key}`"));
    assert_eq!(keys.len(), 9);
    assert!(keys.iter().all(|key| documented(key)), "{keys:?}");
    assert_eq!(value["format"], "welkin-image-based-light");
    assert_eq!(value["version"], 1);
    assert_eq!(value["source"], "noon \"2\".hdr");
    assert_eq!(value["texture"], "sky.ktx2");
    assert_eq!(value["primaries"], "BT.709, linear");
    assert_eq!(value["radiance_scale"], 1.0);
    assert_eq!(
        value["levels"],
        serde_json::json!([
            {"side": 16, "perceptual_roughness": 0.0},
            {"side": 8, "perceptual_roughness": 1.0},
        ])
    );
    let irradiance = &value["irradiance"];
    assert_eq!(irradiance["axes"], "x east, y up, z south");
    assert_eq!(irradiance["basis"][4], "1.092548 * x * y");
    let coefficients = irradiance["coefficients"].as_array().unwrap();
    assert_eq!(coefficients.len(), COUNT);
    // Of a constant sky π sqrt(4π) = 11.1367 times its radiance, and then nothing.
    let first = |i: usize| coefficients[0][i].as_f64().unwrap();
    assert!((first(0) - 11.136_7).abs() < 1e-4 && (first(1) - 22.273_3).abs() < 1e-4);
    assert_eq!(first(2), 0.0);
    for coefficient in &coefficients[1..] {
        assert!(
            coefficient
                .as_array()
                .unwrap()
                .iter()
                .all(|c| c.as_f64().unwrap().abs() < 1e-5)
        );
    }
}
