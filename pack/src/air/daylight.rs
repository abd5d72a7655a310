//! How light the day is, and the unit in which a sky is stored at an hour.
//!
//! A day spans eight powers of ten. Eyes and cameras follow it: what is a factor of c in light is felt as about c^(1/3) (J. Tumblin,
//! H. Rushmeier, "Tone Reproduction for Realistic Images", IEEE CG&A 13(6), 1993, after S. S. Stevens). So radiance is stored in a
//! unit that falls with the light of the hour, by one closed form: what is stored is physical within a sky, and times the unit of the
//! hour it is physical between skies.

use super::layers::WHITE_ELEVATION_RAD;

/// Exponent of what the eye keeps of a change of light.
const ADAPTATION: f32 = 1.0 / 3.0;

/// The unit with the sun 60 degrees high, in cd/m2: about what a sunlit white cloud has. The sun's disc is then below 65504, the largest half float,
/// at every hour.
const UNIT_AT_60_CD_M2: f32 = 32_000.0;

/// The most that a clear sky without the sun gives, in lux: `daylight / (1 + daylight / 16 klx)` is what the table of a clear day has, within 20 %.
const MOST_SKYLIGHT_LX: f32 = 16_000.0;

/// Cubics of the decimal logarithm of illuminance over the sun's elevation in units of 90 degrees, from elevations down.
///
/// P. M. Janiczek, J. A. DeYoung, "Computer Programs for Sun and Moon Illuminance With Contingent Tables and Diagrams", U.S. Naval
/// Observatory Circular 171, 1987, table 2.
const CUBICS: [(f32, [f32; 4]); 6] = [
    (20.0, [3.74, 3.97, -4.07, 1.47]),
    (5.0, [3.05, 13.28, -45.98, 64.33]),
    (-0.8, [2.88, 22.26, -207.64, 1034.30]),
    (-5.0, [2.88, 21.81, -258.11, -858.36]),
    (-12.0, [2.70, 12.17, -431.69, -1899.83]),
    (-18.0, [13.84, 262.72, 1447.42, 2797.93]),
];

/// Illuminance of a horizontal plane by sun and clear sky, in lux; below -18 degrees, that of a moonless night.
pub fn daylight_lx(sun_elevation_rad: f32) -> f32 {
    let degrees = (sun_elevation_rad * (180.0 / std::f32::consts::PI)).clamp(-18.0, 90.0);
    let [.., last] = CUBICS;
    let (_, [a, b, c, d]) = CUBICS
        .into_iter()
        .find(|&(from, _)| degrees >= from)
        .unwrap_or(last);
    let x = degrees / 90.0;
    libm::exp10f(a + x * (b + x * (c + x * d)))
}

/// The sky's part of it, without the sun, in lux.
pub fn skylight_lx(sun_elevation_rad: f32) -> f32 {
    let daylight = daylight_lx(sun_elevation_rad);
    daylight / (1.0 + daylight / MOST_SKYLIGHT_LX)
}

/// The luminance that a stored radiance of 1 stands for with the sun at that elevation, in cd/m2.
pub fn unit_luminance_cd_m2(sun_elevation_rad: f32) -> f32 {
    let light = skylight_lx(sun_elevation_rad) / skylight_lx(WHITE_ELEVATION_RAD);
    UNIT_AT_60_CD_M2 * libm::powf(light, 1.0 - ADAPTATION)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn daylight_is_that_of_the_tables() {
        // Known levels, each to a third: a high sun 120 klx or so, sunset some 400 to 800 lx, the end of civil twilight (-6 degrees) 3.4 lx
        // (RCA Electro-Optics Handbook, 1974, table 6-1), a moonless clear night some 1e-3 lx.
        for (degrees, lux) in [
            (90.0_f32, 125e3),
            (0.0, 7.6e2),
            (-6.0, 3.4),
            (-12.0, 8e-3),
            (-18.0, 6.5e-4),
        ] {
            let found = daylight_lx(degrees.to_radians());
            assert!(libm::logf(found / lux).abs() < 0.3, "{degrees}: {found}");
        }
        assert_eq!(daylight_lx(-1.0), daylight_lx(-18_f32.to_radians()));
    }

    #[test]
    fn the_unit_never_jumps() {
        let mut last = unit_luminance_cd_m2(-0.32);
        for i in -3190..15700 {
            let now = unit_luminance_cd_m2(i as f32 * 1e-4);
            // The table's cubics meet within a few hundredths.
            assert!(
                (now / last - 1.0).abs() < 0.05 && now > 0.0,
                "{i}: {last} {now}"
            );
            last = now;
        }
    }
}
