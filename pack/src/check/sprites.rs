//! The sheet of cloud sprites.

use super::report::{Report, subject};
use super::rule::{
    SPRITE_BORDER, SPRITE_CELLS, SPRITE_CORE, SPRITE_FLAT, SPRITE_FOG, SPRITE_GREY, SPRITE_LEVEL,
};
use crate::mapping::{SheetCell, SheetKind};
use crate::role::Role;
use crate::texture::{Texture, unorm8};
use crate::view::{Texel, View};

const NAME: &str = Role::Sprites.name();
const GREY: usize = 0;
const GREYS: [usize; 3] = [0, 2, 3];
const ALPHA: usize = 1;

/// Opacity that the densest place of a puff has at least, or the sky shows through a heap of few sprites.
const LEAST_CORE: f64 = 0.9;

/// Unevenness of a flat bottom: half of what a disc has.
const MOST_UNEVEN: f64 = 0.02;

pub(super) fn check(report: &mut Report, texture: &Texture) {
    let levels: Vec<View> = texture.views().collect();
    let borders = levels
        .iter()
        .copied()
        .map(brightest_border)
        .fold(0.0, f64::max);
    report.at_most(SPRITE_BORDER, NAME, borders, 0.0);
    check_levels(report, &levels);
    let cells: Vec<Cell> = (0..SheetCell::COUNT)
        .map(|index| Cell::new(levels[0], SheetCell(index)))
        .collect();
    for (index, cell) in cells.iter().enumerate() {
        let [least, most] = SheetCell::OPACITY.map(f64::from);
        report.within(
            SPRITE_CELLS,
            &format!("{NAME} {index}"),
            cell.opacity(),
            [least, most],
        );
    }
    check_kinds(report, &cells);
}

/// What pictures of one's own may break on purpose.
fn check_kinds(report: &mut Report, cells: &[Cell]) {
    for channel in GREYS {
        let off = cells.iter().map(|cell| (cell.grey(channel) - 0.5).abs());
        let name = subject(Role::Sprites, channel);
        report.at_most(SPRITE_GREY, &name, off.fold(0.0, f64::max), 0.05);
    }
    let of = |kind: SheetKind| cells.iter().filter(move |cell| cell.kind == kind);
    let flat = || of(SheetKind::FlatBottomed);
    let cores = of(SheetKind::Puffy).chain(flat()).map(Cell::peak);
    let least = cores.fold(f64::INFINITY, f64::min);
    report.at_least(SPRITE_CORE, NAME, least, LEAST_CORE);
    let uneven = flat().map(Cell::unevenness).fold(0.0, f64::max);
    report.at_most(SPRITE_FLAT, NAME, uneven, MOST_UNEVEN);
    let fog = of(SheetKind::Foggy)
        .map(Cell::roughness)
        .fold(0.0, f64::max);
    let puffs = of(SheetKind::Puffy).map(Cell::roughness);
    let ratio = fog / puffs.fold(f64::INFINITY, f64::min);
    report.at_most(SPRITE_FOG, NAME, ratio, 1.0);
}

/// The largest opacity of the outermost texels of any cell.
fn brightest_border(image: View) -> f64 {
    let last = image.width / SheetCell::A_SIDE - 1;
    let is_border = |i: u32| [0, last].contains(&(i % (last + 1)));
    let border = places(image.width).filter(|&[x, y]| is_border(x) || is_border(y));
    border
        .map(|[x, y]| f64::from(image.texel(x, y)[ALPHA]))
        .fold(0.0, f64::max)
}

fn check_levels(report: &mut Report, levels: &[View]) {
    let worst = |measure: &dyn Fn(View, View) -> f64| {
        let steps = levels.windows(2).map(|pair| measure(pair[0], pair[1]));
        steps.fold(0.0, f64::max)
    };
    // Both levels were rounded: half a step each, and seven digits.
    let name = |channel| subject(Role::Sprites, channel);
    report.at_most(SPRITE_LEVEL, &name(ALPHA), worst(&off_the_mean), 1.0001);
    for grey in GREYS {
        let outside = worst(&|above, level| outside_of_those_above(above, level, grey));
        report.at_most(SPRITE_LEVEL, &name(grey), outside, 1.0);
    }
}

/// By how many steps a texel's opacity differs from the mean of the four above it, borders of cells aside.
fn off_the_mean(above: View, level: View) -> f64 {
    let last = level.width / SheetCell::A_SIDE - 1;
    let is_inside = |i: u32| (1..last).contains(&(i % (last + 1)));
    let inside = places(level.width).filter(|&[x, y]| is_inside(x) && is_inside(y));
    let differences = inside.map(|place| {
        let sum: f64 = under(above, place)
            .map(|t| f64::from(t[ALPHA]))
            .iter()
            .sum();
        let [x, y] = place;
        (f64::from(level.texel(x, y)[ALPHA]) - sum / 4.0).abs() * 255.0
    });
    differences.fold(0.0, f64::max)
}

/// By how many steps a texel's grey, which is a mean by weights, lies outside of the greys above it.
fn outside_of_those_above(above: View, level: View, channel: usize) -> f64 {
    let steps = places(level.width).map(|[x, y]| {
        let greys = under(above, [x, y]).map(|t| unorm8(t[channel]));
        let grey = unorm8(level.texel(x, y)[channel]);
        let [least, most] = greys
            .iter()
            .fold([255, 0], |[a, b], &g| [g.min(a), g.max(b)]);
        least.saturating_sub(grey).max(grey.saturating_sub(most))
    });
    f64::from(steps.max().unwrap_or(0))
}

/// The four texels that a texel of the next level is made from.
fn under(above: View, [x, y]: [u32; 2]) -> [Texel; 4] {
    let corners = [(0, 0), (1, 0), (0, 1), (1, 1)];
    corners.map(|(i, j)| above.texel(2 * x + i, 2 * y + j))
}

/// The texels of a square, row by row.
fn places(side: u32) -> impl Iterator<Item = [u32; 2]> {
    (0..side).flat_map(move |y| (0..side).map(move |x| [x, y]))
}

/// A cell of level 0.
struct Cell<'a> {
    image: View<'a>,
    kind: SheetKind,
    corner: [u32; 2],
    side: u32,
}

impl<'a> Cell<'a> {
    fn new(image: View<'a>, cell: SheetCell) -> Cell<'a> {
        let side = image.width / SheetCell::A_SIDE;
        Cell {
            image,
            kind: cell.kind(),
            corner: cell.place().map(|i| i * side),
            side,
        }
    }

    /// One of its greys, and the opacity, of one of its texels.
    fn texel(&self, [x, y]: [u32; 2], channel: usize) -> [f64; 2] {
        let [left, top] = self.corner;
        let texel = self.image.texel(left + x, top + y);
        [texel[channel], texel[ALPHA]].map(f64::from)
    }

    fn texels(&self, channel: usize) -> impl Iterator<Item = [f64; 2]> {
        places(self.side).map(move |place| self.texel(place, channel))
    }

    fn opacity(&self) -> f64 {
        let sum: f64 = self.texels(GREY).map(|[_, alpha]| alpha).sum();
        sum / f64::from(self.side * self.side)
    }

    fn peak(&self) -> f64 {
        self.texels(GREY)
            .map(|[_, alpha]| alpha)
            .fold(0.0, f64::max)
    }

    /// Mean grey, weighted by opacity; not a number if there is none.
    fn grey(&self, channel: usize) -> f64 {
        let [sum, weights] = self
            .texels(channel)
            .fold([0.0; 2], |[sum, weights], [grey, alpha]| {
                [sum + alpha * grey, weights + alpha]
            });
        sum / weights
    }

    /// Root mean square difference of grey between neighbouring texels, weighted by the lesser opacity.
    fn roughness(&self) -> f64 {
        let (mut sum, mut weights) = (0.0, 0.0);
        for [x, y] in places(self.side - 1) {
            let [grey, alpha] = self.texel([x, y], GREY);
            for beside in [[x + 1, y], [x, y + 1]] {
                let [other, opacity] = self.texel(beside, GREY);
                let weight = alpha.min(opacity);
                sum += weight * (other - grey) * (other - grey);
                weights += weight;
            }
        }
        libm::sqrt(sum / weights)
    }

    /// How uneven the lower outline is: its mean distance from its median, as a share of the sprite's width, without an
    /// eighth at either end, where puffs are round. The outline is, column by column, the lowest texel that is half as opaque
    /// as the densest one.
    fn unevenness(&self) -> f64 {
        let half = self.peak() / 2.0;
        let rows = (0..self.side).filter_map(|x| {
            let is_opaque = |y: &u32| self.texel([x, *y], GREY)[1] >= half;
            (0..self.side).rev().find(is_opaque)
        });
        let mut rows: Vec<u32> = rows.collect();
        let width = rows.len();
        rows.truncate(width - width / 8);
        rows.drain(..width / 8);
        rows.sort_unstable();
        let Some(&median) = rows.get(rows.len() / 2) else {
            return f64::NAN;
        };
        let away: u32 = rows.iter().map(|row| row.abs_diff(median)).sum();
        f64::from(away) / rows.len() as f64 / width as f64
    }
}
