//! The roles of the textures in a pack and what each of their channels means.

mod specs;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::{Format, LayerKind, PackError, Shape, Texture};

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
    /// White noise for the octaves of Guthikonda and others.
    Octaves,
    /// Smooth noise, an octave a layer, of Quilez.
    Fbm,
    /// The parts of a lens flare.
    Flares,
    /// Layers of clouds of Mukhina and Bezgodov: normal, density and rank.
    Layers,
    /// Pictures of parts of clouds, for N. Wang's sprites.
    Sprites,
    /// A picture of a sky around the viewer.
    Skybox,
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

impl Role {
    /// Every role, in the order in which a manifest lists them.
    pub const ALL: [Role; 11] = [
        Role::Clouds,
        Role::Stars,
        Role::Galaxy,
        Role::Sky,
        Role::Sun,
        Role::Octaves,
        Role::Fbm,
        Role::Flares,
        Role::Layers,
        Role::Sprites,
        Role::Skybox,
    ];

    /// The name used in manifests, recipes and file names.
    pub const fn name(self) -> &'static str {
        match self {
            Role::Clouds => "clouds",
            Role::Stars => "stars",
            Role::Galaxy => "galaxy",
            Role::Sky => "sky",
            Role::Sun => "sun",
            Role::Octaves => "octaves",
            Role::Fbm => "fbm",
            Role::Flares => "flares",
            Role::Layers => "layers",
            Role::Sprites => "sprites",
            Role::Skybox => "skybox",
        }
    }

    /// What the role asks of its texture.
    pub const fn spec(self) -> &'static RoleSpec {
        match self {
            Role::Clouds => &specs::CLOUDS,
            Role::Stars => &specs::STARS,
            Role::Galaxy => &specs::GALAXY,
            Role::Sky => &specs::SKY,
            Role::Sun => &specs::SUN,
            Role::Octaves => &specs::OCTAVES,
            Role::Fbm => &specs::FBM,
            Role::Flares => &specs::FLARES,
            Role::Layers => &specs::LAYERS,
            Role::Sprites => &specs::SPRITES,
            Role::Skybox => &specs::SKYBOX,
        }
    }

    /// Whether a pack may do without it.
    pub const fn is_optional(self) -> bool {
        matches!(self, Role::Skybox)
    }

    /// What image `layer` (from 0) of a level is called: a kind of cloud, or what its shape calls it.
    pub fn layer_name(self, layer: u32) -> Option<String> {
        match self {
            Role::Layers => Some(LayerKind::ALL.get(layer as usize)?.name().to_string()),
            _ => self.spec().shape.layer_name(layer),
        }
    }

    /// Compares the layout of a texture with what the role asks: format, shape, size, levels and the bytes of each. A texture
    /// may have level 0 alone where the role asks for more. `file` names it in errors.
    ///
    /// # Errors
    /// [`PackError::Value`].
    pub fn verify_texture(self, file: &str, texture: &Texture) -> Result<(), PackError> {
        let spec = self.spec();
        let bad = |key: &str, found: String, expected: String| {
            Err(PackError::value(file, key, found, expected))
        };
        if !spec.formats.contains(&texture.format) {
            let allowed: Vec<_> = spec.formats.iter().map(|f| f.name()).collect();
            let found = texture.format.name().to_string();
            return bad("format", found, allowed.join(" or "));
        }
        if texture.shape != spec.shape {
            let found = texture.shape.name().to_string();
            return bad("shape", found, spec.shape.name().to_string());
        }
        let size = [texture.width, texture.height, texture.layers];
        spec.verify_size(file, "", size)?;
        let (found, all) = (
            texture.levels.len(),
            spec.mips.count(texture.width, texture.height),
        );
        if found != all && found != 1 {
            let expected = format!("{all}, or level 0 alone");
            return bad("levels", found.to_string(), expected);
        }
        for (level, bytes) in texture.levels.iter().enumerate() {
            let expected = texture.level_bytes(level);
            if bytes.len() != expected {
                let found = format!("{} bytes", bytes.len());
                return bad(
                    &format!("level {level}"),
                    found,
                    format!("{expected} bytes"),
                );
            }
        }
        Ok(())
    }

    /// The file that holds it in a pack.
    pub fn file(self) -> String {
        format!("{}.ktx2", self.name())
    }
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
        Ok(())
    }

    /// The greatest number of images a level at this width.
    fn most_layers(&self, width: u32) -> u32 {
        let most = self.layers[1];
        let doublings = |cells: u32| (width / 2 / cells).checked_ilog2().unwrap_or(0);
        self.least_cells
            .map_or(most, |cells| most.min(1 + doublings(cells)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_finest_cell_of_an_octave_has_two_texels() {
        let fbm = Role::Fbm.spec();
        let most = [64, 128, 256, 512, 1024].map(|width| fbm.most_layers(width));
        assert_eq!(most, [4, 5, 6, 7, 8]);
        let refused = |width, layers| {
            let error = fbm.verify_size("f", "", [width, width, layers]);
            error.err().map(|error| error.to_string())
        };
        assert_eq!(refused(64, 4), None);
        assert_eq!(refused(1024, 8), None);
        for (width, layers) in [(64, 7), (64, 8), (128, 8)] {
            let error = refused(width, layers).unwrap();
            assert!(error.starts_with(&format!("f: layers is {layers}, expected 1 to ")));
        }
        assert_eq!(Role::Skybox.spec().most_layers(16), 6);
    }

    #[test]
    fn levels_are_as_many_as_said() {
        let counts =
            |mips: Mips| [(512, 512), (128, 64), (16, 16), (1, 1)].map(|(w, h)| mips.count(w, h));
        assert_eq!(counts(Mips::One), [1; 4]);
        assert_eq!(counts(Mips::All), [10, 8, 5, 1]);
        assert_eq!(counts(Mips::To(32)), [5, 3, 1, 1]);
        let sprites = Role::Sprites.spec();
        assert_eq!(
            sprites.sides.map(|side| sprites.mips.count(side, side)),
            [3, 7]
        );
    }
}
