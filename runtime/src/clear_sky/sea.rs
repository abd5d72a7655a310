//! A sea below the horizon, in place of the ground, seen through the air.
//!
//! # Theory
//! The surface of a sea is made of facets whose slopes are normally distributed, the wider the stronger the wind (C. Cox, W. Munk, "Measurement of
//! the Roughness of the Sea Surface from Photographs of the Sun's Glitter", 1954: the mean square of slopes is `0.003 + 0.00512 U` at U m/s). A
//! viewer sees the facets that lean towards him the larger; with `c` and `s` cosine and sine of his direction to the vertical, `d` the deviation of
//! slopes along one axis, and `x = c / (d s)`, the area that he sees over the area of the sea is `D = c Phi(x) + d s phi(x)`, and the mean slope of what
//! he sees `d^2 s Phi(x) / D` (Phi and phi the normal distribution and its density; B. G. Smith, "Geometrical Shadowing of a Random Rough Surface",
//! 1967, is about such areas). Facets reflect by Fresnel's law, in the form of C. Schlick, "An Inexpensive BRDF Model for Physically-based
//! Rendering", 1994, with the 0.02 of water.
//!
//! - The sky comes by two facets, a little flatter and a little steeper than that mean one.
//! - The sun comes by the facets that lean half way to it: the glitter, `E F p / (4 h^4 (D + c L))` with the density `p` of their slope, the height
//!   `h` of their normal, and `L = D / c - 1` in the sun's direction, for what of it one facet hides from another (E. Bruneton, F. Neyret, N.
//!   Holzschuch, "Real-time Realistic Ocean Lighting using Seamless Transitions from Geometry to BRDF", 2010).
//! - What is not reflected enters, and comes back as the blue of clear water.
//! - Between the sea and the viewer is the air of [`super::ground`].
//!
//! # Changes
//! Near by, single waves are seen: noise of the clouds' texture, read three times, leans the facets to and fro, and they have that much less of the
//! slopes. A noise of the ground makes patches of stronger and weaker wind. Both by eye.
//!
//! Clouds are seen in it by their mean: waves smear each over so much of the sea that no shape is left. The sun's glitter goes as the sun does behind
//! a cloud. Stars are not seen in it.
//!
//! # Practice
//! A shader of its own, for frames with a sea alone. Below the horizon four reads of noise and four of the sky, and those of the clouds before the sun.

use glam::{DVec2, Vec2, Vec3};

use crate::clear_sky::ground::GroundUniforms;
use crate::geometry::part::{Part, Value};
use crate::geometry::uniforms::uniforms;

/// Its part of the shader.
pub const PART: Part = Part {
    constants: &[
        ("SEA_FINER", Value::Vec3(Vec3::from_array(FINER))),
        ("SEA_ACROSS", Value::Vec3(Vec3::from_array(ACROSS))),
        ("SEA_SHARES", Value::Vec3(Vec3::from_array(SHARES))),
        ("SEA_SEEN", Value::Vec2(SEEN)),
        ("SEA_SPREAD", Value::F32(SPREAD)),
        ("SEA_LEAST_RISE", Value::F32(LEAST_RISE)),
        ("SEA_GUSTS", Value::F32(GUSTS)),
        ("SEA_WATER", Value::F32(WATER)),
    ],
    structs: &[SeaUniforms::WGSL],
    wgsl: include_str!("sea.wgsl"),
};

uniforms! {
    /// The sea below the horizon.
    SeaUniforms {
        /// A quarter of the irradiance of a plane that faces sun or moon.
        sun: Vec3,
        /// Standard deviation of slopes along one axis.
        deviation: f32,
        /// Radiance of what comes back out of the water.
        body: Vec3,
        /// How much softer than by a pixel clouds before the sun are seen in it.
        softer: f32,
        /// Radiance of clouds by skylight.
        cloud_skylit: Vec3,
        /// Their mean opacity.
        cloud_opacity: f32,
        /// What of sunlight they send is multiplied by.
        cloud_sunlit: Vec3,
        /// Slope, for each 1 that the waves lie over their mean.
        ripple: f32,
        /// Where the reads of the waves lie, in tiles: long ones, short ones.
        long_drift: Vec2,
        short_drift: Vec2,
        /// Halvings of sunlight on the way to a middling cloud, and its height.
        middling: Vec2,
        /// How much more of the sun's light facets would take than comes to the sea, were they not in each other's way.
        sun_hidden: f32,
        /// Nothing.
        _pad: f32,
    }
}

/// Wind over the sea at waves of 0 and 1, in metres a second.
const WIND_M_S: [f32; 2] = [1.0, 15.0];
/// The mean square of slopes without wind, and what a metre a second adds: Cox and Munk, above.
const SLOPES: [f32; 2] = [0.003, 0.00512];
/// How much finer than the noise's tile of the ground the waves are read, along and across their crests: long, short, ripples. Whole numbers: places
/// are reduced by whole tiles.
pub const FINER: [f32; 3] = [17.0, 59.0, 157.0];
pub const ACROSS: [f32; 3] = [31.0, 101.0, 251.0];
/// What each of them adds to slopes.
pub const SHARES: [f32; 3] = [0.9, 1.0, 0.9];
/// How far long and short ones go, in tiles of the ground a second: waves of 30 m go 7 m/s (`sqrt(g lambda / 2 pi)`), shorter ones less.
const DRIFT: [DVec2; 2] = [DVec2::new(0.0005, 0.0012), DVec2::new(-0.0003, 0.0006)];
/// Slope, in deviations, for each 1 that the waves lie over their mean: by eye.
const RIPPLE: f32 = 2.6;
/// Share of the slopes that is left to facets where single waves are seen, and the levels of detail of the ripples over which they go out of sight.
pub const SEEN: [f32; 2] = [0.5, 7.0];
/// How much steeper waves are for each 1 that the noise of the ground lies over its mean: patches of wind. By eye.
pub const GUSTS: f32 = 1.6;
/// How far the two facets by which the sky comes are from the mean one, in deviations.
pub const SPREAD: f32 = 0.7;
/// The least sine of elevation of what is reflected: lower comes from other waves.
pub const LEAST_RISE: f32 = 0.01;
/// Share that water reflects straight down.
pub const WATER: f32 = 0.02;
/// Share of the light that clear water gives back, red, green, blue: some 2 % of blue light and a tenth of that of red, about as in A. Morel, S.
/// Maritorena, "Bio-optical properties of oceanic waters: A reappraisal", 2001; rounded.
const BODY: Vec3 = Vec3::new(0.002, 0.009, 0.02);
/// How soft clouds before the sun are, in deviations of slopes.
const SOFT: f32 = 1.5;

/// The clouds that a sea mirrors.
#[derive(Clone, Copy, Debug)]
pub struct SeaClouds {
    /// Mean opacity.
    pub opacity: f32,
    /// Radiance by skylight.
    pub skylit: Vec3,
    /// What the share of sunlight that a middling cloud sends is multiplied by.
    pub sunlit: Vec3,
    /// Halvings of sunlight on the way to a middling cloud, and its height.
    pub middling: Vec2,
}

/// What the sea is computed from.
pub struct SeaLight {
    /// Irradiance over pi by the sky.
    pub sky: Vec3,
    /// Radiance of a white surface that faces sun or moon.
    pub sun: Vec3,
    /// Sine of its elevation.
    pub sun_sin: f32,
    /// What it mirrors beside the sky.
    pub clouds: SeaClouds,
}

/// The sea's share of the uniforms, for waves from 0 to 1.
pub fn uniforms(light: SeaLight, waves: f32, seconds: f64, pixel_rad: f32) -> SeaUniforms {
    let wind = WIND_M_S[0] + (WIND_M_S[1] - WIND_M_S[0]) * waves;
    let deviation = (0.5 * (SLOPES[0] + SLOPES[1] * wind)).sqrt();
    let drift = |index: usize| {
        let times = DVec2::new(FINER[index].into(), ACROSS[index].into());
        let way = DRIFT[index] * times * seconds;
        (way - way.floor()).as_vec2()
    };
    SeaUniforms {
        sun: light.sun * (0.25 * std::f32::consts::PI),
        deviation,
        body: BODY * (light.sky + light.sun * light.sun_sin.max(0.0)),
        softer: SOFT * deviation / pixel_rad.max(1e-9),
        cloud_skylit: light.clouds.skylit,
        cloud_opacity: light.clouds.opacity,
        cloud_sunlit: light.clouds.sunlit,
        ripple: RIPPLE * deviation,
        long_drift: drift(0),
        short_drift: drift(1),
        middling: light.clouds.middling,
        sun_hidden: {
            let sine = light.sun_sin.clamp(1e-3, 1.0);
            let flat = (1.0 - sine * sine).max(1e-6).sqrt();
            Facets::seen(deviation, sine, flat).area / sine - 1.0
        },
        _pad: 0.0,
    }
}

/// What a viewer sees of facets.
struct Facets {
    /// Area over that of the sea.
    area: f32,
    /// Mean slope towards him.
    lean: f32,
}

impl Facets {
    /// For a direction of this sine below the horizon, and that to the vertical: `sea_facets` of the shader.
    fn seen(deviation: f32, down: f32, flat: f32) -> Facets {
        let x = down / (deviation * flat);
        let density = 0.398_942_3 * (-0.5 * x * x).exp();
        let share = 1.0 / (1.0 + (-1.702 * x).exp());
        let over = x * share + density;
        Facets {
            area: deviation * flat * over,
            lean: deviation * share / over,
        }
    }
}

/// Schlick's form of Fresnel's law for water, by the cosine to the facet.
fn fresnel(cosine: f32) -> f32 {
    WATER + (1.0 - WATER) * (1.0 - cosine).clamp(0.0, 1.0).powi(5)
}

impl SeaUniforms {
    /// What is seen along a direction below the horizon, without single waves and glitter: `sea_seen` of the shader. `horizon` is the sky's radiance
    /// there, `above` that at a sine of elevation above that point of the horizon.
    pub fn seen(
        &self,
        ground: &GroundUniforms,
        horizon: Vec3,
        direction: Vec3,
        above: impl Fn(f32) -> Vec3,
    ) -> Vec3 {
        let down = (-direction.y).max(1e-6);
        let flat = (1.0 - down * down).max(1e-6).sqrt();
        let facets = Facets::seen(self.deviation, down, flat);
        let (mut reflected, mut share) = (Vec3::ZERO, 0.0);
        for side in [-SPREAD, SPREAD] {
            let slope = facets.lean + side * self.deviation;
            let up = 1.0 / (1.0 + slope * slope).sqrt();
            let cosine = ((down + slope * flat) * up).max(0.0);
            let rise = (2.0 * cosine * up - down).clamp(LEAST_RISE, 1.0);
            let own = 0.5 * fresnel(cosine);
            reflected += own * above(rise);
            share += own;
        }
        let lit = reflected + self.body * (1.0 - share);
        horizon + (lit - horizon) * through(ground, down)
    }

    /// The glitter: radiance times solid angle, and the unit direction from the viewer in which it lies, for slopes from all sides. The narrower it is, the
    /// denser they lie, so that a low sun's needs no more of them.
    pub fn glitter(
        &self,
        ground: &GroundUniforms,
        sun: Vec3,
    ) -> impl Iterator<Item = (Vec3, Vec3)> {
        let step = 2.0 * FARTHEST_SLOPE / SLOPES_A_SIDE as f32;
        let at = move |i: usize| (i as f32 + 0.5) * step - FARTHEST_SLOPE;
        let slopes = (0..SLOPES_A_SIDE * SLOPES_A_SIDE)
            .map(move |i| Vec2::new(at(i % SLOPES_A_SIDE), at(i / SLOPES_A_SIDE)));
        let light = 4.0 * self.sun * (step * step / std::f32::consts::TAU);
        slopes.filter_map(move |z| {
            let slope = self.deviation * z;
            let up = 1.0 / (1.0 + slope.length_squared()).sqrt();
            let normal = Vec3::new(-slope.x, 1.0, -slope.y) * up;
            let cosine = normal.dot(sun);
            let to_viewer = 2.0 * cosine * normal - sun;
            if cosine <= 0.0 || to_viewer.y <= 1e-4 {
                return None;
            }
            let down = to_viewer.y;
            let flat = (1.0 - down * down).max(1e-6).sqrt();
            let area = Facets::seen(self.deviation, down, flat).area + self.sun_hidden * down;
            // `d omega = 4 cosine up^3` times what the slopes span.
            let share = fresnel(cosine) * (-0.5 * z.length_squared()).exp() * cosine / (up * area);
            Some((light * share * through(ground, down), -to_viewer))
        })
    }
}

/// What the air leaves of light that comes up from this sine below the horizon.
fn through(ground: &GroundUniforms, down: f32) -> Vec3 {
    (-ground.depth / down).map(f32::exp2)
}

/// Slopes of the glitter a side, and how far they go, in deviations.
const SLOPES_A_SIDE: usize = 16;
const FARTHEST_SLOPE: f32 = 3.2;

#[cfg(test)]
mod tests {
    use super::*;

    const NO_CLOUDS: SeaClouds = SeaClouds {
        opacity: 0.0,
        skylit: Vec3::ZERO,
        sunlit: Vec3::ZERO,
        middling: Vec2::ZERO,
    };

    /// Numerically, over slopes along one axis.
    fn integrated(deviation: f32, down: f32, flat: f32) -> Facets {
        let (mut area, mut lean) = (0.0_f64, 0.0_f64);
        let step = 1e-3_f64;
        for i in -8000..8000 {
            let z = f64::from(i) * step;
            let slope = z * f64::from(deviation);
            let seen = (f64::from(down) + slope * f64::from(flat)).max(0.0);
            let weight = seen * (-0.5 * z * z).exp() / std::f64::consts::TAU.sqrt() * step;
            area += weight;
            lean += weight * slope;
        }
        Facets {
            area: area as f32,
            lean: (lean / area) as f32,
        }
    }

    #[test]
    fn facets_are_those_of_the_integral() {
        for deviation in [0.06, 0.12, 0.2] {
            for down in [0.001_f32, 0.02, 0.1, 0.3, 0.7, 0.99] {
                let flat = (1.0 - down * down).sqrt();
                let (found, expected) = (
                    Facets::seen(deviation, down, flat),
                    integrated(deviation, down, flat),
                );
                // The logistic form of the distribution is within 0.01 of it.
                assert!(
                    (found.area / expected.area - 1.0).abs() < 0.02,
                    "{deviation} {down}: {} {}",
                    found.area,
                    expected.area
                );
                assert!(
                    (found.lean - expected.lean).abs() < 0.02 * deviation,
                    "{deviation} {down}: {} {}",
                    found.lean,
                    expected.lean
                );
            }
        }
    }

    /// The share of a beam that the surface reflects, by facets of a Gaussian sea under Fresnel's own law (refractive index 1.34), one reflection each;
    /// what is reflected downwards meets the sea again, and is taken for lost.
    fn reflected(deviation: f64, sun: glam::DVec3) -> f64 {
        let (mut light, mut all) = (0.0, 0.0);
        let steps = 240;
        for i in 0..steps * steps {
            let z = [i % steps, i / steps]
                .map(|i| 8.0 * ((f64::from(i) + 0.5) / f64::from(steps) - 0.5));
            let weight = (-0.5 * (z[0] * z[0] + z[1] * z[1])).exp();
            let steep = glam::DVec3::new(-deviation * z[0], 1.0, -deviation * z[1]);
            // Area over that of the sea, as the sun sees it.
            let meets = steep.dot(sun).max(0.0) * weight;
            let normal = steep.normalize();
            let cosine = normal.dot(sun);
            all += meets;
            if cosine <= 0.0 || (2.0 * cosine * normal - sun).y <= 0.0 {
                continue;
            }
            let inner = (1.0 - (1.0 - cosine * cosine) / (1.34 * 1.34)).sqrt();
            let across = (cosine - 1.34 * inner) / (cosine + 1.34 * inner);
            let along = (1.34 * cosine - inner) / (1.34 * cosine + inner);
            light += meets * 0.5 * (across * across + along * along);
        }
        light / all
    }

    /// The glitter, added up over all directions, is what such facets reflect of the beam.
    #[test]
    fn glitter_is_the_light_that_facets_reflect() {
        let ground = GroundUniforms::default();
        for (waves, sun_deg) in [
            (0.3, 60.0_f32),
            (0.3, 30.0),
            (0.3, 10.0),
            (0.3, 3.0),
            (1.0, 45.0),
            (1.0, 8.0),
        ] {
            let sun = Vec3::new(sun_deg.to_radians().cos(), sun_deg.to_radians().sin(), 0.0);
            let light = SeaLight {
                sky: Vec3::ZERO,
                sun: Vec3::ONE,
                sun_sin: sun.y,
                clouds: NO_CLOUDS,
            };
            let mut sea = uniforms(light, waves, 0.0, 1e-3);
            sea.body = Vec3::ZERO;
            let lights = sea.glitter(&ground, sun);
            let sum: f64 = lights
                .map(|(light, from)| f64::from(-light.x * from.y))
                .sum();
            // A white plane that faces the sun has a radiance of 1: pi of irradiance.
            let found = sum / (std::f64::consts::PI * f64::from(sun.y));
            let expected = reflected(f64::from(sea.deviation), sun.as_dvec3());
            println!("{waves} {sun_deg}: {found:.4}, expected {expected:.4}");
            // Schlick's form is a fifth below Fresnel's law at 45 degrees, and facets in each other's way are counted on average.
            assert!(
                (found / expected - 1.0).abs() < 0.25,
                "{waves} {sun_deg}: {found} {expected}"
            );
        }
    }

    #[test]
    fn waves_drift_within_a_tile_for_ever() {
        let light = || SeaLight {
            sky: Vec3::ONE,
            sun: Vec3::ONE,
            sun_sin: 0.5,
            clouds: NO_CLOUDS,
        };
        for seconds in [-1e12, -3.0, 0.0, 1e9] {
            let sea = uniforms(light(), 0.5, seconds, 1e-3);
            for drift in [sea.long_drift, sea.short_drift] {
                assert!(drift.cmpge(Vec2::ZERO).all() && drift.cmple(Vec2::ONE).all());
            }
        }
    }
}
