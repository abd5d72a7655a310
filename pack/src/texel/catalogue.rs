//! The record of the role `catalogue`: a star of the sky, three texels.

/// A star of the role `catalogue`: where it stands, how bright and of what colour it is, and how it flickers.
///
/// Two bytes, the coarser first, hold a place or a magnitude: a place is off by 0.003 degrees at most, a third of a pixel of a screen that is
/// 2160 lines high over 20 degrees, and a magnitude by 0.0002.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct CatalogueStar {
    /// Right ascension of J2000 in degrees, 0 to 360.
    pub right_ascension_deg: f64,
    /// Declination of J2000 in degrees, -90 to 90.
    pub declination_deg: f64,
    /// Visual magnitude outside the air, -2 to 14.
    pub magnitude: f64,
    /// B-V, -0.4 to 2.15.
    pub colour_index: f64,
    /// Flicker rate in 64ths of a hertz.
    pub rate: u8,
    /// Flicker amplitude in the zenith, as a share of the light in 255ths.
    pub variance: u8,
    /// Where in its cycle the star is at time 0, in 256ths of a turn.
    pub phase: u8,
}

impl CatalogueStar {
    /// Magnitudes that a record can hold. The brightest star has -1.46; what is brighter or fainter is taken for the nearest.
    pub const MAGNITUDES: [f64; 2] = [-2.0, 14.0];
    /// B-V that a record can hold, in hundredths; redder stars, of carbon, are as rare as a few in ten thousand.
    pub const COLOUR_INDICES: [f64; 2] = [-0.4, 2.15];
    /// Flicker rates: 0.2 to 3.95 Hz in 64ths, as the stars of the role `stars` have them.
    pub const RATES: [u8; 2] = [12, 252];
    /// What the fourth byte of the layer `light` is where there is a star.
    pub const IS_STAR: u8 = 255;

    /// The bytes of its texel in each layer: place, light, flicker.
    pub fn encode(self) -> [[u8; 4]; 3] {
        // A turn has 65536 steps; from pole to pole there are 65535.
        let turn = libm::round(self.right_ascension_deg / 360.0 * 65_536.0) as i64;
        let [ra, ra_fine] = (turn.rem_euclid(65_536) as u16).to_be_bytes();
        let [dec, dec_fine] = share(self.declination_deg, [-90.0, 90.0]);
        let [light, light_fine] = share(self.magnitude, Self::MAGNITUDES);
        let [bluest, reddest] = Self::COLOUR_INDICES;
        let colour = libm::round((self.colour_index.clamp(bluest, reddest) - bluest) * 100.0) as u8;
        [
            [ra, ra_fine, dec, dec_fine],
            [light, light_fine, colour, Self::IS_STAR],
            [self.rate, self.variance, self.phase, 0],
        ]
    }

    /// Reads the texels of a star.
    pub fn decode([place, light, flicker]: [[u8; 4]; 3]) -> CatalogueStar {
        let pair = |coarse: u8, fine: u8| f64::from(u16::from_be_bytes([coarse, fine]));
        let of = |steps: f64, [low, high]: [f64; 2]| low + (high - low) * steps / 65_535.0;
        CatalogueStar {
            right_ascension_deg: pair(place[0], place[1]) * (360.0 / 65_536.0),
            declination_deg: of(pair(place[2], place[3]), [-90.0, 90.0]),
            magnitude: of(pair(light[0], light[1]), Self::MAGNITUDES),
            colour_index: Self::COLOUR_INDICES[0] + f64::from(light[2]) / 100.0,
            rate: flicker[0],
            variance: flicker[1],
            phase: flicker[2],
        }
    }
}

/// Two bytes of a number between two others.
fn share(value: f64, [low, high]: [f64; 2]) -> [u8; 2] {
    let share = (value.clamp(low, high) - low) / (high - low);
    (libm::round(share * 65_535.0) as u16).to_be_bytes()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_star_comes_back_within_half_a_step() {
        for i in 0..2000 {
            let t = f64::from(i) / 1999.0;
            let star = CatalogueStar {
                right_ascension_deg: 359.999 * t,
                declination_deg: -90.0 + 180.0 * (7.3 * t).fract(),
                magnitude: -2.0 + 16.0 * (3.7 * t).fract(),
                colour_index: -0.4 + 2.55 * (5.1 * t).fract(),
                rate: i as u8,
                variance: (i / 3) as u8,
                phase: (i / 7) as u8,
            };
            let found = CatalogueStar::decode(star.encode());
            let turn = (found.right_ascension_deg - star.right_ascension_deg + 180.0)
                .rem_euclid(360.0)
                - 180.0;
            assert!(turn.abs() <= 360.0 / 131_072.0 + 1e-9, "{star:?}");
            assert!((found.declination_deg - star.declination_deg).abs() <= 90.0 / 65_535.0 + 1e-9);
            assert!((found.magnitude - star.magnitude).abs() <= 8.0 / 65_535.0 + 1e-9);
            assert!((found.colour_index - star.colour_index).abs() <= 0.005 + 1e-9);
            assert_eq!(
                (found.rate, found.variance, found.phase),
                (star.rate, star.variance, star.phase)
            );
        }
    }

    #[test]
    fn what_a_record_cannot_hold_is_the_nearest_that_it_can() {
        let star = CatalogueStar {
            right_ascension_deg: 359.9999,
            declination_deg: 91.0,
            magnitude: 20.0,
            colour_index: 5.5,
            ..CatalogueStar::default()
        };
        let found = CatalogueStar::decode(star.encode());
        assert_eq!(found.right_ascension_deg, 0.0, "a turn is none");
        assert_eq!((found.declination_deg, found.magnitude), (90.0, 14.0));
        assert!((found.colour_index - 2.15).abs() < 1e-12);
    }
}
