//! The five planets of a date, as stars that do not twinkle.
//!
//! # Theory
//! A planet is so bright that a tent of two pixels would be white whatever its light. It is drawn by the profile of A. F. J. Moffat, "A theoretical investigation of focal stellar
//! images in the photographic emulsion and application to photographic photometry", Astronomy and Astrophysics 3, 1969, `(1 + r^2 / a^2)^-b`, so that the brighter one is also the larger.
//! The radius a counts in pixels: on any screen it stays as small. Its sum over the pixels is the planet's light, by Pogson's law, where a star of the pack with an intensity of 1 is of magnitude 0.
//!
//! Colour goes from B-V to a temperature ([`welkin_pack::starlight`]) and from there to one between those of the stars.
//!
//! # Practice
//! Where they are on the screen is known to the CPU: a pixel of the night compares five distances.

use glam::{Vec3, Vec4};
use welkin_pack::starlight::{light_of_magnitude, temperature_k};

use crate::almanac::planets::{self, Planet};
use crate::almanac::refraction::lifted;
use crate::almanac::{Date, Place};
use crate::clear_sky::stars::{COLD, WARM};
use crate::geometry::camera::CameraUniforms;
use crate::geometry::part::{Part, Value};
use crate::geometry::uniforms::uniforms;

/// Its part of the shader.
pub const PART: Part = Part {
    constants: &[
        ("PLANET_SPREAD", Value::F32(1.0 / (RADIUS_PX * RADIUS_PX))),
        ("PLANET_REACH", Value::F32(REACH_PX * REACH_PX)),
    ],
    structs: &[PlanetUniforms::WGSL],
    wgsl: include_str!("planets.wgsl"),
};

uniforms! {
    /// The planets.
    PlanetUniforms {
        /// Pixel coordinates, and 1 if there is one; the last is what the profile ends at.
        places: [Vec4; 5],
        /// Radiance of the middle of each.
        lights: [Vec4; 5],
    }
}

/// The radius a of the profile, in pixels: as narrow as it may be and still have the same sum wherever it is between pixels, to a third of a hundredth.
pub const RADIUS_PX: f32 = 1.5;
/// Where it ends, in pixels: what is left of it there, 7 millionths of the middle, is taken off everywhere.
pub const REACH_PX: f32 = 16.0;

/// The profile where it ends.
pub fn end() -> f32 {
    (1.0 + REACH_PX * REACH_PX / (RADIUS_PX * RADIUS_PX)).powf(-2.5)
}

/// The sum of the profile over the pixels: its integral to where it ends.
fn sum() -> f32 {
    let (radius, reach) = (RADIUS_PX * RADIUS_PX, REACH_PX * REACH_PX);
    let whole = radius / 1.5 * (1.0 - (1.0 + reach / radius).powf(-1.5));
    std::f32::consts::PI * (whole - reach * end())
}

/// The colour of a B-V index, of about equal luminance.
pub fn colour(colour_index: f32) -> Vec3 {
    let kelvin = temperature_k(f64::from(colour_index)) as f32;
    // Those of 4000 and 12000 kelvin, by the reciprocal: so colours go evenly.
    let share = (1.0 / 4000.0 - 1.0 / kelvin) / (1.0 / 4000.0 - 1.0 / 12000.0);
    WARM.lerp(COLD, share.clamp(0.0, 1.0))
}

/// The planets' share of the uniforms; `one` is the radiance of a star of intensity 1 that falls on one pixel.
pub fn uniforms(
    moment: Option<(Date, Place)>,
    camera: &CameraUniforms,
    one: f32,
) -> PlanetUniforms {
    let mut planets = PlanetUniforms::default();
    let Some((date, place)) = moment.filter(|_| one > 0.0) else {
        return planets;
    };
    for (i, planet) in Planet::ALL.into_iter().enumerate() {
        let seen = planets::seen(planet, date, place);
        let direction = lifted(seen.direction).as_vec3();
        let Some(pixel) = camera.pixel_of(direction) else {
            continue;
        };
        let light = light_of_magnitude(seen.magnitude) as f32 * one / sum();
        planets.places[i] = Vec4::new(pixel.x, pixel.y, 1.0, end());
        planets.lights[i] = (colour(planet.colour_index()) * light).extend(0.0);
    }
    planets
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::camera::{self, Camera};

    #[test]
    fn the_pixels_of_a_planet_add_up_to_its_light_wherever_it_is_between_them() {
        for step in 0..25 {
            let middle = [0.2 * (step % 5) as f32, 0.2 * (step / 5) as f32];
            let mut found = 0.0;
            for i in 0..40 * 40 {
                let [x, y] = [i % 40, i / 40].map(|k| k as f32 - 20.0);
                let square = (x - middle[0]).powi(2) + (y - middle[1]).powi(2);
                if square < REACH_PX * REACH_PX {
                    found += (1.0 + square / (RADIUS_PX * RADIUS_PX)).powf(-2.5) - end();
                }
            }
            // The sum over magnitudes is to be right within 3 %.
            assert!((found / sum() - 1.0).abs() < 0.01, "{middle:?}: {found}");
        }
    }

    #[test]
    fn light_follows_magnitude_and_colour_the_index() {
        // The sun's B-V is 0.65 and its temperature 5772 K; Vega's 0.00 and some 9600 K (both within the fit's tenth).
        let share = |index: f32| (colour(index).x - WARM.x) / (COLD.x - WARM.x);
        let of = |kelvin: f32| (1.0 / 4000.0 - 1.0 / kelvin) / (1.0 / 4000.0 - 1.0 / 12000.0);
        assert!((share(0.65) - of(5772.0)).abs() < 0.05);
        assert!((share(0.0) - of(9600.0)).abs() < 0.1);
        assert!(share(1.43) < share(0.81));
    }

    #[test]
    fn jupiter_is_where_the_almanac_has_it_and_planets_below_are_not_drawn() {
        // Jupiter at its opposition of January 2026, high in the south at midnight.
        let date: Date = "2026-01-10T00:00:00Z".parse().unwrap();
        let place = Place {
            latitude_deg: 40.0,
            longitude_deg: 0.0,
        };
        let jupiter = planets::seen(Planet::Jupiter, date, place);
        let seen = lifted(jupiter.direction).as_vec3();
        let view = Camera::looking(seen.x.atan2(-seen.z), seen.y.asin(), 0.5, [640, 480]);
        let found = uniforms(Some((date, place)), &camera::uniforms(&view), 2.0);
        let at = found.places[3];
        assert!(
            (at.x - 320.0).abs() < 0.5 && (at.y - 240.0).abs() < 0.5,
            "{at}"
        );
        let wanted = 2.0 * 10.0_f32.powf(-0.4 * jupiter.magnitude as f32) / sum();
        let light = found.lights[3] / colour(Planet::Jupiter.colour_index()).extend(1.0);
        assert!((light.y / wanted - 1.0).abs() < 1e-4);
        // Venus and Mars stand by the sun then.
        for below in [1, 2] {
            assert_eq!(found.places[below].z, 0.0);
        }
    }
}
