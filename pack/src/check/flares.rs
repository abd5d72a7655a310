//! The atlas of lens flares.

use super::report::{Bound, Report};
use super::rule::{FLARE_CELLS, FLARE_SHAPE};
use crate::mapping::FlareCell;
use crate::role::Role;
use crate::texture::Texture;
use crate::view::View;

const NAME: &str = Role::Flares.name();

/// Looks at level 0: every cell must have light, and none along its border, where filtering would take
/// it into the next cell.
pub(super) fn check(report: &mut Report, texture: &Texture) {
    let image = texture.view(0, 0);
    let cell = image.width / FlareCell::A_SIDE;
    let edge = FlareCell::BORDER_TEXELS..cell - FlareCell::BORDER_TEXELS;
    let mut brightest_border = 0.0_f32;
    for part in FlareCell::ALL {
        let [column, row] = part.place();
        let mut brightest = 0.0_f32;
        for (x, y) in (0..cell * cell).map(|i| (i % cell, i / cell)) {
            let light = image.texel(column * cell + x, row * cell + y)[0];
            brightest = brightest.max(light);
            if !edge.contains(&x) || !edge.contains(&y) {
                brightest_border = brightest_border.max(light);
            }
        }
        report.at_least(
            FLARE_CELLS,
            &format!("{NAME} {}", part.name()),
            brightest,
            0.5,
        );
    }
    for part in FlareCell::ALL {
        check_shape(report, image, part);
    }
    report.at_most(
        FLARE_CELLS,
        &format!("{NAME} borders"),
        brightest_border,
        0.0,
    );
}

/// How far from the middle the light of a cell is measured, 1 in the middle of a side: near it, half way, and where a disc is
/// still full and a ring bright.
const NEAR: [f64; 2] = [0.2, 0.4];
const RIM: [f64; 2] = [0.6, 0.8];

/// Each part has what no other has: the disc is full to its rim, the ring is empty in the middle, the glow has faded at
/// the rim but not near the middle, the starburst has faded near the middle already.
fn check_shape(report: &mut Report, image: View, part: FlareCell) {
    let (place, bound, measured) = match part {
        FlareCell::Disc => (
            "near and rim",
            Bound::AtLeast(0.5),
            light(image, part, NEAR).min(light(image, part, RIM)),
        ),
        FlareCell::Ring => (
            "rim less middle",
            Bound::AtLeast(0.2),
            light(image, part, RIM) - light(image, part, [0.0, NEAR[0]]),
        ),
        FlareCell::Glow => (
            "near less rim",
            Bound::AtLeast(0.3),
            light(image, part, NEAR) - light(image, part, RIM),
        ),
        FlareCell::Starburst => ("near", Bound::AtMost(0.35), light(image, part, NEAR)),
    };
    report.measure(
        FLARE_SHAPE,
        &format!("{NAME} {}, {place}", part.name()),
        measured,
        bound,
    );
}

/// Mean light between two distances from the middle of a cell.
fn light(image: View, part: FlareCell, [from, to]: [f64; 2]) -> f64 {
    let cell = image.width / FlareCell::A_SIDE;
    let [left, top] = part.place().map(|i| i * cell);
    let unit = |i: u32| (f64::from(i) + 0.5) / f64::from(cell) * 2.0 - 1.0;
    let (mut sum, mut count) = (0.0, 0.0);
    for (x, y) in (0..cell).flat_map(|y| (0..cell).map(move |x| (x, y))) {
        let radius = libm::sqrt(unit(x) * unit(x) + unit(y) * unit(y));
        if (from..to).contains(&radius) {
            sum += f64::from(image.texel(left + x, top + y)[0]);
            count += 1.0;
        }
    }
    sum / count
}
