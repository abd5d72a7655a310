//! The roles of the textures in a pack and what each of their channels means.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::texel::StarTexel;
use crate::{Format, Shape};

/// What a texture is for.
#[derive(
    Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize, JsonSchema,
)]
#[serde(rename_all = "lowercase")]
pub enum Role {
    /// The packed cloud texture of Roden and Parberry.
    Clouds,
    /// The star data of Roden and Parberry.
    Stars,
    /// Brightness of the galaxy over the whole dome.
    Galaxy,
    /// Day gradient: radiance over time and elevation.
    Sky,
    /// The sun's disc and its glow.
    Sun,
}

/// How a texture is addressed outside 0..1.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Wrap {
    /// It tiles in both directions.
    Repeat,
    /// The edge texel goes on for ever.
    Clamp,
}

/// How a texture is filtered.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Filter {
    /// Bilinear in a level, linear between levels.
    Linear,
    /// Texels are read one by one: they are records, not colours.
    Nearest,
}

/// What one channel of a role means.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ChannelSpec {
    /// Name in manifests and file names.
    pub name: &'static str,
    /// One sentence for people.
    pub meaning: &'static str,
    /// Unit of the decoded value; `1` where it has none.
    pub unit: &'static str,
    /// Physical values of stored 0 and stored 1.
    pub range: [f32; 2],
}

/// What a role asks of its texture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RoleSpec {
    /// Formats that it may have, the default first.
    pub formats: &'static [Format],
    /// Arrangement.
    pub shape: Shape,
    /// Default width and height in texels.
    pub size: [u32; 2],
    /// Whether it has a full chain of levels, or one alone.
    pub mips: bool,
    /// Addressing.
    pub wrap: Wrap,
    /// Filtering.
    pub filter: Filter,
    /// Channels in memory order.
    pub channels: &'static [ChannelSpec],
}

const fn channel(
    name: &'static str,
    meaning: &'static str,
    unit: &'static str,
    max: f32,
) -> ChannelSpec {
    ChannelSpec {
        name,
        meaning,
        unit,
        range: [0.0, max],
    }
}

const CLOUDS: RoleSpec = RoleSpec {
    formats: &[Format::Rgba8Unorm, Format::Rgba16Float],
    shape: Shape::D2,
    size: [512, 512],
    mips: true,
    wrap: Wrap::Repeat,
    filter: Filter::Linear,
    channels: &[
        channel("photo", "cloud amount from a photograph", "1", 1.0),
        channel("noise", "cloud amount from fractal noise", "1", 1.0),
        channel("detail", "finer fractal noise", "1", 1.0),
        channel(
            "gradient",
            "sunset tint, from away from the sun (top row) to below it (bottom row)",
            "1",
            1.0,
        ),
    ],
};

const STARS: RoleSpec = RoleSpec {
    formats: &[Format::Rgba8Unorm],
    shape: Shape::D2,
    size: [256, 256],
    mips: true,
    wrap: Wrap::Repeat,
    filter: Filter::Nearest,
    channels: &[
        channel(
            "intensity",
            "mean intensity of the star, 0 where there is none",
            "1",
            1.0,
        ),
        channel("rate", "flicker rate", "Hz", StarTexel::MAX_RATE_HZ),
        channel(
            "variance",
            "flicker amplitude, in the unit of intensity",
            "1",
            1.0,
        ),
        channel("phase", "place in the flicker cycle at time 0", "turn", 1.0),
    ],
};

const GALAXY: RoleSpec = RoleSpec {
    formats: &[Format::R8Unorm],
    shape: Shape::D2,
    size: [128, 128],
    mips: true,
    wrap: Wrap::Clamp,
    filter: Filter::Linear,
    channels: &[channel("brightness", "brightness of the galaxy", "1", 1.0)],
};

const SKY: RoleSpec = RoleSpec {
    formats: &[Format::Rgba16Float],
    shape: Shape::D2,
    size: [128, 64],
    mips: false,
    wrap: Wrap::Repeat,
    filter: Filter::Linear,
    channels: &[
        channel(
            "red",
            "radiance of the clear sky, linear BT.709, red",
            "white of a sunlit cloud at noon",
            1.0,
        ),
        channel(
            "green",
            "radiance of the clear sky, linear BT.709, green",
            "white of a sunlit cloud at noon",
            1.0,
        ),
        channel(
            "blue",
            "radiance of the clear sky, linear BT.709, blue",
            "white of a sunlit cloud at noon",
            1.0,
        ),
        channel(
            "night",
            "share of the night sky that shows through, 0 by day",
            "1",
            1.0,
        ),
    ],
};

const SUN: RoleSpec = RoleSpec {
    formats: &[Format::Rg8Unorm],
    shape: Shape::D2,
    size: [128, 128],
    mips: true,
    wrap: Wrap::Clamp,
    filter: Filter::Linear,
    channels: &[
        channel(
            "disc",
            "the sun's disc with limb darkening; its edge is half way from centre to side",
            "1",
            1.0,
        ),
        channel("glow", "the glow around the sun, 0 at the sides", "1", 1.0),
    ],
};

impl Role {
    /// Every role, in the order in which a manifest lists them.
    pub const ALL: [Role; 5] = [
        Role::Clouds,
        Role::Stars,
        Role::Galaxy,
        Role::Sky,
        Role::Sun,
    ];

    /// The name used in manifests, recipes and file names.
    pub const fn name(self) -> &'static str {
        match self {
            Role::Clouds => "clouds",
            Role::Stars => "stars",
            Role::Galaxy => "galaxy",
            Role::Sky => "sky",
            Role::Sun => "sun",
        }
    }

    /// What the role asks of its texture.
    pub const fn spec(self) -> &'static RoleSpec {
        match self {
            Role::Clouds => &CLOUDS,
            Role::Stars => &STARS,
            Role::Galaxy => &GALAXY,
            Role::Sky => &SKY,
            Role::Sun => &SUN,
        }
    }

    /// The file that holds it in a pack.
    pub fn file(self) -> String {
        format!("{}.ktx2", self.name())
    }
}
