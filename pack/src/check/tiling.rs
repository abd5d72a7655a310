//! Seams and smoothness of channels that tile.

use super::report::{Bound, Report};
use super::rule::{SEAM, SMOOTH};
use super::subject;
use crate::view::View;
use crate::{Role, Texture};

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
/// the root mean squares over both axes, at level 0 of the worst layer.
pub(super) fn check_smooth(
    report: &mut Report,
    role: Role,
    texture: &Texture,
    channel: usize,
    texels_a_wave: f64,
) {
    let ratios = (0..texture.layers).map(|layer| roughness(texture.view(0, layer), channel));
    let most = 2.0 * libm::sin(std::f64::consts::PI / texels_a_wave);
    report.measure(
        SMOOTH,
        &subject(role, channel),
        ratios.fold(0.0, f64::max),
        Bound::AtMost(most),
    );
}

fn roughness(image: View, channel: usize) -> f64 {
    let (mut first, mut second) = (0.0, 0.0);
    let (width, height) = (image.width, image.height);
    let at = |x: u32, y: u32| f64::from(image.texel(x % width, y % height)[channel]);
    for y in 0..height {
        for x in 0..width {
            for (dx, dy) in [(1, 0), (0, 1)] {
                let (a, b, c) = (at(x, y), at(x + dx, y + dy), at(x + 2 * dx, y + 2 * dy));
                first += (b - a) * (b - a);
                second += (c - 2.0 * b + a) * (c - 2.0 * b + a);
            }
        }
    }
    if first > 0.0 {
        libm::sqrt(second / first)
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
