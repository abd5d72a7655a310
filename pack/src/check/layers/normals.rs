//! What bytes of normals and of density can stand for.
//!
//! A stored number stands for any number that rounds to it. So a normal is not compared with a value but with a
//! range, and a rule blames only what no sound surface could have been rounded to.

use crate::view::{Texel, View};

/// Half a step of a byte in a component, whose range is -1..1; a ten-thousandth more, since the numbers that were
/// rounded had seven digits.
const HALF_STEP: f64 = 1.0001 / 255.0;

/// What a central difference of two bytes may be wrong by: half a step each, halved together.
const DIFFERENCE_ERROR: f64 = 0.5 * HALF_STEP;

/// All numbers from the first to the second.
type Range = [f64; 2];

/// Of the squares of a range.
fn squares([low, high]: Range) -> Range {
    let [a, b] = [low * low, high * high];
    let least = if low <= 0.0 && high >= 0.0 {
        0.0
    } else {
        a.min(b)
    };
    [least, a.max(b)]
}

/// The four texels that a texel of the next level is made from.
fn under(above: View, x: u32, y: u32) -> [Texel; 4] {
    let corners = [(0, 0), (1, 0), (0, 1), (1, 1)];
    corners.map(|(i, j)| above.texel(2 * x + i, 2 * y + j))
}

fn texels(image: View) -> impl Iterator<Item = (u32, u32)> + use<> {
    let (width, height) = (image.width, image.height);
    (0..height).flat_map(move |y| (0..width).map(move |x| (x, y)))
}

/// The normals that a texel may stand for: along u, along v and upwards.
fn ranges(texel: &[f32]) -> [Range; 3] {
    let [x, y] = [texel[0], texel[1]].map(|stored| {
        let n = 2.0 * f64::from(stored) - 1.0;
        [n - HALF_STEP, n + HALF_STEP]
    });
    let [[least_x, most_x], [least_y, most_y]] = [x, y].map(squares);
    let up = |square: f64| libm::sqrt((1.0 - square).max(0.0));
    [x, y, [up(most_x + most_y), up(least_x + least_y)]]
}

/// The longest of the shortest horizontal parts that the texels may stand for; longer than 1 none may be.
pub(super) fn longest(image: View) -> f64 {
    let lengths = image.texels().map(|texel| {
        let [x, y, _] = ranges(&texel);
        libm::sqrt(squares(x)[0] + squares(y)[0])
    });
    lengths.fold(0.0, f64::max)
}

/// How far, in half steps, a component of a level is from every unit vector along the sum of the normals above it.
pub(super) fn off_the_mean(above: View, level: View) -> f64 {
    let mut worst = 0.0_f64;
    for (x, y) in texels(level) {
        let normals = under(above, x, y).map(|texel| ranges(&texel));
        let sum = normals.iter().fold([[0.0; 2]; 3], |sum, normal| {
            [0, 1, 2].map(|i| [sum[i][0] + normal[i][0], sum[i][1] + normal[i][1]])
        });
        for (component, other) in [(0, 1), (1, 0)] {
            let [low, high] = unit_component(sum[component], sum[other], sum[2]);
            let stored = 2.0 * f64::from(level.texel(x, y)[component]) - 1.0;
            worst = worst.max((low - stored).max(stored - high) / HALF_STEP);
        }
    }
    worst
}

/// `x / sqrt(x^2 + y^2 + z^2)`, which grows with x, and shrinks to 0 as the others grow.
fn unit_component(x: Range, y: Range, z: Range) -> Range {
    let ([near_y, far_y], [near_z, far_z]) = (squares(y), squares(z));
    let unit = |x: f64, others: f64| {
        let length = libm::sqrt(x * x + others);
        if length > 0.0 { x / length } else { 0.0 }
    };
    let (near, far) = (near_y + near_z, far_y + far_z);
    [
        unit(x[0], if x[0] < 0.0 { near } else { far }),
        unit(x[1], if x[1] > 0.0 { near } else { far }),
    ]
}

/// Whether one height makes the density the surface that has these normals.
///
/// Each slope `s = -x / z` is a height times a periodic central difference `d` of the density. Of both a range is known;
/// so each texel and axis sets bounds to the height. The figure is the greatest lower bound over the least
/// upper bound: at most 1, if there is a height between them.
pub(super) fn disagreement(image: View, density: usize) -> f64 {
    let (width, height) = (image.width, image.height);
    let at = |x: u32, y: u32| f64::from(image.texel(x % width, y % height)[density]);
    let mut bounds = [0.0, f64::INFINITY];
    for (x, y) in texels(image) {
        let [normal_x, normal_y, up] = ranges(&image.texel(x, y));
        let along_u = 0.5 * (at(x + 1, y) - at(x + width - 1, y));
        let along_v = 0.5 * (at(x, y + 1) - at(x, y + height - 1));
        for (normal, difference) in [(normal_x, along_u), (normal_y, along_v)] {
            narrow(&mut bounds, slope(normal, up), difference);
        }
    }
    let [least, most] = bounds;
    if most > 0.0 {
        least / most
    } else {
        f64::INFINITY
    }
}

fn slope([low, high]: Range, [least_up, most_up]: Range) -> Range {
    let over = |n: f64, up: f64| if n == 0.0 { 0.0 } else { n / up };
    [
        over(-high, if high > 0.0 { least_up } else { most_up }),
        over(-low, if low < 0.0 { least_up } else { most_up }),
    ]
}

/// Keeps the heights `h` for which `h d` reaches into the range of the slope.
fn narrow(bounds: &mut Range, [low, high]: Range, difference: f64) {
    let (least, most) = (difference - DIFFERENCE_ERROR, difference + DIFFERENCE_ERROR);
    let [at_least, at_most] = bounds;
    // h least <= high
    if least > 0.0 {
        *at_most = at_most.min(high / least);
    } else if least < 0.0 {
        *at_least = at_least.max(high / least);
    }
    // h most >= low
    if most > 0.0 {
        *at_least = at_least.max(low / most);
    } else if most < 0.0 {
        *at_most = at_most.min(low / most);
    }
}

/// Root mean square slope of the surface with these normals.
pub(super) fn relief(image: View) -> f64 {
    let squares = image.texels().map(|texel| {
        let [x, y] = [texel[0], texel[1]].map(|stored| 2.0 * f64::from(stored) - 1.0);
        let horizontal = x * x + y * y;
        horizontal / (1.0 - horizontal).max(HALF_STEP)
    });
    libm::sqrt(squares.sum::<f64>() / (f64::from(image.width) * f64::from(image.height)))
}
