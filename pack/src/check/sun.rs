//! The sun's disc and glow.

use super::report::{Report, subject};
use super::rule::{SUN_BORDER, SUN_DISC, SUN_ROUND};
use crate::role::Role;
use crate::texture::Texture;
use crate::view::View;

const DISC: usize = 0;

pub(super) fn check(report: &mut Report, texture: &Texture) {
    let image = texture.view(0, 0);
    let name = subject(Role::Sun, DISC);
    // The four texels about the middle are looked at however large they are.
    let innermost = radius(image, image.width / 2, image.height / 2);
    let mut centre = 1.0_f32;
    let mut outside = 0.0_f32;
    for y in 0..image.height {
        for x in 0..image.width {
            // 1 at the middle of each side; the edge of the disc is at 0.5.
            let radius = radius(image, x, y);
            if radius < 0.1 || radius <= innermost {
                centre = centre.min(image.texel(x, y)[DISC]);
            } else if radius > 0.6 {
                outside = outside.max(image.texel(x, y)[DISC]);
            }
        }
    }
    report.at_least(SUN_DISC, &format!("{name} centre"), centre, 0.9);
    report.at_most(SUN_DISC, &format!("{name} outside"), outside, 0.01);
    check_round(report, image);
    check_border(report, texture);
}

/// Compares every texel with its mirror images, and with the one before it on the way out: a step of a byte is rounding.
fn check_round(report: &mut Report, image: View) {
    let (last, half) = (image.width - 1, image.width / 2);
    for channel in 0..Role::Sun.spec().channels.len() {
        let at = |x: u32, y: u32| image.texel(x, y)[channel];
        let mut worst = 0.0_f32;
        for (x, y) in (0..half).flat_map(|y| (0..half).map(move |x| (x, y))) {
            let here = at(x, y);
            for mirrored in [
                at(last - x, y),
                at(x, last - y),
                at(last - x, last - y),
                at(y, x),
            ] {
                worst = worst.max((here - mirrored).abs());
            }
            let inwards = if x + 1 < half { at(x + 1, y) } else { here };
            worst = worst.max(here - inwards);
        }
        report.at_most(SUN_ROUND, &subject(Role::Sun, channel), worst, 1.01 / 255.0);
    }
}

fn radius(image: View, x: u32, y: u32) -> f32 {
    let unit = |i: u32, n: u32| (i as f32 + 0.5) / n as f32 * 2.0 - 1.0;
    let (u, v) = (unit(x, image.width), unit(y, image.height));
    libm::sqrtf(u * u + v * v)
}

/// Looks at level 0: what does not end at the side of the square shows as a square in the sky. Two
/// steps of a byte are below what dithering hides.
fn check_border(report: &mut Report, texture: &Texture) {
    let image = texture.view(0, 0);
    let (right, bottom) = (image.width - 1, image.height - 1);
    for (channel, _) in Role::Sun.spec().channels.iter().enumerate() {
        let mut brightest = 0.0_f32;
        for i in 0..image.width.max(image.height) {
            let (x, y) = (i.min(right), i.min(bottom));
            for (x, y) in [(x, 0), (x, bottom), (0, y), (right, y)] {
                brightest = brightest.max(image.texel(x, y)[channel]);
            }
        }
        report.at_most(
            SUN_BORDER,
            &subject(Role::Sun, channel),
            brightest,
            2.01 / 255.0,
        );
    }
}
