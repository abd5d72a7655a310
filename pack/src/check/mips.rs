//! Levels keep the mean of level 0.

use super::report::{Bound, Report};
use super::rule::MIP_MEAN;
use super::subject;
use crate::view::View;
use crate::{Format, Role, Texture};

/// Checks every channel that is averaged over area. Levels of stars and sprites, the sunset gradient and normals have
/// rules of their own.
pub(super) fn check(report: &mut Report, role: Role, texture: &Texture) {
    if texture.levels.len() == 1 || matches!(role, Role::Stars | Role::Sprites) {
        return;
    }
    let layers: Vec<Vec<View>> = (0..texture.layers)
        .map(|layer| (0..texture.levels.len()).map(move |level| texture.view(level, layer)))
        .map(Iterator::collect)
        .collect();
    for (index, channel) in role.spec().channels.iter().enumerate() {
        if ["gradient", "normal_x", "normal_y"].contains(&channel.name) {
            continue;
        }
        let worst = layers
            .iter()
            .map(|levels| difference(texture.format, levels, index))
            .fold(0.0, f32::max);
        report.measure(
            MIP_MEAN,
            &subject(role, index),
            f64::from(worst),
            Bound::AtMost(1.0),
        );
    }
}

/// The largest difference of a level's mean from that of level 0, over what rounding explains.
fn difference(format: Format, levels: &[View], channel: usize) -> f32 {
    let mut means = levels.iter().map(|image| image.mean_and_spread(channel).0);
    let base = means.next().unwrap_or_default();
    // Every texel of both levels was rounded by half a step at most; halves have steps of 2^-24 near 0.
    let step = match format {
        Format::Rgba16Float => base.abs() / 512.0 + 1.0 / 16_777_216.0,
        _ => 1.0 / 255.0,
    };
    means
        .map(|mean| (mean - base).abs() / step)
        .fold(0.0, f32::max)
}
