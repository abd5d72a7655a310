//! The roles of the textures in a pack and what each of their channels means.

mod spec;
mod specs;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::error::PackError;
use crate::layer_kind::LayerKind;
use crate::texture::Texture;

pub use spec::{ChannelSpec, Filter, Mips, RoleSpec, Wrap};

/// What the layers of [`Role::Catalogue`] are called.
const CATALOGUE_LAYERS: [&str; 3] = ["place", "light", "flicker"];

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
    /// Stars of a catalogue, each where it stands.
    Catalogue,
}

impl Role {
    /// Every role, in the order in which a manifest lists them.
    pub const ALL: [Role; 12] = [
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
        Role::Catalogue,
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
            Role::Catalogue => "catalogue",
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
            Role::Catalogue => &specs::CATALOGUE,
        }
    }

    /// Whether a pack may do without it.
    pub const fn is_optional(self) -> bool {
        matches!(self, Role::Skybox | Role::Catalogue)
    }

    /// What image `layer` (from 0) of a level is called: a kind of cloud, or what its shape calls it.
    pub fn layer_name(self, layer: u32) -> Option<String> {
        match self {
            Role::Layers => Some(LayerKind::ALL.get(layer as usize)?.name().to_string()),
            Role::Catalogue => Some(CATALOGUE_LAYERS.get(layer as usize)?.to_string()),
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
