//! A panorama of anyone's as a cube map: the inverse of [`equirect`](super::equirect), by the same rule of directions.
//!
//! # Practice
//! A texel of the cube is the mean radiance over its solid angle, so that light stays: of at least four directions along each axis, each between the four nearest
//! texels of the panorama and no further apart than a quarter of one. The panorama is made smaller first, by means of 2x2 texels, each with its solid angle,
//! while it has 16 columns or more for each texel of a face's side; it is then still finer than the faces.

pub mod read;

use std::f32::consts::{PI, TAU};

use glam::Vec3;
use rayon::prelude::*;
use welkin_pack::Image;

use super::cube::{FACES, face_to_direction};
use super::cubemap::Cubemap;
use super::equirect::direction_to_equirect;

/// Columns for a texel of a face's side from which a panorama is made smaller first: then it still has 8, and around a face there are 4 sides.
const FINE: u32 = 16;

/// Directions for a texel of the panorama, along each axis. A texel's light is then counted to 2 %, wherever it lies between them: half of
/// `(4 / (3.5 π 4))²` of a tent's transform and its mirror image, for two axes.
const SAMPLES_A_TEXEL: f32 = 4.0;

/// Directions for a texel of a face, along each axis, at least.
const LEAST_SAMPLES: u32 = 4;

/// The panorama on the faces of a cube of `side` texels a side; `azimuth_rad` is what it has in its middle. It is twice as wide as high.
pub fn cubemap(panorama: &Image, side: u32, azimuth_rad: f32) -> Cubemap {
    let mut smaller = None;
    loop {
        let image = smaller.as_ref().unwrap_or(panorama);
        let is_even = image.height.is_multiple_of(2);
        if image.width < FINE * side || !is_even {
            return resampled(image, side, azimuth_rad);
        }
        smaller = Some(halved(image));
    }
}

fn resampled(panorama: &Image, side: u32, azimuth_rad: f32) -> Cubemap {
    // In the middle of a face a texel is widest.
    let texel_rad = 2.0 / side as f32;
    let wanted = (SAMPLES_A_TEXEL * texel_rad * panorama.width as f32 / TAU).ceil();
    let samples = (wanted as u32).max(LEAST_SAMPLES);
    let face = |face: usize| {
        let mut image = Image::new(side, side, 3);
        let rows = image.texels.par_chunks_exact_mut(3 * side as usize);
        rows.zip(0..side).for_each(|(row, y)| {
            for (texel, x) in row.chunks_exact_mut(3).zip(0..) {
                let mean = mean(panorama, azimuth_rad, (face, side, [x, y]), samples);
                texel.copy_from_slice(&mean.to_array());
            }
        });
        image
    };
    Cubemap {
        side,
        faces: (0..FACES.len()).map(face).collect(),
    }
}

/// The mean over a texel of a face.
fn mean(
    panorama: &Image,
    azimuth_rad: f32,
    (face, side, at): (usize, u32, [u32; 2]),
    samples: u32,
) -> Vec3 {
    let (mut light, mut solid_angle) = (Vec3::ZERO, 0.0);
    let count = (side * samples) as f32;
    for (i, j) in (0..samples).flat_map(|j| (0..samples).map(move |i| (i, j))) {
        let st = [(0, i), (1, j)].map(|(axis, n)| ((at[axis] * samples + n) as f32 + 0.5) / count);
        let [s, t] = st.map(|c| 2.0 * c - 1.0);
        let weight = (1.0 + s * s + t * t).powf(-1.5);
        let uv = direction_to_equirect(face_to_direction(face, st), azimuth_rad);
        light += weight * bilinear(panorama, uv);
        solid_angle += weight;
    }
    light / solid_angle
}

/// Between the four nearest texels; the first column is the last one's neighbour, and within half of the row about a pole all is that row's. So it
/// counts 13/12 of its area: the integral of r over 0..1/2, and of r (3/2 - r) over 1/2..3/2, is 13/24 instead of 1/2.
fn bilinear(panorama: &Image, [u, v]: [f32; 2]) -> Vec3 {
    let (width, height) = (panorama.width as i32, panorama.height as i32);
    let place = [u * width as f32 - 0.5, v * height as f32 - 0.5];
    let corner = place.map(f32::floor);
    let [across, down] = [0, 1].map(|i| place[i] - corner[i]);
    let texel = |i: i32, j: i32| {
        let x = (corner[0] as i32 + i).rem_euclid(width);
        let y = (corner[1] as i32 + j).clamp(0, height - 1);
        Vec3::from_slice(panorama.texel(x as u32, y as u32))
    };
    let upper = texel(0, 0).lerp(texel(1, 0), across);
    let lower = texel(0, 1).lerp(texel(1, 1), across);
    upper.lerp(lower, down)
}

/// The means of 2x2 texels, each with its solid angle.
fn halved(panorama: &Image) -> Image {
    let (width, height) = (panorama.width / 2, panorama.height / 2);
    let mut half = Image::new(width, height, 3);
    // The sine of the elevation of a row's upper edge.
    let sine = |row: u32| (PI * (0.5 - row as f32 / panorama.height as f32)).sin();
    let rows = half.texels.par_chunks_exact_mut(3 * width as usize);
    rows.zip(0..height).for_each(|(row, y)| {
        let weights = [0, 1].map(|j| sine(2 * y + j) - sine(2 * y + j + 1));
        let whole = 2.0 * (weights[0] + weights[1]);
        for (texel, x) in row.chunks_exact_mut(3).zip(0..) {
            let of_row = |j: u32| {
                let pair = [0, 1].map(|i| panorama.texel(2 * x + i, 2 * y + j));
                (Vec3::from_slice(pair[0]) + Vec3::from_slice(pair[1])) * weights[j as usize]
            };
            texel.copy_from_slice(&((of_row(0) + of_row(1)) / whole).to_array());
        }
    });
    half
}

#[cfg(test)]
mod tests;
