//! Parameters in their ranges: whatever they are, a frame can be drawn from what comes out.

use super::range::ParamError;
use super::setting::Slot;
use super::sky::SkyParams;
use super::sprites::{LEAST_RING_M, MOST_DISTANCE_M};
use super::table::{OTHERS, SETTINGS};
use super::weather::FLASH_START_S;

impl SkyParams {
    /// The same parameters, all in their ranges.
    pub fn clamped(mut self) -> SkyParams {
        let mut defaults = SkyParams::default();
        for setting in SETTINGS {
            for number in setting.numbers() {
                number.clamp(&mut self, &mut defaults);
            }
            if let Slot::Count { most, place, .. } = setting.slot {
                let count = place(&mut self);
                *count = (*count).clamp(1, most);
            }
        }
        for number in OTHERS {
            number.clamp(&mut self, &mut defaults);
        }
        if self.sprites.ring_radius_m < LEAST_RING_M {
            self.sprites.ring_radius_m = 0.0;
        }
        self.perez.shape = self.perez.shape.clamped();
        let ([first_s, last_s], start_s) = (FLASH_START_S, &mut self.weather.lightning.start_s);
        *start_s = if start_s.is_nan() {
            0.0
        } else {
            start_s.clamp(first_s, last_s)
        };
        self
    }

    /// Tells the first parameter that [`SkyParams::clamped`] would change.
    ///
    /// # Errors
    /// [`ParamError`], with the parameter's name and range.
    pub fn check(&self) -> Result<(), ParamError> {
        let mut copy = *self;
        for setting in SETTINGS {
            for number in setting.numbers() {
                number.check(&mut copy)?;
            }
            if let Slot::Count { field, most, place } = setting.slot {
                ParamError::unless(field, *place(&mut copy), 1..=most)?;
            }
        }
        for number in OTHERS {
            number.check(&mut copy)?;
        }
        let ring_m = self.sprites.ring_radius_m;
        if ring_m != 0.0 && ring_m < LEAST_RING_M {
            return Err(ParamError {
                key: "sprites.ring_radius_m",
                found: ring_m.to_string(),
                expected: format!("0 or a number from {LEAST_RING_M} to {MOST_DISTANCE_M}"),
            });
        }
        let ([first_s, last_s], start_s) = (FLASH_START_S, self.weather.lightning.start_s);
        ParamError::unless("weather.lightning.start_s", start_s, first_s..=last_s)?;
        self.perez.shape.check()
    }
}

#[cfg(test)]
mod tests {
    use crate::almanac::Place;

    use super::super::perez::PerezShape;
    use super::super::sky::MAX_EXPOSURE;
    use super::*;

    #[test]
    fn clamps_what_is_out_of_range_and_replaces_what_is_no_number() {
        let wild = SkyParams {
            cover: -3.0,
            height: f32::INFINITY,
            density: f32::NAN,
            time: f32::NEG_INFINITY,
            exposure: 1e30,
            place: Place {
                latitude_deg: 91.0,
                longitude_deg: f32::NAN,
            },
            ..Default::default()
        };
        let tame = wild.clamped();
        assert_eq!(
            (tame.cover, tame.height, tame.time, tame.exposure),
            (0.0, 1.0, 0.0, MAX_EXPOSURE)
        );
        assert_eq!(tame.density, SkyParams::default().density);
        let place = tame.place;
        assert_eq!((place.latitude_deg, place.longitude_deg), (90.0, 0.0));
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

    #[cfg(feature = "serde")]
    #[test]
    fn parameters_come_back_from_json() {
        use super::super::layers::layers;

        let mut params = SkyParams::figure_4();
        params.perez.shape = PerezShape::Cie(12);
        params.date = Some("2026-06-21T18:30:00.250Z".parse().unwrap());
        params.place.latitude_deg = -33.9;
        params.lit.layers = layers("cumulus:0.5:1:-12.5:0,cirrus:0.25").unwrap();
        for one in [params, SkyParams::default()] {
            let text = serde_json::to_string(&one).unwrap();
            assert_eq!(serde_json::from_str::<SkyParams>(&text).unwrap(), one);
        }
        let some = serde_json::from_str::<SkyParams>("{\"cover\":0.1,\"lit\":{\"k1\":0.5}}");
        let mut wanted = SkyParams::default();
        (wanted.cover, wanted.lit.k1) = (0.1, 0.5);
        assert_eq!(some.unwrap(), wanted);
    }

    #[test]
    fn fields_are_named_by_their_paths() {
        let of = |name: &str| SETTINGS.iter().find(|s| s.words.name == name).unwrap();
        assert_eq!(of("k1").numbers()[0].field, "lit.k1");
        assert_eq!(of("domes").numbers()[2].field, "octaves.domes[2]");
        assert_eq!(
            of("layers").numbers()[23].field,
            "lit.layers[5].velocity_m_s[1]"
        );
    }
}
