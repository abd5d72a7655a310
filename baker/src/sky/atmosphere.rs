//! Light in a spherical atmosphere of air, haze and ozone, seen from the ground.
//!
//! Lengths are kilometres, coefficients per kilometre; radiance is a share of the sun's irradiance above
//! the atmosphere, at each wavelength of [`welkin_pack::air`].
//!
//! E. Bruneton, F. Neyret, "Precomputed Atmospheric Scattering", EGSR 2008; S. Hillaire, "A Scalable and
//! Production Ready Sky and Atmosphere Rendering Technique", EGSR 2020.

use std::f32::consts::PI;

use welkin_pack::air::{
    AEROSOL_ALBEDO, AEROSOL_RAYLEIGH, AEROSOL_SCALE_KM, COUNT, MOLECULE_SCALE_KM, OZONE_KM,
    Spectrum, aerosol, ozone, rayleigh, rayleigh_phase,
};

use super::geometry::{
    GROUND_KM, along, cosine, distance_to_ground, distance_to_top, horizon_sin, sun_above_horizon,
};
use super::table::Table;

/// Steps along a line of sight, and along a ray to the sun.
const VIEW_STEPS: usize = 28;
const SUN_STEPS: usize = 32;

/// Directions and steps of the estimate of multiple scattering: coarse, since its result is very smooth.
const MULTIPLE_RINGS: usize = 8;
const MULTIPLE_TURNS: usize = 4;
const MULTIPLE_STEPS: usize = 12;

/// What of the air is free to choose.
#[derive(Clone, Copy, Debug)]
pub(super) struct Settings {
    /// Optical depth of the aerosol to the zenith at 550 nm.
    pub aerosol_depth: f32,
    /// Share of light that the ground reflects.
    pub ground_albedo: f32,
    /// Ozone, as a multiple of 300 Dobson units.
    pub ozone: f32,
}

/// An atmosphere with its tables of sunlight.
pub(super) struct Atmosphere {
    /// Scattering at the ground.
    air: Spectrum,
    /// Absorption in the densest part of the layer.
    ozone: Spectrum,
    /// Extinction at the ground.
    haze: Spectrum,
    ground_albedo: f32,
    /// Share of the sun's light that reaches a place.
    transmittance: Table,
    /// Radiance of light scattered more than once, before the local coefficient of scattering.
    multiple: Table,
}

/// What a kilometre of the atmosphere does.
struct Medium {
    air: Spectrum,
    haze: Spectrum,
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

/// Light along a line of sight.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Seen {
    /// Radiance without the aureole.
    pub radiance: Spectrum,
    /// What the aureole's phase function is multiplied by.
    pub aureole: Spectrum,
}

impl Atmosphere {
    pub(super) fn new(settings: Settings) -> Atmosphere {
        let mut atmosphere = Atmosphere {
            air: rayleigh(),
            ozone: ozone().map(|o| o * settings.ozone),
            haze: aerosol(settings.aerosol_depth).map(|depth| depth / AEROSOL_SCALE_KM),
            ground_albedo: settings.ground_albedo,
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
                    haze: each(|c| spread[c] * medium.haze[c]),
                }
            },
        );
        Line {
            view,
            steps: steps.collect(),
        }
    }

    /// Light along a line, with the sun at the sine of an elevation and at an azimuth, by its cosine, from the line's.
    pub(super) fn seen(&self, line: &Line, sun_sin: f32, azimuth_cos: f32) -> Seen {
        let (mut radiance, mut aureole) = ([0.0; COUNT], [0.0; COUNT]);
        // The sun's part along the line's horizontal direction, and upwards.
        let sun = [cosine(sun_sin) * azimuth_cos, sun_sin];
        let phase = rayleigh_phase(line.view[0] * sun[0] + line.view[1] * sun[1]);
        for step in &line.steps {
            let (altitude, sun_here) = along(GROUND_KM, line.view, step.distance, sun);
            let direct = self.transmittance.read(altitude, sun_here);
            let more = self.multiple.read(altitude, sun_here);
            for c in 0..COUNT {
                radiance[c] += direct[c] * phase * (step.air[c] + AEROSOL_RAYLEIGH * step.haze[c])
                    + more[c] * (step.air[c] + step.haze[c]);
                aureole[c] += direct[c] * step.haze[c];
            }
        }
        Seen { radiance, aureole }
    }

    fn medium(&self, altitude: f32) -> Medium {
        let air_share = libm::expf(-altitude / MOLECULE_SCALE_KM);
        let haze_share = libm::expf(-altitude / AEROSOL_SCALE_KM);
        let [middle, half] = OZONE_KM;
        let ozone_share = (1.0 - (altitude - middle).abs() / half).max(0.0);
        let air = self.air.map(|a| a * air_share);
        let haze = self.haze.map(|h| h * haze_share);
        Medium {
            air,
            haze: haze.map(|h| AEROSOL_ALBEDO * h),
            // The floor only keeps `pass` from dividing by zero.
            extinction: each(|c| air[c] + haze[c] + self.ozone[c] * ozone_share + 1e-9),
        }
    }

    /// Transmittance from an altitude to the sun (Bruneton and Neyret 2008, eq. 2); 0 behind the Earth.
    pub(super) fn transmittance_along(&self, altitude: f32, sun_sin: f32) -> Spectrum {
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
            let spread: Spectrum = each(|c| spread[c] * (medium.air[c] + medium.haze[c]));
            light = each(|c| light[c] + spread[c] * direct[c] / (4.0 * PI));
            share = each(|c| share[c] + spread[c]);
        }
        if to_ground.is_some() {
            let (_, sun_there) = along(radius, view, length, sun);
            let lit = self.transmittance.read(0.0, sun_there);
            light = each(|c| {
                light[c] + through[c] * lit[c] * self.ground_albedo / PI * sun_there.max(0.0)
            });
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

#[cfg(test)]
mod tests {
    use welkin_pack::air::{CLEAR_AEROSOL_DEPTH, aureole_phase, sun_transmittance};

    use super::*;

    fn clear() -> Atmosphere {
        with_aerosol(CLEAR_AEROSOL_DEPTH)
    }

    fn with_aerosol(aerosol_depth: f32) -> Atmosphere {
        Atmosphere::new(Settings {
            aerosol_depth,
            ground_albedo: 0.2,
            ozone: 1.0,
        })
    }

    #[test]
    fn overhead_sun_is_dimmed_by_the_vertical_depth() {
        let atmosphere = clear();
        let found = atmosphere.transmittance_along(0.0, 1.0);
        for (c, found) in found.into_iter().enumerate() {
            // Exponential layers hold a scale height (the top cuts off e^-12.5 of one), a tent its half width.
            let depth = atmosphere.air[c] * MOLECULE_SCALE_KM
                + atmosphere.haze[c] * AEROSOL_SCALE_KM
                + atmosphere.ozone[c] * OZONE_KM[1];
            let expected = libm::expf(-depth);
            // The steps' midpoints miss less than 1 % of a depth below 0.4.
            assert!((found - expected).abs() < 0.004, "{c}: {found} {expected}");
        }
    }

    #[test]
    fn the_closed_form_of_sunlight_is_that_of_the_integral() {
        let atmosphere = clear();
        for degrees in [90.0_f32, 60.0, 30.0, 10.0, 5.0, 3.0] {
            let rad = degrees.to_radians();
            let integral = atmosphere.transmittance_along(0.0, libm::sinf(rad));
            let closed = sun_transmittance(rad, CLEAR_AEROSOL_DEPTH);
            for c in 0..COUNT {
                // Air masses know refraction and the real profile of the air, the integral knows an exponential without refraction: at 3
                // degrees their depths differ by some 2 %, more where the depth is 5.
                let bound = 0.02 + 0.06 * -libm::logf(integral[c].max(1e-6)) * 0.5;
                let off = libm::logf(closed[c] / integral[c]).abs();
                assert!(off < bound, "{degrees}, {c}: {} {}", closed[c], integral[c]);
            }
        }
    }

    #[test]
    fn no_light_from_below_the_horizon_and_less_from_a_lower_sun() {
        let atmosphere = clear();
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
    fn with_less_aerosol_the_sky_is_bluer() {
        let blue = |depth| {
            let atmosphere = with_aerosol(depth);
            let light = atmosphere.seen(&atmosphere.line(1.0), 0.7, 0.0);
            let whole = |c: usize| light.radiance[c] + light.aureole[c] * aureole_phase(0.7);
            whole(1) / whole(6)
        };
        assert!(blue(0.0) > blue(0.04) && blue(0.04) > blue(0.2));
        // Single scattering goes with the fourth power of the wavelength: (640 / 440)^4 = 4.5. Scattering
        // out of the line and again into it takes some of that back.
        assert!((3.0..4.5).contains(&blue(0.0)), "{}", blue(0.0));
    }

    #[test]
    fn scattered_light_never_exceeds_what_the_sun_sends() {
        let atmosphere = clear();
        for view in [0.0, 0.1, 0.5, 1.0] {
            let line = atmosphere.line(view);
            for sun in [-0.2, 0.0, 0.3, 0.9] {
                let light = atmosphere.seen(&line, sun, -0.5);
                // An even white dome of radiance 1/pi would light the ground as the sun itself does.
                assert!(
                    light
                        .radiance
                        .iter()
                        .all(|&l| (0.0..std::f32::consts::FRAC_1_PI).contains(&l)),
                    "{light:?}"
                );
                // All of the sun's light, scattered once, is the most that the aureole can have.
                assert!(
                    light.aureole.iter().all(|l| (0.0..=1.0).contains(l)),
                    "{light:?}"
                );
            }
        }
    }
}
