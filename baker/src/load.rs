//! Pictures: read with a limit, decoded with limits that are checked before anything is allocated.
//!
//! What a file is, its first bytes say, not its name. Photographs of clouds are wanted as stored; skies are
//! wanted as radiance. A camera held upright says so in its file (Exif 2.32, tag 0x0112, Orientation): such a picture is
//! turned before anything looks at it.

mod colours;
mod exr;
mod format;
mod hdr;
mod icc;
mod photograph;
mod primaries;
mod sky;
mod srgb;
mod stored;
mod texture;

use std::path::Path;

use crate::error::{BakeError, too_long};
use crate::inputs::read_limited;

pub(crate) use photograph::{Photograph, Reading, decode};
pub(crate) use sky::{MAX_RADIANCE, decode_sky};
pub use stored::MAX_FILE_BYTES;
pub use texture::{TextureFile, decode_texture};

/// Reads the bytes of a photograph that no recipe names: a file of at most 256 MiB.
///
/// # Errors
/// [`BakeError::ReadPhoto`], or [`BakeError::Photo`] if it is larger.
pub fn read_photo(path: &Path) -> Result<Vec<u8>, BakeError> {
    let file = path.display().to_string();
    match read_limited(path, MAX_FILE_BYTES) {
        Ok(Some(bytes)) => Ok(bytes),
        Ok(None) => Err(too_long(&file, MAX_FILE_BYTES)),
        Err(source) => Err(BakeError::ReadPhoto { file, source }),
    }
}
