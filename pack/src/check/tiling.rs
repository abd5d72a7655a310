//! Seams and smoothness of channels that tile.

use super::report::{Bound, Report};
use super::rule::{SEAM, SMOOTH};
use super::subject;
use crate::view::View;
use crate::{Format, Role, Texture};

/// Compares the difference across the edges with the differences inside, on both axes, every level and layer.
pub(super) fn check_seam(report: &mut Report, role: Role, texture: &Texture, channel: usize) {
    let worst = seam(texture, channel, texture.levels.len());
    report.measure(SEAM, &subject(role, channel), worst, Bound::AtMost(1.0));
}

/// The worst ratio, on the first `levels`, of the root mean square difference across the edge to the largest one
/// between two neighbouring rows or columns inside, over its bound at that level.
///
/// In a channel that tiles the edge is a place like any other, so the ratio seldom reaches 1; small levels have few
/// rows to take the largest from, hence the slack of 8 / rows.
pub(super) fn seam(texture: &Texture, channel: usize, levels: usize) -> f64 {
    let mut worst = 0.0_f64;
    let images = (0..levels)
        .flat_map(|level| (0..texture.layers).map(move |layer| texture.view(level, layer)));
    for image in images {
        for axis in [Axis::X, Axis::Y] {
            let (inside, across) = differences(image, channel, axis);
            let Some(largest) = inside.into_iter().reduce(f64::max) else {
                continue;
            };
            let slack = 1.25 + 8.0 / f64::from(axis.length(image));
            worst = worst.max(across / ((largest + HALF_STEP) * slack));
        }
    }
    worst
}

/// Below half a step of a byte a difference is rounding.
const HALF_STEP: f64 = 0.5 / 255.0;

/// Compares second differences of neighbouring texels with first ones.
///
/// A wave of `n` texels has the ratio `2 sin(pi / n)`, white noise has sqrt(3). The figure is the ratio of
/// the root mean squares over both axes, at level 0 of the worst layer, without what rounding makes of second ones.
pub(super) fn check_smooth(
    report: &mut Report,
    role: Role,
    texture: &Texture,
    channel: usize,
    texels_a_wave: f64,
) {
    let ratios =
        (0..texture.layers).map(|i| roughness(texture.view(0, i), texture.format, channel));
    let most = 2.0 * libm::sin(std::f64::consts::PI / texels_a_wave);
    report.measure(
        SMOOTH,
        &subject(role, channel),
        ratios.fold(0.0, f64::max),
        Bound::AtMost(most),
    );
}

/// The ratio of second to first differences.
///
/// Where neighbours differ by less than a step of the format, as in large textures, second differences are mostly
/// rounding. Errors that are even over a step `s` have the variance `s^2 / 12` and, weighed 1, -2, 1, make
/// `(1 + 4 + 1) s^2 / 12` of a squared second difference: half a step squared. On a slope of `d` steps a texel errors
/// follow each other and make `2 min(d, 1 - d)` steps squared, which is the same half over all slopes. That much is taken
/// off. Noise of the texels themselves stays: of a third of a step it is as strong as rounding, and no picture can be
/// smoother than its rounding.
fn roughness(image: View, format: Format, channel: usize) -> f64 {
    let (mut first, mut second) = (0.0, 0.0);
    let (width, height) = (image.width, image.height);
    let at = |x: u32, y: u32| f64::from(image.texel(x % width, y % height)[channel]);
    for y in 0..height {
        for x in 0..width {
            let here = image.texel(x, y)[channel];
            let step = 2.0 * f64::from(format.quantisation_error(here));
            for (dx, dy) in [(1, 0), (0, 1)] {
                let (a, b, c) = (
                    f64::from(here),
                    at(x + dx, y + dy),
                    at(x + 2 * dx, y + 2 * dy),
                );
                first += (b - a) * (b - a);
                second += (c - 2.0 * b + a) * (c - 2.0 * b + a) - 0.5 * step * step;
            }
        }
    }
    if first > 0.0 {
        libm::sqrt(second.max(0.0) / first)
    } else {
        0.0
    }
}

#[derive(Clone, Copy)]
enum Axis {
    X,
    Y,
}

impl Axis {
    fn length(self, image: View) -> u32 {
        match self {
            Axis::X => image.width,
            Axis::Y => image.height,
        }
    }
}

/// Root mean square differences between each line and the next, and between the last and the first.
fn differences(image: View, channel: usize, axis: Axis) -> (Vec<f64>, f64) {
    let (length, breadth) = match axis {
        Axis::X => (image.width, image.height),
        Axis::Y => (image.height, image.width),
    };
    let at = |along: u32, across: u32| match axis {
        Axis::X => f64::from(image.texel(along, across)[channel]),
        Axis::Y => f64::from(image.texel(across, along)[channel]),
    };
    let difference = |a: u32, b: u32| {
        let sum: f64 = (0..breadth)
            .map(|i| (at(a, i) - at(b, i)) * (at(a, i) - at(b, i)))
            .sum();
        libm::sqrt(sum / f64::from(breadth))
    };
    let inside = (1..length).map(|i| difference(i - 1, i)).collect();
    (inside, difference(length - 1, 0))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::texture::encode;
    use crate::{Image, Shape};

    /// Waves of several slopes, from a hundredth of a step of a byte to a whole one a texel, and noise, stored.
    fn stored(format: Format, slope: f32, noise: f32) -> Texture {
        let size = 256;
        let mut image = Image::new(size, size, 4);
        let turn = |i: u32, waves: u32| std::f32::consts::TAU * (i * waves) as f32 / size as f32;
        let mut bits = 1_u64;
        for (i, texel) in (0..).zip(image.texels.chunks_exact_mut(4)) {
            let (x, y) = (i % size, i / size);
            let wave = libm::sinf(turn(x, 1)) + libm::cosf(turn(y, 1) + 1.0);
            bits = bits.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
            let even = (bits >> 40) as f32 / 16_777_216.0 - 0.5;
            // A wave of one cycle falls by 2 pi over the size a texel at most.
            let amplitude = slope * size as f32 / std::f32::consts::TAU;
            texel.fill((amplitude * wave + 2.0 * noise * even) / 255.0 + 0.502);
        }
        Texture {
            format,
            shape: Shape::D2,
            width: size,
            height: size,
            layers: 1,
            levels: vec![encode(format, &image.texels)],
        }
    }

    #[test]
    fn what_is_smooth_stays_smooth_however_fine_its_texels_are() {
        for slope in [0.01, 0.03, 0.1, 0.2, 0.4, 0.6, 1.0] {
            for format in [Format::Rgba8Unorm, Format::Rgba16Float] {
                let found = roughness(stored(format, slope, 0.0).view(0, 0), format, 0);
                assert!(found < 0.9, "{format:?} {slope}: {found}");
            }
        }
    }

    #[test]
    fn noise_of_one_step_is_seen_in_the_finest_texels() {
        for slope in [0.01, 0.1, 0.4] {
            let format = Format::Rgba8Unorm;
            // Even over two steps, so of 0.58 steps: twice what rounding adds.
            let found = roughness(stored(format, slope, 1.0).view(0, 0), format, 0);
            assert!(found > 1.1, "{slope}: {found}");
        }
    }
}
