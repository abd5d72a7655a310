//! Image filters that the textures share: blur, resampling, normalisation. One channel at a time.
//!
//! Every sum runs in one fixed order; only whole rows are shared out among threads.

use rayon::prelude::*;
use welkin_pack::Image;

/// What lies beyond the sides of an image.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Edge {
    /// The other side: the image tiles.
    Wrap,
    /// The image again, mirrored.
    Mirror,
}

impl Edge {
    fn index(self, i: isize, length: usize) -> usize {
        let n = length as isize;
        match self {
            Edge::Wrap => i.rem_euclid(n) as usize,
            Edge::Mirror => {
                let m = i.rem_euclid(2 * n);
                m.min(2 * n - 1 - m) as usize
            }
        }
    }
}

/// A standard deviation of less than this share of the largest value is rounding: sums of some hundred floats are exact to
/// about 1e-6.
const LEAST_SPREAD: f32 = 1e-4;

/// From the low end to the maximum, in standard deviations: less is rounding on a plateau.
const LEAST_RANGE: f32 = 0.01;

/// An image of one channel from a function of the texel.
pub(crate) fn plane(width: u32, height: u32, value: impl Fn(u32, u32) -> f32 + Sync) -> Image {
    let mut image = Image::new(width, height, 1);
    let rows = image.texels.par_chunks_mut(width as usize);
    rows.enumerate().for_each(|(y, row)| {
        for (x, texel) in row.iter_mut().enumerate() {
            *texel = value(x as u32, y as u32);
        }
    });
    image
}

/// A square image of one channel from a function of (u, v) at the texels' centres.
pub(crate) fn tile(size: u32, value: impl Fn([f64; 2]) -> f64 + Sync) -> Image {
    plane(size, size, |x, y| {
        value([x, y].map(|i| (f64::from(i) + 0.5) / f64::from(size))) as f32
    })
}

/// Convolution with a Gaussian of standard deviation `sigma` texels, cut at three of them.
pub(crate) fn gaussian_blur(image: &Image, sigma: f32, edge: Edge) -> Image {
    let radius = libm::ceilf(3.0 * sigma) as isize;
    let weight = |d: isize| libm::expf(-0.5 * (d * d) as f32 / (sigma * sigma));
    let weights: Vec<f32> = (-radius..=radius).map(weight).collect();
    let sum: f32 = weights.iter().sum();
    let weights: Vec<f32> = weights.iter().map(|w| w / sum).collect();
    let rows: Vec<Taps> = (0..image.height)
        .map(|y| (y as isize - radius, weights.clone()))
        .collect();
    mix_rows(&convolve_rows(image, &weights, edge), &rows, edge)
}

/// A Gaussian blur so wide that it is made on a smaller image and enlarged again.
pub(crate) fn wide_blur(image: &Image, sigma: f32) -> Image {
    // Three coarse texels a standard deviation: the cubic filter restores what is that smooth.
    let shrink = (sigma / 3.0).max(1.0);
    let coarse = |n: u32| (libm::ceilf(n as f32 / shrink) as u32).max(1);
    let small = resample(image, coarse(image.width), coarse(image.height));
    let scale = small.width as f32 / image.width as f32;
    resample(
        &gaussian_blur(&small, sigma * scale, Edge::Mirror),
        image.width,
        image.height,
    )
}

fn convolve_rows(image: &Image, weights: &[f32], edge: Edge) -> Image {
    let width = image.width as usize;
    let radius = (weights.len() / 2) as isize;
    let mut out = Image::new(image.width, image.height, 1);
    let rows = out
        .texels
        .par_chunks_mut(width)
        .zip(image.texels.par_chunks(width));
    rows.for_each(|(out, row)| {
        let reach = -radius..width as isize + radius;
        let padded: Vec<f32> = reach.map(|i| row[edge.index(i, width)]).collect();
        for (tap, weight) in weights.iter().enumerate() {
            for (sum, value) in out.iter_mut().zip(&padded[tap..]) {
                *sum += weight * value;
            }
        }
    });
    out
}

/// Another size by Mitchell and Netravali's cubic filter (B = C = 1/3), widened where the image shrinks.
///
/// D. P. Mitchell, A. N. Netravali, "Reconstruction Filters in Computer Graphics", SIGGRAPH 1988, eq. 8.
pub(crate) fn resample(image: &Image, width: u32, height: u32) -> Image {
    resample_to(image, width, height, Edge::Mirror)
}

/// The same of an image that tiles or is mirrored.
pub(crate) fn resample_to(image: &Image, width: u32, height: u32, edge: Edge) -> Image {
    let rows = mix_rows(image, &mitchell_taps(image.height, height), edge);
    resample_rows(&rows, width, edge)
}

/// First of the source texels (or rows) that an output takes from, and their weights.
type Taps = (isize, Vec<f32>);

/// One output row for each entry of `taps`.
fn mix_rows(image: &Image, taps: &[Taps], edge: Edge) -> Image {
    let (width, height) = (image.width as usize, image.height as usize);
    let mut out = Image::new(image.width, taps.len() as u32, 1);
    let rows = out.texels.par_chunks_mut(width).zip(taps);
    rows.for_each(|(out, (start, weights))| {
        for (i, weight) in (*start..).zip(weights) {
            let row = &image.texels[edge.index(i, height) * width..][..width];
            for (sum, value) in out.iter_mut().zip(row) {
                *sum += weight * value;
            }
        }
    });
    out
}

fn resample_rows(image: &Image, width: u32, edge: Edge) -> Image {
    let from = image.width as usize;
    let taps = mitchell_taps(image.width, width);
    let mut out = Image::new(width, image.height, 1);
    let rows = out
        .texels
        .par_chunks_mut(width as usize)
        .zip(image.texels.par_chunks(from));
    let reach =
        |(start, weights): &Taps| (-start).max(start + weights.len() as isize - from as isize);
    let pad = taps.iter().map(reach).max().unwrap_or(0).max(0);
    rows.for_each(|(out, row)| {
        let reach = -pad..from as isize + pad;
        let padded: Vec<f32> = reach.map(|i| row[edge.index(i, from)]).collect();
        for (value, (start, weights)) in out.iter_mut().zip(&taps) {
            let reached = &padded[(start + pad) as usize..];
            *value = weights.iter().zip(reached).map(|(w, v)| w * v).sum();
        }
    });
    out
}

/// Where the texels of a row of `to` take from in a row of `from`.
fn mitchell_taps(from: u32, to: u32) -> Vec<Taps> {
    let scale = from as f32 / to as f32;
    let stretch = scale.max(1.0);
    let taps = |x: u32| {
        let centre = (x as f32 + 0.5) * scale - 0.5;
        let start = libm::ceilf(centre - 2.0 * stretch) as isize;
        let end = libm::floorf(centre + 2.0 * stretch) as isize;
        let weight = |i: isize| mitchell((i as f32 - centre) / stretch);
        let weights: Vec<f32> = (start..=end).map(weight).collect();
        let sum: f32 = weights.iter().sum();
        (start, weights.iter().map(|w| w / sum).collect())
    };
    (0..to).map(taps).collect()
}

fn mitchell(x: f32) -> f32 {
    let x = x.abs();
    if x < 1.0 {
        ((7.0 * x - 12.0) * x * x + 16.0 / 3.0) / 6.0
    } else if x < 2.0 {
        (((-7.0 / 3.0 * x + 12.0) * x - 20.0) * x + 32.0 / 3.0) / 6.0
    } else {
        0.0
    }
}

/// Shifts and scales to mean 0 and standard deviation 1. An image whose standard deviation is less than `least` is scaled
/// as if it were that: what is left of a constant is rounding, and stays small.
pub(crate) fn standardise(image: &mut Image, least: f32) {
    let (mean, spread) = image.mean_and_spread(0);
    let scale = 1.0 / spread.max(least);
    for value in &mut image.texels {
        *value = (*value - mean) * scale;
    }
}

/// Brings a field to 0..1 with a given mean: [`stretch`], then [`raise_to_mean`].
///
/// A field without contrast, but for rounding, becomes its mean everywhere.
pub(crate) fn calibrate(image: &mut Image, low: f32, outlier: f32, mean: f32) {
    if stretch(image, low, outlier) {
        raise_to_mean(image, mean);
    } else {
        image.texels.fill(mean);
    }
}

/// Brings a field to 0..1: outliers are bent in softly at `outlier` standard
/// deviations (one lone peak would otherwise use up the range), the range from the quantile
/// `low` to the maximum becomes 0..1. Says no of a field without contrast, but for rounding.
pub(crate) fn stretch(image: &mut Image, low: f32, outlier: f32) -> bool {
    let largest = image.texels.iter().fold(0.0_f32, |m, v| m.max(v.abs()));
    let least = (LEAST_SPREAD * largest).max(f32::MIN_POSITIVE);
    if image.mean_and_spread(0).1 < least {
        return false;
    }
    standardise(image, least);
    for value in &mut image.texels {
        // Straight near 0, bounded by +-`outlier`.
        *value /= libm::sqrtf(1.0 + *value * *value / (outlier * outlier));
    }
    let (from, to) = (
        quantile(image, low),
        image.texels.iter().copied().fold(f32::MIN, f32::max),
    );
    if to - from < LEAST_RANGE {
        return false;
    }
    let scale = 1.0 / (to - from);
    for value in &mut image.texels {
        *value = ((*value - from) * scale).clamp(0.0, 1.0);
    }
    true
}

/// Gives values of 0..1 a mean, by the one power that does: it is found by bisection on a histogram of 4096 bins, to 1/1000 of
/// the mean.
pub(crate) fn raise_to_mean(image: &mut Image, mean: f32) {
    let power = power_for_mean(&image.texels, mean);
    image.texels.par_chunks_mut(4096).for_each(|chunk| {
        for value in chunk {
            *value = libm::powf(*value, power);
        }
    });
}

fn quantile(image: &Image, share: f32) -> f32 {
    let mut values = image.texels.clone();
    let rank = (share * (values.len() - 1) as f32 + 0.5) as usize;
    *values.select_nth_unstable_by(rank, f32::total_cmp).1
}

fn power_for_mean(values: &[f32], mean: f32) -> f32 {
    const BINS: usize = 4096;
    let mut counts = [0_u32; BINS + 1];
    for value in values {
        counts[(value * BINS as f32 + 0.5) as usize] += 1;
    }
    let mean_of = |power: f32| {
        let sum = counts
            .iter()
            .enumerate()
            .fold(0.0_f64, |sum, (bin, &count)| {
                sum + f64::from(count) * f64::from(libm::powf(bin as f32 / BINS as f32, power))
            });
        (sum / values.len() as f64) as f32
    };
    // The mean falls as the power grows. Noise of a cell or two has broad crests and needs more for a low mean. Twenty halvings of
    // the exponent's logarithm are enough.
    let (mut least, mut most) = (1.0 / 64.0_f32, 64.0_f32);
    if mean_of(most) > mean {
        (least, most) = (most, most * most);
    }
    for _ in 0..20 {
        let middle = libm::sqrtf(least * most);
        if mean_of(middle) > mean {
            least = middle
        } else {
            most = middle
        }
    }
    libm::sqrtf(least * most)
}

/// The smooth step 3t^2 - 2t^3 from 0 at `from` to 1 at `to`.
pub(crate) fn smoothstep(from: f32, to: f32, value: f32) -> f32 {
    let t = ((value - from) / (to - from)).clamp(0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn waves(size: u32) -> Image {
        let turn = |i: u32| std::f32::consts::TAU * i as f32 / size as f32;
        plane(size, size, |x, y| {
            libm::sinf(turn(x)) + 0.5 * libm::cosf(3.0 * turn(y))
        })
    }

    #[test]
    fn a_blur_damps_a_wave_as_a_gaussian_does() {
        let (size, sigma) = (64, 3.0);
        let blurred = gaussian_blur(&waves(size), sigma, Edge::Wrap);
        let damped = |waves: f32| {
            let k = std::f32::consts::TAU * waves / size as f32;
            libm::expf(-0.5 * k * k * sigma * sigma)
        };
        let turn = |i: u32| std::f32::consts::TAU * i as f32 / size as f32;
        for (x, y) in [(0, 0), (5, 40), (63, 63), (31, 7)] {
            let expected =
                damped(1.0) * libm::sinf(turn(x)) + 0.5 * damped(3.0) * libm::cosf(3.0 * turn(y));
            // Cutting the kernel at three sigma leaves out 0.3 % of it.
            assert!((blurred.texel(x, y)[0] - expected).abs() < 4e-3, "{x} {y}");
        }
    }

    #[test]
    fn a_constant_stays_constant() {
        let flat = plane(50, 30, |_, _| 0.7);
        let same = |image: &Image| image.texels.iter().all(|v| (v - 0.7).abs() < 1e-5);
        assert!(same(&gaussian_blur(&flat, 4.0, Edge::Mirror)));
        assert!(same(&wide_blur(&flat, 12.0)));
        for (width, height) in [(7, 90), (200, 11), (50, 30)] {
            let other = resample(&flat, width, height);
            assert!(same(&other) && other.width == width && other.height == height);
        }
    }

    #[test]
    fn resampling_keeps_a_slope_where_it_is() {
        let slope = plane(60, 4, |x, _| (x as f32 + 0.5) / 60.0);
        for width in [20, 60, 150] {
            let other = resample(&slope, width, 4);
            // The mirrored sides bend the slope within two source texels of them, or two new ones.
            for x in width / 6..width - width / 6 {
                let expected = (x as f32 + 0.5) / width as f32;
                assert!(
                    (other.texel(x, 2)[0] - expected).abs() < 1e-4,
                    "{width}: {x}"
                );
            }
        }
    }

    #[test]
    fn edges_wrap_and_mirror() {
        let indices = |edge: Edge| [-4, -1, 0, 2, 3, 7].map(|i| edge.index(i, 3));
        assert_eq!(indices(Edge::Wrap), [2, 2, 0, 2, 0, 1]);
        assert_eq!(indices(Edge::Mirror), [2, 0, 0, 2, 2, 1]);
    }

    #[test]
    fn calibration_reaches_its_mean_and_keeps_the_order() {
        for mean in [0.05, 0.3, 0.6] {
            let before = waves(64);
            let mut after = before.clone();
            calibrate(&mut after, 0.01, 3.0, mean);
            assert!((after.mean_and_spread(0).0 - mean).abs() < 1e-3);
            let mut pairs: Vec<(f32, f32)> = before
                .texels
                .iter()
                .copied()
                .zip(after.texels.iter().copied())
                .collect();
            pairs.sort_by(|a, b| a.0.total_cmp(&b.0));
            // A small power makes much of rounding near 0, so only values that differ clearly are compared.
            let mut clear = pairs.windows(2).filter(|w| w[1].0 - w[0].0 > 1e-4);
            assert!(clear.all(|w| w[0].1 <= w[1].1));
        }
    }

    #[test]
    fn a_constant_survives_calibration() {
        let mut flat = plane(8, 8, |_, _| 0.3);
        calibrate(&mut flat, 0.01, 3.0, 0.2);
        assert!(flat.texels.iter().all(|v| *v == 0.2));
    }

    /// A constant but for the last bit of some texels, and a plateau with a few holes but for the same.
    #[test]
    fn rounding_is_not_stretched_to_a_pattern() {
        let rounding = |x: u32, y: u32| {
            if (x * 7 + y * 3) % 5 < 2 {
                1.0 + f32::EPSILON
            } else {
                1.0
            }
        };
        let constant = plane(64, 64, |x, y| 0.7 * rounding(x, y));
        let plateau = plane(64, 64, |x, y| {
            let hole = if x == 9 && y % 3 == 0 { 0.5 } else { 1.0 };
            hole * rounding(x, y)
        });
        for mut field in [constant, plateau] {
            calibrate(&mut field, 0.05, 8.0, 0.16);
            assert!(field.texels.iter().all(|v| *v == 0.16));
        }
        let mut constant = plane(64, 64, rounding);
        standardise(&mut constant, 0.01);
        assert!(constant.texels.iter().all(|v| v.abs() < 1e-4));
    }
}
