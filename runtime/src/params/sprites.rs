//! What [`crate::Method::Sprites`] alone knows.

use super::method::Method;

/// What [`crate::Method::Sprites`] alone knows. See [`crate::sprites`].
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(default))]
pub struct SpriteParams {
    /// The method whose dome is behind the sprites; [`Method::Sprites`] is a clear one with [`crate::SkyParams::upper_layer`] alone.
    pub behind: Method,
    /// Cover of that dome, 0..1.
    pub behind_cover: f32,
    /// How far clouds are seen, in metres, 8000..=60000.
    pub distance_m: f32,
    /// Radius of the ring of impostors: blocks beyond it are drawn as pictures. In metres, 0 (no ring) or 4000..=60000.
    pub ring_radius_m: f32,
    /// Distance beyond which a cloud is one billboard, in metres, 2000..=60000. By default it is so where a cloud of a kilometre has hardly more
    /// than a dozen texels in a picture of the ring.
    pub billboards_beyond_m: f32,
    /// Whether light on clouds is that of the field's hours, as the article has it, not that of the sky.
    pub hours: bool,
    /// The most that a cloud may have formed, 0 (nothing) to 1 (whole).
    pub formation: f32,
}

impl Default for SpriteParams {
    fn default() -> SpriteParams {
        SpriteParams {
            #[cfg(feature = "sprites")]
            behind: Method::Sprites,
            #[cfg(not(feature = "sprites"))]
            behind: Method::Packed,
            behind_cover: 0.0,
            distance_m: 30_000.0,
            ring_radius_m: 12_000.0,
            billboards_beyond_m: 24_000.0,
            hours: false,
            formation: 1.0,
        }
    }
}

/// The least [`SpriteParams::ring_radius_m`] that is a ring, in metres: the side of a block.
pub const LEAST_RING_M: f32 = welkin_pack::field::SECTION_SIDE_M;

/// The most of every distance, in metres.
pub const MOST_DISTANCE_M: f32 = 60_000.0;
