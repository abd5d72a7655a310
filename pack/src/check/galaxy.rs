//! The galaxy map.

use super::report::{Bound, Report};
use super::rule::GALAXY_BRIGHTNESS;
use crate::mapping::galaxy_uv_to_direction;
use crate::{Role, Texture};

/// Looks at the texels above the horizon: the brightest must be seen, the mean must leave dark sky.
pub(super) fn check(report: &mut Report, texture: &Texture) {
    let image = texture.view(0, 0);
    let (mut brightest, mut sum, mut count) = (0.0_f32, 0.0_f64, 0.0_f64);
    for y in 0..image.height {
        for x in 0..image.width {
            let uv = [
                (x as f32 + 0.5) / image.width as f32,
                (y as f32 + 0.5) / image.height as f32,
            ];
            if galaxy_uv_to_direction(uv)[1] > 0.0 {
                let value = image.texel(x, y)[0];
                brightest = brightest.max(value);
                sum += f64::from(value);
                count += 1.0;
            }
        }
    }
    let name = Role::Galaxy.name();
    report.measure(
        GALAXY_BRIGHTNESS,
        &format!("{name} peak"),
        f64::from(brightest),
        Bound::AtLeast(0.25),
    );
    report.measure(
        GALAXY_BRIGHTNESS,
        &format!("{name} mean"),
        sum / count,
        Bound::AtMost(0.5),
    );
}
