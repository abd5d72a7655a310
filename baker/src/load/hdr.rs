//! Radiance HDR: shared-exponent pixels (G. Ward, "Real Pixels", Graphics Gems II, 1991).
//!
//! Radiance is taken as stored: an `EXPOSURE` line is not applied, since a recipe has its own gain. A file says its
//! primaries in a `PRIMARIES` line or not at all.

use image::ImageDecoder;
use image::codecs::hdr::HdrDecoder;
use welkin_pack::Image;

use super::primaries;
use crate::error::{BakeError, unfit};

/// The first bytes of such files; the second is that of some older programs.
const SIGNATURES: [&[u8]; 2] = [b"#?RADIANCE", b"#?RGBE"];

pub(super) fn is_hdr(bytes: &[u8]) -> bool {
    SIGNATURES.iter().any(|start| bytes.starts_with(start))
}

/// What the format itself means where a file says nothing (G. Ward Larson, R. Shakespeare, "Rendering with Radiance",
/// 1998, `src/common/color.h` of Radiance): monitors of its day, about those of BT.709.
const STANDARD: [[f32; 2]; 4] = [
    [0.640, 0.330],
    [0.290, 0.600],
    [0.150, 0.060],
    [0.333, 0.333],
];

/// Refuses colours that would come out wrong without a word: other primaries than BT.709's. Eight zeros, as Photoshop
/// writes them, say nothing, and the format's own say as much as no line at all.
fn verify_primaries(lines: &[(String, String)], file: &str) -> Result<(), BakeError> {
    let mut lines = lines.iter().filter(|(name, _)| name.trim() == "PRIMARIES");
    // Every program that changes a picture adds its line to those before.
    let Some((_, text)) = lines.next_back() else {
        return Ok(());
    };
    let numbers = text.split_whitespace().map(|number| number.parse().ok());
    let numbers: Option<Vec<f32>> = numbers.collect();
    let numbers = numbers.and_then(|numbers| <[f32; 8]>::try_from(numbers).ok());
    let Some(numbers) = numbers else {
        let expected =
            "eight numbers, x and y of red, green, blue and white; correct or remove the line";
        return Err(unfit(file, "PRIMARIES", format!("\"{text}\""), expected));
    };
    let (found, _) = numbers.as_chunks();
    let found = [found[0], found[1], found[2], found[3]];
    if numbers == [0.0; 8] || primaries::are_near(&found, &STANDARD) {
        return Ok(());
    }
    primaries::verify(&found, file, "PRIMARIES")
}

/// Red, green, blue, and a cover of 1.
pub(super) fn decode(
    bytes: &[u8],
    file: &str,
    fits: &dyn Fn(u32, u32) -> Result<(), BakeError>,
) -> Result<Image, BakeError> {
    let failed = |e: image::ImageError| {
        let expected = "a whole Radiance HDR file of red, green and blue; save or copy it again";
        unfit(
            file,
            "content",
            format!("broken or unknown ({e})"),
            expected,
        )
    };
    // The decoder knows one of the two signatures. Where it is not strict, it takes the other for a comment.
    let decoder = HdrDecoder::new_nonstrict(bytes).map_err(failed)?;
    verify_primaries(&decoder.metadata().custom_attributes, file)?;
    let (width, height) = decoder.dimensions();
    fits(width, height)?;
    let mut floats = vec![0; decoder.total_bytes() as usize];
    decoder.read_image(&mut floats).map_err(failed)?;
    let value = |bytes: &[u8]| f32::from_ne_bytes([bytes[0], bytes[1], bytes[2], bytes[3]]);
    let mut texels = Vec::with_capacity(width as usize * height as usize * 4);
    for pixel in floats.chunks_exact(12) {
        texels.extend(pixel.chunks_exact(4).map(value));
        texels.push(1.0);
    }
    Ok(Image {
        width,
        height,
        channels: 4,
        texels,
    })
}
