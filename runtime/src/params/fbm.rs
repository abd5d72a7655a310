//! What [`crate::Method::Fbm`] alone knows.

/// What [`crate::Method::Fbm`] alone knows. Colours are reflectances, linear BT.709, 0..1.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(default))]
pub struct FbmParams {
    /// How sharply clouds end, 0 to 1: the nearer the article's b is to its a.
    pub sharpness: f32,
    /// Colour where the light comes through least cloud.
    pub lit: [f32; 3],
    /// Colour where it comes through most.
    pub shaded: [f32; 3],
}

impl FbmParams {
    /// White clouds with grey undersides.
    pub const FAIR: FbmParams = FbmParams {
        sharpness: 0.45,
        lit: [1.0, 1.0, 1.0],
        shaded: [0.42, 0.46, 0.53],
    };

    /// Two dark greys.
    pub const STORMY: FbmParams = FbmParams {
        sharpness: 0.25,
        lit: [0.40, 0.42, 0.46],
        shaded: [0.08, 0.085, 0.10],
    };
}

/// Colours that go together, with their names and what they are like.
pub const PALETTES: [(&str, &str, FbmParams); 2] = [
    ("fair", "White clouds with grey undersides", FbmParams::FAIR),
    ("stormy", "Two dark greys", FbmParams::STORMY),
];

impl FbmParams {
    /// Which of [`PALETTES`] has these colours, the first one where they are of none.
    pub fn palette(&self) -> usize {
        let same = |(.., palette): &(&str, &str, FbmParams)| {
            palette.lit == self.lit && palette.shaded == self.shaded
        };
        PALETTES.iter().position(same).unwrap_or(0)
    }
}

impl Default for FbmParams {
    /// [`FbmParams::FAIR`].
    fn default() -> FbmParams {
        FbmParams::FAIR
    }
}
