//! Sun and sky as light sources, by the time of day: computed once a frame.
//!
//! # Theory
//! Sunlight is what the air leaves of it: `exp(-tau m)` with the optical depths of molecules, ozone and
//! haze over the relative air mass m of F. Kasten, A. T. Young, "Revised optical air mass tables and
//! approximation formula", Applied Optics 28(22), 1989, eq. 3. The light of the sky is the mean radiance
//! of the pack's own day gradient, so that the clouds of a pack belong to its sky.
//!
//! # Changes versus the paper
//! The paper's `amount_sunlight` is one number (line 28). Here it is two colours, sunlight and skylight.
//!
//! # Practice
//! Some 64 texels and a few exponentials a frame.

use glam::Vec3;
use welkin_pack::{Image, mapping};

use crate::geometry::math::smoothstep;
use crate::geometry::part::{Part, Value};

/// Its part of the shader.
pub const PART: Part = Part {
    constants: &[("LUMINANCE", Value::Vec3(LUMINANCE))],
    structs: &[],
    wgsl: "",
};

/// Optical depth of the air's molecules to the zenith at 680, 550 and 440 nm: the scattering
/// coefficients 5.802, 13.558, 33.1 per 1000 km times the scale height 8 km.
/// S. Hillaire, "A Scalable and Production Ready Sky and Atmosphere Rendering Technique", EGSR 2020, table 1.
const RAYLEIGH_DEPTH: Vec3 = Vec3::new(0.0464, 0.1085, 0.2648);

/// Optical depth of ozone: 0.650, 1.881, 0.085 per 1000 km over a tent of 15 km (same table).
const OZONE_DEPTH: Vec3 = Vec3::new(0.0098, 0.0282, 0.0013);

/// Optical depth of haze, the same for all colours: a clear day has about 0.1.
const HAZE_DEPTH: f32 = 0.08;

/// Clouds stand above the densest air: the longest path that light takes to them, in air masses.
const MAX_AIR_MASS: f32 = 9.0;

/// How bright sunlit white is beside the light of the sky at noon; both together make about 1.
const NOON_SUNLIGHT: f32 = 0.78;

/// Light at one time of day. Colours are linear BT.709, 1 is the white of a sunlit cloud at noon.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Light {
    /// Unit direction towards the sun.
    pub sun_direction: Vec3,
    /// What the air leaves of the sun's light, relative to noon; black once the sun is well down.
    pub sunlight: Vec3,
    /// Mean radiance of the clear sky.
    pub skylight: Vec3,
    /// Share of the night sky that shows, 0 by day.
    pub night: f32,
}

impl Light {
    /// The light at `time` (0..1) under the sky gradient of a pack.
    pub fn new(sky: &Image, noon_elevation_rad: f32, time: f32) -> Light {
        let sun_direction = Vec3::from(mapping::sun_direction(time, noon_elevation_rad));
        let noon = transmittance(noon_elevation_rad);
        let strength = NOON_SUNLIGHT * daylight(sun_direction.y);
        let (skylight, night) = sky_column(sky, time);
        let elevation_rad = sun_direction.y.clamp(-1.0, 1.0).asin();
        let sunlight = adapted(transmittance(elevation_rad) / noon) * strength;
        Light {
            sun_direction,
            sunlight,
            skylight,
            night,
        }
    }
}

/// Relative air mass at an elevation: 1 at the zenith, nine (`MAX_AIR_MASS`) at and below the horizon.
/// Kasten and Young 1989, eq. 3 (elevation in degrees).
pub fn air_mass(elevation_rad: f32) -> f32 {
    let degrees = elevation_rad.to_degrees().max(0.0);
    let sin = degrees.to_radians().sin();
    (1.0 / (sin + 0.50572 * (degrees + 6.07995).powf(-1.6364))).min(MAX_AIR_MASS)
}

/// Share of sunlight that reaches the clouds, for red, green and blue.
pub fn transmittance(elevation_rad: f32) -> Vec3 {
    let depth = (RAYLEIGH_DEPTH + OZONE_DEPTH + HAZE_DEPTH) * air_mass(elevation_rad);
    Vec3::new((-depth.x).exp(), (-depth.y).exp(), (-depth.z).exp())
}

/// The eye adapts: of the dimming at a low sun only the square root of the luminance is kept.
fn adapted(colour: Vec3) -> Vec3 {
    colour / luminance(colour).max(1e-6).sqrt()
}

/// How much of the sun's disc lights the clouds, over the sine of its elevation: from 0 (5 degrees under
/// the horizon, where clouds at 3 km lose it) to 1.
fn daylight(sin_elevation: f32) -> f32 {
    smoothstep(-0.09, 0.12, sin_elevation)
}

/// Mean radiance over the hemisphere and night share of one column.
fn sky_column(sky: &Image, time: f32) -> (Vec3, f32) {
    let [column, _] = mapping::sky_to_texel(time, 0.0, sky.width, sky.height);
    let (left, share) = (column.floor(), column - column.floor());
    let at = |row: u32| {
        let a = sky.texel(left as u32 % sky.width, row);
        let b = sky.texel((left as u32 + 1) % sky.width, row);
        [0, 1, 2, 3].map(|c| a[c] + (b[c] - a[c]) * share)
    };
    let (mut sum, mut weights) = (Vec3::ZERO, 0.0);
    for row in 0..sky.height {
        // Rows are even in the root of the sine, and solid angle is even in the sine: d sin = 2 root d root.
        let weight = row as f32;
        let [r, g, b, _] = at(row);
        sum += Vec3::new(r, g, b) * weight;
        weights += weight;
    }
    let [.., night] = at(0);
    (sum / weights.max(1.0), night.clamp(0.0, 1.0))
}

/// What red, green and blue of linear BT.709 add to luminance. ITU-R BT.709-6, 2015, item 3.2.
pub const LUMINANCE: Vec3 = Vec3::new(0.2126, 0.7152, 0.0722);

/// Luminance of linear BT.709.
pub fn luminance(colour: Vec3) -> f32 {
    colour.dot(LUMINANCE)
}

/// The full moon's light on clouds as the eye, adapted to the night, sees it: grey with a breath of blue.
pub(crate) const MOONLIGHT: Vec3 = Vec3::new(0.080, 0.090, 0.110);

/// Sines of the sun's elevation between which the moon takes over: the sun's last light on clouds is gone at -0.09.
const MOONRISE: [f32; 2] = [-0.10, -0.24];

/// The light that clouds get: the sun's, or the full moon's, which stands opposite.
pub fn luminary(light: &Light, moon: f32) -> Light {
    if light.sun_direction.y > MOONRISE[0] {
        return *light;
    }
    let up = 1.0 - smoothstep(MOONRISE[1], MOONRISE[0], light.sun_direction.y);
    Light {
        sun_direction: -light.sun_direction,
        sunlight: MOONLIGHT * (moon * up),
        ..*light
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn air_mass_is_that_of_the_tables() {
        // Kasten and Young 1989, table II: 1.9939 at 30 degrees, 5.5841 at 10 degrees.
        assert!((air_mass(std::f32::consts::FRAC_PI_2) - 1.0).abs() < 1e-3);
        assert!((air_mass(30_f32.to_radians()) - 1.9939).abs() < 2e-3);
        assert!((air_mass(10_f32.to_radians()) - 5.5841).abs() < 1e-2);
    }

    #[test]
    fn sunlight_reddens_and_dims_towards_the_horizon() {
        let mut last = transmittance(1.5);
        for degrees in (0..85).rev().step_by(5) {
            let now = transmittance((degrees as f32).to_radians());
            assert!(now.cmple(last).all(), "brighter at {degrees}");
            assert!(now.x / now.z >= last.x / last.z, "less red at {degrees}");
            last = now;
        }
    }

    #[test]
    fn noon_lights_white_and_midnight_not_at_all() {
        let sky = Image {
            width: 2,
            height: 2,
            channels: 4,
            texels: vec![0.2; 16],
        };
        let noon = Light::new(&sky, 1.0, 0.5);
        assert!(
            (noon.sunlight - Vec3::splat(NOON_SUNLIGHT))
                .abs()
                .max_element()
                < 1e-3
        );
        assert!((noon.skylight - Vec3::splat(0.2)).abs().max_element() < 1e-6);
        assert_eq!(Light::new(&sky, 1.0, 0.0).sunlight, Vec3::ZERO);
    }
}
