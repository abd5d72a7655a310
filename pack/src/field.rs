//! Clouds in space: a square of sky, repeated without end, filled with clouds that are made of sprites.
//!
//! Metres; x is east, y up, z south, from the north-west corner of the field at sea level. The field repeats every
//! [`Field::side_m`] in x and z. N. Wang, "Let There Be Clouds! Fast, Realistic Cloud-Rendering in Microsoft Flight
//! Simulator 2004: A Century of Flight", Game Developer, 2004.

mod exposure;
pub(crate) mod glb;
mod verify;

/// Side of a section, in metres: the article counts sprites and boxes in blocks of 16 square kilometres.
pub const SECTION_SIDE_M: f32 = 4000.0;

/// Colour levels of a cloud.
pub const COLOUR_LEVELS: usize = 5;

/// A field of clouds.
#[derive(Clone, Debug, PartialEq)]
pub struct Field {
    /// Sections along a side of the field.
    pub sections: u32,
    /// Light of the clouds over the day, in the order of time; interpolated, and it wraps.
    pub hours: Vec<Hour>,
    /// The clouds, in the order of their rank.
    pub clouds: Vec<Cloud>,
}

impl Field {
    /// Side of the square after which it repeats, in metres.
    pub fn side_m(&self) -> f32 {
        self.sections as f32 * SECTION_SIDE_M
    }

    /// How many sprites there are in all.
    pub fn sprite_count(&self) -> usize {
        self.clouds.iter().map(|cloud| cloud.sprites.len()).sum()
    }

    /// How many boxes there are in all.
    pub fn box_count(&self) -> usize {
        self.clouds.iter().map(|cloud| cloud.boxes.len()).sum()
    }

    /// Rounds every rotation as [`rounded_rotation`] does.
    pub fn round_rotations(&mut self) {
        let sprites = self.clouds.iter_mut().flat_map(|cloud| &mut cloud.sprites);
        sprites.for_each(|sprite| sprite.rotation_rad = rounded_rotation(sprite.rotation_rad));
    }
}

/// Light on clouds at one time of day.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hour {
    /// Time of day, 0..1: 0 midnight, 0.25 sunrise, 0.5 noon, 0.75 sunset.
    pub time: f32,
    /// Factor on the colour levels, 0..1.
    pub ambient: f32,
    /// The most light that the sun or moon adds: linear BT.709, 1 is the white of a sunlit cloud at noon.
    pub colour: [f32; 3],
    /// Share of `colour` on the side of a shading group that faces away from the sun, 0..1.
    pub least: f32,
    /// Share of `colour` on the side that faces the sun, 0..1.
    pub most: f32,
}

impl Hour {
    /// The least light that the brightest hour of a field has.
    pub const LEAST_LIGHT: f32 = 0.25;

    /// Ambient and the most direct light together, as luminance.
    pub fn light(&self) -> f32 {
        let [r, g, b] = self.colour;
        // ITU-R BT.709-6, item 3.2.
        self.ambient + self.most * (0.2126 * r + 0.7152 * g + 0.0722 * b)
    }
}

/// A kind of cloud.
///
/// World Meteorological Organization, "International Cloud Atlas", WMO-No. 407, 2017, section 2.3.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum CloudKind {
    /// Separate heaps with flat bases.
    Cumulus,
    /// Heaps that have grown into towers.
    Congestus,
    /// A storm cloud with an anvil.
    Cumulonimbus,
    /// A low grey sheet.
    Stratus,
    /// A low sheet of rolls and rounded lumps.
    Stratocumulus,
    /// Small lumps at middle height.
    Altocumulus,
    /// High ice clouds: flat rectangles, which face up and not the camera.
    Cirrus,
}

impl CloudKind {
    /// Every kind, in the order of their numbers.
    pub const ALL: [CloudKind; 7] = [
        CloudKind::Cumulus,
        CloudKind::Congestus,
        CloudKind::Cumulonimbus,
        CloudKind::Stratus,
        CloudKind::Stratocumulus,
        CloudKind::Altocumulus,
        CloudKind::Cirrus,
    ];

    /// The name in recipes, files and on the command line.
    pub const fn name(self) -> &'static str {
        match self {
            CloudKind::Cumulus => "cumulus",
            CloudKind::Congestus => "congestus",
            CloudKind::Cumulonimbus => "cumulonimbus",
            CloudKind::Stratus => "stratus",
            CloudKind::Stratocumulus => "stratocumulus",
            CloudKind::Altocumulus => "altocumulus",
            CloudKind::Cirrus => "cirrus",
        }
    }

    /// The kind of a name; the inverse of [`CloudKind::name`].
    pub fn from_name(name: &str) -> Option<CloudKind> {
        CloudKind::ALL.into_iter().find(|kind| kind.name() == name)
    }

    /// Whether its sprites lie flat instead of facing the camera.
    pub const fn is_flat(self) -> bool {
        matches!(self, CloudKind::Cirrus)
    }
}

/// A cloud: boxes, the sprites in them, and how they are shaded.
#[derive(Clone, Debug, PartialEq)]
pub struct Cloud {
    /// What kind of cloud it is.
    pub kind: CloudKind,
    /// The cover from which it is there, 0..1.
    pub rank: f32,
    /// Middle of the box around all its boxes: see [`bounds`].
    pub centre_m: [f32; 3],
    /// Size of that box.
    pub size_m: [f32; 3],
    /// Ambient colour over the cloud's height, lowest first.
    pub levels: [ColourLevel; COLOUR_LEVELS],
    /// Centres of the shading groups; a sprite names one by its index.
    pub groups_m: Vec<[f32; 3]>,
    /// The boxes that it was modelled from.
    pub boxes: Vec<CloudBox>,
    /// Its sprites.
    pub sprites: Vec<Sprite>,
}

impl Cloud {
    /// Distance from the middle of its box to a corner, in metres: the article's `cloud_radius`.
    pub fn radius_m(&self) -> f32 {
        let [x, y, z] = self.size_m;
        0.5 * libm::sqrtf(x * x + y * y + z * z)
    }
}

/// Middle and size of the box around boxes: [`Cloud::centre_m`] and [`Cloud::size_m`]. Zeros around none.
pub fn bounds(boxes: &[CloudBox]) -> ([f32; 3], [f32; 3]) {
    let edge = |axis: usize, side: f32, pick: fn(f32, f32) -> f32| {
        let edges = boxes
            .iter()
            .map(|b| b.centre_m[axis] + side * b.size_m[axis]);
        edges.reduce(pick).unwrap_or(0.0)
    };
    let (mut centre, mut size) = ([0.0; 3], [0.0; 3]);
    for axis in 0..3 {
        let (low, high) = (edge(axis, -0.5, f32::min), edge(axis, 0.5, f32::max));
        (centre[axis], size[axis]) = (0.5 * (low + high), high - low);
    }
    (centre, size)
}

/// Steps of a rotation in a turn, as it is stored.
pub const ROTATION_STEPS: f32 = 4096.0;

/// A rotation as it is stored: the nearest multiple of a 4096th of a turn, above -pi and up to pi.
pub fn rounded_rotation(rotation_rad: f32) -> f32 {
    rotation_step(rotation_rad) as f32 * (std::f32::consts::TAU / ROTATION_STEPS)
}

/// The same in steps, -2047 to 2048.
fn rotation_step(rotation_rad: f32) -> i32 {
    let turns = rotation_rad / std::f32::consts::TAU;
    let turns = turns - libm::floorf(turns);
    let step = libm::roundf(turns * ROTATION_STEPS) as i32;
    if step > 2048 { step - 4096 } else { step }
}

/// The ambient colour at one height of a cloud.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ColourLevel {
    /// Share of the cloud's height, 0 its base, 1 its top.
    pub height: f32,
    /// Linear BT.709, 1 is the white of a sunlit cloud at noon, and opacity 0..1.
    pub rgba: [f32; 4],
}

/// Which pictures of the sheet a box is filled with.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Category {
    /// Fog and wisps: sheets.
    Stratus,
    /// Puffs, and few wisps: solid heaps.
    Cumulus,
    /// Wisps alone: edges and veils.
    Wispy,
}

impl Category {
    /// Every category, in the order of their numbers.
    pub const ALL: [Category; 3] = [Category::Stratus, Category::Cumulus, Category::Wispy];

    /// The name in recipes and files.
    pub const fn name(self) -> &'static str {
        match self {
            Category::Stratus => "stratus",
            Category::Cumulus => "cumulus",
            Category::Wispy => "wispy",
        }
    }

    /// The category of a name; the inverse of [`Category::name`].
    pub fn from_name(name: &str) -> Option<Category> {
        Category::ALL.into_iter().find(|kind| kind.name() == name)
    }
}

/// A box that an artist, or the field maker, has placed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CloudBox {
    /// Its middle.
    pub centre_m: [f32; 3],
    /// Its size.
    pub size_m: [f32; 3],
    /// The pictures on its sprites.
    pub category: Category,
    /// Index of its shading group in [`Cloud::groups_m`].
    pub group: u16,
    /// The least distance of its sprites from each other.
    pub cull_m: f32,
}

/// A textured square in space.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sprite {
    /// Its middle.
    pub centre_m: [f32; 3],
    /// Width and height.
    pub size_m: [f32; 2],
    /// How far it is turned about the axis towards the viewer, anticlockwise; of a flat one about +Y, from width along +x
    /// and height along -z. See [`rounded_rotation`].
    pub rotation_rad: f32,
    /// Index of its picture on the sheet, from the upper left, row by row: see [`crate::mapping::SheetCell`].
    pub cell: u8,
    /// Index of the box that it was placed in, in [`Cloud::boxes`]; its shading group is that of the box.
    pub cloud_box: u16,
    /// Light that gets to it: see [`Field::expose`].
    pub exposure: Exposure,
}

/// What light gets to a sprite, as it is stored.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Exposure {
    /// Halvings of sunlight on its way from just above the horizon in the east, south, west and north, in 255ths of [`MOST_DEPTH`].
    pub sides: [u8; 4],
    /// The same from above.
    pub above: u8,
    /// Share of the sky's light that gets there, in 255ths.
    pub sky: u8,
    /// Halvings a metre about it, in 255ths of [`MOST_HALVINGS_M`].
    pub halvings: u8,
}

/// The largest depth that is stored, in halvings.
pub const MOST_DEPTH: f32 = 16.0;

/// The most halvings a metre that are stored.
pub const MOST_HALVINGS_M: f32 = 0.064;
