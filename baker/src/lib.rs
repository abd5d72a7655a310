//! Bakes sky texture packs: a recipe, a photograph and a seed become small textures whose every
//! channel has a documented meaning.
//!
//! The way through is one line: [`Recipe::parse`] reads TOML, [`Recipe::resolve`] fills defaults and
//! checks ranges, [`sources`] makes the linear float images of every texture, and [`bake`] hands those to
//! `welkin-pack`, which quantises them and builds the mip levels.
//!
//! The same recipe, seed and version give the same bytes on every machine and with any number of
//! threads: every channel draws from its own random stream (`stream.rs`), rows are filled in parallel
//! but sums are taken in one order, and transcendental functions come from `libm`.
//!
//! ```
//! use std::ops::ControlFlow;
//! let resolved = welkin_baker::Recipe::default().resolve(Some(7))?;
//! let images = welkin_baker::sources(&resolved, None, &|_| ControlFlow::Continue(()))?;
//! assert_eq!(images.len(), 10);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod bake;
pub mod catalogue;
mod catalogued;
mod clouds;
mod error;
mod fbm;
mod field;
mod files;
mod filter;
mod flares;
mod fractal;
#[doc(hidden)]
pub mod fuzzing;
mod galaxy;
mod inputs;
mod lattice;
mod layers;
mod load;
mod notice;
mod octaves;
mod rebake;
mod recipe;
mod resolve;
mod settings;
mod sky;
mod skybox;
mod sound;
mod sprites;
mod stars;
mod stream;
mod sun;

pub use bake::{Progress, bake, bake_from, cloud_field, skybox_faces, sources, sprite_sheet};
pub use catalogued::{BUILT_IN_NAME as BUILT_IN_CATALOGUE, built_in_catalogue};
pub use clouds::photo::{
    BUILT_IN_NAME as BUILT_IN_PHOTO, PhotoFile, PhotoTile, built_in_photo, photo_channel,
    photo_tile,
};
pub use error::{BakeError, Fault, RecipeError};
pub use field::model::cloud_model;
pub use inputs::Inputs;
pub use load::{MAX_FILE_BYTES, TextureFile, decode_texture, read_photo};
pub use notice::{Clipped, Dropped, Notice};
pub use rebake::{REBAKE, RebakeError, rebake};
pub use recipe::{DEFAULT_RECIPE, Recipe};
pub use settings::{
    BoxSettings, CatalogueSource, CloudLayerSettings, CloudSettings, FbmSettings, FieldBound,
    FieldSettings, FlareSettings, GalaxySettings, GradientSettings, LayerSettings, LayersSettings,
    ModelSettings, ModelSource, PhotoProjection, PhotoRegion, PhotoSeam, PhotoSettings,
    PlacedSprite, Resolved, SkySettings, SkyboxPicture, SkyboxSettings, SpriteShape, SpriteSource,
    SpritesSettings, StarSettings, SunSettings,
};
pub use sound::{recipe_key, verify};
