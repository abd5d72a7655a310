//! Sequences that begin again where they end.
//!
//! # Theory
//! A. Schödl, R. Szeliski, D. H. Salesin, I. Essa, "Video Textures", SIGGRAPH 2000: a film jumps back unseen where its end has been faded over to
//! what goes before its beginning. J. Liao, N. Joshi, H. Hoppe, "Automated Video Looping with Progressive Dynamism", SIGGRAPH 2013: each pixel
//! may do so at its own moment.
//!
//! Any moment of a sky can be drawn. So a loop of L seconds shows the sky of its moment t at first and that of t - L at last, which goes on into
//! the first frame. Both move all the while.
//!
//! # Practice
//! A fade of the whole picture has every cloud twice, at half its contrast, for as long as it takes. Here each direction fades at its own moment,
//! told by a smooth wave over the sphere, in a fifth of the time of the change: most of the sky is that of one moment alone and has
//! its contrast; in between, clouds dissolve and form along soft edges some ten degrees wide. The change takes all of a loop of up to [`CHANGE_S`], so no part of
//! it differs from another. A direction has one moment, whatever the picture, so faces of a cube meet.
//!
//! Radiance is mixed as it is; pictures for a display as the light that the display shows, for a sun of which a
//! hundredth is left would still be white before the tone curve.

use glam::{Vec2, Vec3};
use rayon::prelude::*;
use welkin_runtime::Camera;
use welkin_runtime::internals::tonemap::srgb_encoded;

use super::cube::{FACES, texel_direction};
use super::cubemap::Cubemap;
use super::equirect::equirect_to_direction;
use crate::frame::{Frame, Pixels, linear};
use crate::headless::View;

/// The longest change, in seconds. Edges of what changes stand nearly still in a longer one, and are seen.
pub const CHANGE_S: f64 = 60.0;

/// Share of the change in which a direction fades.
const FADE: f32 = 0.2;

/// Waves whose sum tells a direction's moment.
const WAVES: usize = 8;
/// Their length is a turn over this, in radians: patches of some 70 degrees.
const WAVE_NUMBER: f32 = 5.0;
/// Fractions of the golden ratio and of the plastic number: multiples of them fill 0..1 evenly, and do not repeat together.
const GOLDEN: f32 = 0.618_034;
const PLASTIC: f32 = 0.754_877_7;
/// The logistic function of 1.702 x is the normal distribution within 0.01: S. R. Bowling et al., "A logistic approximation to the cumulative
/// normal distribution", J. Ind. Eng. Manag. 2(1), 2009.
const LOGISTIC: f32 = 1.702;

/// What a frame of a loop shows of the sky that goes before the first frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Change {
    /// The moment of that sky, in seconds.
    pub earlier_s: f64,
    /// How far the change to it has come, 0..=1.
    pub progress: f32,
}

impl Change {
    /// The share of the earlier sky in a direction.
    pub fn share(&self, direction: Vec3) -> f32 {
        let begin = moment(direction) * (1.0 - FADE);
        let t = ((self.progress - begin) / FADE).clamp(0.0, 1.0);
        t * t * (3.0 - 2.0 * t)
    }
}

/// When a direction begins to change: 0..1, about as often each.
fn moment(direction: Vec3) -> f32 {
    let wave = |i: usize| {
        let (turn, height) = (i as f32 * GOLDEN, (2 * i + 1) as f32 / WAVES as f32 - 1.0);
        let (sin, cos) = (std::f32::consts::TAU * turn).sin_cos();
        let across = (1.0 - height * height).sqrt();
        let along = Vec3::new(across * cos, height, across * sin).dot(direction);
        (WAVE_NUMBER * along + std::f32::consts::TAU * (i as f32 * PLASTIC)).sin()
    };
    // The mean square of a wave is 1/2.
    let sum = (0..WAVES).map(wave).sum::<f32>() / (0.5 * WAVES as f32).sqrt();
    1.0 / (1.0 + (-LOGISTIC * sum).exp())
}

/// Draws a moment of a sequence: `draw` draws a moment of the sky, `mix` puts so much of the second picture into the first at each
/// of `directions`.
///
/// # Errors
/// Those of `draw`.
pub fn draw<T, E>(
    view: &View,
    change: Option<&Change>,
    directions: impl FnOnce() -> Vec<Vec3>,
    mut draw: impl FnMut(&View) -> Result<T, E>,
    mix: impl FnOnce(&mut T, &T, &[f32]),
) -> Result<T, E> {
    let Some(change) = change else {
        return draw(view);
    };
    let earlier = View {
        seconds: change.earlier_s,
        ..view.clone()
    };
    let directions = directions().into_par_iter();
    let shares: Vec<f32> = directions.map(|d| change.share(d)).collect();
    if shares.iter().all(|share| *share == 0.0) {
        return draw(view);
    }
    if shares.iter().all(|share| *share == 1.0) {
        return draw(&earlier);
    }
    let mut drawn = draw(view)?;
    mix(&mut drawn, &draw(&earlier)?, &shares);
    Ok(drawn)
}

/// Where the pixels of a camera look.
pub fn of_camera(camera: &Camera) -> Vec<Vec3> {
    let rays = camera.rays();
    let size = Vec2::from(camera.viewport_px.map(|side| side as f32));
    let direction = |(x, y): (u32, u32)| {
        let place = (Vec2::new(x as f32, y as f32) + 0.5) / size * 2.0 - 1.0;
        (rays.forward + place.x * rays.right - place.y * rays.up).normalize()
    };
    places(camera.viewport_px).map(direction).collect()
}

/// Where the texels of a panorama look.
pub fn of_equirect(width: u32, azimuth_rad: f32) -> Vec<Vec3> {
    let size = [width, width / 2];
    let direction = |(x, y): (u32, u32)| {
        let [u, v] = [(x, size[0]), (y, size[1])].map(|(i, n)| (i as f32 + 0.5) / n as f32);
        Vec3::from(equirect_to_direction([u, v], azimuth_rad))
    };
    places(size).map(direction).collect()
}

/// Where the texels of the faces of a cube map look.
pub fn of_cubemap(side: u32) -> Vec<Vec3> {
    let faces = (0..FACES.len()).flat_map(|face| places([side; 2]).map(move |(x, y)| (face, x, y)));
    let direction = |(face, x, y)| texel_direction(face, [x, y], side);
    faces.map(direction).collect()
}

fn places([width, height]: [u32; 2]) -> impl Iterator<Item = (u32, u32)> {
    (0..height).flat_map(move |y| (0..width).map(move |x| (x, y)))
}

/// Puts so much of another picture into each pixel. Pictures of different kinds stay what they are.
pub fn mix_frames(frame: &mut Frame, other: &Frame, shares: &[f32]) {
    match (&mut frame.pixels, &other.pixels) {
        (Pixels::Srgb8(pixels), Pixels::Srgb8(others)) => {
            each(pixels, others, shares, |pixel, other, share| {
                // What is the same keeps its dither.
                if pixel != other {
                    let [a, b] = [*pixel, *other]
                        .map(|p| Vec3::new(linear(p[0]), linear(p[1]), linear(p[2])));
                    let [r, g, b] = (srgb_encoded(a.lerp(b, share)) * 255.0).round().to_array();
                    *pixel = [r as u8, g as u8, b as u8, pixel[3]];
                }
            });
        }
        (Pixels::Linear(pixels), Pixels::Linear(others)) => {
            each(pixels, others, shares, |pixel, other, share| {
                for (value, other) in pixel.iter_mut().zip(other) {
                    let [a, b] = [value.to_f32(), other.to_f32()];
                    *value = half::f16::from_f32(a + (b - a) * share);
                }
            });
        }
        _ => {}
    }
}

/// Puts so much of another cube map into each texel.
pub fn mix_cubemaps(map: &mut Cubemap, other: &Cubemap, shares: &[f32]) {
    let shares = shares.chunks_exact((map.side * map.side) as usize);
    for ((face, other), shares) in map.faces.iter_mut().zip(&other.faces).zip(shares) {
        let texels = face.texels.as_chunks_mut::<3>().0;
        let others = other.texels.as_chunks::<3>().0;
        each(texels, others, shares, |texel, other, share| {
            for (value, other) in texel.iter_mut().zip(other) {
                *value += (other - *value) * share;
            }
        });
    }
}

/// What is all of one picture is not computed, so it is the same to the last bit.
fn each<T: Copy + Send + Sync>(
    texels: &mut [T],
    others: &[T],
    shares: &[f32],
    mix: impl Fn(&mut T, &T, f32) + Sync,
) {
    let all = texels.par_iter_mut().zip(others).zip(shares);
    all.for_each(|((texel, other), share)| match *share {
        0.0 => {}
        1.0 => *texel = *other,
        share => mix(texel, other, share),
    });
}

#[cfg(test)]
mod tests;
