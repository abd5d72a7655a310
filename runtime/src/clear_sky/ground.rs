//! The ground below the horizon, seen through the air.
//!
//! # Theory
//! What falls on a ground of an albedo leaves it as `L = albedo E / pi` where it is skylight. Sunlight is cast back by blades, clods and stones
//! that stand up from it: by the law of Lommel and Seeliger, `L ~ mu0 / (mu0 + mu)` with the cosines of sun and viewer to the vertical (H. Seeliger,
//! "Zur Photometrie zerstreut reflectirender Substanzen", 1888), so that a low sun still lights a meadow that is looked along. Between ground and viewer
//! air takes some of that and adds its own light, which at the horizon is the sky's: `L T + L_horizon (1 - T)`, `T = exp(-sigma d)`
//! (H. Koschmieder, "Theorie der horizontalen Sichtweite", 1924). So a viewer near the ground sees a line where the sky begins, and from
//! high up the ground fades into the sky.
//!
//! # Changes
//! Towards the sun the ground shows its shaded side and away from it its lit one: a factor from 1 - [`BACKSCATTER`] to 1 + [`BACKSCATTER`], chosen.
//! Its albedo varies with the detail of the clouds' texture, read twice: in patches of fields and woods, the brighter the redder, as dry grass and bare
//! soil are, and [`FINER`] times finer in them. Both fade to the mean with distance.
//! The distance is that of a plane; where the earth would curve away, air hides it for a viewer below some kilometres.
//!
//! # Practice
//! Two reads, an exponential and a division a pixel below the horizon. An application that draws its own ground covers it.

use glam::{DVec2, DVec3, Vec2, Vec3};
use welkin_pack::air::{AEROSOL_SCALE_KM, Colour, MOLECULE_SCALE_KM, aerosol, rayleigh};

use crate::geometry::math::{luminance, smoothstep};
use crate::geometry::part::{Part, Value};
use crate::geometry::uniforms::uniforms;

/// Its part of the shader.
pub const PART: Part = Part {
    constants: &[
        ("GROUND_MOTTLING", Value::Vec3(MOTTLING)),
        ("GROUND_FINER", Value::F32(FINER)),
        ("GROUND_FINER_LEVEL", Value::Log2(FINER)),
        ("GROUND_BACKSCATTER", Value::F32(BACKSCATTER)),
    ],
    structs: &[GroundUniforms::WGSL],
    wgsl: include_str!("ground.wgsl"),
};

uniforms! {
    /// The ground below the horizon.
    GroundUniforms {
        /// Its radiance by skylight.
        skylit: Vec3,
        /// Tiles of the texture of noise that the viewer's height is.
        height_tiles: f32,
        /// What the air takes on the way straight down, as a power of two.
        depth: Vec3,
        /// Level of detail of the noise straight below.
        lod: f32,
        /// Texture coordinates of the place below the viewer.
        place: Vec2,
        /// Mean of the noise.
        mean: f32,
        /// Sine of the elevation of sun or moon, and a little, so that it is no divisor of 0.
        sun_sin: f32,
        /// Its radiance by sunlight where the law of Lommel and Seeliger is 1.
        sunlit: Vec3,
        /// How much brighter it is for each 1 that the second read lies over the mean.
        finer_mottling: f32,
    }
}

/// The lowest viewer over the ground, in metres: on a hill, from where the land fades into the air over a degree.
const LEAST_HEIGHT_M: f32 = 60.0;

/// Side of a tile of the noise on the ground, in metres.
const TILE_M: f64 = 5000.0;
/// How much brighter than its mean the ground is for each 1 that the noise lies over its own: red, green, blue. Chosen by eye, as is the finer one.
pub const MOTTLING: Vec3 = Vec3::new(1.2, 1.05, 0.85);
/// How much finer the second read is. A whole number: places are reduced by whole tiles.
pub const FINER: f32 = 23.0;
/// How much brighter the ground is for each 1 that the second read lies over the mean.
const FINER_MOTTLING: f32 = 1.2;
/// Heights of the viewer up to which all of that is seen, and from which nothing: from higher up one sees its tiles.
const FINER_UP_TO_M: [f32; 2] = [200.0, 1000.0];

/// How much brighter than its mean the ground is away from the sun, and darker towards it.
pub const BACKSCATTER: f32 = 0.4;

/// What the ground's pattern is read from.
#[derive(Clone, Copy, Debug)]
pub struct Noise {
    /// Texels a side.
    pub texels: u32,
    /// Mean of its values.
    pub mean: f32,
}

/// What lights the ground.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GroundLight {
    /// Irradiance over pi by the sky.
    pub sky: Vec3,
    /// Radiance of a white surface that faces the sun.
    pub sun: Vec3,
    /// Sine of the sun's elevation.
    pub sun_sin: f32,
    /// Share of the sky that clouds shut: air in their shade is grey.
    pub shut: f32,
}

/// The ground's share of the uniforms: its albedo, what lights it, the viewer's place over it, and the aerosol's optical depth.
pub fn uniforms(
    albedo: Vec3,
    light: GroundLight,
    noise: Noise,
    place_m: DVec3,
    pixel_rad: f32,
    aerosol_depth: f32,
) -> GroundUniforms {
    let height_m = (place_m.y as f32).max(LEAST_HEIGHT_M);
    let km = height_m * 1e-3;
    let height_tiles = height_m / TILE_M as f32;
    let place = DVec2::new(place_m.x, place_m.z) / TILE_M;
    // Exponential layers: what is above the viewer does not count.
    let below = |scale_km: f32| scale_km * (1.0 - (-km / scale_km).exp());
    let [molecules, particles] = extinctions_per_km(aerosol_depth, light.shut);
    let depth = molecules * below(MOLECULE_SCALE_KM) + particles * below(AEROSOL_SCALE_KM);
    GroundUniforms {
        skylit: albedo * light.sky,
        height_tiles,
        depth: depth * std::f32::consts::LOG2_E,
        lod: (pixel_rad * height_tiles * noise.texels as f32).log2(),
        place: (place - place.floor()).as_vec2(),
        mean: noise.mean,
        sun_sin: light.sun_sin.max(1e-3),
        sunlit: albedo * light.sun * light.sun_sin.max(0.0),
        finer_mottling: FINER_MOTTLING
            * (1.0 - smoothstep(FINER_UP_TO_M[0], FINER_UP_TO_M[1], height_m)),
    }
}

impl GroundUniforms {
    /// What is seen along a direction below the horizon, without the pattern: `ground_seen` of the shader. `horizon` is the sky's radiance.
    pub fn seen(&self, horizon: Vec3, direction: Vec3, sun: Vec3) -> Vec3 {
        let away = 1.0 / (-direction.y).max(1e-6);
        let facing = 1.0 - BACKSCATTER * direction.dot(sun);
        let lit = self.skylit + self.sunlit * (facing / (self.sun_sin - direction.y));
        let through = (-self.depth * away).map(f32::exp2);
        horizon + (lit - horizon) * through
    }
}

/// Extinction at the ground by molecules and by the aerosol, 1 / km; under a sky that is shut, grey.
pub(crate) fn extinctions_per_km(aerosol_depth: f32, shut: f32) -> [Vec3; 2] {
    let aerosol = extinction(aerosol(aerosol_depth)) / AEROSOL_SCALE_KM;
    [extinction(rayleigh()), aerosol].map(|e| e.lerp(Vec3::splat(luminance(e)), shut))
}

/// A coefficient of red, green and blue: the mean over the wavelengths, weighed by what they add to each in white light.
fn extinction(spectrum: welkin_pack::air::Spectrum) -> Vec3 {
    let colour = Colour::daylight();
    // A thin layer: of 1 - T the slope at nothing is the coefficient.
    let thin = 1e-2;
    let through = Vec3::from(colour.rgb(&spectrum.map(|s| 1.0 - thin * s)));
    let white = Vec3::from(colour.rgb(&[1.0; welkin_pack::air::COUNT]));
    ((white - through) / white / thin).max(Vec3::ZERO)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn air_takes_blue_first_and_more_from_higher_up() {
        let noise = Noise {
            texels: 512,
            mean: 0.5,
        };
        let at = |height_m: f32, depth| {
            let place = DVec3::new(0.0, f64::from(height_m), 0.0);
            let light = GroundLight {
                sky: Vec3::ONE,
                sun: Vec3::ONE,
                sun_sin: 0.5,
                shut: 0.0,
            };
            uniforms(Vec3::ONE, light, noise, place, 1e-3, depth).depth
        };
        let low = at(100.0, 0.04);
        assert!(low.z > low.y && low.y > low.x && low.x > 0.0, "{low}");
        assert!(at(1000.0, 0.04).cmpgt(low).all() && at(100.0, 0.2).cmpgt(low).all());
        assert_eq!(at(-5.0, 0.04), at(LEAST_HEIGHT_M, 0.04));
        // 100 m of the clearest air at 550 nm: 1.36e-5 a metre (Hillaire 2020, table 1).
        let green = at(100.0, 0.0).y / std::f32::consts::LOG2_E;
        assert!((green / 1.36e-3 - 1.0).abs() < 0.15, "{green}");
    }
}
