//! The lens flare: light that the lens throws onto the line from the sun through the middle of the screen.
//!
//! # Theory
//! Guthikonda et al. (see [`crate::clouds::octaves`]), section III: a picture of the sun and five of flares, at 0.5, 0.33333, -0.05, -0.25 and
//! -0.75 of the sun's distance from the middle of the screen, added by their own opacity. They are there only while
//! the sun is in view. Every picture is round, as of a lens without an aperture.
//!
//! # Changes versus the paper
//! - The flare fades with the clouds before the sun, with the sun's height, and at the edge of the screen instead of going
//!   out at once. How much the clouds cover is asked of the method's own clouds, in the vertex stage: nothing is read back.
//! - Where [`crate::SkyParams::starburst`] asks for it the sun's own picture is a starburst, as an aperture of blades makes it.
//!
//! # Practice
//! Six squares, drawn after the sky and over the scene, in the target's own encoding: what is behind a hill is for the
//! application to know ([`crate::SkyParams::flare`] 0 switches it off). Five looks at the clouds a vertex. Colours are those of the display, so
//! no tone curve is taken of them; a picture that is exposed less has less of the flare.

use glam::{Vec2, Vec3};
use welkin_pack::mapping::FlareCell;

use crate::clear_sky::light::Light;
use crate::geometry::camera::CameraUniforms;
use crate::geometry::math::{luminance, smoothstep};
use crate::geometry::part::Part;
use crate::geometry::uniforms::uniforms;
use crate::params::SkyParams;

/// Its part of the shader.
pub const PART: Part = Part {
    constants: &[],
    structs: &[FlareSquare::WGSL, FlareUniforms::WGSL],
    wgsl: include_str!("flares.wgsl"),
};

uniforms! {
    /// A square of the flare.
    FlareSquare {
        /// Its middle in clip space.
        position: Vec2,
        /// Half its sides in clip space.
        half_size: Vec2,
        /// Its colour.
        colour: Vec3,
        /// Its opacity.
        opacity: f32,
        /// Corner of its cell of the atlas, as uv.
        cell: Vec2,
        /// Side of the cell.
        cell_size: f32,
        /// Level of detail.
        lod: f32,
    }

    /// The lens flare.
    FlareUniforms {
        /// Strength of the whole flare.
        strength: f32,
        /// Radius, as a sine, in which clouds hide the sun.
        sun_radius: f32,
        /// Nothing.
        _pad: Vec2,
        /// The sun's first.
        squares: [FlareSquare; COUNT as usize],
    }
}

/// Squares: the sun's and the flares'.
pub const COUNT: u32 = 6;

/// Distances of the squares from the middle of the screen, in distances of the sun; the sun's own first.
pub const RATIOS: [f32; COUNT as usize] = [1.0, 0.5, 0.33333, -0.05, -0.25, -0.75];

/// A square: its picture, half its side in halves of the screen's height, colour and opacity.
type Square = (FlareCell, f32, [f32; 3], f32);

/// The sun's square if it is a starburst.
const STARBURST: Square = (FlareCell::Starburst, 0.44, [1.0, 0.95, 0.85], 0.4);

/// Every square, the sun's first.
const SQUARES: [Square; COUNT as usize] = [
    (FlareCell::Disc, 0.2, [1.0, 0.95, 0.85], 0.2),
    (FlareCell::Disc, 0.085, [1.0, 0.85, 0.55], 0.14),
    (FlareCell::Ring, 0.15, [0.65, 0.85, 1.0], 0.15),
    (FlareCell::Disc, 0.05, [0.75, 1.0, 0.75], 0.12),
    (FlareCell::Glow, 0.19, [0.6, 0.75, 1.0], 0.16),
    (FlareCell::Ring, 0.33, [1.0, 0.75, 0.55], 0.13),
];

/// The angle about the sun in which clouds hide it, as a sine: a little more than its disc.
const HIDING: f32 = 0.012;
/// Share of the half screen over which the flare fades as the sun goes out of view.
const EDGE: f32 = 0.06;
/// Sines of the sun's elevation between which the flare comes up.
const RISE: [f32; 2] = [-0.01, 0.14];
/// Levels beyond this would mix the cells of the atlas.
const LAST_LEVEL: f32 = 3.0;

/// The flare's share of the uniforms. `texels` is the side of the atlas.
pub fn uniforms(
    params: &SkyParams,
    light: &Light,
    camera: &CameraUniforms,
    texels: u32,
) -> FlareUniforms {
    let (width, height) = (camera.width_px, camera.height_px);
    let sun = camera.on_screen(light.sun_direction);
    let in_view = sun.map_or(0.0, |sun| {
        1.0 - smoothstep(1.0 - EDGE, 1.0, sun.abs().max_element())
    });
    // The moon is too weak for one.
    let risen = match light.is_moon {
        true => 0.0,
        false => smoothstep(RISE[0], RISE[1], light.sun_direction.y),
    };
    let mut flares = FlareUniforms {
        strength: params.flare * in_view * risen,
        sun_radius: HIDING,
        ..Default::default()
    };
    let hue = light.sunlight / luminance(light.sunlight).max(1e-3);
    let mut squares = SQUARES;
    if params.starburst {
        squares[0] = STARBURST;
    }
    for (k, (cell, half, colour, opacity)) in squares.into_iter().enumerate() {
        let [[u, v], [right, _]] = cell.uv_rect();
        let side = right - u;
        let texels_a_pixel = side * texels as f32 / (half * height).max(1.0);
        flares.squares[k] = FlareSquare {
            position: sun.unwrap_or_default() * RATIOS[k],
            half_size: Vec2::new(half * height / width, half),
            colour: (Vec3::from(colour) * hue).min(Vec3::ONE),
            opacity,
            cell: Vec2::new(u, v),
            cell_size: side,
            lod: texels_a_pixel.log2().clamp(0.0, LAST_LEVEL),
        };
    }
    flares
}
