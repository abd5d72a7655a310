//! Which published system makes the clouds, and which the clear sky.

/// Which published system makes the clouds.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "lowercase"))]
pub enum Method {
    /// One packed texture: T. Roden, I. Parberry, ACE 2005. See [`crate::clouds::shared`].
    #[default]
    Packed,
    /// Octaves of white noise that form anew: S. Guthikonda et al., USC. See [`crate::clouds::octaves`].
    Octaves,
    /// Octaves of smooth noise that drift, lit by a short ray march: I. Quilez, 2005. See [`crate::clouds::fbm`].
    Fbm,
    /// Layers with normals, lit by sun and moon: K. Mukhina, A. Bezgodov, 2015. See [`crate::clouds::lit`].
    Lit,
    /// Clouds in space, made of sprites: N. Wang, 2004. See [`crate::sprites`].
    Sprites,
}

impl Method {
    /// Every method, in the order of their numbers.
    pub const ALL: [Method; 5] = [
        Method::Packed,
        Method::Octaves,
        Method::Fbm,
        Method::Lit,
        Method::Sprites,
    ];

    /// The methods whose clouds are on a dome about the viewer, in the order of their numbers.
    pub const DOMES: [Method; 4] = [Method::Packed, Method::Octaves, Method::Fbm, Method::Lit];

    /// The name on command lines and in settings.
    pub const fn name(self) -> &'static str {
        match self {
            Method::Packed => "packed",
            Method::Octaves => "octaves",
            Method::Fbm => "fbm",
            Method::Lit => "lit",
            Method::Sprites => "sprites",
        }
    }

    /// What it is, in a few words.
    pub const fn title(self) -> &'static str {
        match self {
            Method::Packed => "Roden and Parberry: one packed cloud texture",
            Method::Octaves => "USC: octaves of white noise that form anew, on three domes",
            Method::Fbm => {
                "Quilez: octaves of smooth noise that drift, lit by a short march towards the sun"
            }
            Method::Lit => "Mukhina and Bezgodov: layers of three kinds, lit by sun and moon",
            Method::Sprites => "Wang: clouds in space, made of sprites",
        }
    }

    /// Where it was published.
    pub const fn paper(self) -> &'static str {
        match self {
            Method::Packed => "T. Roden, I. Parberry, “Clouds and Stars”, 2005",
            Method::Octaves => "S. Guthikonda and others, “Realistic Real-Time Skies”, USC",
            Method::Fbm => "I. Quilez, “Dynamic Clouds”, 2005",
            Method::Lit => {
                "K. Mukhina, A. Bezgodov, “The Method for Real-time Cloud Rendering”, 2015"
            }
            Method::Sprites => "N. Wang, “Let There Be Clouds!”, 2004",
        }
    }
}

/// How the clear sky is computed.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "lowercase"))]
pub enum SkyModel {
    /// The pack's day gradient, with light scattered around the sun. See [`crate::clear_sky::gradient`].
    #[default]
    Gradient,
    /// The distribution of Perez and others, in colour, as bright as the gradient. See [`crate::clear_sky::perez`].
    Perez,
}

impl SkyModel {
    /// Every model, in the order of their numbers.
    pub const ALL: [SkyModel; 2] = [SkyModel::Gradient, SkyModel::Perez];

    /// The name on command lines and in settings.
    pub const fn name(self) -> &'static str {
        match self {
            SkyModel::Gradient => "gradient",
            SkyModel::Perez => "perez",
        }
    }

    /// What it is, in a few words.
    pub const fn title(self) -> &'static str {
        match self {
            SkyModel::Gradient => "The pack's day gradient, with light scattered around the sun",
            SkyModel::Perez => {
                "Perez's distribution of light around sun and zenith, in Preetham's colours"
            }
        }
    }
}
