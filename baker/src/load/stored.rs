//! PNG, JPEG, TIFF and WebP as they are stored, upright.

use std::io::Cursor;

use image::metadata::Orientation;
use image::{DynamicImage, ExtendedColorType, ImageDecoder, ImageFormat, ImageReader, Limits};

use crate::error::{BakeError, unfit};

/// The largest file that is read, in bytes: an 8192x8192 PNG of noise is smaller.
pub const MAX_FILE_BYTES: u64 = 256 << 20;

/// The largest side of a skybox or of a picture of sprites, in texels.
pub(super) const MAX_SIDE: u32 = 8192;

/// The most that the decoder may allocate, in bytes: one 8192x8192 picture of four 16-bit channels.
const MAX_DECODED_BYTES: u64 = 512 << 20;

/// What a file holds.
pub(super) struct Stored {
    /// Its first picture, upright, as it is stored.
    pub picture: DynamicImage,
    /// Its ICC profile.
    pub icc: Option<Vec<u8>>,
}

/// Decodes a PNG, JPEG, TIFF or WebP, upright; of several pictures the first. `fits` is asked about the upright size before anything is allocated for it.
pub(super) fn decode_stored(
    bytes: &[u8],
    file: &str,
    format: ImageFormat,
    fits: &dyn Fn(u32, u32) -> Result<(), BakeError>,
) -> Result<Stored, BakeError> {
    if format == ImageFormat::Jpeg && !jpeg_ends(bytes) {
        return Err(unfit(
            file,
            "length",
            format!("{} bytes without an end marker", bytes.len()),
            "a whole JPEG file; copy it again",
        ));
    }
    if format == ImageFormat::Jpeg && jpeg_components(bytes) == Some(4) {
        return Err(cmyk(file));
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
    if let ExtendedColorType::Cmyk8 | ExtendedColorType::Cmyk16 = decoder.original_color_type() {
        return Err(cmyk(file));
    }
    let orientation = decoder.orientation().map_err(failed)?;
    let icc = decoder.icc_profile().map_err(failed)?;
    let (width, height) = decoder.dimensions();
    if lies_on_its_side(orientation) {
        fits(height, width)?;
    } else {
        fits(width, height)?;
    }
    limits.reserve(decoder.total_bytes()).map_err(failed)?;
    let mut picture = DynamicImage::from_decoder(decoder).map_err(failed)?;
    picture.apply_orientation(orientation);
    Ok(Stored { picture, icc })
}

fn cmyk(file: &str) -> BakeError {
    let expected = "red, green and blue, or grey; convert it to sRGB";
    unfit(file, "colours", "CMYK, inks for a press", expected)
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
fn jpeg_ends(bytes: &[u8]) -> bool {
    const END: u8 = 0xd9;
    jpeg_segment(bytes, |marker| marker == END).is_some()
}

/// How many components a JPEG's frame has: one is grey, three are colours, four are inks.
fn jpeg_components(bytes: &[u8]) -> Option<u8> {
    let is_frame = |marker| matches!(marker, 0xc0..=0xcf) && !matches!(marker, 0xc4 | 0xc8 | 0xcc);
    // After the marker: length, precision, rows, columns.
    bytes.get(jpeg_segment(bytes, is_frame)? + 9).copied()
}

/// Where the first marker is that is looked for.
///
/// ITU-T T.81, annex B: segments with a length, and after a start of scan coded data, in which 0xFF is
/// followed by 0 or by a restart marker.
fn jpeg_segment(bytes: &[u8], is_looked_for: impl Fn(u8) -> bool) -> Option<usize> {
    const START_OF_SCAN: u8 = 0xda;
    let mut at = 2;
    while let (Some(0xff), Some(&marker)) = (bytes.get(at), bytes.get(at + 1)) {
        match marker {
            _ if is_looked_for(marker) => return Some(at),
            0xff => at += 1,
            _ => {
                let &[high, low] = bytes.get(at + 2..at + 4)? else {
                    return None;
                };
                at += 2 + usize::from(u16::from_be_bytes([high, low]));
            }
        }
        if marker == START_OF_SCAN {
            let rest = bytes.get(at..).unwrap_or_default();
            let is_marker =
                |pair: &[u8]| pair[0] == 0xff && !matches!(pair[1], 0 | 0xd0..=0xd7 | 0xff);
            at += rest.windows(2).position(is_marker)?;
        }
    }
    None
}
