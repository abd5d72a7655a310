//! The fbm method: one layer of clouds from drifting octaves of noise, lit by a short march towards the sun.
//!
//! # Theory
//! I. Quilez, "Dynamic Clouds", 2005. The octaves of a fractal sum are kept apart and moved each with its own velocity, so
//! that their sum changes its shape ([`crate::clouds::fbm::map`]). A threshold a and a sharpness b open the sky by a linear map. Four
//! heights along a ray towards the sun tell how much cloud the light has passed; it blends two colours of the user.
//!
//! # Changes versus the article
//! - a is found from the cover: the share of a normal distribution with the mean and the spread of the pack's octaves.
//! - Opacity rises smoothly from the article's cover and is full at [`FULL`] of it: its straight line makes either
//!   hard feet or glassy bodies.
//! - The two colours are reflectances; the light of the time of day falls on them. By default the shade halves sunlight, of which
//!   [`crate::clouds::shared`] says what is scattered to the eye: then the lit colour is that of sunlight, and between both lies that of
//!   skylight. With [`Shading::Paper`] the shade goes from one to the other, as in the article.
//! - The photograph's large shapes take a part of the sum's variance ([`crate::clouds::photo`]). In an overcast heights along the ray are never below it.
//! - The dome reads the map a second time, finer: four octaves of 8 to 64 cells are soft so near to the eye. It roughens
//!   edges only.
//!
//! # Practice
//! Two reads of the map a pixel, whatever the number of octaves.

pub mod coverage;
pub mod map;
pub mod pack;

use glam::{DMat2, DVec2, Vec2, Vec3, Vec4};

use crate::clouds::shared::{
    CloudUniforms, CloudView, LOW_HEIGHT_M, MAX_WIND, offset, overcast_weight, scattered,
};
use crate::geometry::math::normal_share;
use crate::geometry::part::{Part, Value};
use crate::geometry::uniforms::uniforms;
use crate::params::{Shading, SkyParams};

/// Its part of the shader.
pub const PART: Part = Part {
    constants: &[
        ("FBM_FINER", Value::F32(FINER)),
        ("FBM_FINER_LEVEL", Value::Log2(FINER)),
        ("FBM_ROUGH_SHADE", Value::F32(ROUGH_SHADE)),
        ("FBM_FULL", Value::F32(FULL)),
        ("FBM_DEPTH", Value::F32(DEPTH)),
        ("FBM_THICK", Value::F32(THICK)),
        ("FBM_FINER_START", Value::Vec2(FINER_START)),
    ],
    structs: &[FbmUniforms::WGSL],
    wgsl: include_str!("fbm.wgsl"),
};

uniforms! {
    /// Clouds of the fbm method.
    FbmUniforms {
        /// What a height to the east adds to uv.
        east_axis: Vec2,
        /// What a height to the south adds to uv.
        south_axis: Vec2,
        /// Where the map lies.
        offset: Vec2,
        /// Level of detail at distance 1.
        lod_bias: f32,
        /// m for the heights along the ray.
        ray_slope: f32,
        /// The article's m: what the sum of octaves is multiplied by.
        slope: f32,
        /// The article's n: what is added then.
        intercept: f32,
        /// How many octaves are summed.
        count: f32,
        /// Texels a side of the map.
        resolution: f32,
        /// The lit colour, a reflectance.
        lit: Vec3,
        /// What the shade is multiplied by.
        shade_strength: f32,
        /// The shaded colour, a reflectance.
        shaded: Vec3,
        /// How much the finer read roughens edges.
        roughness: f32,
        /// A step of the ray towards the sun, in tiles.
        sun_step: Vec2,
        /// Mean of the sum of octaves.
        mean: f32,
        /// n for the heights along the ray.
        ray_intercept: f32,
        /// Nothing.
        _pad: Vec3,
        /// Standard deviation of the sum of octaves.
        spread: f32,
        /// Where octaves lie, two a vector.
        offsets: [Vec4; 4],
        /// Weights of octaves, four a vector.
        weights: [Vec4; 2],
    }
}

/// How much finer the second read of the map is. A whole number: offsets are reduced by whole tiles.
pub const FINER: f32 = 5.0;
/// Where the second read starts.
pub const FINER_START: [f32; 2] = [0.13, 0.57];

/// The cover in the map at which the sky is full: above it clouds are opaque, whatever their height.
pub const FULL: f32 = 0.62;
/// How strong the shade is at density 0 and 1. Chosen by eye, as is the next one.
const SHADE: [f32; 2] = [0.85, 1.1];
/// How much the finer read roughens edges.
const ROUGHNESS: f32 = 0.9;
/// How much the finer read changes the shade where the sky is full.
pub const ROUGH_SHADE: f32 = 0.9;

/// Halvings of sunlight where the article's shade is full: that ends, and so do they. Chosen by eye, as is the next one.
pub const DEPTH: f32 = 4.0;
/// The height of a cloud whose cover in the map is 1.
pub const THICK: f32 = 0.8;

/// How far the map reaches in heights of the layer, at height 0 and 1.
const TILE: [f64; 2] = [7.0, 3.4];
/// How the map is turned against the world, in radians: the article moves octaves along the axes of the map.
const TURN: f64 = 0.52;
/// Where the map lies over the viewer.
const START: DVec2 = DVec2::new(0.407, 0.326);

/// From a to b in standard deviations of the sum, at sharpness 0 and 1.
const SLOPE: [f32; 2] = [3.6, 0.4];
/// How far a sinks in an overcast, as a share of the way from a to b.
const OVERCAST_SINK: f32 = 1.6;
/// The lowest that a goes for the heights along the ray, in standard deviations from the mean.
const LOWEST_RAY: f32 = -0.8;
/// The same in an overcast, where no place is without height, and how much less heights differ there.
const OVERCAST_RAY: f32 = -3.0;
const OVERCAST_EVENED: f32 = 0.3;
/// The farthest that a goes from the mean, in standard deviations: beyond it is nothing.
const FARTHEST: f32 = 4.0;

/// The method's share of the uniforms. `params` are in range; `sun` is the unit direction towards the sun.
pub fn uniforms(
    params: &SkyParams,
    view: &CloudView,
    octaves: &map::Octaves,
    sun: Vec3,
) -> FbmUniforms {
    let own = params.fbm;
    let tile = TILE[0] + (TILE[1] - TILE[0]) * f64::from(params.height);
    let axes = DMat2::from_angle(TURN) * (1.0 / tile);
    let near = view.distance(LOW_HEIGHT_M);
    let texels_a_height = f64::from(map::SIDE) / tile * near;
    // Tiles that the slowest octave goes.
    let way = MAX_WIND * f64::from(params.speed) * view.seconds / tile;
    let (mean, spread) = map::mean_and_spread(octaves);
    let [slope, intercept] = remap(params.cover, own.sharpness, mean, spread);
    let [ray_slope, ray_intercept] = remap_of_ray(params.cover, own.sharpness, mean, spread);
    let seen = axes * near;
    FbmUniforms {
        east_axis: seen.x_axis.as_vec2(),
        south_axis: seen.y_axis.as_vec2(),
        offset: offset(START + axes * view.place(LOW_HEIGHT_M)),
        lod_bias: view.level(texels_a_height),
        slope,
        intercept,
        count: octaves.count() as f32,
        resolution: map::SIDE as f32,
        lit: Vec3::from(own.lit),
        shade_strength: SHADE[0] + (SHADE[1] - SHADE[0]) * params.density,
        shaded: Vec3::from(own.shaded),
        roughness: ROUGHNESS,
        sun_step: pack::step(sun, TURN),
        mean,
        ray_intercept,
        ray_slope,
        spread,
        offsets: bytemuck::cast(map::offsets(way)),
        weights: bytemuck::cast(map::weights(octaves)),
        ..Default::default()
    }
}

/// The article's m and n: `m = 1 / (b - a)`, `n = -a / (b - a)`.
fn remap(cover: f32, sharpness: f32, mean: f32, spread: f32) -> [f32; 2] {
    let slope = deviations(sharpness);
    // An overcast has no holes: a sinks until even the thinnest place is opaque.
    let sunk = OVERCAST_SINK * slope * overcast_weight(cover);
    let a = mean + spread * (normal_quantile(1.0 - cover) - sunk);
    let m = 1.0 / (spread * slope);
    [m, -a * m]
}

/// The same for the heights along the ray. In an overcast sky every height would be far above it: there a stays at what leaves light and shade.
fn remap_of_ray(cover: f32, sharpness: f32, mean: f32, spread: f32) -> [f32; 2] {
    let weight = overcast_weight(cover);
    let alone = normal_quantile(1.0 - cover).max(LOWEST_RAY);
    let a = mean + spread * (alone + (OVERCAST_RAY - alone) * weight);
    let m = (1.0 - OVERCAST_EVENED * weight) / (spread * deviations(sharpness));
    [m, -a * m]
}

/// From a to b, in standard deviations of the sum.
fn deviations(sharpness: f32) -> f32 {
    SLOPE[0] + (SLOPE[1] - SLOPE[0]) * sharpness
}

/// The z below which a share of the normal distribution lies, by bisection of the shader's own approximation.
fn normal_quantile(share: f32) -> f32 {
    let (mut low, mut high) = (-FARTHEST, FARTHEST);
    for _ in 0..24 {
        let z = 0.5 * (low + high);
        if normal_share(z) < share {
            low = z
        } else {
            high = z
        }
    }
    0.5 * (low + high)
}

/// Radiance of an overcast sky far away: every height along the ray is the mean one.
pub fn overcast(fbm: &FbmUniforms, clouds: &CloudUniforms, shading: Shading) -> Vec3 {
    lights_at(fbm, clouds, shading, fbm.mean).into_iter().sum()
}

/// Radiance by sunlight and by skylight of a place with this sum of octaves, where the sky around has its mean: heights along the ray are those of the map.
fn lights_at(
    fbm: &FbmUniforms,
    clouds: &CloudUniforms,
    shading: Shading,
    amount: f32,
) -> [Vec3; 2] {
    let height = fbm.ray_slope * amount + fbm.ray_intercept;
    let inside = map::DEPTHS
        .iter()
        .map(|depth| (height - depth).max(0.0))
        .sum::<f32>()
        / 4.0;
    let shade = fbm.shade_strength * (1.0 - (-map::ABSORPTION * inside).exp2());
    let shade = shade.clamp(0.0, 1.0);
    let colour = fbm.lit.lerp(fbm.shaded, shade);
    match shading {
        Shading::Scattered => {
            let cover = (fbm.slope * amount + fbm.intercept).clamp(0.0, 1.0);
            let [sunlit, skylit] = scattered(clouds, None, DEPTH * shade, THICK * cover);
            [
                fbm.lit * clouds.sunlight * sunlit,
                colour * clouds.ambient * skylit,
            ]
        }
        Shading::Paper => [colour * clouds.sunlight, colour * clouds.ambient],
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_remap_is_the_articles_line() {
        let (mean, spread) = (0.5, 0.1);
        for (cover, sharpness) in [(0.2, 0.0), (0.5, 0.5), (0.8, 1.0)] {
            let [m, n] = remap(cover, sharpness, mean, spread);
            let (a, b) = (-n / m, (1.0 - n) / m);
            let slope = deviations(sharpness);
            assert!((b - a - spread * slope).abs() < 1e-5);
            assert!((m - 1.0 / (b - a)).abs() < 1e-2 && (n + a / (b - a)).abs() < 1e-2);
        }
        let [m, n] = remap(0.5, 0.5, mean, spread);
        assert!(
            (-n / m - mean).abs() < 1e-4,
            "half the sky is above the mean"
        );
    }

    #[test]
    fn quantiles_are_those_of_the_tables() {
        // NIST/SEMATECH e-Handbook of Statistical Methods, 1.3.6.7.1: 0.84134 below 1, 0.97725 below 2.
        for (share, z) in [
            (0.5, 0.0),
            (0.841_34, 1.0),
            (0.977_25, 2.0),
            (0.158_66, -1.0),
        ] {
            assert!((normal_quantile(share) - z).abs() < 5e-3, "{share}");
        }
        assert!(normal_quantile(0.0) < -3.9 && normal_quantile(1.0) > 3.9);
    }

    #[test]
    fn a_shut_sky_is_opaque_where_it_is_thinnest_and_a_clear_one_empty_where_it_is_thickest() {
        let height = |cover: f32, z: f32| {
            let [m, n] = remap(cover, 0.45, 0.5, 0.1);
            m * (0.5 + 0.1 * z) + n
        };
        assert!(height(1.0, -3.9) >= 1.0, "{}", height(1.0, -3.9));
        assert!(height(0.0, 3.9) <= 0.0, "{}", height(0.0, 3.9));
    }
}
