//! Layers of clouds: normal, density and rank of three kinds, each from noise of its own character.
//!
//! # Theory
//! K. Mukhina, A. Bezgodov, "The Method for Real-time Cloud Rendering", Procedia Computer Science 66, 2015: clouds are
//! two-dimensional Perlin noise, packed in one texture with its normals; cover takes the brightest parts.
//!
//! # Changes versus the paper
//! - Three kinds: the paper has stratocumulus, and expects cumulus and cirrus of other parameters. Cellular noise gives
//!   the lumps that gradient noise lacks.
//! - Beside the density stands its rank, which inverts its distribution: ranks above `1 - c` are the densest share `c`
//!   of the texels exactly, so cover can be told in oktas.
//! - Normals are unit vectors of the surface whose height is the density, by periodic central differences.

mod cells;
mod cirrus;
mod cumulus;
mod stratocumulus;

use welkin_pack::{Image, LayerKind};

use crate::filter;
use crate::settings::{LayerSettings, LayersSettings};
use crate::stream::Stream;

/// Where outliers of the density are bent in, in standard deviations.
const OUTLIER: f32 = 3.0;

/// One image a kind, in the order of [`LayerKind::ALL`], four channels each, as [`welkin_pack::LayerTexel`] names
/// them. Each kind has a random stream of its own, such as `layers.cirrus`.
pub(crate) fn images(settings: &LayersSettings, seed: u64) -> Vec<Image> {
    let kinds = LayerKind::ALL.into_iter().zip(&settings.kinds);
    kinds
        .map(|(kind, layer)| {
            let mut stream = Stream::new(seed, &format!("layers.{}", kind.name()));
            let density = density(kind, layer, settings.size, &mut stream);
            packed(&density, layer.relief)
        })
        .collect()
}

/// One channel, 0..1, both reached.
fn density(kind: LayerKind, settings: &LayerSettings, size: u32, stream: &mut Stream) -> Image {
    let mut density = match kind {
        LayerKind::Stratocumulus => stratocumulus::field(settings, size, stream),
        LayerKind::Cumulus => cumulus::field(settings, size, stream),
        LayerKind::Cirrus => cirrus::field(settings, size, stream),
    };
    filter::calibrate(&mut density, 0.0, OUTLIER, kind.mean_density());
    density
}

/// Normal, density and rank. `relief` is the root mean square slope that the surface gets.
fn packed(density: &Image, relief: f32) -> Image {
    let differences = differences(density);
    let squares = differences
        .iter()
        .flatten()
        .map(|&d| f64::from(d) * f64::from(d));
    let spread = libm::sqrt(squares.sum::<f64>() / differences.len() as f64) as f32;
    let scale = if spread > 0.0 { relief / spread } else { 0.0 };
    let ranks = ranks(&density.texels);
    let mut image = Image::new(density.width, density.height, 4);
    for (i, texel) in image.texels.chunks_exact_mut(4).enumerate() {
        let [x, y] = differences[i].map(|d| -scale * d);
        let length = libm::sqrtf(1.0 + x * x + y * y);
        let [x, y] = [x, y].map(|n| 0.5 + 0.5 * n / length);
        texel.copy_from_slice(&[x, y, density.texels[i], ranks[i]]);
    }
    image
}

/// Periodic central differences along u and v, per texel.
fn differences(density: &Image) -> Vec<[f32; 2]> {
    let (width, height) = (density.width, density.height);
    let at = |x: u32, y: u32| density.texel(x % width, y % height)[0];
    let texels = (0..height).flat_map(|y| (0..width).map(move |x| (x, y)));
    texels
        .map(|(x, y)| {
            [
                0.5 * (at(x + 1, y) - at(x + width - 1, y)),
                0.5 * (at(x, y + 1) - at(x, y + height - 1)),
            ]
        })
        .collect()
}

/// Of each value the share of values below it; equal ones follow each other as they stand. In steps of a byte, so that
/// every byte comes equally often: the `i`-th of `n` values in order has `floor(256 i / n) / 255`.
fn ranks(values: &[f32]) -> Vec<f32> {
    let mut order: Vec<usize> = (0..values.len()).collect();
    order.sort_by(|&a, &b| values[a].total_cmp(&values[b]));
    let mut ranks = vec![0.0; values.len()];
    for (i, place) in order.into_iter().enumerate() {
        ranks[place] = (256 * i / values.len()) as f32 / 255.0;
    }
    ranks
}
