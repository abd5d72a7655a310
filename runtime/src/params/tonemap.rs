//! How radiance becomes colour on a display.

/// How radiance becomes colour on a display. See [`crate::tonemap`].
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "kebab-case"))]
pub enum Tonemap {
    /// Khronos PBR Neutral: hues stay, what is bright goes over to white. Khronos Group, 2024. See [`crate::tonemap::neutral`].
    Neutral,
    /// AgX: a wide range with a soft shoulder, colours fade as they grow bright. T. Sobotka, 2022. See [`crate::tonemap::agx`].
    Agx,
    /// AgX with its look "Punchy": more contrast and colour, about as a camera shows it. B. Wrensch, 2023. See [`crate::tonemap::agx`].
    #[default]
    AgxPunchy,
    /// A filmic curve without a toe, for each channel by itself. J. Hable, 2010. See [`crate::tonemap::filmic`].
    Filmic,
    /// Radiance as it is, cut off at 1.
    None,
}

impl Tonemap {
    /// Every one, in the order of their numbers.
    pub const ALL: [Tonemap; 5] = [
        Tonemap::Neutral,
        Tonemap::Agx,
        Tonemap::AgxPunchy,
        Tonemap::Filmic,
        Tonemap::None,
    ];

    /// The name on command lines and in settings.
    pub const fn name(self) -> &'static str {
        match self {
            Tonemap::Neutral => "neutral",
            Tonemap::Agx => "agx",
            Tonemap::AgxPunchy => "agx-punchy",
            Tonemap::Filmic => "filmic",
            Tonemap::None => "none",
        }
    }

    /// What it is, in a few words.
    pub const fn title(self) -> &'static str {
        match self {
            Tonemap::Neutral => "Khronos PBR Neutral: hues stay, highlights go to white",
            Tonemap::AgxPunchy => "AgX with more contrast and colour, about as a camera shows it",
            Tonemap::Agx => "AgX: a soft shoulder, colours fade as they grow bright",
            Tonemap::Filmic => "Hable's filmic curve without a toe, each channel by itself",
            Tonemap::None => "Radiance as it is, cut off at 1",
        }
    }
}
