//! Frames as picture files. A file appears whole or not at all: it is made in memory and written by [`welkin_pack::whole`].

pub(crate) mod encode;

use std::path::Path;

use image::ExtendedColorType;
use welkin_pack::WriteError;
use welkin_pack::whole::write_file;

use crate::frame::{Frame, Pixels, Target};

/// Why a picture could not be saved. Nothing was changed then.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum SaveError {
    /// The name of the file says no format that we write.
    #[error(
        "{file}: the name ends in none of .png, .exr and .hdr; expected .png (8-bit sRGB), .exr or .hdr (linear radiance)"
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
    #[error(transparent)]
    Write(#[from] WriteError),
}

/// A format of a picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Format {
    /// 8-bit sRGB, or shares of light.
    Png,
    /// Linear radiance as half floats, in OpenEXR.
    Exr,
    /// Linear radiance with a common exponent of a pixel's three bytes, in Radiance's RGBE.
    Hdr,
}

impl Format {
    /// Every format.
    pub const ALL: [Format; 3] = [Format::Png, Format::Exr, Format::Hdr];

    /// What the name of such a file ends in, without the dot.
    pub const fn extension(self) -> &'static str {
        match self {
            Format::Png => "png",
            Format::Exr => "exr",
            Format::Hdr => "hdr",
        }
    }

    /// The format that the name of a file says.
    ///
    /// # Errors
    /// [`SaveError::UnknownFormat`].
    pub fn of(path: &Path) -> Result<Format, SaveError> {
        let extension = path.extension().and_then(|e| e.to_str());
        let of_that_name =
            |format: &Format| extension.is_some_and(|e| e.eq_ignore_ascii_case(format.extension()));
        let found = Format::ALL.into_iter().find(of_that_name);
        found.ok_or_else(|| SaveError::UnknownFormat {
            file: path.display().to_string(),
        })
    }

    /// What to draw for it.
    pub const fn target(self) -> Target {
        match self {
            Format::Png => Target::Srgb8,
            Format::Exr | Format::Hdr => Target::Linear,
        }
    }
}

/// What to draw for a file of this name: `.png` wants [`Target::Srgb8`], `.exr` and `.hdr` [`Target::Linear`].
///
/// # Errors
/// [`SaveError::UnknownFormat`].
pub fn target_for(path: &Path) -> Result<Target, SaveError> {
    Format::of(path).map(Format::target)
}

/// Saves a frame in the format that the file's name says. A file of that name is replaced.
///
/// # Errors
/// See [`SaveError`].
pub fn save(path: &Path, frame: &Frame) -> Result<(), SaveError> {
    let bytes = encode(&path.display().to_string(), Format::of(path)?, frame)?;
    Ok(write_file(path, &bytes, &|| false)?)
}

/// The bytes of a picture. `file` names it in errors.
///
/// # Errors
/// [`SaveError::WrongPixels`], [`SaveError::Encode`].
pub fn encode(file: &str, format: Format, frame: &Frame) -> Result<Vec<u8>, SaveError> {
    let (width, height) = (frame.width, frame.height);
    let encoded = match (format, &frame.pixels) {
        (Format::Png, Pixels::Srgb8(pixels)) => encode::png_rgb(width, height, pixels),
        (Format::Png, Pixels::Share8(pixels)) => {
            encode::png(width, height, pixels, ExtendedColorType::L8)
        }
        (Format::Exr, Pixels::Linear(pixels)) => encode::exr(width, height, pixels),
        (Format::Hdr, Pixels::Linear(pixels)) => encode::hdr(width, height, pixels),
        (format, _) => {
            let (format, expected) = match format {
                Format::Png => ("PNG", "8-bit"),
                Format::Exr => ("EXR", "linear"),
                Format::Hdr => ("HDR", "linear"),
            };
            return Err(SaveError::WrongPixels {
                file: file.to_string(),
                format,
                expected,
            });
        }
    };
    encoded.map_err(|reason| SaveError::Encode {
        file: file.to_string(),
        reason,
    })
}

#[cfg(test)]
mod tests {
    use exr::prelude::read_first_rgba_layer_from_file;
    use half::f16;

    use super::encode::BT709;
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
            save_as("frame.hdr", srgb_frame()),
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
