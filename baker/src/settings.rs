//! What a bake needs to know, as plain data: the recipe after `resolve.rs` has checked it.

mod field;
mod photo;

use welkin_pack::Format;
use welkin_pack::manifest::FractalNoise;

pub use field::{
    BoxSettings, CloudLayerSettings, FieldBound, FieldSettings, ModelSettings, ModelSource,
    PlacedSprite,
};

pub use photo::{PhotoProjection, PhotoRegion, PhotoSeam, PhotoSettings};

/// Everything a bake needs to know, checked.
#[derive(Clone, Debug, PartialEq)]
pub struct Resolved {
    /// Name of the pack.
    pub name: String,
    /// Seed of every random stream.
    pub seed: u64,
    /// Text of the recipe, for the manifest.
    pub recipe: String,
    /// The packed cloud texture.
    pub clouds: CloudSettings,
    /// The star data.
    pub stars: StarSettings,
    /// The galaxy.
    pub galaxy: GalaxySettings,
    /// The clear sky.
    pub sky: SkySettings,
    /// The sun.
    pub sun: SunSettings,
    /// Octaves of smooth noise.
    pub fbm: FbmSettings,
    /// The lens flare.
    pub flares: FlareSettings,
    /// Layers of clouds.
    pub layers: LayersSettings,
    /// The sheet of cloud sprites.
    pub sprites: SpritesSettings,
    /// The skybox, if the recipe names a picture.
    pub skybox: Option<SkyboxSettings>,
    /// The clouds in space, unless the recipe leaves them out.
    pub field: Option<FieldSettings>,
}

/// The packed cloud texture.
#[derive(Clone, Debug, PartialEq)]
pub struct CloudSettings {
    /// Texels a side, a power of two.
    pub size: u32,
    /// How it is stored: 8-bit unorm or half floats.
    pub format: Format,
    /// Red channel.
    pub photo: PhotoSettings,
    /// Green channel.
    pub noise: FractalNoise,
    /// Blue channel.
    pub detail: FractalNoise,
    /// Alpha channel.
    pub gradient: GradientSettings,
}

/// The sunset gradient.
#[derive(Clone, Debug, PartialEq)]
pub struct GradientSettings {
    /// Exponent of the curve: 1 is straight, more gathers the tint on the sun's side.
    pub power: f32,
}

/// The star data.
#[derive(Clone, Debug, PartialEq)]
pub struct StarSettings {
    /// Texels a side, a power of two.
    pub size: u32,
    /// Stars in the texture.
    pub count: u32,
    /// Magnitudes from the brightest star to the faintest.
    pub magnitudes: f32,
    /// Mean intensity of the brightest star.
    pub brightest: f32,
    /// The catalogue whose stars are drawn in their place, if there is one.
    pub catalogue: Option<CatalogueSource>,
}

/// Where a catalogue of stars comes from.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum CatalogueSource {
    /// The one of the baker: 5,044 stars to magnitude 6.
    BuiltIn,
    /// A file of one of the layouts of [`crate::catalogue`].
    File(String),
}

/// The galaxy.
#[derive(Clone, Debug, PartialEq)]
pub struct GalaxySettings {
    /// Texels a side, a power of two.
    pub size: u32,
    /// Inclination of the galaxy's plane to the horizon, in radians.
    pub tilt_rad: f32,
    /// Azimuth at which the plane rises, from north towards east, in radians.
    pub azimuth_rad: f32,
    /// Strength of the dust lane, 0..1.
    pub dust: f32,
}

/// The clear sky.
#[derive(Clone, Debug, PartialEq)]
pub struct SkySettings {
    /// Columns: azimuths from the sun.
    pub width: u32,
    /// Rows: elevations.
    pub height: u32,
    /// Elevations of the sun.
    pub suns: u32,
    /// Optical depths of the aerosol to the zenith at 550 nm: as it is without haze, and with all of it.
    pub aerosol_depths: [f32; 2],
}

/// The sun.
#[derive(Clone, Debug, PartialEq)]
pub struct SunSettings {
    /// Texels a side, a power of two.
    pub size: u32,
    /// Elevation of the sun at noon, in radians.
    pub noon_elevation_rad: f32,
}

/// Octaves of smooth noise.
#[derive(Clone, Debug, PartialEq)]
pub struct FbmSettings {
    /// Texels a side, a power of two.
    pub size: u32,
    /// Octaves, one a layer; each doubles the cells of the one before.
    pub octaves: u32,
    /// Lattice cells of the first octave across the tile, a power of two.
    pub cells: u32,
}

/// The lens flare.
#[derive(Clone, Debug, PartialEq)]
pub struct FlareSettings {
    /// Texels a side of the atlas, a power of two.
    pub size: u32,
}

/// Layers of clouds.
#[derive(Clone, Debug, PartialEq)]
pub struct LayersSettings {
    /// Texels a side, a power of two.
    pub size: u32,
    /// One a kind, in the order of [`welkin_pack::LayerKind::ALL`].
    pub kinds: [LayerSettings; 3],
}

/// One kind of cloud in a layer.
#[derive(Clone, Debug, PartialEq)]
pub struct LayerSettings {
    /// Clouds across the tile.
    pub cells: u32,
    /// Octaves of the noise that shapes them; each is twice as fine as the one before.
    pub octaves: u32,
    /// Amplitude of an octave as a share of the one before.
    pub gain: f32,
    /// Root mean square slope of the cloud's surface.
    pub relief: f32,
}

/// The sheet of cloud sprites.
#[derive(Clone, Debug, PartialEq)]
pub struct SpritesSettings {
    /// Texels a side of the sheet, a power of two.
    pub size: u32,
    /// Factor on the relief of the grey.
    pub contrast: f32,
    /// What it is made from.
    pub source: SpriteSource,
}

/// What the sheet of sprites is made from. Pictures have an alpha channel: PNG or OpenEXR files.
#[derive(Clone, Debug, PartialEq)]
pub enum SpriteSource {
    /// Clouds of noise.
    Noise(SpriteShape),
    /// A square picture of all cells.
    Sheet(String),
    /// A square picture a cell, in the order of [`welkin_pack::SheetCell`].
    Cells(Box<[String; 16]>),
}

/// How clouds of noise look.
#[derive(Clone, Debug, PartialEq)]
pub struct SpriteShape {
    /// Factor on what is fine: knobs and fibres.
    pub detail: f32,
    /// Factor on the width of a puff's edge.
    pub softness: f32,
}

/// The skybox.
#[derive(Clone, Debug, PartialEq)]
pub struct SkyboxSettings {
    /// What it is made from.
    pub picture: SkyboxPicture,
    /// Texels a side of a face, a power of two; as many as the picture has, if absent.
    pub size: Option<u32>,
    /// Factor on the radiance.
    pub gain: f32,
}

/// The files of a skybox: PNG, JPEG, Radiance HDR or OpenEXR.
#[derive(Clone, Debug, PartialEq)]
pub enum SkyboxPicture {
    /// An equirectangular picture, twice as wide as high.
    Panorama {
        /// The file.
        file: String,
        /// Azimuth of its middle, from north towards east, in radians.
        azimuth_rad: f32,
    },
    /// Square pictures in the order of [`welkin_pack::format::CUBE_FACES`], upright, as seen from the middle.
    /// The lower edge of `up` and the upper edge of `down` join north.
    Faces([String; 6]),
}
