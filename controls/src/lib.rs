//! What a person moves at a sky, without a window: the window of `welkin-view` and the web page both stand on it.
//!
//! - [`Settings`]: all that a picture depends on but the pack and the size, and the pace of a time-lapse.
//! - [`KEYS`]: every setting by name, with its range, its words for a person and the methods that look at it. Settings become
//!   text and come back by it: pairs for links, the options of `welkin-view render`, TOML.
//! - [`PRESETS`] and [`Blend`]: weathers, and the way from one to the next over seconds.
//! - [`Pilot`]: looking and flying with mouse and keys.

mod blend;
mod flashes;
mod key;
mod keys;
mod layers;
mod lightning;
mod pilot;
mod preset;
mod settings;
mod text;
#[cfg(feature = "toml")]
mod toml;
pub mod values;

pub use blend::Blend;
pub use key::{Group, Input, Key};
pub use keys::KEYS;
pub use layers::{LAYERS_FORM, layers, layers_help, layers_text};
pub use lightning::{Flash, LIGHTNING_FORM, lightning};
pub use pilot::{Keys, Pilot};
pub use preset::{PRESETS, Preset};
pub use settings::{SettingError, Settings, Viewpoint};
#[cfg(feature = "toml")]
pub use toml::TomlError;
