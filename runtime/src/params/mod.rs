//! The parameters of Roden and Parberry, those of each method, and a few of our own: what can be set, and the table of all settings.

mod check;
mod fbm;
pub mod layers;
mod lit;
mod method;
mod octaves;
mod perez;
mod range;
#[macro_use]
pub mod row;
mod setting;
mod sky;
mod sprites;
mod table;
mod text;
mod tonemap;
mod weather;

pub use fbm::{FbmParams, PALETTES};
pub use lit::{LAYERS_AN_ITERATION, LitLayer, LitParams, MAX_LAYERS};
pub use method::{Method, Shading, SkyModel};
pub use octaves::{DEFAULT_OCTAVES, FORMATION_INTERVAL_S, MAX_OCTAVES, OctaveParams};
pub use perez::{CUSTOM, LAST_OVERCAST, PerezParams, PerezShape, STANDARD_SKIES, TURBIDITY};
pub use range::{ParamError, whole_within, within};
pub use setting::{
    Command, CommandOption, DefaultSaid, Group, Input, NONE, Number, Setting, Slot, Words,
};
pub use sky::{EXPOSURE_EV, MAX_EXPOSURE, SkyParams};
pub use sprites::{LEAST_RING_M, MOST_DISTANCE_M, SpriteParams};
pub use table::{OTHERS, SETTINGS};
pub use tonemap::Tonemap;
pub use weather::{FLASH_PLACE_M, FLASH_START_S, FLASH_STRENGTH, Lightning, WeatherParams};
