//! Octaves of smooth noise that tile, packed so that one fetch gives four points of a ray.
//!
//! # Theory
//! I. Quilez, "dynamic clouds", 2005. An octave is random numbers on a lattice, between them the bilinear
//! interpolation of `x^2 (3 - 2x)`. Its alpha is the noise; blue, green and red are the noise one, two and
//! three steps of a ray march towards the sun away, so the sum over the octaves is the height of the cloud
//! at four points of the ray at once.
//!
//! # Changes versus the paper
//! Every octave has a lattice of its own instead of a coarser part of one texture, so no octave repeats in
//! another. The step is a fixed share of the tile, towards +u; where the sun stands elsewhere, the runtime
//! displaces anew.

use rayon::prelude::*;
use welkin_pack::Image;
use welkin_pack::mapping::FBM_STEPS_A_TILE;

use crate::filter;
use crate::settings::FbmSettings;
use crate::stream::Stream;

/// One image an octave, four channels each, as [`welkin_pack::FbmTexel`] names them.
///
/// Octave `j`, from 0, has `cells << j` cells across the tile and the random stream `fbm.{j + 1}`. Lattice
/// points stand at the centres of the texels 0, step, 2 step and so on.
pub(crate) fn images(settings: &FbmSettings, seed: u64) -> Vec<Image> {
    (0..settings.octaves)
        .map(|octave| {
            let mut stream = Stream::new(seed, &format!("fbm.{}", octave + 1));
            displaced(&noise(settings.size, settings.cells << octave, &mut stream))
        })
        .collect()
}

/// Periodic value noise of `cells` cells a side, one channel, 0..1.
fn noise(size: u32, cells: u32, stream: &mut Stream) -> Image {
    let bytes = (0..cells * cells).map(|_| (stream.bits() >> 56) as u8);
    let lattice: Vec<f32> = bytes.map(|byte| f32::from(byte) / 255.0).collect();
    let at = |x: u32, y: u32| lattice[((y % cells) * cells + x % cells) as usize];
    let step = size / cells;
    let share = |i: u32| filter::smoothstep(0.0, step as f32, (i % step) as f32);
    filter::plane(size, size, |x, y| {
        let (i, j) = (x / step, y / step);
        let row = |j: u32| at(i, j) + (at(i + 1, j) - at(i, j)) * share(x);
        row(j) + (row(j + 1) - row(j)) * share(y)
    })
}

/// The noise three, two, one and no steps to the right.
fn displaced(noise: &Image) -> Image {
    let width = noise.width as usize;
    let step = (noise.width / FBM_STEPS_A_TILE) as usize;
    let mut packed = Image::new(noise.width, noise.height, 4);
    let rows = packed.texels.par_chunks_mut(width * 4);
    rows.zip(noise.texels.par_chunks(width))
        .for_each(|(texels, row)| {
            for (x, texel) in texels.chunks_exact_mut(4).enumerate() {
                let away = |steps: usize| row[(x + steps * step) % width];
                texel.copy_from_slice(&[away(3), away(2), away(1), away(0)]);
            }
        });
    packed
}
