//! What the runtime asks of a method, and the list of those that it has.
//!
//! A method makes the clouds of the dome: it brings shader parts, of which one has the function `NAME_layer(direction, narrowing)`, its
//! uniforms, and, if it has one, a map that is drawn off screen. All of this lies in its folder in `clouds/`; here is what the rest of
//! the runtime sees of it.

#[cfg(feature = "fbm")]
mod fbm;
pub(crate) mod interface;
#[cfg(feature = "lit")]
mod lit;
#[cfg(feature = "octaves")]
mod octaves;
mod packed;
#[cfg(feature = "sprites")]
mod sprites;

use crate::methods::interface::CloudMethod;
use crate::params::Method;

impl Method {
    /// What makes its clouds.
    pub(crate) fn clouds(self) -> &'static dyn CloudMethod {
        match self {
            Method::Packed => &packed::Packed,
            #[cfg(feature = "octaves")]
            Method::Octaves => &octaves::Octaves,
            #[cfg(feature = "fbm")]
            Method::Fbm => &fbm::Fbm,
            #[cfg(feature = "lit")]
            Method::Lit => &lit::Lit,
            #[cfg(feature = "sprites")]
            Method::Sprites => &sprites::Sprites,
        }
    }
}
