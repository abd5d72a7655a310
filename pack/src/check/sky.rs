//! The day gradient.

use super::report::{Bound, Report};
use super::rule::{SKY_DAY, SKY_NIGHT, SKY_RANGE, SKY_STEP};
use crate::view::View;
use crate::{Role, Texture};

const NAME: &str = Role::Sky.name();

pub(super) fn check(report: &mut Report, texture: &Texture) {
    let image = texture.view(0, 0);
    let colours = image
        .texels()
        .flat_map(|[red, green, blue, _]| [red, green, blue]);
    let wrong = colours.filter(|v| !v.is_finite() || *v < 0.0).count();
    report.measure(SKY_RANGE, NAME, wrong as f64, Bound::AtMost(0.0));
    if wrong > 0 {
        for rule in [SKY_NIGHT, SKY_DAY, SKY_STEP] {
            report.skip(rule, NAME, "the radiance is not sound");
        }
        return;
    }
    check_night(report, image);
    let (noon, midnight) = (image.width / 2, 0);
    let mean = |x: u32| {
        (0..image.height)
            .map(|y| luminance(image, x, y))
            .sum::<f64>()
            / f64::from(image.height)
    };
    // A clear sky by day is some ten million times brighter than by night; adapted eyes see far less.
    report.measure(
        SKY_DAY,
        "noon / midnight",
        mean(noon) / mean(midnight).max(1e-6),
        Bound::AtLeast(8.0),
    );
    let zenith = luminance(image, noon, image.height - 1).max(1e-6);
    report.measure(
        SKY_DAY,
        "horizon / zenith",
        luminance(image, noon, 0) / zenith,
        Bound::AtLeast(1.0),
    );
    check_steps(report, image);
}

/// The worst of: night at noon, day at midnight, any share outside 0..1.
fn check_night(report: &mut Report, image: View) {
    let mut worst = 0.0_f32;
    for y in 0..image.height {
        worst = worst.max(image.texel(image.width / 2, y)[3].abs());
        worst = worst.max((1.0 - image.texel(0, y)[3]).abs());
    }
    for share in image.channel(3) {
        worst = worst.max(-share).max(share - 1.0);
    }
    report.measure(SKY_NIGHT, NAME, f64::from(worst), Bound::AtMost(0.02));
}

/// The largest change of luminance from one time to the next, against the brightest of the whole day.
///
/// With 64 columns or more the sun climbs at most 5.6 degrees a column, and dusk takes it through 18.
fn check_steps(report: &mut Report, image: View) {
    let brightest = (0..image.width * image.height)
        .map(|i| luminance(image, i % image.width, i / image.width))
        .fold(0.0, f64::max);
    let mut worst = 0.0_f64;
    for y in 0..image.height {
        for x in 0..image.width {
            let next = luminance(image, (x + 1) % image.width, y);
            worst = worst.max((next - luminance(image, x, y)).abs());
        }
    }
    report.measure(
        SKY_STEP,
        NAME,
        worst / brightest.max(1e-6),
        Bound::AtMost(0.34),
    );
}

/// Luminance of linear BT.709 colour (ITU-R BT.709-6, item 3.2).
fn luminance(image: View, x: u32, y: u32) -> f64 {
    let t = image.texel(x, y);
    0.2126 * f64::from(t[0]) + 0.7152 * f64::from(t[1]) + 0.0722 * f64::from(t[2])
}
