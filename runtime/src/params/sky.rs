//! What the sky shall look like.

use crate::almanac::{Date, Place};

use super::fbm::FbmParams;
use super::lit::LitParams;
use super::method::{Method, Shading, SkyModel};
use super::octaves::OctaveParams;
use super::perez::PerezParams;
use super::sprites::SpriteParams;
use super::tonemap::Tonemap;
use super::weather::WeatherParams;

/// What the sky shall look like. The first six are the paper's, 0..1 each.
///
/// Values out of range are clamped when a frame is prepared, and what is not a number becomes the
/// default, so that a slider or a script can never make a frame of NaN. [`SkyParams::check`] tells instead.
///
/// T. Roden, I. Parberry, "Clouds and Stars: Efficient Real-Time Procedural Sky Rendering Using 3D
/// Hardware", ACE 2005, section 2.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(default))]
pub struct SkyParams {
    /// Amount of cloud: 0 clear, 1 overcast.
    pub cover: f32,
    /// Height of the clouds over the viewer: 0 low (large on the sky), 1 high (small).
    pub height: f32,
    /// Density of the clouds: 0 bumpy and bright, 1 smooth with dark cores.
    pub density: f32,
    /// Strength of the red gradient over the clouds on the sun's side.
    pub sunset: f32,
    /// Wind speed: 0 still, 1 fast.
    pub speed: f32,
    /// Time of day: 0 midnight, 0.25 sunrise, 0.5 noon, 0.75 sunset, 1 midnight again.
    pub time: f32,
    /// The moment of universal time at second 0, if the sky is that of a date and place: sun and moon then stand where they are, and
    /// [`SkyParams::time`] is not looked at. It goes on with the seconds of [`crate::Sky::prepare`].
    pub date: Option<Date>,
    /// The place for [`SkyParams::date`].
    pub place: Place,
    /// Amount of the thin upper layer of [`Method::Packed`], 0 (off) to 1.
    pub upper_layer: f32,
    /// Factor on the radiance before the tone curve, 0..=64: what an application's camera has adapted to. A float target gets radiance
    /// without it.
    pub exposure: f32,
    /// A person's correction of it in stops, -16..=16: the radiance is multiplied by [`SkyParams::exposure_factor`].
    pub exposure_ev: f32,
    /// Whether [`SkyParams::exposure`] is the one that a camera would choose, [`crate::SkyLight::exposure`], instead of a number.
    pub auto_exposure: bool,
    /// The tone curve.
    pub tonemap: Tonemap,
    /// Whether targets of few bits are dithered by half a step.
    pub dither: bool,
    /// How the clear sky is computed.
    pub sky: SkyModel,
    /// Of [`SkyModel::Perez`].
    pub perez: PerezParams,
    /// Which system makes the clouds.
    pub method: Method,
    /// How they are shaded. A change of it makes shaders anew.
    pub shading: Shading,
    /// How much of the large shapes of [`Method::Octaves`], [`Method::Fbm`] and [`Method::Lit`] is the photograph's, as the square root of its
    /// share of their variance, 0 (as published) to 1.
    pub photo: f32,
    /// Of [`Method::Octaves`].
    pub octaves: OctaveParams,
    /// Of [`Method::Fbm`].
    pub fbm: FbmParams,
    /// Of [`Method::Lit`].
    pub lit: LitParams,
    /// Of [`Method::Sprites`].
    pub sprites: SpriteParams,
    /// Rays, rain and lightning.
    pub weather: WeatherParams,
    /// Side of the square around the viewer whose cloud shadows [`crate::Sky::shadow`] gives, in metres, 0..=1000000; 0 for none.
    pub shadow_extent_m: f32,
    /// How hazy the air is: 0 as the pack's clear air, 1 as its hazy air.
    pub haze: f32,
    /// Strength of the moon's light, 0..=1. It is full and stands opposite the sun, but with [`SkyParams::date`].
    pub moon: f32,
    /// Share of red, green and blue light that the ground reflects, linear BT.709, 0..=1 each.
    pub ground: [f32; 3],
    /// Whether a sea takes the place of the ground below the horizon.
    pub sea: bool,
    /// How rough the sea is, 0 (calm, wind of 1 m/s) to 1 (15 m/s).
    pub waves: f32,
    /// Whether the discs of sun and moon are drawn.
    pub sun: bool,
    /// Whether stars and galaxy are drawn.
    pub stars: bool,
    /// Whether a star's light is spread over the solid angle of its pixels, as an environment map wants it: the sum of radiance over solid
    /// angle is then the same wherever the star is on a wide picture. Otherwise the sum over pixels is, so that stars look alike on a screen.
    pub even_stars: bool,
    /// Strength of the lens flare, 0 (off) to 1.
    pub flare: f32,
    /// Whether the flare's picture of the sun is a starburst instead of a disc.
    pub starburst: bool,
    /// How far the pack's skybox, if it has one, takes the place of the computed sky, 0 to 1.
    pub skybox: f32,
}

/// Grassland, as bright as the ground that the pack's sky was baked over: a tenth of the visible light.
const GROUND: [f32; 3] = [0.102, 0.103, 0.076];

/// The largest [`SkyParams::exposure`]: some four and a half stops over the default.
pub const MAX_EXPOSURE: f32 = 64.0;
/// Range of [`SkyParams::exposure_ev`]: half floats, which packs and targets hold radiance in, end just below `2^16`, and what they hold can be
/// brought to 1.
pub const EXPOSURE_EV: [f32; 2] = [-16.0, 16.0];

impl Default for SkyParams {
    /// A fair day at noon.
    fn default() -> SkyParams {
        SkyParams {
            cover: 0.6,
            height: 0.7,
            density: 0.2,
            sunset: 0.0,
            speed: 0.1,
            time: 0.5,
            date: None,
            place: Place::default(),
            upper_layer: 0.0,
            exposure: 2.6,
            exposure_ev: 0.0,
            auto_exposure: false,
            tonemap: Tonemap::default(),
            dither: true,
            sky: SkyModel::Table,
            perez: PerezParams::default(),
            method: Method::Packed,
            shading: Shading::Scattered,
            photo: 0.6,
            octaves: OctaveParams::default(),
            fbm: FbmParams::default(),
            lit: LitParams::default(),
            sprites: SpriteParams::default(),
            weather: WeatherParams::default(),
            shadow_extent_m: 0.0,
            haze: 0.0,
            moon: 1.0,
            ground: GROUND,
            sea: false,
            waves: 0.3,
            sun: true,
            stars: true,
            even_stars: false,
            flare: 0.0,
            starburst: false,
            skybox: 1.0,
        }
    }
}

impl SkyParams {
    /// The parameters in the caption of the paper's figure 2.
    pub fn figure_2() -> SkyParams {
        SkyParams {
            cover: 0.69,
            height: 1.0,
            density: 0.0,
            sunset: 0.72,
            speed: 0.1,
            time: 0.35,
            ..Default::default()
        }
    }

    /// The parameters in the caption of the paper's figure 4.
    pub fn figure_4() -> SkyParams {
        SkyParams {
            cover: 0.57,
            height: 0.52,
            density: 0.84,
            sunset: 0.43,
            speed: 0.0,
            time: 0.72,
            ..Default::default()
        }
    }

    /// The factor on the radiance before the tone curve: `exposure 2^exposure_ev`.
    pub fn exposure_factor(&self) -> f32 {
        self.exposure * self.exposure_ev.exp2()
    }

    /// The parameters of the dome: those of the method behind the sprites, or these themselves.
    pub(crate) fn dome(self) -> SkyParams {
        #[cfg(feature = "sprites")]
        if self.method == Method::Sprites {
            return SkyParams {
                method: self.sprites.behind,
                cover: self.sprites.behind_cover,
                ..self
            };
        }
        self
    }
}
