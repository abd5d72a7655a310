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
    #[cfg(feature = "octaves")]
    Octaves,
    /// Octaves of smooth noise that drift, lit by a short ray march: I. Quilez, 2005. See [`crate::clouds::fbm`].
    #[cfg(feature = "fbm")]
    Fbm,
    /// Layers with normals, lit by sun and moon: K. Mukhina, A. Bezgodov, 2015. See [`crate::clouds::lit`].
    #[cfg(feature = "lit")]
    Lit,
    /// Clouds in space, made of sprites: N. Wang, 2004. See [`crate::sprites`].
    #[cfg(feature = "sprites")]
    Sprites,
}

impl Method {
    /// Every method, in the order of their numbers.
    pub const ALL: [Method; Method::DOMES.len() + cfg!(feature = "sprites") as usize] = [
        Method::Packed,
        #[cfg(feature = "octaves")]
        Method::Octaves,
        #[cfg(feature = "fbm")]
        Method::Fbm,
        #[cfg(feature = "lit")]
        Method::Lit,
        #[cfg(feature = "sprites")]
        Method::Sprites,
    ];

    /// The methods whose clouds are on a dome about the viewer, in the order of their numbers.
    pub const DOMES: [Method;
        1 + cfg!(feature = "octaves") as usize
            + cfg!(feature = "fbm") as usize
            + cfg!(feature = "lit") as usize] = [
        Method::Packed,
        #[cfg(feature = "octaves")]
        Method::Octaves,
        #[cfg(feature = "fbm")]
        Method::Fbm,
        #[cfg(feature = "lit")]
        Method::Lit,
    ];

    /// The name on command lines and in settings.
    pub const fn name(self) -> &'static str {
        match self {
            Method::Packed => "packed",
            #[cfg(feature = "octaves")]
            Method::Octaves => "octaves",
            #[cfg(feature = "fbm")]
            Method::Fbm => "fbm",
            #[cfg(feature = "lit")]
            Method::Lit => "lit",
            #[cfg(feature = "sprites")]
            Method::Sprites => "sprites",
        }
    }

    /// What it is, in a few words.
    pub const fn title(self) -> &'static str {
        match self {
            Method::Packed => "Roden and Parberry: one packed cloud texture",
            #[cfg(feature = "octaves")]
            Method::Octaves => "USC: octaves of white noise that form anew, on three domes",
            #[cfg(feature = "fbm")]
            Method::Fbm => {
                "Quilez: octaves of smooth noise that drift, lit by a short march towards the sun"
            }
            #[cfg(feature = "lit")]
            Method::Lit => "Mukhina and Bezgodov: layers of three kinds, lit by sun and moon",
            #[cfg(feature = "sprites")]
            Method::Sprites => "Wang: clouds in space, made of sprites",
        }
    }

    /// Where it was published.
    pub const fn paper(self) -> &'static str {
        match self {
            Method::Packed => "T. Roden, I. Parberry, “Clouds and Stars”, 2005",
            #[cfg(feature = "octaves")]
            Method::Octaves => "S. Guthikonda and others, “Realistic Real-Time Skies”, USC",
            #[cfg(feature = "fbm")]
            Method::Fbm => "I. Quilez, “Dynamic Clouds”, 2005",
            #[cfg(feature = "lit")]
            Method::Lit => {
                "K. Mukhina, A. Bezgodov, “The Method for Real-time Cloud Rendering”, 2015"
            }
            #[cfg(feature = "sprites")]
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
    #[cfg(feature = "perez")]
    Perez,
}

impl SkyModel {
    /// Every model, in the order of their numbers.
    pub const ALL: [SkyModel; 1 + cfg!(feature = "perez") as usize] = [
        SkyModel::Gradient,
        #[cfg(feature = "perez")]
        SkyModel::Perez,
    ];

    /// The name on command lines and in settings.
    pub const fn name(self) -> &'static str {
        match self {
            SkyModel::Gradient => "gradient",
            #[cfg(feature = "perez")]
            SkyModel::Perez => "perez",
        }
    }

    /// What it is, in a few words.
    pub const fn title(self) -> &'static str {
        match self {
            SkyModel::Gradient => "The pack's day gradient, with light scattered around the sun",
            #[cfg(feature = "perez")]
            SkyModel::Perez => {
                "Perez's distribution of light around sun and zenith, in Preetham's colours"
            }
        }
    }
}
