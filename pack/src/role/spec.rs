//! What a role can ask of its texture.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::error::PackError;
use crate::format::{Format, Shape};
use crate::texture::Texture;

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

/// How many levels a texture has.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Mips {
    /// Level 0 alone.
    One,
    /// All, to 1x1.
    All,
    /// Down to this width.
    To(u32),
}

impl Mips {
    /// Levels of a texture of this size.
    pub fn count(self, width: u32, height: u32) -> usize {
        let all = Texture::full_level_count(width, height);
        match self {
            Mips::One => 1,
            Mips::All => all,
            Mips::To(least) => all.saturating_sub(least.ilog2() as usize).max(1),
        }
    }
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
    /// Whether it is fractal noise, of which a manifest tells the octaves.
    pub is_fractal: bool,
}

/// What a role asks of its texture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RoleSpec {
    /// Formats that it may have, the default first.
    pub formats: &'static [Format],
    /// Arrangement.
    pub shape: Shape,
    /// Default width and height in texels. Where they are equal, they always are.
    pub size: [u32; 2],
    /// Least and greatest side in texels; every side is a power of two.
    pub sides: [u32; 2],
    /// Least and greatest number of images a level.
    pub layers: [u32; 2],
    /// What their number is a multiple of.
    pub layers_multiple: u32,
    /// Where each layer has twice the cells of the one before: the fewest of the first. A cell has two texels or more, so
    /// the width bounds the layers too.
    pub least_cells: Option<u32>,
    /// Its levels.
    pub mips: Mips,
    /// Addressing.
    pub wrap: Wrap,
    /// Filtering.
    pub filter: Filter,
    /// Channels in memory order.
    pub channels: &'static [ChannelSpec],
}

impl RoleSpec {
    /// Compares the size of a texture with what the role asks. `file` names it in the error, `at` is what
    /// stands before the key.
    pub(crate) fn verify_size(
        &self,
        file: &str,
        at: &str,
        [width, height, layers]: [u32; 3],
    ) -> Result<(), PackError> {
        let bad = |key: &str, found: u32, expected: String| {
            Err(PackError::value(
                file,
                &format!("{at}{key}"),
                found,
                expected,
            ))
        };
        let [least, most] = self.sides;
        for (key, side) in [("width", width), ("height", height)] {
            if !side.is_power_of_two() || !(least..=most).contains(&side) {
                let expected = if least == most {
                    least.to_string()
                } else {
                    format!("a power of two from {least} to {most}")
                };
                return bad(key, side, expected);
            }
        }
        if self.size[0] == self.size[1] && width != height {
            return bad("height", height, format!("{width}, as the width"));
        }
        let [least, most] = [self.layers[0], self.most_layers(width)];
        if !(least..=most).contains(&layers) {
            let expected = if least == most {
                least.to_string()
            } else if most < self.layers[1] {
                format!("{least} to {most} at this width: the finest cell has two texels or more")
            } else {
                format!("{least} to {most}")
            };
            return bad("layers", layers, expected);
        }
        let group = self.layers_multiple;
        if !layers.is_multiple_of(group) {
            return bad("layers", layers, format!("a multiple of {group}"));
        }
        Ok(())
    }

    /// The greatest number of images a level at this width.
    pub(super) fn most_layers(&self, width: u32) -> u32 {
        let most = self.layers[1];
        let doublings = |cells: u32| (width / 2 / cells).checked_ilog2().unwrap_or(0);
        self.least_cells
            .map_or(most, |cells| most.min(1 + doublings(cells)))
    }
}
