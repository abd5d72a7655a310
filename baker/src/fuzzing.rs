//! Doors for the fuzz targets (`fuzz/`), which see the crate from outside. Not part of its interface.

use crate::error::{BakeError, unfit_size};
use crate::field::model;
use crate::inputs::Picture;
use crate::load;

/// The largest side of a picture: what takes time only is not looked for.
const MAX_SIDE: u32 = 512;

fn fits(width: u32, height: u32) -> Result<(), BakeError> {
    if width.max(height) <= MAX_SIDE {
        return Ok(());
    }
    let expected = format!("at most {MAX_SIDE} texels a side");
    Err(unfit_size("fuzz", [width, height], expected))
}

/// Decodes a photograph of clouds.
pub fn photo(bytes: &[u8]) {
    if let Ok(format) = image::guess_format(bytes)
        && let Ok(size) =
            image::ImageReader::with_format(std::io::Cursor::new(bytes), format).into_dimensions()
        && fits(size.0, size.1).is_ok()
    {
        drop(load::decode(bytes, "fuzz", load::Reading::Photograph));
    }
}

/// Decodes a sky.
pub fn sky(bytes: &[u8]) {
    let picture = Picture {
        file: "fuzz".to_string(),
        bytes: bytes.to_vec(),
    };
    drop(load::decode_sky(&picture, &fits));
}

/// Reads the boxes of a model.
pub fn model(bytes: &[u8]) {
    drop(model::boxes(bytes, "fuzz"));
}
