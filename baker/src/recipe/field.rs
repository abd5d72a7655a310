//! The table `[field]` as it is written.

use serde::Deserialize;
use toml::Spanned;

use super::Entry;

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
