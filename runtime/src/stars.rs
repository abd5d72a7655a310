//! Stars: each flickers by its own four numbers, and stays a point.
//!
//! # Theory
//! A star shines `I(t) = mean + variance sin(2 pi (rate t + phase))` (Roden and Parberry, section 4).
//! The texture is tiled on the plane of Lambert's equal-area dome, so that no place has more stars than
//! another (welkin_pack::mapping).
//!
//! # Changes versus the paper
//! The paper samples the texture like a picture, which blends rates and phases of neighbours. Here one
//! texel is read whole and decoded; the star is a point at the texel's centre, projected to the screen,
//! and drawn as a tent one pixel wide each way. The tents of the pixels around it add up to one
//! wherever it is, so that a star which moves over the screen neither shimmers nor changes its light. A
//! tent fits into its texel where the texel is at least 2 sqrt(2) pixels wide: smaller ones are read
//! from the next level, which keeps the light of the stars. Near the horizon the projection narrows
//! texels by sqrt(1/2), and the tents of some stars lose their outermost corners there.
//!
//! Away from the lens' axis, at an angle t to it, a pixel covers cos^3 t of the solid angle that one in the middle does. On a screen
//! that is nobody's concern; a map of radiance divides by it ([`crate::SkyParams::even_stars`]).
//!
//! # Practice
//! One texture read a pixel at night, the rest only where there is a star (about one pixel in 40).

use glam::Vec3;
use welkin_pack::StarTexel;
use welkin_pack::mapping::STAR_TILE_SIDE;

use crate::uniforms::StarUniforms;

/// How much brighter a star is in the brightest part of the galaxy, less one: "stars inside the galaxies
/// receive an additional intensity increase" (section 4).
pub const GALAXY_BOOST: f32 = 3.0;

/// Colours of the stars, from phase 0 to phase 1, of about equal luminance: 4000 K and 12000 K.
pub const WARM: Vec3 = Vec3::new(1.15, 0.97, 0.76);
/// See [`WARM`].
pub const COLD: Vec3 = Vec3::new(0.84, 1.0, 1.30);

/// Radiance of a star of intensity 1 that fills its pixel.
const BRIGHTNESS: f32 = 1.6;

/// The narrowest texel into which the tent of a star fits at any turn, in pixels: its diagonal.
const MIN_TEXEL_PX: f32 = 2.0 * std::f32::consts::SQRT_2;

/// The stars' share of the uniforms. `texels` is the side of level 0, `pixel_rad` width and height of a
/// pixel in the middle of the screen, `even` is [`crate::SkyParams::even_stars`].
pub fn uniforms(
    texels: u32,
    levels: usize,
    pixel_rad: [f32; 2],
    night: f32,
    even: bool,
    seconds: f64,
) -> StarUniforms {
    let level = level(texels, levels, pixel_rad);
    let side = (texels >> level).max(1) as f32;
    let texel_sr = (STAR_TILE_SIDE / side) * (STAR_TILE_SIDE / side);
    let pixel_sr = pixel_rad[0] * pixel_rad[1];
    let brightness = BRIGHTNESS * night * texel_sr / pixel_sr;
    StarUniforms {
        field: [level as f32, side, period(seconds), brightness],
        spread: [f32::from(u8::from(even)), 0.0, 0.0, 0.0],
    }
}

/// The first level whose texels hold the tent of a star.
fn level(texels: u32, levels: usize, pixel_rad: [f32; 2]) -> u32 {
    let wanted = MIN_TEXEL_PX * pixel_rad[0].max(pixel_rad[1]);
    let fits = |level: u32| STAR_TILE_SIDE / (texels >> level).max(1) as f32 >= wanted;
    let last = levels.saturating_sub(1) as u32;
    (0..last).find(|&level| fits(level)).unwrap_or(last)
}

/// Place in the flicker's period, 0..1: reduced in 64 bits, so that any time can be drawn.
fn period(seconds: f64) -> f32 {
    let turns = seconds / StarTexel::PERIOD_S;
    // A value that rounds up to 1 is the start of the next period.
    ((turns - turns.floor()) as f32).min(1.0 - f32::EPSILON)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_level_is_the_first_that_holds_the_tent() {
        let pixel = |texel_px: f32| [1.0 / (256.0 * texel_px); 2];
        assert_eq!(level(256, 9, pixel(4.0)), 0);
        assert_eq!(level(256, 9, pixel(2.84)), 0);
        assert_eq!(level(256, 9, pixel(2.82)), 1);
        assert_eq!(level(256, 9, pixel(1.0)), 2);
        assert_eq!(level(256, 9, pixel(1e-6)), 8, "never beyond the last");
        assert_eq!(level(256, 0, pixel(1e-6)), 0);
    }

    #[test]
    fn the_same_sky_returns_after_each_period() {
        assert_eq!(period(0.0), period(640.0));
        assert_eq!(period(1e6), period(1e6 + 64.0 * 1e6));
        assert!((0.0..1.0).contains(&period(-1e-12)));
    }

    #[test]
    fn light_does_not_depend_on_the_level() {
        // Level 0 at 4 pixels a texel, level 1 at 2: four times the area holds a quarter of the intensity.
        let fine = uniforms(256, 9, [1e-3; 2], 1.0, false, 0.0).field;
        let coarse = uniforms(256, 9, [1.5e-3; 2], 1.0, false, 0.0).field;
        assert_eq!((fine[0], coarse[0]), (0.0, 1.0));
        let per_pixel_area = |field: [f32; 4], pixel_rad: f32| field[3] * pixel_rad * pixel_rad;
        let ratio = per_pixel_area(coarse, 1.5e-3) / per_pixel_area(fine, 1e-3);
        assert!((ratio - 4.0).abs() < 1e-5);
    }
}
