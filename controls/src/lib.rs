//! What a person moves at a sky, without a window: the window of `welkin-view` and the web page both stand on it.
//!
//! - [`Settings`]: all that a picture depends on but the pack and the size, and the pace of a time-lapse.
//! - [`KEYS`]: every setting by name, with its range, its words for a person and the methods that look at it. Settings become
//!   text and come back by it: pairs for links, the options of `welkin-view render`, TOML.
//! - [`PRESETS`] and [`Blend`]: weathers, and the way from one to the next over seconds.
//! - [`Pilot`]: looking and flying with mouse and keys.

mod blend;
mod by_name;
mod flashes;
mod keys;
mod lightning;
mod pilot;
mod preset;
mod settings;
#[cfg(feature = "toml")]
mod toml;

pub use blend::Blend;
pub use keys::{KEYS, Key, SettingError};
pub use lightning::{Flash, LIGHTNING_FORM, lightning};
pub use pilot::{Keys, Pilot};
pub use preset::{PRESETS, Preset};
pub use settings::{Settings, Viewpoint};
#[cfg(feature = "toml")]
pub use toml::TomlError;
pub use welkin_runtime::params::{Group, Input, Setting, Words};
