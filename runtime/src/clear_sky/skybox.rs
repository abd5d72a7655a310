//! The skybox: a picture of a whole sky in place of the computed one, behind the clouds.
//!
//! # Theory
//! N. Greene, "Environment Mapping and Other Applications of World Projections", IEEE CG&A 6(11), 1986: a
//! picture on the six faces of a cube, read along a direction. S. Guthikonda and others mix such a static sky
//! with moving clouds; T. Porter, T. Duff, "Compositing Digital Images", SIGGRAPH 1984, give the mixing: the
//! pack holds radiance times cover, so that `over` leaves no rim where the picture ends.
//!
//! # Practice
//! One trilinear cube texture read a pixel, compiled out of skies whose pack has no skybox. Clear sky, night and
//! sun lie behind it; where its cover is less than 1, or its strength, they show.

use glam::Vec2;

use crate::geometry::part::Part;
use crate::geometry::uniforms::uniforms;

/// Its part of the shader.
pub const PART: Part = Part {
    constants: &[],
    structs: &[SkyboxUniforms::WGSL],
    wgsl: include_str!("skybox.wgsl"),
};

uniforms! {
    /// The skybox.
    SkyboxUniforms {
        /// Weight of the skybox where its cover is 1.
        weight: f32,
        /// Level of detail.
        lod: f32,
        /// Nothing.
        _pad: Vec2,
    }
}

/// Side of a texel of a face of one texel in radians, were all texels of a cube of equal solid angle:
/// `sqrt(4 pi / 6)`. In the middle of a face they are 1.4 times as wide, in its corners 0.7 times.
const FACE_RAD: f32 = 1.447_202_5;

/// The skybox's share of the uniforms. `strength` is 0..1, `face_texels` the side of a face, `pixel_rad` that
/// of a pixel in the middle of the screen.
pub fn uniforms(strength: f32, face_texels: u32, levels: usize, pixel_rad: f32) -> SkyboxUniforms {
    let texel_rad = FACE_RAD / face_texels as f32;
    let level = (pixel_rad / texel_rad).log2();
    let last = levels.saturating_sub(1) as f32;
    SkyboxUniforms {
        weight: strength,
        lod: level.clamp(0.0, last),
        ..Default::default()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn level(face_texels: u32, levels: usize, pixel_rad: f32) -> f32 {
        uniforms(1.0, face_texels, levels, pixel_rad).lod
    }

    #[test]
    fn the_texels_of_a_face_together_are_a_sixth_of_the_sphere() {
        let sphere = 4.0 * std::f32::consts::PI;
        assert!((6.0 * FACE_RAD * FACE_RAD - sphere).abs() < 1e-5);
    }

    #[test]
    fn a_pixel_as_wide_as_a_texel_reads_level_0_and_twice_as_wide_level_1() {
        let texel = FACE_RAD / 256.0;
        assert_eq!(level(256, 9, texel), 0.0);
        assert!((level(256, 9, 2.0 * texel) - 1.0).abs() < 1e-5);
        assert!((level(512, 10, 2.0 * texel) - 2.0).abs() < 1e-5);
    }

    #[test]
    fn the_level_is_one_of_those_there_are() {
        assert_eq!(level(256, 9, 1e-6), 0.0);
        assert_eq!(level(256, 9, 1e6), 8.0);
        assert_eq!(level(1, 1, 0.5), 0.0);
        assert_eq!(level(16, 0, 0.5), 0.0);
    }

    #[test]
    fn the_strength_is_handed_on() {
        assert_eq!(uniforms(0.25, 256, 9, 0.001).weight, 0.25);
    }
}
