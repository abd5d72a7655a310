//! The pack's photograph as the large shapes of `octaves`, `fbm` and `lit`.
//!
//! # Theory
//! Independent normal numbers of variance 1, weighted by w and `sqrt(1 - w^2)`, add up to another. So the photo's coarse shapes, as deviations from
//! their mean in units of their spread, take the place of a share `w^2` of the variance of a method's noise, and cover keeps its share of the sky. `lit`, whose
//! amounts are evenly distributed, blends them with the photo's share of a normal distribution and makes the blend even again.
//!
//! # Changes versus the papers
//! Their noise repeats in clouds of one size. With the weight 0 they are as published.
//!
//! # Practice
//! A read or, towards the sun, some in the methods' maps; none on the screen. The photo covers a tile of the map once.

use welkin_pack::Texture;

use crate::geometry::math::{NORMAL_BEND, NORMAL_SLOPE};
use crate::geometry::part::{Part, Value};
use crate::geometry::uniforms::uniforms;

/// Its part of the shader.
pub const PART: Part = Part {
    constants: &[
        ("NORMAL_SLOPE", Value::F32(NORMAL_SLOPE)),
        ("NORMAL_BEND", Value::F32(NORMAL_BEND)),
    ],
    structs: &[PhotoUniforms::WGSL],
    wgsl: include_str!("photo.wgsl"),
};

uniforms! {
    /// The photograph's share of large shapes.
    PhotoUniforms {
        /// Level of the clouds' texture at which it is read.
        level: f32,
        /// Its mean there.
        mean: f32,
        /// 1 / its standard deviation there.
        per_spread: f32,
        /// Its weight, 0..1.
        weight: f32,
    }
}

/// Texels a side of the level that is read, at most: what is finer is the methods' own.
const SIDE: u32 = 128;
/// A photo whose spread is less than a step of a byte has no shapes.
const LEAST_SPREAD: f32 = 1.0 / 255.0;

/// What the runtime keeps of the photo.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Photo {
    /// The level that is read.
    pub level: u32,
    /// Mean of that level.
    pub mean: f32,
    /// Its standard deviation.
    pub spread: f32,
}

impl Photo {
    /// Measures the first channel of the clouds' texture.
    pub fn new(clouds: &Texture) -> Photo {
        let finest = clouds.levels.len() as u32 - 1;
        let level = (clouds.width / SIDE).max(1).ilog2().min(finest);
        let (mean, spread) = clouds.image(level as usize, 0).mean_and_spread(0);
        Photo {
            level,
            mean,
            spread,
        }
    }
}

/// Its share of the uniforms; `weight` is 0..1.
pub fn uniforms(photo: Photo, weight: f32) -> PhotoUniforms {
    let weight = match photo.spread < LEAST_SPREAD {
        true => 0.0,
        false => weight,
    };
    PhotoUniforms {
        level: photo.level as f32,
        mean: photo.mean,
        per_spread: 1.0 / photo.spread.max(LEAST_SPREAD),
        weight,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_flat_photo_has_no_weight() {
        let photo = Photo {
            level: 2,
            mean: 0.4,
            spread: 0.2,
        };
        assert_eq!(uniforms(photo, 0.7).weight, 0.7);
        let flat = Photo {
            spread: 0.0,
            ..photo
        };
        let found = uniforms(flat, 0.7);
        assert_eq!(found.weight, 0.0);
        assert!(found.per_spread.is_finite());
    }
}
