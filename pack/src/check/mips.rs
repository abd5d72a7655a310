//! Levels keep the mean of level 0.

use super::report::{Bound, Report};
use super::rule::MIP_MEAN;
use super::subject;
use crate::{Format, Role, Texture};

/// Checks every channel that is averaged over area. Star levels and the sunset gradient have rules of
/// their own.
pub(super) fn check(report: &mut Report, role: Role, texture: &Texture) {
    let base = texture.image(0, 0);
    let images: Vec<_> = (1..texture.levels.len())
        .map(|level| texture.image(level, 0))
        .collect();
    if images.is_empty() || role == Role::Stars {
        return;
    }
    for (index, channel) in role.spec().channels.iter().enumerate() {
        if channel.name == "gradient" {
            continue;
        }
        let mean = base.mean_and_spread(index).0;
        let worst = images
            .iter()
            .map(|image| (image.mean_and_spread(index).0 - mean).abs())
            .fold(0.0, f32::max);
        // Every texel of both levels was rounded by half a step at most.
        let step = match texture.format {
            Format::Rgba16Float => mean.abs() / 512.0,
            _ => 1.0 / 255.0,
        };
        report.measure(
            MIP_MEAN,
            &subject(role, index),
            f64::from(worst),
            Bound::AtMost(f64::from(step)),
        );
    }
}
