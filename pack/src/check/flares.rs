//! The atlas of lens flares.

use super::report::{Bound, Report};
use super::rule::FLARE_CELLS;
use crate::{FlareCell, Role, Texture};

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
        report.measure(
            FLARE_CELLS,
            &format!("{NAME} {}", part.name()),
            f64::from(brightest),
            Bound::AtLeast(0.5),
        );
    }
    report.measure(
        FLARE_CELLS,
        &format!("{NAME} borders"),
        f64::from(brightest_border),
        Bound::AtMost(0.0),
    );
}
