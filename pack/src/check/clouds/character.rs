//! Whether a cloud channel is the one that it claims to be, and not a neighbour, its inverse or something else.
//!
//! # Theory
//! The curve that gives a channel its mean is monotone, so the order of its values is that of the noise below it. Each
//! value is replaced by its rank, which undoes every such curve; what is measured of ranks does not depend on the
//! mean, nor on a curve that somebody has laid over a copy.
//!
//! - **Waves.** Noise of `c` cells has some `c^2` waves of about equal energy, a photograph dozens, stripes two. The effective
//!   number is `(sum e)^2 / sum e^2` over the energies `e` (the participation ratio of R. J. Bell, P. Dean, "Atomic
//!   vibrations in vitreous silica", 1970).
//! - **Band.** An octave of `c` cells has its energy about the wave number `c / 2^1.25`, where the mean of the logarithm
//!   lies; octaves weigh as the squares of their amplitudes.
//! - **Apart.** Of independent channels the gradients have any angle `a` to each other, so `cos^2 a` is 1/2 on the mean, weighted by
//!   their lengths. Of a channel and any monotone function of it, rising or falling, it is 1.

use crate::image::Image;
use crate::manifest::FractalNoise;
use crate::texture::Texture;
use crate::view::View;

use super::super::spectrum::Spectrum;

/// Cells finer than this many texels are left out of the octaves.
const FINEST_CELL_TEXELS: u32 = 6;

/// Where the mean of the logarithm to the base 2 of the wave number lies, from that of the cells: the property of gradient
/// noise, seen on a plane half way between two layers of its lattice.
const BAND_OCTAVES: f64 = -1.25;

/// The narrowest level that is looked at, in texels: coarser ones have too few waves.
const NARROWEST: u32 = 256;

/// Texels that a cell has at least.
const CELL_TEXELS: u32 = 8;

/// The narrowest level that shows noise of so many cells: what is finer says nothing new, and takes memory and time.
pub(super) fn view(texture: &Texture, cells: u32) -> View<'_> {
    let least = NARROWEST.max(cells.saturating_mul(CELL_TEXELS));
    let widths = (0..texture.levels.len()).map(|level| texture.level_size(level).0);
    let level = widths.take_while(|&width| width >= least).count();
    texture.view(level.saturating_sub(1), 0)
}

/// The ranks of a channel's values, 0..1, as an image of one channel; equal values have the mean of their ranks.
pub(super) fn ranks(image: View, channel: usize) -> Image {
    let values: Vec<f32> = image.channel(channel).collect();
    let value = |i: u32| values[i as usize];
    let mut order: Vec<u32> = (0..values.len() as u32).collect();
    order.sort_unstable_by(|&a, &b| value(a).total_cmp(&value(b)));
    let mut ranks = Image::new(image.width, image.height, 1);
    let mut start = 0;
    while start < order.len() {
        let here = value(order[start]);
        let count = order[start..].partition_point(|&i| value(i) <= here).max(1);
        let rank = (start as f64 + count as f64 / 2.0) / order.len() as f64;
        for &i in &order[start..start + count] {
            ranks.texels[i as usize] = rank as f32;
        }
        start += count;
    }
    ranks
}

/// The effective number of waves.
pub(super) fn waves(spectrum: &Spectrum) -> f64 {
    let squares: f64 = spectrum.vectors().map(|(_, _, e)| e * e).sum();
    let total = spectrum.total();
    total * total / squares.max(f64::MIN_POSITIVE)
}

/// The mean of the logarithm to the base 2 of the wave number, weighted by energy.
pub(super) fn band(spectrum: &Spectrum) -> f64 {
    let sum: f64 = spectrum
        .vectors()
        .filter(|(.., energy)| *energy > 0.0)
        .map(|(kx, ky, energy)| {
            let [x, y] = [kx, ky].map(|k| spectrum.magnitude(k) as f64);
            0.5 * energy * libm::log2(x * x + y * y)
        })
        .sum();
    sum / spectrum.total().max(f64::MIN_POSITIVE)
}

/// The same of noise with these octaves, from theory: made for `base` texels a side, and seen where it was averaged to `size`. Below
/// wave number 1 there is nothing.
pub(super) fn expected_band(noise: &FractalNoise, base: u32, size: u32) -> f64 {
    let finest = f64::from((base / FINEST_CELL_TEXELS).max(1));
    let (mut sum, mut weights) = (0.0, 0.0);
    let (mut energy, mut cells) = (1.0, f64::from(noise.cells));
    for octave in 0..noise.octaves {
        if octave > 0 && cells > finest {
            break;
        }
        let wave_number = (cells * libm::exp2(BAND_OCTAVES)).max(1.0);
        let weight = energy * averaging(wave_number, base, size);
        sum += weight * libm::log2(wave_number.min(f64::from(size) / 2.0));
        weights += weight;
        energy *= f64::from(noise.gain) * f64::from(noise.gain);
        cells *= 2.0;
    }
    sum / weights
}

/// How much of a wave's energy is left where `base / size` texels along each axis are averaged to one: `(sin (m x) / (m sin x))^2` an
/// axis, for a wave along the diagonal.
fn averaging(wave_number: f64, base: u32, size: u32) -> f64 {
    let texels = f64::from(base / size);
    let half_turn =
        std::f64::consts::PI * wave_number * std::f64::consts::FRAC_1_SQRT_2 / f64::from(base);
    let left = libm::sin(texels * half_turn) / (texels * libm::sin(half_turn));
    libm::pow(left, 4.0)
}

/// How far the band may lie below and above what theory says. The energies of the waves of one octave are random, and the logarithms
/// of their wave numbers differ by about half an octave, so the mean over its `c^2` waves strays by `0.5 / c`: five of that, which
/// chance exceeds less than once in a million, and a quarter of an octave for the theory's own error.
///
/// Where a share of the channel is clear, ranks see only the islands that are left, which are finer than the noise that they were
/// cut from: by less than 0.6 octaves for each halving of what is left.
pub(super) fn band_slack(noise: &FractalNoise, clear: f64) -> [f64; 2] {
    let chance = 0.25 + 2.5 / f64::from(noise.cells);
    let islands = 0.6 * libm::log2(1.0 / (1.0 - clear).max(1e-6));
    [chance, chance + islands]
}

/// The fewest effective waves of noise that is not of few cells: a quarter of `c^2`, where chance makes that from a third (once in
/// ten thousand at four cells) to three.
pub(super) fn least_waves(noise: &FractalNoise, size: u32) -> f64 {
    // What is cut by the texels has no more waves than they have.
    let cells = f64::from(noise.cells.min(size / FINEST_CELL_TEXELS));
    0.25 * cells * cells
}

/// More effective waves than stripes have: a sine has two, its ranks, which are a triangle, 2.06.
pub(super) const STRIPES: f64 = 2.1;

/// How far the gradients of two channels, given as ranks, are alike: the mean of `cos^2` of their angle.
pub(super) fn likeness(a: &Image, b: &Image) -> f64 {
    let (width, height) = (a.width, a.height);
    let gradient = |image: &Image, x: u32, y: u32| {
        let at = |x: u32, y: u32| f64::from(image.texel(x % width, y % height)[0]);
        [
            at(x + 1, y) - at(x + width - 1, y),
            at(x, y + 1) - at(x, y + height - 1),
        ]
    };
    let (mut sum, mut weights) = (0.0, 0.0);
    for (x, y) in (0..height).flat_map(|y| (0..width).map(move |x| (x, y))) {
        let ([ax, ay], [bx, by]) = (gradient(a, x, y), gradient(b, x, y));
        let weight = libm::sqrt((ax * ax + ay * ay) * (bx * bx + by * by));
        if weight > 0.0 {
            let dot = ax * bx + ay * by;
            sum += dot * dot / weight;
            weights += weight;
        }
    }
    if weights > 0.0 { sum / weights } else { 0.0 }
}

#[cfg(all(test, feature = "write"))]
mod tests {
    use super::*;
    use crate::format::{Format, Shape};
    use crate::test_pack::waves as field;

    /// As a texture of half floats.
    fn texture(values: &[f32]) -> Texture {
        let side = values.len().isqrt() as u32;
        let texels: Vec<f32> = values.iter().flat_map(|&v| [v, 0.0, 0.0, 1.0]).collect();
        Texture {
            format: Format::Rgba16Float,
            shape: Shape::D2,
            width: side,
            height: side,
            layers: 1,
            levels: vec![crate::texture::encode(Format::Rgba16Float, &texels)],
        }
    }

    fn ranks_of(values: &[f32]) -> Image {
        ranks(texture(values).view(0, 0), 0)
    }

    #[test]
    fn ranks_forget_every_rising_curve_and_share_ties() {
        // Values that halves keep apart.
        let plain: Vec<f32> = (0..1024).map(|i| (i * 37 % 1024) as f32 / 1024.0).collect();
        let bent: Vec<f32> = plain.iter().map(|v| 0.25 * v).collect();
        assert_eq!(ranks_of(&plain), ranks_of(&bent));
        assert_eq!(
            ranks_of(&[0.5, 0.125, 0.5, 0.875]).texels,
            [0.5, 0.125, 0.5, 0.875]
        );
    }

    #[test]
    fn a_channel_is_like_itself_and_its_inverse_and_no_other() {
        let [a, b] = [3, 4].map(|seed| ranks_of(&field(64, seed)));
        let mut inverse = a.clone();
        inverse.texels.iter_mut().for_each(|v| *v = 1.0 - *v);
        assert!((likeness(&a, &a) - 1.0).abs() < 1e-6);
        assert!((likeness(&a, &inverse) - 1.0).abs() < 1e-6);
        assert!((likeness(&a, &b) - 0.5).abs() < 0.2, "{}", likeness(&a, &b));
    }

    #[test]
    fn stripes_are_two_waves_in_one_place() {
        let turn = |x: usize| std::f32::consts::TAU * 8.0 * (x % 64) as f32 / 64.0;
        let stripes = (0..4096).map(|i| libm::sinf(turn(i)));
        let spectrum = Spectrum::new(64, stripes);
        assert!((waves(&spectrum) - 2.0).abs() < 1e-3);
        assert!((band(&spectrum) - 3.0).abs() < 1e-3);
    }
}
