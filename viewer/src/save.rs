//! Frames as picture files. A file appears whole or not at all: it is made in memory, written beside
//! its place and renamed into it, so an older file of that name stays until the new one is complete.

use std::io::{self, Cursor, Write};
use std::path::Path;

use exr::meta::attribute::Chromaticities;
use exr::prelude::{
    Encoding, Image, Layer, LayerAttributes, SpecificChannels, Text, Vec2, WritableImage,
};
use half::f16;
use image::{ExtendedColorType, ImageEncoder};

use crate::frame::{Frame, Pixels, Target};

/// Primaries and white point of ITU-R BT.709-6 (2015), table 3, as CIE 1931 x, y.
const BT709: Chromaticities = Chromaticities {
    red: Vec2(0.64, 0.33),
    green: Vec2(0.30, 0.60),
    blue: Vec2(0.15, 0.06),
    white: Vec2(0.3127, 0.3290),
};

/// Why a picture could not be saved. Nothing was changed then.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum SaveError {
    /// The name of the file says no format that we write.
    #[error(
        "{file}: the name ends in neither .png nor .exr; expected .png (8-bit sRGB) or .exr (linear radiance)"
    )]
    UnknownFormat {
        /// The file.
        file: String,
    },
    /// The pixels do not suit the format.
    #[error(
        "{file}: {format} holds {expected} pixels, but the frame was drawn to another kind; draw it again for {format}"
    )]
    WrongPixels {
        /// The file.
        file: String,
        /// Format of the file.
        format: &'static str,
        /// Pixels that it holds.
        expected: &'static str,
    },
    /// The frame could not be encoded.
    #[error("{file}: cannot be encoded: {reason}; choose a smaller frame")]
    Encode {
        /// The file.
        file: String,
        /// The encoder's reason.
        reason: String,
    },
    /// The file could not be written.
    #[error("{file}: cannot be written: {source}; choose another place, or make room there")]
    Write {
        /// The file.
        file: String,
        /// The operating system's reason.
        source: io::Error,
    },
}

/// What to draw for a file of this name: `.png` wants [`Target::Srgb8`], `.exr` [`Target::Linear`].
///
/// # Errors
/// [`SaveError::UnknownFormat`].
pub fn target_for(path: &Path) -> Result<Target, SaveError> {
    let extension = path
        .extension()
        .and_then(|e| e.to_str())
        .unwrap_or_default();
    match extension.to_ascii_lowercase().as_str() {
        "png" => Ok(Target::Srgb8),
        "exr" => Ok(Target::Linear),
        _ => Err(SaveError::UnknownFormat {
            file: path.display().to_string(),
        }),
    }
}

/// Saves a frame in the format that the file's name says.
///
/// # Errors
/// See [`SaveError`].
pub fn save(path: &Path, frame: &Frame) -> Result<(), SaveError> {
    let file = || path.display().to_string();
    let wrong = |format, expected| {
        Err(SaveError::WrongPixels {
            file: file(),
            format,
            expected,
        })
    };
    let encoded = match (target_for(path)?, &frame.pixels) {
        (Target::Srgb8, Pixels::Srgb8(pixels)) => png_rgb(frame.width, frame.height, pixels),
        (Target::Srgb8, Pixels::Share8(pixels)) => {
            png(frame.width, frame.height, pixels, ExtendedColorType::L8)
        }
        (Target::Linear, Pixels::Linear(pixels)) => exr(frame.width, frame.height, pixels),
        (Target::Srgb8, Pixels::Linear(_)) => return wrong("PNG", "8-bit"),
        (Target::Linear, _) => return wrong("EXR", "linear"),
    };
    let bytes = encoded.map_err(|reason| SaveError::Encode {
        file: file(),
        reason,
    })?;
    write_whole(path, &bytes).map_err(|source| SaveError::Write {
        file: file(),
        source,
    })
}

/// The sky is opaque, so alpha stays out of the file.
fn png_rgb(width: u32, height: u32, pixels: &[[u8; 4]]) -> Result<Vec<u8>, String> {
    let rgb: Vec<u8> = pixels.iter().flat_map(|&[r, g, b, _]| [r, g, b]).collect();
    png(width, height, &rgb, ExtendedColorType::Rgb8)
}

fn png(
    width: u32,
    height: u32,
    samples: &[u8],
    colour: ExtendedColorType,
) -> Result<Vec<u8>, String> {
    let mut bytes = Vec::new();
    let encoder = image::codecs::png::PngEncoder::new(&mut bytes);
    encoder
        .write_image(samples, width, height, colour)
        .map_err(|e| e.to_string())?;
    Ok(bytes)
}

/// Half-float RGB with ZIP compression and the chromaticities of BT.709, which are also those that
/// readers assume where none are given.
fn exr(width: u32, height: u32, pixels: &[[f16; 4]]) -> Result<Vec<u8>, String> {
    let size = (width as usize, height as usize);
    let channels = SpecificChannels::rgb(|at: Vec2<usize>| {
        let [r, g, b, _] = pixels[at.y() * size.0 + at.x()];
        (r, g, b)
    });
    let comment = "Linear BT.709 radiance; 1.0 is the white of a sunlit cloud at noon.";
    let attributes = LayerAttributes {
        software_name: Some(Text::from(concat!(
            "welkin-view ",
            env!("CARGO_PKG_VERSION")
        ))),
        comments: Some(Text::from(comment)),
        ..Default::default()
    };
    let layer = Layer::new(size, attributes, Encoding::SMALL_LOSSLESS, channels);
    let mut image = Image::from_layer(layer);
    image.attributes.chromaticities = Some(BT709);
    let mut bytes = Cursor::new(Vec::new());
    image
        .write()
        .non_parallel()
        .to_buffered(&mut bytes)
        .map_err(|e| e.to_string())?;
    Ok(bytes.into_inner())
}

/// Writes a file that is there whole or, if that fails, as it was before.
///
/// # Errors
/// The operating system's.
pub fn write_whole(path: &Path, bytes: &[u8]) -> io::Result<()> {
    if path.exists() && !path.is_file() {
        // A device or a folder would be renamed over.
        return Err(io::Error::other("there is something that is not a file"));
    }
    let folder = path
        .parent()
        .filter(|p| !p.as_os_str().is_empty())
        .unwrap_or(Path::new("."));
    let mut builder = tempfile::Builder::new();
    builder.prefix(".welkin-");
    // As open as the umask allows: temporary files are private unless told otherwise.
    #[cfg(unix)]
    builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o666));
    let mut file = builder.tempfile_in(folder)?;
    file.write_all(bytes)?;
    file.as_file().sync_all()?;
    file.persist(path).map_err(|e| e.error)?;
    Ok(())
}

#[cfg(test)]
mod tests {
    use exr::prelude::read_first_rgba_layer_from_file;

    use super::*;

    const SIZE: [u32; 2] = [3, 2];

    fn linear_frame() -> Frame {
        let value = |i: u32| f16::from_f32(i as f32 * 0.37 - 1.0);
        let pixels = (0..6)
            .map(|i| [value(i), value(i + 10), value(100 * i), f16::ONE])
            .collect();
        Frame {
            width: SIZE[0],
            height: SIZE[1],
            pixels: Pixels::Linear(pixels),
        }
    }

    fn srgb_frame() -> Frame {
        let pixels = (0..6).map(|i| [i * 40, 255 - i, 7 * i, 255]).collect();
        Frame {
            width: SIZE[0],
            height: SIZE[1],
            pixels: Pixels::Srgb8(pixels),
        }
    }

    fn share_frame() -> Frame {
        Frame {
            width: SIZE[0],
            height: SIZE[1],
            pixels: Pixels::Share8(vec![0, 1, 60, 128, 254, 255]),
        }
    }

    #[test]
    fn png_gives_back_the_same_bytes() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("frame.png");
        let frame = srgb_frame();
        save(&path, &frame).unwrap();
        let read = image::open(&path).unwrap().to_rgba8();
        assert_eq!([read.width(), read.height()], SIZE);
        let pixels = read.pixels().map(|p| p.0).collect();
        assert_eq!(Pixels::Srgb8(pixels), frame.pixels);
    }

    #[test]
    fn shares_stay_the_bytes_that_they_are() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("shadow.png");
        save(&path, &share_frame()).unwrap();
        let read = image::open(&path).unwrap();
        assert_eq!(read.color(), image::ColorType::L8);
        assert_eq!(Pixels::Share8(read.into_bytes()), share_frame().pixels);
    }

    #[test]
    fn exr_gives_back_the_same_halves_in_the_same_places() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("frame.exr");
        let frame = linear_frame();
        save(&path, &frame).unwrap();
        let image = read_first_rgba_layer_from_file(
            &path,
            |size, _| vec![vec![[f16::ZERO; 4]; size.width()]; size.height()],
            |rows: &mut Vec<Vec<[f16; 4]>>, at, (r, g, b, _): (f16, f16, f16, f16)| {
                rows[at.y()][at.x()] = [r, g, b, f16::ONE];
            },
        )
        .unwrap();
        assert_eq!(
            Pixels::Linear(image.layer_data.channel_data.pixels.concat()),
            frame.pixels
        );
        assert_eq!(image.attributes.chromaticities, Some(BT709));
    }

    #[test]
    fn the_name_must_say_a_format_that_suits_the_pixels() {
        let folder = tempfile::tempdir().unwrap();
        let save_as = |name: &str, frame: Frame| save(&folder.path().join(name), &frame);
        assert!(matches!(
            save_as("frame.gif", srgb_frame()),
            Err(SaveError::UnknownFormat { .. })
        ));
        assert!(matches!(
            save_as("frame", srgb_frame()),
            Err(SaveError::UnknownFormat { .. })
        ));
        assert!(matches!(
            save_as("frame.exr", srgb_frame()),
            Err(SaveError::WrongPixels { .. })
        ));
        assert!(matches!(
            save_as("frame.PNG", linear_frame()),
            Err(SaveError::WrongPixels { .. })
        ));
        assert!(matches!(
            save_as("shadow.exr", share_frame()),
            Err(SaveError::WrongPixels { .. })
        ));
        assert_eq!(folder.path().read_dir().unwrap().count(), 0);
    }

    #[test]
    fn a_place_that_cannot_be_written_keeps_what_is_there() {
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join("file");
        std::fs::write(&file, "old").unwrap();
        let error = save(&file.join("frame.png"), &srgb_frame()).unwrap_err();
        assert!(
            error.to_string().contains("frame.png: cannot be written"),
            "{error}"
        );
        // A folder of that name is not replaced either, and no temporary file stays beside it.
        std::fs::create_dir(folder.path().join("taken.png")).unwrap();
        assert!(save(&folder.path().join("taken.png"), &srgb_frame()).is_err());
        assert_eq!(std::fs::read(&file).unwrap(), b"old");
        assert_eq!(folder.path().read_dir().unwrap().count(), 2);
    }
}
