//! The parameters of Roden and Parberry, those of each method, and a few of our own.

mod fbm;
mod lit;
mod method;
mod octaves;
mod perez;
mod range;
mod sprites;
mod weather;

pub use fbm::FbmParams;
pub use lit::{LAYERS_AN_ITERATION, LitLayer, LitParams, MAX_LAYERS};
pub use method::{Method, SkyModel};
pub use octaves::{DEFAULT_OCTAVES, OctaveParams};
pub use perez::{CUSTOM, PerezParams, PerezShape, STANDARD_SKIES, TURBIDITY};
pub use range::ParamError;
pub use sprites::{LEAST_RING_M, MOST_DISTANCE_M, SpriteParams};
pub use weather::{Lightning, WeatherParams};

use range::Ranged;

/// What the sky shall look like. The first six are the paper's, 0..1 each.
///
/// Values out of range are clamped when a frame is prepared, and what is not a number becomes the
/// default, so that a slider or a script can never make a frame of NaN. [`SkyParams::check`] tells instead.
///
/// T. Roden, I. Parberry, "Clouds and Stars: Efficient Real-Time Procedural Sky Rendering Using 3D
/// Hardware", ACE 2005, section 2.
#[derive(Clone, Copy, Debug, PartialEq)]
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
    /// Amount of the thin upper layer of [`Method::Packed`], 0 (off) to 1.
    pub upper_layer: f32,
    /// Factor on the radiance before the tone curve, 0..=64. A float target gets radiance without it.
    pub exposure: f32,
    /// Whether targets of few bits are dithered by half a step.
    pub dither: bool,
    /// How the clear sky is computed.
    pub sky: SkyModel,
    /// Of [`SkyModel::Perez`].
    pub perez: PerezParams,
    /// Which system makes the clouds.
    pub method: Method,
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
    /// Of [`Method::Lit`] alone.
    pub shadow_extent_m: f32,
    /// Whether the sun's disc and glow are drawn.
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

/// The least and the largest [`OctaveParams::formation_interval_s`]: a day.
pub const FORMATION_INTERVAL_S: [f32; 2] = [0.1, 86_400.0];

/// The most octaves of [`OctaveParams::count`].
pub const MAX_OCTAVES: u32 = 8;

/// The largest [`SkyParams::exposure`]: six stops over the default.
pub const MAX_EXPOSURE: f32 = 64.0;

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
            upper_layer: 0.0,
            exposure: 1.0,
            dither: true,
            sky: SkyModel::Gradient,
            perez: PerezParams::default(),
            method: Method::Packed,
            octaves: OctaveParams::default(),
            fbm: FbmParams::default(),
            lit: LitParams::default(),
            sprites: SpriteParams::default(),
            weather: WeatherParams::default(),
            shadow_extent_m: 0.0,
            sun: true,
            stars: true,
            even_stars: false,
            flare: 1.0,
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

    /// The same parameters, all in their ranges.
    pub fn clamped(mut self) -> SkyParams {
        for (_, value, usual, [low, high]) in self.numbers() {
            *value = if value.is_nan() {
                usual
            } else {
                value.clamp(low, high)
            };
        }
        self.octaves.count = self.octaves.count.clamp(1, MAX_OCTAVES);
        if self.sprites.ring_radius_m < LEAST_RING_M {
            self.sprites.ring_radius_m = 0.0;
        }
        self.perez.shape = self.perez.shape.clamped();
        let lightning = &mut self.weather.lightning;
        lightning.start_s = weather::clamped_start(lightning.start_s);
        self
    }

    /// Tells the first parameter that [`SkyParams::clamped`] would change.
    ///
    /// # Errors
    /// [`ParamError`], with the parameter's name and range.
    pub fn check(&self) -> Result<(), ParamError> {
        for (key, value, _, [low, high]) in { *self }.numbers() {
            if !(low..=high).contains(value) {
                let (found, expected) =
                    (value.to_string(), format!("a number from {low} to {high}"));
                return Err(ParamError {
                    key,
                    found,
                    expected,
                });
            }
        }
        let count = self.octaves.count;
        if !(1..=MAX_OCTAVES).contains(&count) {
            return Err(ParamError {
                key: "octaves.count",
                found: count.to_string(),
                expected: format!("a number from 1 to {MAX_OCTAVES}"),
            });
        }
        let ring = self.sprites.ring_radius_m;
        if ring != 0.0 && ring < LEAST_RING_M {
            return Err(ParamError {
                key: "sprites.ring_radius_m",
                found: ring.to_string(),
                expected: format!("0 or a number from {LEAST_RING_M} to {MOST_DISTANCE_M}"),
            });
        }
        weather::check_start(self.weather.lightning.start_s)?;
        self.perez.shape.check()
    }

    /// Every number that has a range.
    fn numbers(&mut self) -> Vec<Ranged<'_>> {
        const UNIT: [f32; 2] = [0.0, 1.0];
        let usual = SkyParams::default();
        let [low, middle, high] = &mut self.octaves.domes;
        let [lit_r, lit_g, lit_b] = &mut self.fbm.lit;
        let [shaded_r, shaded_g, shaded_b] = &mut self.fbm.shaded;
        let (octaves, fbm) = (usual.octaves, usual.fbm);
        let mut numbers = vec![
            ("cover", &mut self.cover, usual.cover, UNIT),
            ("height", &mut self.height, usual.height, UNIT),
            ("density", &mut self.density, usual.density, UNIT),
            ("sunset", &mut self.sunset, usual.sunset, UNIT),
            ("speed", &mut self.speed, usual.speed, UNIT),
            ("time", &mut self.time, usual.time, UNIT),
            (
                "upper_layer",
                &mut self.upper_layer,
                usual.upper_layer,
                UNIT,
            ),
            (
                "exposure",
                &mut self.exposure,
                usual.exposure,
                [0.0, MAX_EXPOSURE],
            ),
            ("flare", &mut self.flare, usual.flare, UNIT),
            ("skybox", &mut self.skybox, usual.skybox, UNIT),
            (
                "perez.turbidity",
                &mut self.perez.turbidity,
                usual.perez.turbidity,
                TURBIDITY,
            ),
            (
                "octaves.sharpness",
                &mut self.octaves.sharpness,
                octaves.sharpness,
                UNIT,
            ),
            (
                "octaves.formation_interval_s",
                &mut self.octaves.formation_interval_s,
                octaves.formation_interval_s,
                FORMATION_INTERVAL_S,
            ),
            ("octaves.domes[0]", low, octaves.domes[0], UNIT),
            ("octaves.domes[1]", middle, octaves.domes[1], UNIT),
            ("octaves.domes[2]", high, octaves.domes[2], UNIT),
            (
                "fbm.sharpness",
                &mut self.fbm.sharpness,
                fbm.sharpness,
                UNIT,
            ),
            ("fbm.lit[0]", lit_r, fbm.lit[0], UNIT),
            ("fbm.lit[1]", lit_g, fbm.lit[1], UNIT),
            ("fbm.lit[2]", lit_b, fbm.lit[2], UNIT),
            ("fbm.shaded[0]", shaded_r, fbm.shaded[0], UNIT),
            ("fbm.shaded[1]", shaded_g, fbm.shaded[1], UNIT),
            ("fbm.shaded[2]", shaded_b, fbm.shaded[2], UNIT),
            (
                "shadow_extent_m",
                &mut self.shadow_extent_m,
                usual.shadow_extent_m,
                [0.0, 1e6],
            ),
        ];
        numbers.extend(lit::numbers(&mut self.lit));
        numbers.extend(sprites::numbers(&mut self.sprites));
        numbers.extend(weather::numbers(&mut self.weather));
        numbers
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn clamps_what_is_out_of_range_and_replaces_what_is_no_number() {
        let wild = SkyParams {
            cover: -3.0,
            height: f32::INFINITY,
            density: f32::NAN,
            time: f32::NEG_INFINITY,
            exposure: 1e30,
            ..Default::default()
        };
        let tame = wild.clamped();
        assert_eq!(
            (tame.cover, tame.height, tame.time, tame.exposure),
            (0.0, 1.0, 0.0, MAX_EXPOSURE)
        );
        assert_eq!(tame.density, SkyParams::default().density);
    }

    #[test]
    fn tells_the_parameter_that_is_out_of_range() {
        assert_eq!(SkyParams::default().check(), Ok(()));
        let told = |change: &dyn Fn(&mut SkyParams)| {
            let mut params = SkyParams::default();
            change(&mut params);
            let error = params.check().expect_err("out of range");
            assert_eq!(params.clamped().check(), Ok(()), "{error}");
            error.to_string()
        };
        assert_eq!(
            told(&|p| p.octaves.formation_interval_s = 0.0),
            "octaves.formation_interval_s is 0, expected a number from 0.1 to 86400"
        );
        assert_eq!(
            told(&|p| p.octaves.count = 0),
            "octaves.count is 0, expected a number from 1 to 8"
        );
        assert_eq!(
            told(&|p| p.fbm.shaded[2] = f32::NAN),
            "fbm.shaded[2] is NaN, expected a number from 0 to 1"
        );
        assert_eq!(
            told(&|p| p.perez.turbidity = 1.0),
            "perez.turbidity is 1, expected a number from 1.7 to 10"
        );
        assert_eq!(
            told(&|p| p.perez.shape = PerezShape::Cie(16)),
            "perez.shape.cie is 16, expected a number from 1 to 15"
        );
        assert_eq!(
            told(&|p| p.perez.shape = PerezShape::Custom([0.0, 0.0, 0.0, -1.0, 0.0])),
            "perez.shape.b is 0, expected a number from -5 to -0.05"
        );
        assert_eq!(
            told(&|p| p.perez.shape = PerezShape::Custom([0.0, -1.0, f32::NAN, -1.0, 0.0])),
            "perez.shape.c is NaN, expected a number from 0 to 30"
        );
        assert_eq!(
            told(&|p| p.weather.lightning.start_s = f64::NAN),
            "weather.lightning.start_s is NaN, expected a number from -1000000000 to 1000000000"
        );
        assert_eq!(
            told(&|p| p.sprites.ring_radius_m = 100.0),
            "sprites.ring_radius_m is 100, expected 0 or a number from 4000 to 60000"
        );
        assert!(told(&|p| p.sprites.formation = -0.5).starts_with("sprites.formation is -0.5"));
        assert!(told(&|p| p.weather.rain = 1.5).starts_with("weather.rain is 1.5"));
        assert!(told(&|p| p.octaves.domes[1] = 1.5).starts_with("octaves.domes[1] is 1.5"));
        assert!(told(&|p| p.cover = -0.1).starts_with("cover is -0.1"));
        assert!(told(&|p| p.exposure = f32::INFINITY).starts_with("exposure is inf"));
    }

    #[test]
    fn leaves_good_parameters_alone() {
        assert_eq!(SkyParams::figure_2().clamped(), SkyParams::figure_2());
        assert_eq!(SkyParams::figure_4().clamped(), SkyParams::figure_4());
    }
}
