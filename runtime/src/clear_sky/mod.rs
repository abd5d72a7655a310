//! The sky without clouds, by day and by night.

pub mod catalogue;
pub(crate) mod catalogue_texture;
pub mod cells;
#[cfg(feature = "perez")]
pub mod cie;
pub mod eclipse;
pub mod eye;
pub mod flares;
pub mod galaxy;
pub mod ground;
pub mod light;
pub mod moment;
pub mod moon;
#[cfg(feature = "perez")]
pub mod perez;
pub mod picture;
pub mod planets;
pub mod sea;
pub mod skybox;
pub mod spread;
pub mod stars;
pub mod sun;
pub mod table;
pub(crate) mod view_texture;
