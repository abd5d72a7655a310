//! Where the photograph comes from: a file that the recipe names, or the built-in one.

use welkin_pack::Image;

use super::photo::{BUILT_IN, BUILT_IN_BLAKE3, BUILT_IN_NAME, PhotoFile, photo_tile};
use crate::error::{BakeError, unfit};
use crate::inputs::{Named, Picture, Reader};
use crate::load::MAX_FILE_BYTES;
use crate::settings::PhotoSettings;

/// The keys of the photograph and of its mask in the recipe.
const KEY: &str = "clouds.photo.file";
const MASK_KEY: &str = "clouds.photo.mask";

/// The files that the recipe names, or the one that has to be given where none is compiled in.
pub(crate) fn files(settings: &PhotoSettings) -> Vec<Named> {
    let file = match (&settings.file, BUILT_IN) {
        (Some(file), _) => Some(named(file)),
        (None, Some(_)) => None,
        (None, None) => Some(named(BUILT_IN_NAME)),
    };
    file.into_iter().chain(mask(settings)).collect()
}

fn mask(settings: &PhotoSettings) -> Option<Named> {
    let file = settings.mask.as_ref();
    file.map(|file| Named::new(MASK_KEY, file, MAX_FILE_BYTES))
}

fn named(file: &str) -> Named {
    Named::new(KEY, file, MAX_FILE_BYTES)
}

/// The photograph as a channel.
pub(crate) fn channel(settings: &PhotoSettings, reader: &Reader) -> Result<Image, BakeError> {
    let given = match (&settings.file, BUILT_IN) {
        (Some(file), _) => Some(reader.read(&named(file))?),
        (None, Some(_)) => None,
        (None, None) => Some(given_built_in(reader)?),
    };
    let mask = mask(settings)
        .map(|named| reader.read(&named))
        .transpose()?;
    let built_in = PhotoFile {
        name: BUILT_IN_NAME,
        bytes: BUILT_IN.unwrap_or_default(),
    };
    let picture = given.as_ref().map_or(built_in, photo_file);
    photo_tile(picture, mask.as_ref().map(photo_file), settings).map(|tile| tile.channel)
}

/// The built-in photograph where none is compiled in. The pack does not say which photograph it was made from: there is one.
fn given_built_in(reader: &Reader) -> Result<Picture, BakeError> {
    let given = reader.read_only(&named(BUILT_IN_NAME))?;
    let found = blake3::hash(&given.bytes).to_hex();
    if found.as_str() != BUILT_IN_BLAKE3 {
        return Err(unfit(BUILT_IN_NAME, "BLAKE3", found, BUILT_IN_BLAKE3));
    }
    Ok(given)
}

fn photo_file(picture: &Picture) -> PhotoFile<'_> {
    PhotoFile {
        name: &picture.file,
        bytes: &picture.bytes,
    }
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
