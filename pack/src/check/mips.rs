//! Levels are means of those above them.

use super::report::{Report, subject};
use super::rule::{LEVEL_MEAN, MIP_MEAN};
use crate::format::Format;
use crate::role::Role;
use crate::texture::Texture;
use crate::view::View;

/// Checks every channel that is averaged over area. Levels of stars and sprites, the sunset gradient and normals have
/// rules of their own.
pub(super) fn check(report: &mut Report, role: Role, texture: &Texture) {
    if texture.levels.len() == 1 || matches!(role, Role::Stars | Role::Sprites) {
        return;
    }
    let channels: Vec<usize> = (0..texture.format.channels())
        .filter(|&channel| {
            let name = role.spec().channels[channel].name;
            !["gradient", "normal_x", "normal_y"].contains(&name)
        })
        .collect();
    let mut drifts = vec![0.0_f32; channels.len()];
    let mut steps = vec![0.0_f64; channels.len()];
    for layer in 0..texture.layers {
        let mut above = texture.view(0, layer);
        let means: Vec<f32> = channels
            .iter()
            .map(|&c| above.mean_and_spread(c).0)
            .collect();
        for level in 1..texture.levels.len() {
            let image = texture.view(level, layer);
            for (i, &channel) in channels.iter().enumerate() {
                let drift = drift(texture.format, image, channel, means[i]);
                drifts[i] = drifts[i].max(drift);
                let off = off_the_mean(texture.format, above, image, channel);
                steps[i] = steps[i].max(off);
            }
            above = image;
        }
    }
    for (i, channel) in channels.into_iter().enumerate() {
        let name = subject(role, channel);
        report.at_most(MIP_MEAN, &name, drifts[i], 1.0);
        // Seven digits of the mean.
        report.at_most(LEVEL_MEAN, &name, steps[i], 1.0001);
    }
}

/// The difference of a level's mean from that of level 0, over what rounding explains.
fn drift(format: Format, image: View, channel: usize, base: f32) -> f32 {
    // Every texel of both levels was rounded by half a step at most; halves have steps of 2^-24 near 0.
    let step = match format {
        Format::Rgba16Float => base.abs() / 512.0 + HALF_FLOAT_STEP as f32,
        _ => 1.0 / 255.0,
    };
    (image.mean_and_spread(channel).0 - base).abs() / step
}

/// The step of a half float near 0.
const HALF_FLOAT_STEP: f64 = 1.0 / 16_777_216.0;

/// The largest difference of a texel from the mean of those above it, over what rounding explains: half a step of both.
fn off_the_mean(format: Format, above: View, level: View, channel: usize) -> f64 {
    let [step_x, step_y] = [above.width / level.width, above.height / level.height];
    let mut worst = 0.0_f64;
    for y in 0..level.height {
        for x in 0..level.width {
            let (mut sum, mut largest) = (0.0_f64, 0.0_f64);
            for (j, i) in (0..step_y).flat_map(|j| (0..step_x).map(move |i| (j, i))) {
                let value = f64::from(above.texel(x * step_x + i, y * step_y + j)[channel]);
                sum += value;
                largest = largest.max(value.abs());
            }
            let mean = sum / f64::from(step_x * step_y);
            let step = match format {
                // A half has eleven digits, so half a step is 2^-12 to 2^-11 of a value.
                Format::Rgba16Float => largest / 1024.0 + HALF_FLOAT_STEP,
                _ => 1.0 / 255.0,
            };
            worst = worst.max((f64::from(level.texel(x, y)[channel]) - mean).abs() / step);
        }
    }
    worst
}
