//! Texel formats and texture shapes that a pack may hold.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A texel format. Data textures are linear: there is no sRGB format on purpose.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Format {
    /// One 8-bit unorm channel.
    R8Unorm,
    /// Two 8-bit unorm channels.
    Rg8Unorm,
    /// Four 8-bit unorm channels.
    Rgba8Unorm,
    /// Four IEEE 754 binary16 channels, little-endian.
    Rgba16Float,
}

impl Format {
    /// Every format, in a fixed order.
    pub const ALL: [Format; 4] = [
        Format::R8Unorm,
        Format::Rg8Unorm,
        Format::Rgba8Unorm,
        Format::Rgba16Float,
    ];

    /// Channels a texel.
    pub const fn channels(self) -> usize {
        match self {
            Format::R8Unorm => 1,
            Format::Rg8Unorm => 2,
            Format::Rgba8Unorm | Format::Rgba16Float => 4,
        }
    }

    /// Bytes a channel.
    pub const fn bytes_per_channel(self) -> usize {
        match self {
            Format::R8Unorm | Format::Rg8Unorm | Format::Rgba8Unorm => 1,
            Format::Rgba16Float => 2,
        }
    }

    /// Bytes a texel.
    pub const fn bytes_per_texel(self) -> usize {
        self.channels() * self.bytes_per_channel()
    }

    /// The name used in manifests and recipes, as wgpu spells it in lower case.
    pub const fn name(self) -> &'static str {
        match self {
            Format::R8Unorm => "r8unorm",
            Format::Rg8Unorm => "rg8unorm",
            Format::Rgba8Unorm => "rgba8unorm",
            Format::Rgba16Float => "rgba16float",
        }
    }

    /// The Vulkan format that the KTX2 header carries.
    pub(crate) const fn vk(self) -> ktx2::Format {
        match self {
            Format::R8Unorm => ktx2::Format::R8_UNORM,
            Format::Rg8Unorm => ktx2::Format::R8G8_UNORM,
            Format::Rgba8Unorm => ktx2::Format::R8G8B8A8_UNORM,
            Format::Rgba16Float => ktx2::Format::R16G16B16A16_SFLOAT,
        }
    }

    /// The largest error of storing `value`: half a unorm step, or half a unit in the last place.
    pub fn quantisation_error(self, value: f32) -> f32 {
        match self {
            Format::Rgba16Float => (value.abs() / 2048.0).max(1.0 / 33_554_432.0),
            _ => 0.5 / 255.0,
        }
    }
}

/// The faces of a cube in their order: +X, -X, +Y, -Y, +Z, -Z.
pub const CUBE_FACES: [&str; 6] = ["east", "west", "up", "down", "south", "north"];

/// How the images of one level are arranged.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Shape {
    /// One image.
    #[serde(rename = "2d")]
    D2,
    /// A list of images of one size, sampled by index.
    #[serde(rename = "2d-array")]
    Array,
    /// Six square images in the order +X, -X, +Y, -Y, +Z, -Z.
    Cube,
}

impl Shape {
    /// The name used in manifests.
    pub const fn name(self) -> &'static str {
        match self {
            Shape::D2 => "2d",
            Shape::Array => "2d-array",
            Shape::Cube => "cube",
        }
    }

    /// What the image `layer` (from 0) of a level is called: nothing where there is only one, a number from 1
    /// in an array, and the direction of a cube's face.
    pub fn layer_name(self, layer: u32) -> Option<String> {
        match self {
            Shape::D2 => None,
            Shape::Array => Some((layer + 1).to_string()),
            Shape::Cube => Some(CUBE_FACES.get(layer as usize)?.to_string()),
        }
    }
}
