//! Seams and smoothness of channels that tile.

use super::report::{Report, subject};
use super::rule::{SEAM, SMOOTH};
use crate::format::Format;
use crate::role::Role;
use crate::texture::Texture;
use crate::view::View;

/// Compares the step across the edges with the steps inside, on both axes of every layer. Level 0 is enough: the others are shown to
/// be means of it.
pub(super) fn check_seam(report: &mut Report, role: Role, texture: &Texture, channel: usize) {
    let worst = seam(texture, channel);
    report.at_most(SEAM, &subject(role, channel), worst, 1.0);
}

/// The worst ratio, on level 0, of the root mean square step across the edge to the largest one between two neighbouring
/// rows or columns inside, over its bound.
///
/// The step is what the difference of two lines has beyond the mean of the differences next to it: in a smooth picture the slope
/// goes on, whereas a cut is in one difference alone. In a channel that tiles the edge is a place like any other, so a ratio above 1
/// is rare and one above 2.5 all but impossible; small textures have few rows to take the largest from, hence the slack of 16 / rows.
/// Three quarters of the texels of a side, cut out anywhere, have twice the bound and more.
pub(super) fn seam(texture: &Texture, channel: usize) -> f64 {
    let mut worst = 0.0_f64;
    for image in (0..texture.layers).map(|layer| texture.view(0, layer)) {
        for axis in [Axis::X, Axis::Y] {
            let (inside, across) = steps(image, channel, axis);
            let Some(largest) = inside.into_iter().reduce(f64::max) else {
                continue;
            };
            let slack = 2.5 + 16.0 / f64::from(axis.length(image));
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
    report.at_most(
        SMOOTH,
        &subject(role, channel),
        ratios.fold(0.0, f64::max),
        most,
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

/// Root mean square steps between each line and the next, of those that do not reach over the edge, and at the edge.
fn steps(image: View, channel: usize, axis: Axis) -> (Vec<f64>, f64) {
    let (length, breadth) = match axis {
        Axis::X => (image.width, image.height),
        Axis::Y => (image.height, image.width),
    };
    let at = |along: u32, across: u32| match axis {
        Axis::X => f64::from(image.texel(along % length, across)[channel]),
        Axis::Y => f64::from(image.texel(across, along % length)[channel]),
    };
    // Between the second and the third of four lines: 1.5 times their difference less half of that of the outer two.
    let step = |first: u32| {
        let square = |i: u32| {
            let [a, b, c, d] = [0, 1, 2, 3].map(|k| at(first + k, i));
            let step = 1.5 * (c - b) - 0.5 * (d - a);
            step * step
        };
        libm::sqrt((0..breadth).map(square).sum::<f64>() / f64::from(breadth))
    };
    let inside = (0..length.saturating_sub(3)).map(step).collect();
    (inside, step(length.max(2) - 2))
}

#[cfg(all(test, feature = "write"))]
mod tests {
    use super::*;
    use crate::format::Shape;
    use crate::image::Image;
    use crate::texture::encode;

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
    fn a_part_that_was_cut_out_has_twice_the_bound_and_more() {
        let tile = crate::test_pack::waves(128, 5);
        let cut = |side: usize| {
            let rows = tile.chunks_exact(128).take(side);
            let texels: Vec<f32> = rows
                .flat_map(|row| row[..side].iter().flat_map(|&v| [v; 4]))
                .collect();
            let texture = Texture {
                format: Format::Rgba8Unorm,
                shape: Shape::D2,
                width: side as u32,
                height: side as u32,
                layers: 1,
                levels: vec![encode(Format::Rgba8Unorm, &texels)],
            };
            seam(&texture, 0)
        };
        assert!(cut(128) < 0.5, "{}", cut(128));
        for side in [96, 101, 110] {
            assert!(cut(side) > 2.0, "{side}: {}", cut(side));
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
