//! Where the photograph comes from: a file that the recipe names, or the built-in one.

use welkin_pack::Image;

use super::photo::{BUILT_IN, BUILT_IN_BLAKE3, BUILT_IN_NAME};
use crate::bake::photo_channel;
use crate::error::BakeError;
use crate::inputs::{Inputs, Picture};
use crate::load::{PHOTO_KEY, unfit};
use crate::settings::PhotoSettings;

/// A photograph.
pub(crate) enum Photo {
    /// That which the recipe names.
    Named(Picture),
    /// That which is compiled in.
    BuiltIn(&'static [u8]),
    /// The same from outside, where it is not compiled in.
    Given(Picture),
}

impl Photo {
    /// Reads the photograph.
    pub fn read(settings: &PhotoSettings, inputs: Inputs) -> Result<Photo, BakeError> {
        if let Some(file) = &settings.file {
            return Ok(Photo::Named(inputs.read(file, PHOTO_KEY)?));
        }
        if let Some(bytes) = BUILT_IN {
            return Ok(Photo::BuiltIn(bytes));
        }
        let given = inputs.read(BUILT_IN_NAME, PHOTO_KEY)?;
        // The pack does not say which photograph it was made from: there is one.
        let found = blake3::hash(&given.bytes).to_hex();
        if found.as_str() != BUILT_IN_BLAKE3 {
            return Err(unfit(BUILT_IN_NAME, "BLAKE3", found, BUILT_IN_BLAKE3));
        }
        Ok(Photo::Given(given))
    }

    /// The file, if the recipe names one.
    pub fn named(&self) -> Option<&Picture> {
        match self {
            Photo::Named(picture) => Some(picture),
            Photo::BuiltIn(_) | Photo::Given(_) => None,
        }
    }

    /// The photograph as a channel.
    pub fn channel(&self, settings: &PhotoSettings) -> Result<Image, BakeError> {
        match self {
            Photo::Named(picture) | Photo::Given(picture) => {
                photo_channel(&picture.bytes, &picture.file, settings)
            }
            Photo::BuiltIn(bytes) => photo_channel(bytes, BUILT_IN_NAME, settings),
        }
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
