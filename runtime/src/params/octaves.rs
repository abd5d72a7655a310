//! What [`crate::Method::Octaves`] alone knows.

/// Octaves of the paper.
pub const DEFAULT_OCTAVES: u32 = 4;

/// The most octaves of [`OctaveParams::count`].
pub const MAX_OCTAVES: u32 = 8;

/// The least and the largest [`OctaveParams::formation_interval_s`]: a day.
pub const FORMATION_INTERVAL_S: [f32; 2] = [0.1, 86_400.0];

/// What [`crate::Method::Octaves`] alone knows.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(default))]
pub struct OctaveParams {
    /// Octaves that are summed, 1..=8. The paper has four.
    pub count: u32,
    /// How abruptly clouds end, 0 (fuzzy) to 1 (cut out): the paper's `cloudSharpness`.
    pub sharpness: f32,
    /// Seconds from one state of an octave to the next, 0.1..=86400: the paper's `cloudFormationInterval`.
    pub formation_interval_s: f32,
    /// Cover of the low, middle and high dome, as a share of [`crate::SkyParams::cover`], 0..1. 0 leaves a dome out.
    pub domes: [f32; 3],
}

impl Default for OctaveParams {
    fn default() -> OctaveParams {
        OctaveParams {
            count: DEFAULT_OCTAVES,
            sharpness: 0.016,
            formation_interval_s: 60.0,
            domes: [0.8, 0.6, 0.7],
        }
    }
}
