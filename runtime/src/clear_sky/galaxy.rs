//! The galaxy: one texture over the whole dome (Roden and Parberry, section 4).
//!
//! # Changes versus the paper
//! It lies on Lambert's equal-area dome, like the stars, and is tinted. A texel of its 128x128 is wider than a
//! degree, so the finer structure of the Milky Way, clouds of stars too faint to be seen, comes from noise and
//! detail of the cloud texture, over what they are on average in the pack: its clouds shape the galaxy and do not brighten it.
//!
//! # Practice
//! One bilinear and one trilinear texture read a pixel at night; the latter is bilinear too where its level is nearly whole.

use std::f32::consts::SQRT_2;

use glam::Vec3;

use crate::geometry::part::{Part, Value};
use crate::geometry::uniforms::uniforms;

/// Its part of the shader.
pub const PART: Part = Part {
    constants: &[
        ("EXTINCTION", Value::F32(EXTINCTION)),
        ("GALAXY_GRAIN_SCALE", Value::F32(GRAIN_SCALE)),
        ("GALAXY_SEAM", Value::F32(SEAM)),
        ("GALAXY_UV_SCALE", Value::F32(UV_SCALE)),
    ],
    structs: &[GalaxyUniforms::WGSL],
    wgsl: include_str!("galaxy.wgsl"),
};

uniforms! {
    /// Galaxy. The mean of its grain is 1.
    GalaxyUniforms {
        /// Radiance of the brightest place, times the weight of the night sky.
        radiance: Vec3,
        /// Level of detail of the grain.
        grain_lod: f32,
        /// The grain without noise and detail.
        plain: f32,
        /// What noise adds to the grain where it is 1.
        noise: f32,
        /// What detail adds to the grain where it is 1.
        detail: f32,
        /// Nothing.
        _pad: f32,
    }
}

/// Stars and galaxy fade over this sine of the elevation above the horizon: the air takes their light.
pub const EXTINCTION: f32 = 0.16;

/// Sine of the declination below which the two halves of the dome of a date go over into each other: the texture's edge goes on in both.
pub const SEAM: f32 = 0.2;

/// Radiance of the brightest place.
const LIGHT: Vec3 = Vec3::new(0.085, 0.098, 0.135);

/// Tiles of the cloud texture a radian of the dome: its waves are 0.5 to 15 degrees long then.
pub const GRAIN_SCALE: f32 = 1.9;

/// From the plane of the dome, a disc with the radius [`SQRT_2`], to halves of the texture: see [`welkin_pack::mapping::direction_to_galaxy_uv`].
pub const UV_SCALE: f32 = 0.25 * SQRT_2;

/// A level of the grain that is this near to a whole one is taken for it: the eye sees no difference, and a GPU reads one level, not two.
const NEARLY_WHOLE: f32 = 0.125;

/// The grain: what is there without noise and detail, and what each adds where it is 1.
const GRAIN: [f32; 3] = [0.4, 1.15, 0.6];

/// The galaxy's share of the uniforms. `means` are those of noise and detail in the pack, `texels` is the side of the cloud
/// texture, `pixel_rad` a pixel in the middle of the screen.
pub fn uniforms(night: f32, means: [f32; 2], texels: u32, pixel_rad: f32) -> GalaxyUniforms {
    let level = (pixel_rad * GRAIN_SCALE * texels as f32).log2().max(0.0);
    let [plain, noise, detail] = GRAIN;
    let mean = plain + noise * means[0] + detail * means[1];
    let [plain, noise, detail] = GRAIN.map(|part| part / mean);
    GalaxyUniforms {
        radiance: LIGHT * night,
        grain_lod: whole_if_near(level),
        plain,
        noise,
        detail,
        ..Default::default()
    }
}

fn whole_if_near(level: f32) -> f32 {
    let whole = level.round();
    if (level - whole).abs() < NEARLY_WHOLE {
        whole
    } else {
        level
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_grain_is_1_on_average_whatever_the_means_of_the_clouds() {
        for means in [[0.26, 0.5], [0.45, 0.9], [0.15, 0.1], [0.0, 0.0]] {
            let galaxy = uniforms(1.0, means, 512, 1e-3);
            let mean = galaxy.plain + galaxy.noise * means[0] + galaxy.detail * means[1];
            assert!((mean - 1.0).abs() < 1e-6, "{means:?}: {mean}");
            assert!(
                galaxy.plain > 0.0,
                "the galaxy is nowhere black by its grain"
            );
        }
    }

    #[test]
    fn the_grains_level_is_that_of_the_pixel_or_the_whole_one_beside_it() {
        let texel_rad = 1.0 / (GRAIN_SCALE * 512.0);
        for step in -200..800 {
            let level = step as f32 / 100.0;
            let found = uniforms(1.0, [0.26, 0.5], 512, texel_rad * level.exp2()).grain_lod;
            let expected = level.max(0.0);
            assert!((found - expected).abs() <= NEARLY_WHOLE, "{level}: {found}");
            assert!(
                found == found.round() || (found - expected).abs() < 1e-4,
                "{level}: {found}"
            );
        }
    }
}
