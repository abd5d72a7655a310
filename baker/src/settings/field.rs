//! A field of clouds.

use welkin_pack::field::{COLOUR_LEVELS, Category, CloudKind, ColourLevel, Hour};

/// A field of clouds.
#[derive(Clone, Debug, PartialEq)]
pub struct FieldSettings {
    /// Sections along a side.
    pub sections: u32,
    /// The most sprites that it may have; a bake that would need more stops with an error.
    pub most_sprites: u32,
    /// Clouds that an artist has modelled; they come first.
    pub models: Vec<ModelSettings>,
    /// Layers that the field maker fills, one after another.
    pub layers: Vec<CloudLayerSettings>,
    /// Light over the day.
    pub hours: Vec<Hour>,
}

/// A layer that the field maker fills.
#[derive(Clone, Debug, PartialEq)]
pub struct CloudLayerSettings {
    /// Kind of its clouds.
    pub kind: CloudKind,
    /// Share of the ground below clouds of any layer at which this one is full, 0..1.
    pub cover: f32,
    /// Height of the bases above the sea.
    pub base_m: f32,
    /// Height that no box exceeds.
    pub top_m: f32,
    /// Factor on the sprites of each box.
    pub density: f32,
    /// Cull distance as a share of the sprites' height.
    pub cull: f32,
    /// Ambient colour, lowest first.
    pub levels: [ColourLevel; COLOUR_LEVELS],
}

/// A cloud that an artist has modelled, and where it goes.
#[derive(Clone, Debug, PartialEq)]
pub struct ModelSettings {
    /// What kind of cloud it is.
    pub kind: CloudKind,
    /// Its boxes.
    pub source: ModelSource,
    /// How many of it there are.
    pub copies: u32,
    /// Height of the model's origin above the sea.
    pub base_m: f32,
    /// Rank of all copies, 0..1; by the cover that they add, if absent.
    pub rank: Option<f32>,
    /// Ambient colour, lowest first.
    pub levels: [ColourLevel; COLOUR_LEVELS],
}

/// Where the boxes of a model come from.
#[derive(Clone, Debug, PartialEq)]
pub enum ModelSource {
    /// A glTF file.
    File(String),
    /// The recipe itself.
    Boxes(Vec<BoxSettings>),
}

/// A box to be filled with sprites. Lengths in metres.
#[derive(Clone, Debug, PartialEq)]
pub struct BoxSettings {
    /// Its middle, from the origin of its cloud: x east, y up, z south.
    pub centre_m: [f32; 3],
    /// Its size.
    pub size_m: [f32; 3],
    /// Sprites that are placed in it, before those too near to another are taken away: 1 to 100.
    pub sprites: u32,
    /// Least and largest width of a sprite.
    pub width_m: [f32; 2],
    /// Least and largest height of a sprite.
    pub height_m: [f32; 2],
    /// Which pictures they get.
    pub category: Category,
    /// Least and largest turn of a sprite about the axis of view, in radians.
    pub rotation_rad: [f32; 2],
    /// Number of its shading group; boxes of one number are shaded as one clump.
    pub group: u32,
    /// Whether its lowest sprites are flat at the bottom, all at one height.
    pub flat_bottom: bool,
    /// Cull distance as a share of the sprites' mean height, 0..1.
    pub cull: f32,
}

impl BoxSettings {
    /// The cull distance in metres.
    pub fn cull_m(&self) -> f32 {
        self.cull * 0.5 * (self.height_m[0] + self.height_m[1])
    }
}
