//! How the numbers that make opacity are distributed in a pack: what the covered fraction of the sky follows from.

use welkin_pack::{Pack, Role};

#[cfg(feature = "fbm")]
use crate::clouds::fbm;
#[cfg(feature = "fbm")]
use crate::clouds::histogram::Histogram;
use crate::clouds::packed;
use crate::error::{SkyError, texture};

/// How the numbers that make opacity are distributed in a pack.
#[derive(Clone, Debug, PartialEq)]
pub struct Distributions {
    /// Texels of the packed texture.
    pub packed: packed::coverage::Texels,
    /// The weighted sum of the octaves of smooth noise.
    #[cfg(feature = "fbm")]
    pub(crate) fbm: Histogram,
}

impl Distributions {
    /// Counts the texels of level 0: some milliseconds.
    ///
    /// # Errors
    /// [`SkyError::MissingTexture`].
    pub fn new(pack: &Pack) -> Result<Distributions, SkyError> {
        let clouds = texture(pack, Role::Clouds)?.image(0, 0);
        Ok(Distributions {
            packed: packed::coverage::Texels::new(&clouds),
            #[cfg(feature = "fbm")]
            fbm: fbm::coverage::sums(texture(pack, Role::Fbm)?),
        })
    }
}
