//! Round trips of every format and shape, and hostile files.

mod rules;

use proptest::prelude::*;

use crate::error::PackError;
use crate::format::{Format, Shape};
use crate::ktx::{decode, encode, encode_with};
use crate::role::Mips;
use crate::texture::{Texture, level_size};

fn texture(
    format: Format,
    shape: Shape,
    width: u32,
    height: u32,
    layers: u32,
    mips: Mips,
) -> Texture {
    let count = mips.count(width, height);
    let mut texture = Texture {
        format,
        shape,
        width,
        height,
        layers,
        levels: Vec::new(),
    };
    for level in 0..count {
        let bytes = texture.level_bytes(level);
        // Small steps, so that half floats stay finite.
        texture.levels.push(
            (0..bytes)
                .map(|i| ((i * 7 + level * 31) % 60) as u8)
                .collect(),
        );
    }
    texture
}

fn sample() -> Vec<u8> {
    encode(
        "t.ktx2",
        &texture(Format::Rgba8Unorm, Shape::D2, 16, 8, 1, Mips::All),
        "welkin test",
    )
    .unwrap()
}

#[test]
fn every_format_and_shape_survives() {
    for format in Format::ALL {
        for (shape, size, layers) in [
            (Shape::D2, [16, 8], 1),
            (Shape::Array, [8, 8], 3),
            (Shape::Cube, [8, 8], 6),
        ] {
            for mips in [Mips::All, Mips::One, Mips::To(4)] {
                let texture = texture(format, shape, size[0], size[1], layers, mips);
                let bytes = encode("t.ktx2", &texture, "welkin test").unwrap();
                assert_eq!(
                    decode("t.ktx2", &bytes).unwrap(),
                    texture,
                    "{format:?} {shape:?}"
                );
            }
        }
    }
}

#[test]
fn the_same_texture_gives_the_same_bytes() {
    assert_eq!(sample(), sample());
}

#[test]
fn key_values_are_what_the_specification_asks() {
    let bytes = sample();
    let reader = ktx2::Reader::new(&bytes[..]).unwrap();
    let pairs: Vec<_> = reader.key_value_data().collect();
    assert_eq!(
        pairs,
        [
            ("KTXorientation", &b"rd\0"[..]),
            ("KTXwriter", &b"welkin test\0"[..])
        ]
    );
    assert_eq!(reader.basic_dfd().unwrap().bytes_planes[0], 4);
    assert_eq!(
        reader.transfer_function(),
        Some(ktx2::TransferFunction::Linear)
    );
}

#[test]
fn texts_of_an_application_stand_among_the_keys_in_order() {
    let texture = texture(Format::Rgba16Float, Shape::Cube, 8, 8, 6, Mips::All);
    let with = |texts| encode_with("t.ktx2", &texture, "welkin test", texts);
    let bytes = with(&[("skyScale", "4"), ("Azimuth", "north")]).unwrap();
    let reader = ktx2::Reader::new(&bytes[..]).unwrap();
    assert_eq!(
        reader.key_value_data().collect::<Vec<_>>(),
        [
            ("Azimuth", &b"north\0"[..]),
            ("KTXorientation", &b"rd\0"[..]),
            ("KTXwriter", &b"welkin test\0"[..]),
            ("skyScale", &b"4\0"[..]),
        ]
    );
    assert_eq!(decode("t.ktx2", &bytes).unwrap(), texture);
    // What the specification keeps for itself, twice the same, and no key at all.
    for texts in [
        &[("KTXscale", "4")][..],
        &[("KTXwriter", "me")],
        &[("a", "1"), ("a", "2")],
        &[("", "1")],
    ] {
        assert!(with(texts).is_err(), "{texts:?}");
    }
}

#[test]
fn levels_lie_smallest_first() {
    let bytes = sample();
    let start = |level: usize| {
        let at = 80 + level * 24;
        u64::from_le_bytes(bytes[at..at + 8].try_into().unwrap())
    };
    assert!((1..5).all(|level| start(level) < start(level - 1)));
}

/// The field that is blamed for these bytes.
fn blamed_in(bytes: &[u8]) -> String {
    match decode("t.ktx2", bytes).unwrap_err() {
        PackError::Value { key, .. } | PackError::TooLarge { key, .. } => key,
        other => panic!("{other}"),
    }
}

/// The same for the sample with four of its bytes replaced.
fn blamed(offset: usize, value: u32) -> String {
    let mut bytes = sample();
    bytes[offset..offset + 4].copy_from_slice(&value.to_le_bytes());
    blamed_in(&bytes)
}

#[test]
fn hostile_headers_are_refused_by_name() {
    let of_block = |key: &str| format!("data format descriptor: {key}");
    assert_eq!(blamed(0, 0), "container");
    assert_eq!(blamed(12, 43), "vkFormat"); // R8G8B8A8_SRGB: data is linear
    assert_eq!(blamed(12, 9), of_block("dfdByteLength")); // R8 with the descriptor of RGBA8
    assert_eq!(blamed(16, 4), "typeSize");
    assert_eq!(blamed(20, 0), "container");
    assert_eq!(blamed(20, 100_000), "pixelWidth");
    assert_eq!(blamed(24, 0), "pixelHeight");
    assert_eq!(blamed(24, u32::MAX), "pixelHeight");
    assert_eq!(blamed(28, 2), "pixelDepth");
    assert_eq!(blamed(32, u32::MAX), "layerCount");
    assert_eq!(blamed(36, 6), "faceCount");
    assert_eq!(blamed(36, 3), "faceCount");
    assert_eq!(blamed(40, 0), "levelCount");
    assert_eq!(blamed(40, 6), "levelCount");
    assert_eq!(blamed(40, u32::MAX), "levelCount");
    assert_eq!(blamed(44, 1), "supercompressionScheme");
    assert_eq!(blamed(44, 3), "supercompressionScheme");
    assert_eq!(blamed(44, 0x1_0000), "supercompressionScheme");
    assert_eq!(blamed(48, u32::MAX), "data format descriptor");
    assert_eq!(blamed(52, 0), of_block("dfdByteLength"));
    assert_eq!(blamed(56, u32::MAX), "kvdByteOffset");
    assert_eq!(blamed(60, u32::MAX), "key/value data");
    assert_eq!(blamed(80 + 16, 100), "level 0: uncompressedByteLength");
}

#[test]
fn a_texture_of_one_dimension_is_told_what_it_lacks() {
    let mut bytes = sample();
    bytes[24..28].fill(0);
    let error = decode("t.ktx2", &bytes).unwrap_err().to_string();
    assert_eq!(
        error,
        "t.ktx2: pixelHeight is 0, expected 1 or more: a 2-D texture"
    );
}

#[test]
fn a_small_file_that_claims_much_is_refused_before_anything_is_allocated() {
    let mut bytes = sample();
    bytes[20..24].copy_from_slice(&8192_u32.to_le_bytes());
    bytes[24..28].copy_from_slice(&8192_u32.to_le_bytes());
    bytes[32..36].copy_from_slice(&256_u32.to_le_bytes());
    bytes[40..44].copy_from_slice(&1_u32.to_le_bytes());
    let error = decode("t.ktx2", &bytes).unwrap_err();
    assert!(
        matches!(
            error,
            PackError::TooLarge {
                found: 68_719_476_736,
                ..
            }
        ),
        "{error}"
    );
}

#[test]
fn a_truncated_file_is_refused_at_every_length() {
    let bytes = sample();
    for length in 0..bytes.len() {
        assert!(decode("t.ktx2", &bytes[..length]).is_err(), "{length}");
    }
}

#[test]
fn level_sizes_end_at_one() {
    assert_eq!(level_size(16, 4, 3), (2, 1));
    assert_eq!(level_size(16, 4, 40), (1, 1));
    assert_eq!(Texture::full_level_count(512, 512), 10);
    assert_eq!(Texture::full_level_count(1, 1), 1);
}

/// Every byte in turn becomes each of the values that arithmetic trips over.
#[test]
fn no_single_byte_makes_it_panic() {
    let mut bytes = sample();
    for at in 0..bytes.len() {
        let kept = bytes[at];
        for value in [0, 1, 3, 4, 127, 128, 254, 255] {
            bytes[at] = value;
            let _ = decode("t.ktx2", &bytes);
        }
        bytes[at] = kept;
    }
}

#[test]
fn a_descriptor_of_older_revisions_is_read() {
    let mut bytes = sample();
    let planes = bytes.len().min(80 + 5 * 24 + 4 + 16);
    bytes[planes..planes + 8].fill(0);
    assert_eq!(
        decode("t.ktx2", &bytes).unwrap(),
        decode("t.ktx2", &sample()).unwrap()
    );
}

proptest! {
    #[test]
    fn no_bytes_make_it_panic(bytes in proptest::collection::vec(any::<u8>(), 0..400)) {
        let _ = decode("t.ktx2", &bytes);
    }

    #[test]
    fn no_damage_makes_it_panic(at in 0_usize..400, value in any::<u8>(), at_2 in 0_usize..200, value_2 in any::<u8>()) {
        let mut bytes = sample();
        let length = bytes.len();
        bytes[at % length] = value;
        bytes[at_2 % length] = value_2;
        let _ = decode("t.ktx2", &bytes);
    }
}
