//! PNG and JPEG as they are stored, upright.

use std::io::Cursor;

use image::metadata::Orientation;
use image::{DynamicImage, ImageDecoder, ImageFormat, ImageReader, Limits};
use welkin_pack::Image;

use crate::error::{BakeError, unfit, unfit_size};

/// The largest file that is read, in bytes: an 8192x8192 PNG of noise is smaller.
pub const MAX_FILE_BYTES: u64 = 256 << 20;

/// The largest side of a picture, in texels.
pub(super) const MAX_SIDE: u32 = 8192;

/// The smallest side of a photograph, in texels: less holds no cloud.
const MIN_SIDE: u32 = 64;

/// The most that the decoder may allocate, in bytes: one 8192x8192 picture of four 16-bit channels.
const MAX_DECODED_BYTES: u64 = 512 << 20;

/// Decodes a PNG or a JPEG to red, green and blue as stored (gamma-encoded), 0..1.
pub(crate) fn decode(bytes: &[u8], file: &str) -> Result<Image, BakeError> {
    if bytes.is_empty() {
        return Err(unfit(file, "length", "0 bytes", "a PNG or JPEG file"));
    }
    let format = match image::guess_format(bytes) {
        Ok(format @ (ImageFormat::Png | ImageFormat::Jpeg)) => format,
        _ => {
            return Err(unfit(
                file,
                "format",
                "unknown",
                "a PNG or JPEG file; convert it",
            ));
        }
    };
    let fits = |side| (MIN_SIDE..=MAX_SIDE).contains(&side);
    let picture = decode_stored(bytes, file, format, &|width, height| {
        if fits(width) && fits(height) {
            return Ok(());
        }
        let expected = format!("{MIN_SIDE} to {MAX_SIDE} texels a side; resize it");
        Err(unfit_size(file, [width, height], expected))
    })?;
    Ok(to_image(picture))
}

/// Decodes a PNG or a JPEG, upright. `fits` is asked about the upright size before anything is allocated for it.
pub(super) fn decode_stored(
    bytes: &[u8],
    file: &str,
    format: ImageFormat,
    fits: &dyn Fn(u32, u32) -> Result<(), BakeError>,
) -> Result<DynamicImage, BakeError> {
    if format == ImageFormat::Jpeg && !jpeg_ends(bytes) {
        return Err(unfit(
            file,
            "length",
            format!("{} bytes without an end marker", bytes.len()),
            "a whole JPEG file; copy it again",
        ));
    }
    let failed = |source| BakeError::Decode {
        file: file.to_string(),
        source,
    };
    let mut limits = Limits::default();
    limits.max_alloc = Some(MAX_DECODED_BYTES);
    let mut reader = ImageReader::with_format(Cursor::new(bytes), format);
    reader.limits(limits.clone());
    let mut decoder = reader.into_decoder().map_err(failed)?;
    let orientation = decoder.orientation().map_err(failed)?;
    let (width, height) = decoder.dimensions();
    if lies_on_its_side(orientation) {
        fits(height, width)?;
    } else {
        fits(width, height)?;
    }
    limits.reserve(decoder.total_bytes()).map_err(failed)?;
    let mut picture = DynamicImage::from_decoder(decoder).map_err(failed)?;
    picture.apply_orientation(orientation);
    Ok(picture)
}

/// Whether the rows of a file are the columns of its picture.
const fn lies_on_its_side(orientation: Orientation) -> bool {
    use Orientation::{Rotate90, Rotate90FlipH, Rotate270, Rotate270FlipH};
    matches!(
        orientation,
        Rotate90 | Rotate270 | Rotate90FlipH | Rotate270FlipH
    )
}

/// Whether a JPEG goes on to its end marker: decoders fill what is missing with grey instead of saying so.
///
/// ITU-T T.81, annex B: segments with a length, and after a start of scan coded data, in which 0xFF is
/// followed by 0 or by a restart marker.
fn jpeg_ends(bytes: &[u8]) -> bool {
    const START_OF_SCAN: u8 = 0xda;
    const END: u8 = 0xd9;
    let mut at = 2;
    while let (Some(0xff), Some(&marker)) = (bytes.get(at), bytes.get(at + 1)) {
        match marker {
            END => return true,
            0xff => at += 1,
            _ => {
                let Some(&[high, low]) = bytes.get(at + 2..at + 4) else {
                    return false;
                };
                at += 2 + usize::from(u16::from_be_bytes([high, low]));
            }
        }
        if marker == START_OF_SCAN {
            let rest = bytes.get(at..).unwrap_or_default();
            let is_marker =
                |pair: &[u8]| pair[0] == 0xff && !matches!(pair[1], 0 | 0xd0..=0xd7 | 0xff);
            let Some(length) = rest.windows(2).position(is_marker) else {
                return false;
            };
            at += length;
        }
    }
    false
}

fn to_image(picture: DynamicImage) -> Image {
    let (width, height) = (picture.width(), picture.height());
    let texels = match picture {
        DynamicImage::ImageRgb8(rgb) => rgb
            .into_raw()
            .iter()
            .map(|&v| f32::from(v) / 255.0)
            .collect(),
        other => other
            .into_rgb16()
            .into_raw()
            .iter()
            .map(|&v| f32::from(v) / 65535.0)
            .collect(),
    };
    Image {
        width,
        height,
        channels: 3,
        texels,
    }
}
