//! What the CPU keeps of a pack between frames.

use glam::Vec2;
#[cfg(feature = "sprites")]
use welkin_pack::field::Hour;
use welkin_pack::mapping::{direction_from_angles, direction_to_galaxy_uv};
use welkin_pack::{Pack, Role, StarTexel, Texture};

use crate::clear_sky::catalogue::Catalogue;
use crate::clear_sky::light::LitSky;
use crate::clear_sky::moment::{Lighting, Moment};
use crate::clear_sky::table::SkyTable;
#[cfg(feature = "fbm")]
use crate::clouds::fbm::map::Octaves;
#[cfg(feature = "lit")]
use crate::clouds::lit;
#[cfg(feature = "octaves")]
use crate::clouds::octaves;
#[cfg(any(feature = "fbm", feature = "lit", feature = "octaves"))]
use crate::clouds::photo::Photo;
use crate::error::{SkyError, texture};
use crate::geometry::math::finite;
use crate::params::SkyParams;
#[cfg(feature = "sprites")]
use crate::sprites;

/// What the CPU keeps of a pack between frames.
#[derive(Clone, Debug, PartialEq)]
pub struct PackData {
    /// Elevation of the sun at noon, in radians.
    pub noon_elevation_rad: f32,
    /// The table of the clear sky.
    pub sky: SkyTable,
    /// Texels a side of the clouds.
    pub clouds_texels: u32,
    /// Means of photo, noise and detail.
    pub cloud_means: [f32; 3],
    /// Photo, noise and detail at places of the clouds that have nothing to do with each other.
    pub cloud_texels: Vec<[f32; 3]>,
    /// The photo's large shapes.
    #[cfg(any(feature = "fbm", feature = "lit", feature = "octaves"))]
    pub photo: Photo,
    /// See [`lit::map::spreads`].
    #[cfg(feature = "lit")]
    pub cirrus_spreads: Vec2,
    /// Texels a side of the stars.
    pub stars: u32,
    /// What a step of each of their levels stands for: [`StarTexel::level_units`].
    pub star_units: Vec<f32>,
    /// The stars of a catalogue, if there is one.
    pub catalogue: Option<Catalogue>,
    /// The line along which the galaxy's band crosses the rim of its dome: east and south, a unit vector.
    pub galaxy_node: Vec2,
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
            sky: SkyTable::new(texture(pack, Role::Sky)?, pack.manifest().aerosol_depths),
            clouds_texels: texture(pack, Role::Clouds)?.width,
            cloud_means: cloud_means(pack)?,
            cloud_texels: cloud_texels(texture(pack, Role::Clouds)?),
            #[cfg(any(feature = "fbm", feature = "lit", feature = "octaves"))]
            photo: Photo::new(texture(pack, Role::Clouds)?),
            #[cfg(feature = "lit")]
            cirrus_spreads: lit::map::spreads(texture(pack, Role::Layers)?),
            stars: texture(pack, Role::Stars)?.width,
            star_units: StarTexel::level_units(texture(pack, Role::Stars)?),
            catalogue: pack.texture(Role::Catalogue).map(Catalogue::new),
            galaxy_node: galaxy_node(texture(pack, Role::Galaxy)?),
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

    /// Where sun and moon stand: a date goes on with the seconds. `params` are in range.
    pub fn moment(&self, params: &SkyParams, seconds: f64) -> Moment {
        let noon_rad = self.noon_elevation_rad;
        match params.date {
            None => Moment::of_time(params.time, noon_rad),
            Some(date) => Moment::of_date(date.after(finite(seconds)), params.place, noon_rad),
        }
    }

    /// The light of a moment and its clear sky. `params` are in range.
    pub fn lit_sky(&self, params: &SkyParams, seconds: f64) -> LitSky {
        self.lit_sky_at(&(self.moment(params, seconds), [params.haze, params.moon]))
    }

    /// The same of a moment that is known.
    pub fn lit_sky_at(&self, (moment, [haze, moon]): &Lighting) -> LitSky {
        LitSky::new(&self.sky, moment, *haze, *moon)
    }

    /// The states of the octaves method's noise at a moment: see [`octaves::map::states`].
    #[cfg(feature = "octaves")]
    pub fn octave_states(&self, params: &SkyParams, seconds: f64) -> Vec<f32> {
        let seconds = finite(seconds);
        octaves::map::states(&self.noise, self.seed, &params.clamped(), seconds)
    }
}

/// The axis through the light at the rim: the mean of its azimuths, twice each so that opposite ones are one.
fn galaxy_node(galaxy: &Texture) -> Vec2 {
    const STEPS: u32 = 360;
    let image = galaxy.image(0, 0);
    let sum: Vec2 = (0..STEPS)
        .map(|step| {
            let azimuth = std::f32::consts::TAU * step as f32 / STEPS as f32;
            let uv = direction_to_galaxy_uv(direction_from_angles(azimuth, 0.0));
            let [x, y] = [(uv[0], image.width), (uv[1], image.height)]
                .map(|(c, side)| ((c * side as f32) as u32).min(side - 1));
            let stored = image.texel(x, y)[0];
            let towards = Vec2::from_angle(azimuth);
            towards.rotate(towards) * (stored * stored)
        })
        .sum();
    let azimuth = 0.5 * sum.to_angle();
    Vec2::new(libm::sinf(azimuth), -libm::cosf(azimuth))
}

/// Photo, noise and detail at 512 places each, a golden ratio of the texture apart, each from another start.
fn cloud_texels(clouds: &Texture) -> Vec<[f32; 3]> {
    const COUNT: u64 = 512;
    let image = clouds.image(0, 0);
    let texels = u64::from(image.width) * u64::from(image.height);
    // Odd, so that no power of two shares a factor with it.
    let step = (texels as f64 * 0.618_033_988_75) as u64 | 1;
    let at = |i: u64, channel: usize| {
        let texel = (i * (channel as u64 + 1) * step + channel as u64 * texels / 3) % texels;
        let (x, y) = (
            texel % u64::from(image.width),
            texel / u64::from(image.width),
        );
        image.texel(x as u32, y as u32)[channel]
    };
    (0..COUNT)
        .map(|i| [0, 1, 2].map(|channel| at(i, channel)))
        .collect()
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
