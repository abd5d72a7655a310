//! How faint a star an eye sees under the sky of a moment.
//!
//! # Theory
//! The sky overhead is so bright by what there is of twilight, moonlight and the night's own light. From its brightness follows the magnitude of the faintest star
//! that an eye tells from it: 6.4 in a dark night, 4.3 beneath a full moon, and at the end of civil twilight those brighter than 0.
//!
//! # Practice
//! A few exponentials a frame. What a *picture* makes of starlight by the hour, and the moon's share in it, is `Light::night` and `Light::dark`.

use libm::{exp, log10, pow};

/// The sky overhead without moon and sun, in magnitudes a square second of arc. F. E. Roach, J. L. Gordon, "The Light of the Night Sky", 1973.
const DARK: f64 = 21.6;

/// Magnitudes in which a star fades that is fainter than the faintest: eyes differ, and none may leap in as the sky turns.
const FADE: f32 = 1.0;

/// What the sky overhead has of light.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Overhead {
    /// Sine of the sun's elevation.
    pub sun_sine: f32,
    /// Sine of the moon's elevation.
    pub moon_sine: f32,
    /// The moon's light over that of a full moon, 0 if it is down.
    pub moonlight: f32,
    /// What the air takes of a star overhead, in magnitudes.
    pub extinction: f32,
}

/// Magnitudes a square second of arc of the sky overhead.
pub fn sky_magnitude(overhead: Overhead) -> f32 {
    let nanolamberts = nanolamberts(twilight(overhead.sun_sine)) + moonlit(overhead);
    ((20.7233 - libm::log(nanolamberts / 34.08)) / 0.92104) as f32
}

/// The magnitude of the faintest star that is seen, as it is seen through the air.
///
/// B. E. Schaefer, "Telescopic limiting magnitudes", PASP 102, 1990, for the naked eye.
pub fn faintest(sky_magnitude: f32) -> f32 {
    let contrast = pow(10.0, 4.316 - f64::from(sky_magnitude) / 5.0);
    (7.93 - 5.0 * log10(contrast + 1.0)) as f32
}

/// The magnitude from which nothing is left of a star.
pub fn end(faintest: f32) -> f32 {
    faintest + FADE
}

/// How much is seen of a star of a magnitude, 0 to 1.
pub fn share(faintest: f32, magnitude: f32) -> f32 {
    let t = ((magnitude - faintest) / FADE).clamp(0.0, 1.0);
    1.0 - t * t * (3.0 - 2.0 * t)
}

/// F. Patat, O. S. Ugolnikov, O. V. Postylyakov, "UBVRI twilight sky brightness at ESO-Paranal", A&A 455, 2006, table 2, V: from 5 to 15 degrees below the
/// horizon; carried on to either side.
fn twilight(sun_sine: f32) -> f64 {
    // Degrees beyond a zenith distance of 95.
    let angle = -f64::from(sun_sine.clamp(-1.0, 1.0)).asin().to_degrees() - 5.0;
    // There the parabola has its top.
    let angle = angle.min(1.518 / (2.0 * 0.057));
    (11.84 + angle * (1.518 - 0.057 * angle)).min(DARK)
}

/// Luminance in nanolamberts (K. Krisciunas, B. E. Schaefer, "A model of the brightness of moonlight", PASP 103, 1991, (1)).
fn nanolamberts(magnitude: f64) -> f64 {
    34.08 * exp(20.7233 - 0.92104 * magnitude)
}

/// Moonlight scattered overhead, in nanolamberts (Krisciunas and Schaefer 1991, (3), (15), (16), (18), (21)).
fn moonlit(overhead: Overhead) -> f64 {
    let sine = f64::from(overhead.moon_sine.clamp(0.0, 1.0));
    let full = pow(10.0, -0.4 * 3.84) * f64::from(overhead.moonlight);
    // The moon's distance from the zenith, in degrees.
    let away = sine.acos().to_degrees();
    let scattered = pow(10.0, 5.36) * (1.06 + sine * sine) + pow(10.0, 6.15 - away / 40.0);
    let extinction = 0.4 * f64::from(overhead.extinction);
    let air_mass = 1.0 / (1.0 - 0.96 * (1.0 - sine * sine)).sqrt();
    scattered * full * pow(10.0, -extinction * air_mass) * (1.0 - pow(10.0, -extinction))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn night() -> Overhead {
        Overhead {
            sun_sine: -0.7,
            moon_sine: -0.2,
            moonlight: 0.0,
            extinction: 0.17,
        }
    }

    fn sun_at(degrees: f32) -> Overhead {
        Overhead {
            sun_sine: degrees.to_radians().sin(),
            ..night()
        }
    }

    #[test]
    fn a_dark_sky_shows_stars_of_the_sixth_magnitude() {
        assert!((sky_magnitude(night()) - 21.6).abs() < 0.01);
        let found = faintest(sky_magnitude(night()));
        assert!((6.0..6.6).contains(&found), "{found}");
    }

    #[test]
    fn a_full_moon_hides_all_but_the_brightest_hundreds() {
        // Measured skies of a full moon have some 18 magnitudes a square second of arc, those of a quarter 20.5 or so (Krisciunas and Schaefer 1991, table 2).
        let moon = |moonlight: f32| Overhead {
            moon_sine: 0.7,
            moonlight,
            ..night()
        };
        let full = sky_magnitude(moon(1.0));
        assert!((17.5..18.7).contains(&full), "{full}");
        assert!((3.8..4.6).contains(&faintest(full)));
        let quarter = sky_magnitude(moon(0.09));
        assert!((20.0..21.0).contains(&quarter), "{quarter}");
        // The air that is hazier scatters more of it.
        let hazy = Overhead {
            extinction: 0.5,
            ..moon(1.0)
        };
        assert!(sky_magnitude(hazy) < full);
    }

    #[test]
    fn twilight_lets_one_star_after_another_out() {
        // Civil twilight ends with the first stars, nautical when the horizon is lost and constellations are out.
        let at = |degrees: f32| faintest(sky_magnitude(sun_at(degrees)));
        assert!((-2.5..0.5).contains(&at(-6.0)), "{}", at(-6.0));
        assert!((3.5..5.5).contains(&at(-12.0)), "{}", at(-12.0));
        assert!((at(-18.0) - faintest(21.6)).abs() < 1e-3);
        // No star is drawn before.
        let mut last = at(-5.0);
        for step in 51..=250 {
            let now = at(-0.1 * step as f32);
            assert!(
                now >= last - 1e-4 && now - last < 0.15,
                "{step}: {last} {now}"
            );
            last = now;
        }
    }

    #[test]
    fn a_star_fades_and_never_leaps() {
        assert_eq!((share(6.4, 6.4), share(6.4, 7.5)), (1.0, 0.0));
        for step in 0..200 {
            let fainter = |step: i32| share(6.0, 5.5 + 0.01 * step as f32);
            let fall = fainter(step) - fainter(step + 1);
            assert!((0.0..0.02).contains(&fall));
        }
    }
}
