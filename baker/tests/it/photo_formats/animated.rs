//! Files of several pictures: the first counts.

use image::{DynamicImage, ImageFormat};

use super::files::{chunk, find_chunk};
use super::{channel, difference, encoded, error, png, sky};

#[test]
fn of_an_animated_png_the_first_frame_is_taken() {
    let (first, second) = (
        sky(100, 100),
        image::imageops::flip_vertical(&sky(100, 100)),
    );
    let [still, other] = [&first, &second].map(png);
    let frame_control = |sequence: u32| {
        let size = 100_u32.to_be_bytes();
        let mut data = sequence.to_be_bytes().to_vec();
        // Width, height, left, top; a tenth of a second; no disposal, no blending.
        data.extend([size, size, [0; 4], [0; 4]].concat());
        data.extend([0, 1, 0, 10, 0, 0]);
        chunk(b"fcTL", &data)
    };
    let (data_at, _) = find_chunk(&still, b"IDAT");
    let (end_at, _) = find_chunk(&still, b"IEND");
    let (_, second_data) = find_chunk(&other, b"IDAT");
    let mut animated = still[..data_at].to_vec();
    animated.extend(chunk(b"acTL", &[0, 0, 0, 2, 0, 0, 0, 0]));
    animated.extend(frame_control(0));
    animated.extend(&still[data_at..end_at]);
    animated.extend(frame_control(1));
    animated.extend(chunk(
        b"fdAT",
        &[2_u32.to_be_bytes().to_vec(), second_data].concat(),
    ));
    animated.extend(&still[end_at..]);
    assert_eq!(difference(&channel(&animated), &channel(&still)), 0.0);
    assert!(difference(&channel(&other), &channel(&still)) > 0.04);
}

/// WebP Container Specification: RIFF chunks, of which VP8X says that there are frames, and each ANMF is one.
#[test]
fn of_an_animated_webp_the_first_frame_is_taken() {
    let (first, second) = (
        sky(100, 100),
        image::imageops::flip_vertical(&sky(100, 100)),
    );
    let still = |picture: &image::RgbImage| {
        encoded(&DynamicImage::from(picture.clone()), ImageFormat::WebP)
    };
    let riff = |kind: &[u8], data: &[u8]| {
        let mut bytes = kind.to_vec();
        bytes.extend((data.len() as u32).to_le_bytes());
        bytes.extend(data);
        bytes.resize(bytes.len().next_multiple_of(2), 0);
        bytes
    };
    // Left, top, width - 1, height - 1, milliseconds, flags.
    let header = [0, 0, 0, 0, 0, 0, 99, 0, 0, 99, 0, 0, 100, 0, 0, 2];
    let frame = |picture| riff(b"ANMF", &[&header, &still(picture)[12..]].concat());
    let parts = [
        b"WEBP".to_vec(),
        riff(b"VP8X", &[2, 0, 0, 0, 99, 0, 0, 99, 0, 0]),
        riff(b"ANIM", &[0; 6]),
        frame(&first),
        frame(&second),
    ];
    let animated = riff(b"RIFF", &parts.concat());
    let expected = channel(&still(&first));
    assert_eq!(difference(&channel(&animated), &expected), 0.0);
}

#[test]
fn a_gif_is_told_by_its_name() {
    let error = error(b"GIF89a\x64\0\x64\0\x80\0\0");
    assert!(
        error.contains("format is GIF, expected a PNG, JPEG"),
        "{error}"
    );
}
