//! A field of clouds.

use welkin_pack::field::{
    COLOUR_LEVELS, Category, Cloud, CloudBox, CloudKind, ColourLevel, Hour, Sprite,
};
use welkin_pack::limits::{MAX_BOXES, MAX_CLOUDS};

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

/// The most that a field may be.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct FieldBound {
    /// Clouds.
    pub clouds: usize,
    /// Boxes.
    pub boxes: usize,
    /// Sprites.
    pub sprites: usize,
    /// Bytes of memory while it is made and written: what a cloud, a box and a sprite take in the field and in its file.
    pub bytes: usize,
}

impl FieldSettings {
    /// The most that the field may be, said before anything is made. No box is without a sprite, and no cloud without a box.
    pub fn bound(&self) -> FieldBound {
        let sprites = self.most_sprites as usize;
        let (boxes, clouds) = (sprites.min(MAX_BOXES), sprites.min(MAX_CLOUDS));
        FieldBound {
            clouds,
            boxes,
            sprites,
            bytes: sprites * SPRITE_BYTES + boxes * BOX_BYTES + clouds * CLOUD_BYTES,
        }
    }
}

/// A sprite is in a list twice while it is culled, and in the file once: 40 bytes.
const SPRITE_BYTES: usize = 2 * size_of::<Sprite>() + 40;

/// A box is in the field and in the file (36 bytes), and may have a shading group of its own: three numbers, there
/// and as text.
const BOX_BYTES: usize = size_of::<CloudBox>() + 36 + 12 + 48;

/// A cloud is in the field, and in the file as some words.
const CLOUD_BYTES: usize = size_of::<Cloud>() + 128;

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
    /// Sprites that the artist placed one by one: where there are any, they are all that is in the box, and nothing is random.
    pub by_hand: Vec<PlacedSprite>,
}

/// A sprite that an artist has placed. Lengths in metres, places from the origin of its cloud, as of a box.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlacedSprite {
    /// Its middle.
    pub centre_m: [f32; 3],
    /// Width and height.
    pub size_m: [f32; 2],
    /// How far it is turned: see [`Sprite::rotation_rad`].
    pub rotation_rad: f32,
    /// Its picture: see [`Sprite::cell`].
    pub cell: u8,
}

impl BoxSettings {
    /// The cull distance in metres.
    pub fn cull_m(&self) -> f32 {
        self.cull * 0.5 * (self.height_m[0] + self.height_m[1])
    }
}
