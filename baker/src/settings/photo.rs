//! What is made of a photograph.

/// A cloud channel made from a photograph.
#[derive(Clone, Debug, PartialEq)]
pub struct PhotoSettings {
    /// File of a photograph; the built-in one if absent.
    pub file: Option<String>,
    /// File of a mask, white where there is cloud, as large as the photograph.
    pub mask: Option<String>,
    /// Texels a side, a power of two.
    pub size: u32,
    /// Mean that the channel is calibrated to; absent only of a tile that is taken as it is.
    pub mean: Option<f32>,
    /// Whether the file is a finished tile, of which only the size is changed.
    pub as_is: bool,
    /// Whether what is clear is cloud.
    pub invert: bool,
    /// Values of the picture, 0..1, that become black and white.
    pub levels: [f32; 2],
    /// How much of uneven light is taken away, 0..1.
    pub flatten: f32,
    /// What the width of the last blur is divided by.
    pub sharpness: f32,
    /// The part that is used.
    pub region: PhotoRegion,
    /// How the picture sees the layer of clouds.
    pub projection: PhotoProjection,
    /// How the tile is closed.
    pub seam: PhotoSeam,
}

/// How opposite sides of a tile are made to meet.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PhotoSeam {
    /// By a blend that keeps the variance, and a wide blur: large soft shapes.
    Blend,
    /// By a cut where they differ least, blended by its gradients: fine structure is kept.
    Cut,
}

/// How a picture sees the flat layer that the tile is a plan of. A horizon is its row as a share of the height from above.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum PhotoProjection {
    /// As the tile is: every texel of the picture is as much of the layer.
    Plan,
    /// By a camera without roll.
    Perspective {
        /// Angle across the longer side, in radians.
        fov_rad: f32,
        /// The horizon; found if absent.
        horizon: Option<f32>,
    },
    /// By a panorama of all azimuths, equirectangular.
    Equirect {
        /// The horizon; in the middle of a picture twice as wide as high, and at the lower edge of one four times as wide.
        horizon: Option<f32>,
    },
}

/// A part of a photograph; of one that is not square its middle is used.
#[derive(Clone, Debug, PartialEq)]
pub enum PhotoRegion {
    /// All of it.
    Middle,
    /// Left, top, width and height in texels of the upright picture.
    Part([u32; 4]),
}

impl PhotoSettings {
    /// The mean of the default recipe.
    pub const MEAN: f32 = 0.37;
}

impl Default for PhotoSettings {
    /// The settings of the default recipe.
    fn default() -> PhotoSettings {
        PhotoSettings {
            file: None,
            mask: None,
            size: 512,
            mean: Some(PhotoSettings::MEAN),
            as_is: false,
            invert: false,
            levels: [0.0, 1.0],
            flatten: 1.0,
            sharpness: 1.0,
            region: PhotoRegion::Middle,
            projection: PhotoProjection::Plan,
            seam: PhotoSeam::Blend,
        }
    }
}
