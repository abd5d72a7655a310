use exr::meta::attribute::Chromaticities;
use exr::prelude::{
    Encoding, Image as ExrImage, Layer, LayerAttributes, SpecificChannels, Vec2, WritableImage,
};
use image::Rgb;
use image::codecs::hdr::HdrEncoder;
use proptest::prelude::*;

use super::*;

const WIDTH: usize = 16;

fn radiance(i: usize) -> [f32; 3] {
    [i as f32, 0.5, 1.0 / (1.0 + i as f32)]
}

fn hdr_of(size: [usize; 2], value: impl Fn(usize) -> [f32; 3]) -> Vec<u8> {
    let mut bytes = Vec::new();
    let pixels: Vec<_> = (0..size[0] * size[1]).map(|i| Rgb(value(i))).collect();
    let encoder = HdrEncoder::new(&mut bytes);
    encoder.encode(&pixels, size[0], size[1]).unwrap();
    bytes
}

fn exr_of(
    size: [usize; 2],
    primaries: Option<Chromaticities>,
    value: impl Fn(usize) -> [f32; 3] + Sync,
) -> Vec<u8> {
    let channels = SpecificChannels::rgb(|at: Vec2<usize>| {
        let [r, g, b] = value(at.y() * size[0] + at.x());
        (r, g, b)
    });
    let layer = Layer::new(
        (size[0], size[1]),
        LayerAttributes::default(),
        Encoding::SMALL_LOSSLESS,
        channels,
    );
    let mut image = ExrImage::from_layer(layer);
    image.attributes.chromaticities = primaries;
    let mut bytes = Cursor::new(Vec::new());
    image
        .write()
        .non_parallel()
        .to_buffered(&mut bytes)
        .unwrap();
    bytes.into_inner()
}

/// That the bytes are refused, with the file and all of these words.
fn refused(bytes: &[u8], words: &[&str]) {
    let error = decode(bytes, "sky.hdr").unwrap_err().to_string();
    assert!(error.starts_with("sky.hdr: "), "{error}");
    for word in words {
        assert!(error.contains(word), "no {word:?} in {error}");
    }
}

#[test]
fn both_formats_give_back_what_was_written() {
    let size = [WIDTH, WIDTH / 2];
    let read = decode(&exr_of(size, Some(BT709), radiance), "sky").unwrap();
    assert_eq!((read.infinite, read.negative), (0, 0));
    assert_eq!([read.image.width, read.image.height], [16, 8]);
    for (i, texel) in read.image.texels.chunks_exact(3).enumerate() {
        assert_eq!(texel, radiance(i));
    }
    let read = decode(&hdr_of(size, radiance), "sky").unwrap();
    for (i, texel) in read.image.texels.chunks_exact(3).enumerate() {
        let wanted = radiance(i);
        let brightest = wanted.into_iter().fold(0.0, f32::max);
        for (found, wanted) in texel.iter().zip(wanted) {
            // A step of RGBE, which its encoder cuts off.
            assert!((found - wanted).abs() <= brightest / 128.0);
        }
    }
}

#[test]
fn what_is_no_panorama_is_refused_with_what_one_is() {
    refused(b"", &["format is empty", "Radiance HDR or OpenEXR"]);
    refused(b"\x89PNG\r\n\x1a\n", &["format is unknown", "convert it"]);
    for size in [[16, 16], [16, 4], [17, 8], [1, 1]] {
        let words = [format!("{}x{}", size[0], size[1]), "twice as wide".into()];
        let words = [0, 1].map(|i| words[i].as_str());
        refused(&hdr_of(size, radiance), &words);
        refused(&exr_of(size, None, radiance), &words);
    }
    // Before anything is allocated for it: 100000 by 50000 texels would be 60 GB.
    let header = b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 50000 +X 100000\n";
    refused(header, &["100000x50000", "8192 columns"]);
    let turned = b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n+Y 8 +X 16\n";
    refused(turned, &["Orientation +Y +X", "save"]);
}

#[test]
fn broken_files_are_refused_as_such() {
    let size = [WIDTH, WIDTH / 2];
    for whole in [hdr_of(size, radiance), exr_of(size, None, radiance)] {
        refused(&whole[..whole.len() - 9], &["content", "again"]);
        refused(&whole[..12], &["again"]);
    }
}

#[test]
fn other_primaries_are_refused_and_what_says_nothing_is_taken() {
    let size = [WIDTH, WIDTH / 2];
    // ITU-R BT.2020-2, table 3.
    let wide = Chromaticities {
        red: Vec2(0.708, 0.292),
        green: Vec2(0.170, 0.797),
        blue: Vec2(0.131, 0.046),
        white: Vec2(0.3127, 0.3290),
    };
    refused(
        &exr_of(size, Some(wide), radiance),
        &["chromaticities", "0.708", "BT.709"],
    );
    let with = |line: &str| {
        let text = hdr_of(size, radiance);
        let start = text.windows(2).position(|pair| pair == b"\n\n").unwrap();
        let line = format!("\nPRIMARIES={line}");
        [&text[..start], line.as_bytes(), &text[start..]].concat()
    };
    refused(
        &with("0.708 0.292 0.170 0.797 0.131 0.046 0.3127 0.329"),
        &["PRIMARIES", "BT.709"],
    );
    refused(&with("a b"), &["PRIMARIES", "eight numbers"]);
    for line in [
        "0 0 0 0 0 0 0 0",
        "0.640 0.330 0.290 0.600 0.150 0.060 0.333 0.333",
        "0.64 0.33 0.30 0.60 0.15 0.06 0.3127 0.329",
    ] {
        decode(&with(line), "sky").unwrap();
    }
}

#[test]
fn texels_that_no_light_has_are_refused_or_counted() {
    let with = |value: f32| {
        exr_of([WIDTH, WIDTH / 2], None, move |i| {
            if i == 35 {
                [1.0, value, 2.0]
            } else {
                radiance(i)
            }
        })
    };
    refused(
        &with(f32::NAN),
        &["radiance", "NaN in column 3, row 2", "repair"],
    );
    refused(&with(1e30), &["column 3, row 2", "1e12"]);
    let read = decode(&with(f32::INFINITY), "sky").unwrap();
    assert_eq!((read.infinite, read.negative), (1, 0));
    assert_eq!(read.image.texel(3, 2), [1.0, 65504.0, 2.0]);
    for below in [-0.25, f32::NEG_INFINITY] {
        let read = decode(&with(below), "sky").unwrap();
        assert_eq!((read.infinite, read.negative), (0, 1));
        assert_eq!(read.image.texel(3, 2), [1.0, 0.0, 2.0]);
    }
    // As bright as the sun in candelas a square metre.
    let read = decode(&with(1.6e9), "sky").unwrap();
    assert_eq!(read.image.texel(3, 2)[1], 1.6e9);
}

#[test]
fn a_file_that_cannot_be_read_is_told() {
    let folder = tempfile::tempdir().unwrap();
    for path in [folder.path().join("none.hdr"), folder.path().to_path_buf()] {
        let error = panorama(&path).unwrap_err().to_string();
        assert!(error.contains("cannot be read"), "{error}");
        assert!(error.contains(&path.display().to_string()), "{error}");
    }
}

proptest! {
    #[test]
    fn changed_bytes_end_in_a_panorama_or_an_error(
        is_exr in any::<bool>(),
        changes in prop::collection::vec((any::<prop::sample::Index>(), any::<u8>()), 1..6),
    ) {
        let size = [WIDTH, WIDTH / 2];
        let mut bytes = if is_exr { exr_of(size, None, radiance) } else { hdr_of(size, radiance) };
        for (place, value) in changes {
            let at = place.index(bytes.len());
            bytes[at] = value;
        }
        if let Ok(read) = decode(&bytes, "sky") {
            prop_assert!(read.image.width == 2 * read.image.height);
            prop_assert!(read.image.texels.iter().all(|v| (0.0..=1e12).contains(v)));
        }
    }
}
