//! The clouds of each method on a dome.

pub mod coverage;
#[cfg(feature = "fbm")]
pub mod fbm;
mod histogram;
#[cfg(feature = "lit")]
pub mod lit;
pub mod march;
#[cfg(feature = "octaves")]
pub mod octaves;
pub mod packed;
#[cfg(any(feature = "fbm", feature = "lit", feature = "octaves"))]
pub mod photo;
pub mod shadow;
pub mod shared;
