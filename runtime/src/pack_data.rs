//! What the CPU keeps of a pack between frames.

#[cfg(feature = "sprites")]
use welkin_pack::field::Hour;
use welkin_pack::{Image, Pack, Role, StarTexel, Texture};

#[cfg(feature = "fbm")]
use crate::clouds::fbm::map::Octaves;
#[cfg(feature = "octaves")]
use crate::clouds::octaves;
use crate::error::{SkyError, texture};
#[cfg(feature = "octaves")]
use crate::geometry::math::finite;
#[cfg(feature = "octaves")]
use crate::params::SkyParams;
#[cfg(feature = "sprites")]
use crate::sprites;

/// What the CPU keeps of a pack between frames.
#[derive(Clone, Debug, PartialEq)]
pub struct PackData {
    /// Elevation of the sun at noon, in radians.
    pub noon_elevation_rad: f32,
    /// The day gradient.
    pub sky: Image,
    /// Texels a side of the clouds.
    pub clouds_texels: u32,
    /// Means of photo, noise and detail.
    pub cloud_means: [f32; 3],
    /// Texels a side of the stars.
    pub stars: u32,
    /// What a step of each of their levels stands for: [`StarTexel::level_units`].
    pub star_units: Vec<f32>,
    /// Texels a side and levels of the sun.
    pub sun: (u32, usize),
    /// Texels a side of the atlas of flares.
    pub flares: u32,
    /// Texels a side of a face and levels of the skybox, if there is one.
    pub skybox: Option<(u32, usize)>,
    /// Seed of the pack.
    #[cfg(feature = "octaves")]
    pub seed: u64,
    /// Texels of the white noise, 32x32 of four bytes.
    #[cfg(feature = "octaves")]
    pub noise: Vec<u8>,
    /// The octaves of smooth noise.
    #[cfg(feature = "fbm")]
    pub fbm: Octaves,
    /// Light on the sprites' clouds over the day; empty without a field.
    #[cfg(feature = "sprites")]
    pub hours: Vec<Hour>,
    /// The lowest base and the highest top of the sprites' clouds, in metres; 0 without a field.
    #[cfg(feature = "sprites")]
    pub cloud_heights_m: [f32; 2],
}

impl PackData {
    /// Reads them from a pack.
    ///
    /// # Errors
    /// [`SkyError::MissingTexture`] if the pack lacks a texture.
    pub fn new(pack: &Pack) -> Result<PackData, SkyError> {
        let side = |t: &Texture| (t.width, t.levels.len());
        Ok(PackData {
            noon_elevation_rad: pack.manifest().noon_elevation_rad,
            sky: texture(pack, Role::Sky)?.image(0, 0),
            clouds_texels: texture(pack, Role::Clouds)?.width,
            cloud_means: cloud_means(pack)?,
            stars: texture(pack, Role::Stars)?.width,
            star_units: StarTexel::level_units(texture(pack, Role::Stars)?),
            sun: side(texture(pack, Role::Sun)?),
            flares: texture(pack, Role::Flares)?.width,
            skybox: pack.texture(Role::Skybox).map(side),
            #[cfg(feature = "octaves")]
            seed: pack.manifest().seed,
            #[cfg(feature = "octaves")]
            noise: texture(pack, Role::Octaves)?.levels.concat(),
            #[cfg(feature = "fbm")]
            fbm: Octaves::new(texture(pack, Role::Fbm)?),
            #[cfg(feature = "sprites")]
            hours: pack.field().map_or(Vec::new(), |field| field.hours.clone()),
            #[cfg(feature = "sprites")]
            cloud_heights_m: pack.field().map_or([0.0; 2], sprites::heights_m),
        })
    }

    /// The states of the octaves method's noise at a moment: see [`octaves::map::states`].
    #[cfg(feature = "octaves")]
    pub fn octave_states(&self, params: &SkyParams, seconds: f64) -> Vec<f32> {
        let seconds = finite(seconds);
        octaves::map::states(&self.noise, self.seed, &params.clamped(), seconds)
    }
}

/// Means of the first three channels of the clouds, as the manifest gives them.
fn cloud_means(pack: &Pack) -> Result<[f32; 3], SkyError> {
    let role = Role::Clouds;
    let entry = pack
        .manifest()
        .texture(role)
        .ok_or(SkyError::MissingTexture { role })?;
    let mean = |channel: usize| entry.channels.get(channel).map_or(0.0, |c| c.mean);
    Ok([mean(0), mean(1), mean(2)])
}
