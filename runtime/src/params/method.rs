//! Which published system makes the clouds, and which the clear sky.

/// Which published system makes the clouds.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "lowercase"))]
pub enum Method {
    /// One packed texture: T. Roden, I. Parberry, ACE 2005. See [`crate::clouds::packed`].
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

    /// Every method, in the order of their numbers.
    pub const ALL: [Method; Method::DOMES.len() + cfg!(feature = "sprites") as usize] = {
        let mut all = [Method::Packed; Method::DOMES.len() + cfg!(feature = "sprites") as usize];
        let mut i = 0;
        while i < Method::DOMES.len() {
            all[i] = Method::DOMES[i];
            i += 1;
        }
        #[cfg(feature = "sprites")]
        {
            all[i] = Method::Sprites;
        }
        all
    };

    /// The name on command lines and in settings.
    pub const fn name(self) -> &'static str {
        self.words()[0]
    }

    /// What it is, in a few words.
    pub const fn title(self) -> &'static str {
        self.words()[1]
    }

    /// Where it was published.
    pub const fn paper(self) -> &'static str {
        self.words()[2]
    }

    /// Name, title, paper.
    const fn words(self) -> [&'static str; 3] {
        match self {
            Method::Packed => [
                "packed",
                "Roden and Parberry: one packed cloud texture",
                "T. Roden, I. Parberry, “Clouds and Stars”, 2005",
            ],
            #[cfg(feature = "octaves")]
            Method::Octaves => [
                "octaves",
                "USC: octaves of white noise that form anew, on three domes",
                "S. Guthikonda and others, “Realistic Real-Time Skies”, USC",
            ],
            #[cfg(feature = "fbm")]
            Method::Fbm => [
                "fbm",
                "Quilez: octaves of smooth noise that drift, lit by a short march towards the sun",
                "I. Quilez, “Dynamic Clouds”, 2005",
            ],
            #[cfg(feature = "lit")]
            Method::Lit => [
                "lit",
                "Mukhina and Bezgodov: layers of three kinds, lit by sun and moon",
                "K. Mukhina, A. Bezgodov, “The Method for Real-time Cloud Rendering”, 2015",
            ],
            #[cfg(feature = "sprites")]
            Method::Sprites => [
                "sprites",
                "Wang: clouds in space, made of sprites",
                "N. Wang, “Let There Be Clouds!”, 2004",
            ],
        }
    }
}

/// How clouds are shaded.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "lowercase"))]
pub enum Shading {
    /// By the light that comes through them from sun or moon, from where it stands.
    #[default]
    Scattered,
    /// As the method's paper has it, the same wherever the sun stands.
    Paper,
}

impl Shading {
    /// Every one, in the order of their numbers.
    pub const ALL: [Shading; 2] = [Shading::Scattered, Shading::Paper];

    /// The name on command lines and in settings.
    pub const fn name(self) -> &'static str {
        match self {
            Shading::Scattered => "scattered",
            Shading::Paper => "paper",
        }
    }

    /// What it is, in a few words.
    pub const fn title(self) -> &'static str {
        match self {
            Shading::Scattered => {
                "By the light of sun or moon through the clouds, from where it stands"
            }
            Shading::Paper => "As the method's paper has it",
        }
    }
}

/// How the clear sky is computed.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "lowercase"))]
pub enum SkyModel {
    /// The pack's table of the clear sky. See [`crate::clear_sky::table`].
    #[default]
    Table,
    /// The distribution of Perez and others, in colour, as bright as the table. See [`crate::clear_sky::perez`].
    #[cfg(feature = "perez")]
    Perez,
}

impl SkyModel {
    /// Every model, in the order of their numbers.
    pub const ALL: [SkyModel; 1 + cfg!(feature = "perez") as usize] = [
        SkyModel::Table,
        #[cfg(feature = "perez")]
        SkyModel::Perez,
    ];

    /// The name on command lines and in settings.
    pub const fn name(self) -> &'static str {
        match self {
            SkyModel::Table => "table",
            #[cfg(feature = "perez")]
            SkyModel::Perez => "perez",
        }
    }

    /// What it is, in a few words.
    pub const fn title(self) -> &'static str {
        match self {
            SkyModel::Table => "The pack's table: air, aerosol and ozone at any hour",
            #[cfg(feature = "perez")]
            SkyModel::Perez => {
                "Perez's distribution of light around sun and zenith, in Preetham's colours"
            }
        }
    }
}
