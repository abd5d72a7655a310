//! Sky texture packs: the contract between the program that bakes them and the runtime that draws them.

pub mod air;
#[cfg(feature = "write")]
mod build;
pub mod check;
pub mod error;
pub mod field;
pub mod format;
pub mod image;
#[cfg(feature = "interrupt")]
pub mod interrupt;
pub mod ktx;
#[cfg(test)]
#[cfg(feature = "write")]
mod ktx_tests;
pub mod layer_kind;
pub mod limits;
pub mod manifest;
pub mod mapping;
mod mip;
pub mod pack;
#[cfg(test)]
#[cfg(feature = "write")]
mod pack_tests;
#[cfg(all(feature = "write", not(target_family = "wasm")))]
pub mod place;
mod read;
pub mod role;
#[cfg(all(feature = "write", not(target_family = "wasm")))]
mod save;
mod shown;
pub mod starlight;
#[cfg(test)]
#[cfg(feature = "write")]
mod test_field;
#[cfg(test)]
#[cfg(feature = "write")]
mod test_pack;
pub mod texel;
pub mod texture;
mod view;
#[cfg(all(feature = "write", not(target_family = "wasm")))]
pub mod whole;

#[cfg(feature = "write")]
pub use build::{PackInfo, Source};
pub use error::PackError;
#[cfg(all(feature = "write", not(target_family = "wasm")))]
pub use error::WriteError;
pub use field::Field;
pub use format::{Format, Shape};
pub use image::Image;
pub use layer_kind::LayerKind;
pub use manifest::Manifest;
pub use mapping::{FlareCell, SheetCell, SheetKind};
pub use pack::Pack;
pub use role::Role;
#[cfg(all(feature = "write", not(target_family = "wasm")))]
pub use save::{Overwrite, verify_place};
pub use shown::shown;
pub use texel::{
    CatalogueStar, CloudTexel, FbmTexel, FlareTexel, GalaxyTexel, LayerTexel, OctaveTexel,
    SkyTexel, SkyboxTexel, SpriteTexel, StarTexel, SunTexel,
};
pub use texture::Texture;
