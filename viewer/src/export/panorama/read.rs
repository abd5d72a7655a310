//! Panoramas from files: Radiance HDR (G. Ward, "Real Pixels", Graphics Gems II, 1991) and OpenEXR. The first bytes say which, not the name.
//!
//! Radiance is taken as it is stored, linear BT.709: an `EXPOSURE` line changes nothing, and of an OpenEXR's alpha nothing is asked.

use std::fs::File;
use std::io::{self, Cursor, Read};
use std::path::Path;

use exr::meta::MetaData;
use exr::meta::header::Header;
use exr::prelude::{ReadChannels, ReadLayers, read};
use image::ImageDecoder;
use image::codecs::hdr::HdrDecoder;
use welkin_pack::{Image, shown};

use crate::save::encode::BT709;

/// The largest file that is read, in bytes: four channels of floats for [`MAX_WIDTH`] columns, without compression.
const MAX_FILE_BYTES: u64 = 513 << 20;

/// Columns that are read at most; in memory they take 400 MB.
const MAX_WIDTH: u32 = 8192;

/// What infinity becomes: the largest half float, since infinity most often comes from halves that were too small.
const INFINITE: f32 = 65504.0;

/// Radiance that no picture of a sky has in any unit: the sun's luminance is 1.6e9 cd/m².
const NONSENSE: f32 = 1e12;

/// A panorama, and what was changed in it.
#[derive(Clone, Debug, PartialEq)]
pub struct Panorama {
    /// Red, green and blue, 0 and more.
    pub image: Image,
    /// Texels that were infinite, and are 65504 now.
    pub infinite: usize,
    /// Texels that were below 0 in a channel, which is 0 now.
    pub negative: usize,
}

/// Why there is no panorama.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum PanoramaError {
    /// The operating system refused.
    #[error("{}: cannot be read: {source}; name a Radiance HDR or OpenEXR file", shown(.file))]
    Read {
        /// The file.
        file: String,
        /// The operating system's reason.
        source: io::Error,
    },
    /// The file is no panorama.
    #[error("{}: {key} is {}, expected {expected}", shown(.file), shown(.found))]
    Unfit {
        /// The file.
        file: String,
        /// What about it.
        key: &'static str,
        /// As it is.
        found: String,
        /// As it should be, and what to do.
        expected: String,
    },
}

/// What is wrong: key, found, expected.
type Fault = (&'static str, String, String);

fn fault(key: &'static str, found: impl ToString, expected: impl ToString) -> Fault {
    (key, found.to_string(), expected.to_string())
}

/// Reads a panorama, twice as wide as high.
///
/// # Errors
/// See [`PanoramaError`].
pub fn panorama(path: &Path) -> Result<Panorama, PanoramaError> {
    let file = path.display().to_string();
    let mut bytes = Vec::new();
    let read = File::open(path).and_then(|f| f.take(MAX_FILE_BYTES + 1).read_to_end(&mut bytes));
    match read {
        Ok(_) => decode(&bytes, &file),
        Err(source) => Err(PanoramaError::Read { file, source }),
    }
}

/// Reads the bytes of a panorama. `file` names it in errors.
///
/// # Errors
/// [`PanoramaError::Unfit`].
pub fn decode(bytes: &[u8], file: &str) -> Result<Panorama, PanoramaError> {
    let decoded = if bytes.len() as u64 > MAX_FILE_BYTES {
        let most = MAX_FILE_BYTES >> 20;
        let expected = format!("at most {most} MiB; save it with compression");
        Err(fault("length", format!("over {most} MiB"), expected))
    } else if bytes.starts_with(b"\x76\x2f\x31\x01") {
        exr(bytes)
    } else if [&b"#?RADIANCE"[..], b"#?RGBE"]
        .iter()
        .any(|start| bytes.starts_with(start))
    {
        hdr(bytes)
    } else {
        let found = if bytes.is_empty() { "empty" } else { "unknown" };
        Err(fault(
            "format",
            found,
            "Radiance HDR or OpenEXR; convert it",
        ))
    };
    decoded
        .and_then(tamed)
        .map_err(|(key, found, expected)| PanoramaError::Unfit {
            file: file.to_string(),
            key,
            found,
            expected,
        })
}

/// Before anything is allocated for it.
fn verify_size(width: u64, height: u64) -> Result<(), Fault> {
    let bad = |expected: &str| Err(fault("size", format!("{width}x{height}"), expected));
    if width == 0 || width != 2 * height {
        return bad("twice as wide as high, the whole sky (an equirectangular panorama)");
    }
    if width > MAX_WIDTH.into() {
        return bad(&format!("at most {MAX_WIDTH} columns; make it smaller"));
    }
    Ok(())
}

/// That primaries and white, as x and y, are those of BT.709, by half of the last digit that the standard gives and room for programs
/// that round.
fn verify_primaries(key: &'static str, found: [[f32; 2]; 4]) -> Result<(), Fault> {
    let wanted = [BT709.red, BT709.green, BT709.blue, BT709.white].map(|xy| [xy.x(), xy.y()]);
    let mut pairs = found.as_flattened().iter().zip(wanted.as_flattened());
    if pairs.all(|(a, b)| (a - b).abs() < 0.001) {
        return Ok(());
    }
    let expected = "those of BT.709 (sRGB), linear; convert it";
    Err(fault(key, format!("{found:?}"), expected))
}

fn exr(bytes: &[u8]) -> Result<Image, Fault> {
    let broken = |e: exr::error::Error| {
        let expected = "a whole OpenEXR file, best with ZIP compression; save or copy it again";
        fault("content", format!("not readable ({e})"), expected)
    };
    let meta = MetaData::read_from_buffered(Cursor::new(bytes), false).map_err(broken)?;
    let Some(header) = meta.headers.iter().find(|header| has_colours(header)) else {
        let expected = "R, G and B in one flat layer; save it as RGB";
        return Err(fault("channels", "other than that", expected));
    };
    let window = header.shared_attributes.display_window;
    if (header.layer_size, header.own_attributes.layer_position) != (window.size, window.position) {
        let expected = "the whole display window; save it without cropping";
        return Err(fault("data window", "a part", expected));
    }
    if let Some(c) = &header.shared_attributes.chromaticities {
        let found = [c.red, c.green, c.blue, c.white].map(|xy| [xy.x(), xy.y()]);
        verify_primaries("chromaticities", found)?;
    }
    verify_size(header.layer_size.x() as u64, header.layer_size.y() as u64)?;
    let picture = read()
        .no_deep_data()
        .largest_resolution_level()
        .rgb_channels(
            |size, _| Image::new(size.x() as u32, size.y() as u32, 3),
            |image: &mut Image, at, (r, g, b): (f32, f32, f32)| {
                let texel = image.texel_mut(at.x() as u32, at.y() as u32);
                texel.copy_from_slice(&[r, g, b]);
            },
        )
        .first_valid_layer()
        .all_attributes()
        .non_parallel()
        .from_buffered(Cursor::new(bytes))
        .map_err(broken)?;
    Ok(picture.layer_data.channel_data.pixels)
}

fn has_colours(header: &Header) -> bool {
    let has = |name: &str| header.channels.list.iter().any(|c| c.name.eq(name));
    !header.deep && ["R", "G", "B"].into_iter().all(has)
}

fn hdr(bytes: &[u8]) -> Result<Image, Fault> {
    let broken = |e: image::ImageError| {
        let expected = "a whole Radiance HDR file of red, green and blue; save or copy it again";
        fault("content", format!("not readable ({e})"), expected)
    };
    // The decoder knows one of the two signatures. Where it is not strict, it takes the other for a comment.
    let decoder = HdrDecoder::new_nonstrict(bytes).map_err(broken)?;
    let header = decoder.metadata();
    let mut lines = header.custom_attributes.iter();
    // Every program that changes a picture adds its line to those before.
    if let Some((_, text)) = lines.rfind(|(name, _)| name.trim() == "PRIMARIES") {
        verify_line(text)?;
    }
    let (width, height) = decoder.dimensions();
    verify_size(width.into(), height.into())?;
    let mut floats = vec![0.0_f32; 3 * width as usize * height as usize];
    decoder
        .read_image(bytemuck::cast_slice_mut(&mut floats))
        .map_err(broken)?;
    Ok(Image {
        width,
        height,
        channels: 3,
        texels: floats,
    })
}

/// What a `PRIMARIES` line says. Eight zeros, as Photoshop writes them, say nothing; the format's own (G. Ward Larson, R. Shakespeare,
/// "Rendering with Radiance", 1998, `src/common/color.h` of Radiance) as much as no line at all.
fn verify_line(text: &str) -> Result<(), Fault> {
    const STANDARD: [f32; 8] = [0.640, 0.330, 0.290, 0.600, 0.150, 0.060, 0.333, 0.333];
    let numbers = text.split_whitespace().map(|number| number.parse().ok());
    let numbers: Option<Vec<f32>> = numbers.collect();
    let Some(numbers) = numbers.and_then(|n| <[f32; 8]>::try_from(n).ok()) else {
        let expected =
            "eight numbers, x and y of red, green, blue and white; correct or remove the line";
        return Err(fault("PRIMARIES", format!("\"{text}\""), expected));
    };
    let is_standard = numbers
        .iter()
        .zip(STANDARD)
        .all(|(a, b)| (a - b).abs() < 0.001);
    if numbers == [0.0; 8] || is_standard {
        return Ok(());
    }
    let (pairs, _) = numbers.as_chunks();
    verify_primaries("PRIMARIES", [pairs[0], pairs[1], pairs[2], pairs[3]])
}

/// Refuses what is not a number or far too much, and brings the rest to 0 and more.
fn tamed(mut image: Image) -> Result<Panorama, Fault> {
    let is_wrong = |v: &f32| v.is_nan() || v.is_finite() && *v > NONSENSE;
    if let Some(first) = image.texels.iter().position(is_wrong) {
        let (texel, width) = (first / 3, image.width as usize);
        let (x, y, value) = (texel % width, texel / width, image.texels[first]);
        return Err(fault(
            "radiance",
            format!("{value} in column {x}, row {y}"),
            format!("numbers up to {NONSENSE:e}; repair the picture"),
        ));
    }
    let (mut infinite, mut negative) = (0, 0);
    for texel in image.texels.chunks_exact_mut(3) {
        infinite += usize::from(texel.contains(&f32::INFINITY));
        negative += usize::from(texel.iter().any(|v| *v < 0.0));
        for value in texel.iter_mut() {
            *value = if *value == f32::INFINITY {
                INFINITE
            } else {
                value.max(0.0)
            };
        }
    }
    Ok(Panorama {
        image,
        infinite,
        negative,
    })
}

#[cfg(test)]
mod tests;
