//! Radiance HDR: shared-exponent pixels (G. Ward, "Real Pixels", Graphics Gems II, 1991).
//!
//! Radiance is taken as stored: an `EXPOSURE` line is not applied, since a recipe has its own gain.

use image::ImageDecoder;
use image::codecs::hdr::HdrDecoder;
use welkin_pack::Image;

use super::unfit;
use crate::error::BakeError;

/// The first bytes of such files; the second is that of some older programs.
const SIGNATURES: [&[u8]; 2] = [b"#?RADIANCE", b"#?RGBE"];

pub(super) fn is_hdr(bytes: &[u8]) -> bool {
    SIGNATURES.iter().any(|start| bytes.starts_with(start))
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
