//! Where the photograph comes from: a file that the recipe names, or the built-in one.

use welkin_pack::Image;

use super::photo::{BUILT_IN, BUILT_IN_BLAKE3, BUILT_IN_NAME, photo_channel};
use crate::error::{BakeError, unfit};
use crate::inputs::{Named, Reader};
use crate::load::MAX_FILE_BYTES;
use crate::settings::PhotoSettings;

/// The key of the photograph in the recipe.
const KEY: &str = "clouds.photo.file";

/// The file that the recipe names, or the one that has to be given where none is compiled in.
pub(crate) fn file(settings: &PhotoSettings) -> Option<Named> {
    match (&settings.file, BUILT_IN) {
        (Some(file), _) => Some(named(file)),
        (None, Some(_)) => None,
        (None, None) => Some(named(BUILT_IN_NAME)),
    }
}

fn named(file: &str) -> Named {
    Named::new(KEY, file, MAX_FILE_BYTES)
}

/// The photograph as a channel.
pub(crate) fn channel(settings: &PhotoSettings, reader: &Reader) -> Result<Image, BakeError> {
    if let Some(file) = &settings.file {
        let picture = reader.read(&named(file))?;
        return photo_channel(&picture.bytes, &picture.file, settings);
    }
    if let Some(bytes) = BUILT_IN {
        return photo_channel(bytes, BUILT_IN_NAME, settings);
    }
    // The pack does not say which photograph it was made from: there is one.
    let given = reader.read_only(&named(BUILT_IN_NAME))?;
    let found = blake3::hash(&given.bytes).to_hex();
    if found.as_str() != BUILT_IN_BLAKE3 {
        return Err(unfit(BUILT_IN_NAME, "BLAKE3", found, BUILT_IN_BLAKE3));
    }
    photo_channel(&given.bytes, BUILT_IN_NAME, settings)
}

#[cfg(all(test, feature = "photo"))]
mod tests {
    use super::*;

    #[test]
    fn the_built_in_photograph_has_the_hash_by_which_it_is_known() {
        let photograph = BUILT_IN.expect("compiled in by default");
        assert_eq!(blake3::hash(photograph).to_hex().as_str(), BUILT_IN_BLAKE3);
    }
}
