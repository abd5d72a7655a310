//! Light in a spherical atmosphere of air, haze and ozone, seen from the ground.
//!
//! Lengths are kilometres, coefficients per kilometre; radiance is a share of the sun's irradiance above
//! the atmosphere, at each wavelength of `spectrum.rs`.
//!
//! E. Bruneton, F. Neyret, "Precomputed Atmospheric Scattering", EGSR 2008; S. Hillaire, "A Scalable and
//! Production Ready Sky and Atmosphere Rendering Technique", EGSR 2020.

use std::f32::consts::PI;

use super::geometry::{
    GROUND_KM, along, cosine, distance_to_ground, distance_to_top, horizon_sin, sun_above_horizon,
};
use super::spectrum::{self, COUNT, Spectrum};
use super::table::Table;

/// Scale height of air, km (Hillaire 2020, table 1).
const AIR_SCALE_KM: f32 = 8.0;

/// Scattering and absorption of haze at the ground at every wavelength, 1/km, and scale height, km
/// (Hillaire 2020, table 1).
const HAZE_SCATTERING: f32 = 3.996e-3;
const HAZE_ABSORPTION: f32 = 4.40e-3;
const HAZE_SCALE_KM: f32 = 1.2;

/// Asymmetry of the haze's phase function (Hillaire 2020, table 1).
const HAZE_ASYMMETRY: f32 = 0.8;

/// The haze's phase function is held constant within 40 degrees of the sun (a cosine): the glow there is
/// drawn by the runtime, which knows where the sun is.
const GLOW_COS: f32 = 0.766;

/// Middle and half width of the ozone layer, a tent, in km (Hillaire 2020, table 1).
const OZONE_MIDDLE_KM: f32 = 25.0;
const OZONE_HALF_KM: f32 = 15.0;

/// Reflectance of the ground (Hillaire 2020, section 4).
const GROUND_ALBEDO: f32 = 0.3;

/// Steps along a line of sight, and along a ray to the sun.
const VIEW_STEPS: usize = 28;
const SUN_STEPS: usize = 32;

/// Directions and steps of the estimate of multiple scattering: coarse, since its result is very smooth.
const MULTIPLE_RINGS: usize = 8;
const MULTIPLE_TURNS: usize = 4;
const MULTIPLE_STEPS: usize = 12;

/// An atmosphere with its tables of sunlight.
pub(super) struct Atmosphere {
    air: Spectrum,
    ozone: Spectrum,
    haze: f32,
    /// Share of the sun's light that reaches a place.
    transmittance: Table,
    /// Radiance of light scattered more than once, before the local coefficient of scattering.
    multiple: Table,
}

/// What a kilometre of the atmosphere does.
struct Medium {
    air: Spectrum,
    haze: f32,
    extinction: Spectrum,
}

/// A line of sight from the ground: what every step of it passes on, whatever the sun does.
pub(super) struct Line {
    view: [f32; 2],
    steps: Vec<Step>,
}

struct Step {
    distance: f32,
    air: Spectrum,
    haze: Spectrum,
}

impl Atmosphere {
    /// `haze` multiplies the aerosol.
    pub(super) fn new(haze: f32) -> Atmosphere {
        let mut atmosphere = Atmosphere {
            air: spectrum::air(),
            ozone: spectrum::ozone(),
            haze,
            transmittance: Table::empty(),
            multiple: Table::empty(),
        };
        atmosphere.transmittance = Table::new(32, 96, |altitude, sun| {
            atmosphere.transmittance_along(altitude, sun)
        });
        atmosphere.multiple = Table::new(12, 48, |altitude, sun| {
            atmosphere.multiple_at(altitude, sun)
        });
        atmosphere
    }

    /// The line of sight at the sine of an elevation.
    pub(super) fn line(&self, view_sin: f32) -> Line {
        let view = [cosine(view_sin), view_sin];
        let mut through = [1.0; COUNT];
        let steps = squared_steps(distance_to_top(GROUND_KM, view_sin), VIEW_STEPS).map(
            |(distance, span)| {
                let medium = self.medium(along(GROUND_KM, view, distance, view).0);
                let spread = medium.pass(span, &mut through);
                Step {
                    distance,
                    air: each(|c| spread[c] * medium.air[c]),
                    haze: spread.map(|s| s * medium.haze),
                }
            },
        );
        Line {
            view,
            steps: steps.collect(),
        }
    }

    /// Radiance along a line, with the sun at the sine of an elevation, averaged over azimuths given as
    /// (cosine of the angle from the sun's azimuth, weight).
    pub(super) fn radiance(&self, line: &Line, sun_sin: f32, azimuths: &[(f32, f32)]) -> Spectrum {
        let mut sum = [0.0; COUNT];
        for &(azimuth_cos, weight) in azimuths {
            // The sun's part along the line's horizontal direction, and upwards.
            let sun = [cosine(sun_sin) * azimuth_cos, sun_sin];
            let between = line.view[0] * sun[0] + line.view[1] * sun[1];
            let (air_phase, haze_phase) = (
                air_phase(between) * weight,
                haze_phase(between.min(GLOW_COS)) * weight,
            );
            for step in &line.steps {
                let (altitude, sun_here) = along(GROUND_KM, line.view, step.distance, sun);
                let direct = self.transmittance.read(altitude, sun_here);
                let more = self.multiple.read(altitude, sun_here);
                for c in 0..COUNT {
                    sum[c] += direct[c] * (step.air[c] * air_phase + step.haze[c] * haze_phase)
                        + more[c] * weight * (step.air[c] + step.haze[c]);
                }
            }
        }
        sum
    }

    fn medium(&self, altitude: f32) -> Medium {
        let air_share = libm::expf(-altitude / AIR_SCALE_KM);
        let haze_share = self.haze * libm::expf(-altitude / HAZE_SCALE_KM);
        let ozone_share = (1.0 - (altitude - OZONE_MIDDLE_KM).abs() / OZONE_HALF_KM).max(0.0);
        let haze_extinction = (HAZE_SCATTERING + HAZE_ABSORPTION) * haze_share;
        let air = self.air.map(|a| a * air_share);
        Medium {
            air,
            haze: HAZE_SCATTERING * haze_share,
            // The floor only keeps `pass` from dividing by zero.
            extinction: each(|c| air[c] + haze_extinction + self.ozone[c] * ozone_share + 1e-9),
        }
    }

    /// Transmittance from an altitude to the sun (Bruneton and Neyret 2008, eq. 2); 0 behind the Earth.
    fn transmittance_along(&self, altitude: f32, sun_sin: f32) -> Spectrum {
        let radius = GROUND_KM + altitude;
        let visible = sun_above_horizon(radius, sun_sin);
        if visible == 0.0 {
            return [0.0; COUNT];
        }
        // A sun whose middle is below the horizon is read at the horizon: the rest of its disc is there.
        let sun_sin = sun_sin.max(horizon_sin(radius));
        let view = [cosine(sun_sin), sun_sin];
        let mut depth = [0.0; COUNT];
        for (distance, span) in squared_steps(distance_to_top(radius, sun_sin), SUN_STEPS) {
            let (altitude, _) = along(radius, view, distance, view);
            let medium = self.medium(altitude);
            depth = each(|c| depth[c] + medium.extinction[c] * span);
        }
        depth.map(|d| visible * libm::expf(-d))
    }

    /// Light scattered more than once, taken as isotropic: the second order over one minus the share that
    /// is scattered again (Hillaire 2020, eq. 5-10).
    fn multiple_at(&self, altitude: f32, sun_sin: f32) -> Spectrum {
        let sun_cos = cosine(sun_sin);
        let (mut second, mut again) = ([0.0; COUNT], [0.0; COUNT]);
        for ring in 0..MULTIPLE_RINGS {
            let up = -1.0 + 2.0 * (ring as f32 + 0.5) / MULTIPLE_RINGS as f32;
            for turn in 0..MULTIPLE_TURNS {
                let azimuth = PI * (turn as f32 + 0.5) / MULTIPLE_TURNS as f32;
                let (light, share) =
                    self.gathered(altitude, up, [sun_cos * libm::cosf(azimuth), sun_sin]);
                second = each(|c| second[c] + light[c]);
                again = each(|c| again[c] + share[c]);
            }
        }
        let count = (MULTIPLE_RINGS * MULTIPLE_TURNS) as f32;
        each(|c| (second[c] / count) / (1.0 - (again[c] / count).min(0.95)))
    }

    /// Light that arrives at a place from one direction after isotropic scattering or from the ground, and
    /// the share of an everywhere equal light that is scattered to here from there.
    fn gathered(&self, altitude: f32, up: f32, sun: [f32; 2]) -> (Spectrum, Spectrum) {
        let radius = GROUND_KM + altitude;
        let to_ground = distance_to_ground(radius, up);
        let length = to_ground.unwrap_or_else(|| distance_to_top(radius, up));
        let view = [cosine(up), up];
        let mut through = [1.0; COUNT];
        let (mut light, mut share) = ([0.0; COUNT], [0.0; COUNT]);
        for (distance, span) in squared_steps(length, MULTIPLE_STEPS) {
            let (here, sun_here) = along(radius, view, distance, sun);
            let medium = self.medium(here);
            let direct = self.transmittance.read(here, sun_here);
            let spread = medium.pass(span, &mut through);
            let spread: Spectrum = each(|c| spread[c] * (medium.air[c] + medium.haze));
            light = each(|c| light[c] + spread[c] * direct[c] / (4.0 * PI));
            share = each(|c| share[c] + spread[c]);
        }
        if to_ground.is_some() {
            let (_, sun_there) = along(radius, view, length, sun);
            let lit = self.transmittance.read(0.0, sun_there);
            light =
                each(|c| light[c] + through[c] * lit[c] * GROUND_ALBEDO / PI * sun_there.max(0.0));
        }
        (light, share)
    }
}

impl Medium {
    /// Dims `through` by a step and returns the length that the step counts for, dimmed by all before it
    /// and by itself (S. Hillaire, "Physically Based and Unified Volumetric Rendering in Frostbite",
    /// SIGGRAPH 2015 course, slide 28).
    fn pass(&self, span: f32, through: &mut Spectrum) -> Spectrum {
        each(|c| {
            let passed = libm::expf(-self.extinction[c] * span);
            let counted = through[c] * (1.0 - passed) / self.extinction[c];
            through[c] *= passed;
            counted
        })
    }
}

fn each(value: impl FnMut(usize) -> f32) -> Spectrum {
    std::array::from_fn(value)
}

/// Middles and lengths of steps whose ends grow with the square of their number: the air is thickest at
/// the start.
fn squared_steps(length: f32, count: usize) -> impl Iterator<Item = (f32, f32)> {
    let end = move |step: usize| {
        let t = step as f32 / count as f32;
        length * t * t
    };
    (0..count).map(move |step| (0.5 * (end(step) + end(step + 1)), end(step + 1) - end(step)))
}

/// Rayleigh's phase function (Bruneton and Neyret 2008, section 2.1).
fn air_phase(cosine: f32) -> f32 {
    3.0 / (16.0 * PI) * (1.0 + cosine * cosine)
}

/// Cornette and Shanks's phase function (Bruneton and Neyret 2008, eq. 4).
fn haze_phase(cosine: f32) -> f32 {
    let g = HAZE_ASYMMETRY;
    let base = 1.0 + g * g - 2.0 * g * cosine;
    3.0 / (8.0 * PI) * (1.0 - g * g) * (1.0 + cosine * cosine)
        / ((2.0 + g * g) * base * libm::sqrtf(base))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Integral of a phase function over the sphere, by the midpoint rule in the cosine.
    fn whole(phase: fn(f32) -> f32) -> f32 {
        let steps = 100_000;
        let cosine = |i: i32| -1.0 + 2.0 * (i as f32 + 0.5) / steps as f32;
        let sum: f64 = (0..steps).map(|i| f64::from(phase(cosine(i)))).sum();
        (sum * 4.0 * std::f64::consts::PI / f64::from(steps)) as f32
    }

    #[test]
    fn phase_functions_scatter_all_light_once() {
        // The rule's own error is below 1e-6 for these smooth functions; the rest is f32.
        assert!((whole(air_phase) - 1.0).abs() < 1e-4);
        assert!((whole(haze_phase) - 1.0).abs() < 1e-4);
    }

    #[test]
    fn overhead_sun_is_dimmed_by_the_vertical_depth() {
        let atmosphere = Atmosphere::new(1.0);
        let found = atmosphere.transmittance_along(0.0, 1.0);
        let haze = (HAZE_SCATTERING + HAZE_ABSORPTION) * HAZE_SCALE_KM;
        for (c, found) in found.into_iter().enumerate() {
            // Exponential layers hold a scale height (the top cuts off e^-12.5 of one), a tent its half width.
            let depth =
                atmosphere.air[c] * AIR_SCALE_KM + haze + atmosphere.ozone[c] * OZONE_HALF_KM;
            let expected = libm::expf(-depth);
            // The steps' midpoints miss less than 1 % of a depth below 0.4.
            assert!((found - expected).abs() < 0.004, "{c}: {found} {expected}");
        }
    }

    #[test]
    fn no_light_from_below_the_horizon_and_less_from_a_lower_sun() {
        let atmosphere = Atmosphere::new(1.0);
        assert_eq!(atmosphere.transmittance_along(0.0, -0.1), [0.0; COUNT]);
        // From 60 km up that sun stands above the horizon, behind 28 km of thin air.
        assert!(atmosphere.transmittance_along(60.0, -0.1)[4] > 0.1);
        let suns = [0.0, 0.05, 0.2, 0.6, 1.0].map(|s| atmosphere.transmittance_along(0.0, s));
        assert!(
            suns.windows(2)
                .all(|w| (0..COUNT).all(|c| w[0][c] < w[1][c]))
        );
    }

    #[test]
    fn without_an_atmosphere_of_haze_the_sky_is_bluer() {
        let blue = |haze| {
            let atmosphere = Atmosphere::new(haze);
            let light = atmosphere.radiance(&atmosphere.line(1.0), 0.7, &[(0.0, 1.0)]);
            light[1] / light[6]
        };
        assert!(blue(0.0) > blue(1.0) && blue(1.0) > blue(5.0));
        // Single scattering goes with the fourth power of the wavelength: (640 / 440)^4 = 4.5. Scattering
        // out of the line and again into it takes some of that back.
        assert!((3.0..4.5).contains(&blue(0.0)), "{}", blue(0.0));
    }

    #[test]
    fn scattered_light_never_exceeds_what_the_sun_sends() {
        let atmosphere = Atmosphere::new(1.0);
        for view in [0.0, 0.1, 0.5, 1.0] {
            let line = atmosphere.line(view);
            for sun in [-0.2, 0.0, 0.3, 0.9] {
                let light = atmosphere.radiance(&line, sun, &[(-0.5, 1.0)]);
                // An even white dome of radiance 1/pi would light the ground as the sun itself does.
                assert!(
                    light
                        .iter()
                        .all(|&l| (0.0..std::f32::consts::FRAC_1_PI).contains(&l)),
                    "{light:?}"
                );
            }
        }
    }
}
