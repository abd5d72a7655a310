//! The tables of a recipe as they are written.

use serde::Deserialize;
use toml::{Spanned, Value};

/// A value that may be left out, with its place in the text.
pub(crate) type Entry = Option<Spanned<Value>>;

#[derive(Clone, Debug, Default, Deserialize)]
#[serde(deny_unknown_fields, default, expecting = "a table")]
pub(crate) struct Tables {
    pub name: Entry,
    pub seed: Entry,
    pub clouds: Clouds,
    pub stars: Stars,
    pub galaxy: Galaxy,
    pub sky: Sky,
    pub sun: Sun,
    pub fbm: Fbm,
    pub flares: Flares,
    pub layers: Layers,
    pub sprites: Sprites,
    pub skybox: Option<Spanned<Skybox>>,
    pub field: Option<Spanned<FieldTable>>,
}

#[derive(Clone, Debug, Default, Deserialize)]
#[serde(deny_unknown_fields, default, expecting = "a table")]
pub(crate) struct Clouds {
    pub size: Entry,
    pub format: Entry,
    pub photo: Photo,
    pub noise: Fractal,
    pub detail: Fractal,
    pub gradient: Gradient,
}

#[derive(Clone, Debug, Default, Deserialize)]
#[serde(deny_unknown_fields, default, expecting = "a table")]
pub(crate) struct Photo {
    pub file: Entry,
    pub mean: Entry,
}

#[derive(Clone, Debug, Default, Deserialize)]
#[serde(deny_unknown_fields, default, expecting = "a table")]
pub(crate) struct Fractal {
    pub cells: Entry,
    pub octaves: Entry,
    pub gain: Entry,
    pub mean: Entry,
}

#[derive(Clone, Debug, Default, Deserialize)]
#[serde(deny_unknown_fields, default, expecting = "a table")]
pub(crate) struct Gradient {
    pub power: Entry,
}

#[derive(Clone, Debug, Default, Deserialize)]
#[serde(deny_unknown_fields, default, expecting = "a table")]
pub(crate) struct Stars {
    pub size: Entry,
    pub count: Entry,
    pub magnitudes: Entry,
    pub brightest: Entry,
}

#[derive(Clone, Debug, Default, Deserialize)]
#[serde(deny_unknown_fields, default, expecting = "a table")]
pub(crate) struct Galaxy {
    pub size: Entry,
    pub tilt_deg: Entry,
    pub azimuth_deg: Entry,
    pub dust: Entry,
}

#[derive(Clone, Debug, Default, Deserialize)]
#[serde(deny_unknown_fields, default, expecting = "a table")]
pub(crate) struct Sky {
    pub width: Entry,
    pub height: Entry,
    pub haze: Entry,
}

#[derive(Clone, Debug, Default, Deserialize)]
#[serde(deny_unknown_fields, default, expecting = "a table")]
pub(crate) struct Sun {
    pub size: Entry,
    pub noon_elevation_deg: Entry,
}

#[derive(Clone, Debug, Default, Deserialize)]
#[serde(deny_unknown_fields, default, expecting = "a table")]
pub(crate) struct Fbm {
    pub size: Entry,
    pub octaves: Entry,
    pub cells: Entry,
}

#[derive(Clone, Debug, Default, Deserialize)]
#[serde(deny_unknown_fields, default, expecting = "a table")]
pub(crate) struct Flares {
    pub size: Entry,
}

#[derive(Clone, Debug, Default, Deserialize)]
#[serde(deny_unknown_fields, default, expecting = "a table")]
pub(crate) struct Layers {
    pub size: Entry,
    pub stratocumulus: Layer,
    pub cumulus: Layer,
    pub cirrus: Layer,
}

#[derive(Clone, Debug, Default, Deserialize)]
#[serde(deny_unknown_fields, default, expecting = "a table")]
pub(crate) struct Layer {
    pub cells: Entry,
    pub octaves: Entry,
    pub gain: Entry,
    pub relief: Entry,
}

#[derive(Clone, Debug, Default, Deserialize)]
#[serde(deny_unknown_fields, default, expecting = "a table")]
pub(crate) struct Sprites {
    pub size: Entry,
    pub file: Entry,
    pub pictures: Option<Spanned<Vec<Spanned<Value>>>>,
    pub contrast: Entry,
    pub detail: Entry,
    pub softness: Entry,
}

#[derive(Clone, Debug, Default, Deserialize)]
#[serde(deny_unknown_fields, default, expecting = "a table")]
pub(crate) struct Skybox {
    pub file: Entry,
    pub faces: Option<Spanned<Faces>>,
    pub size: Entry,
    pub gain: Entry,
    pub azimuth_deg: Entry,
}

#[derive(Clone, Debug, Default, Deserialize)]
#[serde(deny_unknown_fields, default, expecting = "a table")]
pub(crate) struct Faces {
    pub east: Entry,
    pub west: Entry,
    pub up: Entry,
    pub down: Entry,
    pub south: Entry,
    pub north: Entry,
}

#[derive(Clone, Debug, Default, Deserialize)]
#[serde(deny_unknown_fields, default, expecting = "a table")]
pub(crate) struct FieldTable {
    pub sections: Entry,
    pub most_sprites: Entry,
    pub clouds: Option<Vec<Spanned<CloudLayer>>>,
    pub models: Option<Vec<Spanned<Model>>>,
    pub hours: Option<Vec<Spanned<HourTable>>>,
}

#[derive(Clone, Debug, Default, Deserialize)]
#[serde(deny_unknown_fields, default, expecting = "a table")]
pub(crate) struct CloudLayer {
    pub kind: Entry,
    pub cover: Entry,
    pub base_m: Entry,
    pub top_m: Entry,
    pub density: Entry,
    pub cull: Entry,
    pub levels: Entry,
}

#[derive(Clone, Debug, Default, Deserialize)]
#[serde(deny_unknown_fields, default, expecting = "a table")]
pub(crate) struct Model {
    pub kind: Entry,
    pub file: Entry,
    pub boxes: Option<Vec<Spanned<BoxTable>>>,
    pub copies: Entry,
    pub base_m: Entry,
    pub rank: Entry,
    pub levels: Entry,
}

#[derive(Clone, Debug, Default, Deserialize)]
#[serde(deny_unknown_fields, default, expecting = "a table")]
pub(crate) struct BoxTable {
    pub centre_m: Entry,
    pub size_m: Entry,
    pub sprites: Entry,
    pub width_m: Entry,
    pub height_m: Entry,
    pub category: Entry,
    pub rotation_deg: Entry,
    pub group: Entry,
    pub flat_bottom: Entry,
    pub cull: Entry,
}

#[derive(Clone, Debug, Default, Deserialize)]
#[serde(deny_unknown_fields, default, expecting = "a table")]
pub(crate) struct HourTable {
    pub time: Entry,
    pub ambient: Entry,
    pub colour: Entry,
    pub least: Entry,
    pub most: Entry,
}
