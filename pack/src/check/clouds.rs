//! The packed cloud texture.

use super::report::{Bound, Report};
use super::rule::{CLOUD_COVER, CLOUD_SPREAD, GRADIENT_ENDS, GRADIENT_MONOTONE, GRADIENT_STEP};
use super::{subject, tiling};
use crate::{Format, Role, Texture};

const PHOTO: usize = 0;
const NOISE: usize = 1;
const DETAIL: usize = 2;
const GRADIENT: usize = 3;

/// Smallest mean wavelength of the two channels that shape the clouds, in texels: they are thresholded
/// and their contrast is multiplied, so anything finer shows as single texels.
const SHAPE_WAVE_TEXELS: f64 = 6.0;

/// The same for the detail channel, which only modulates.
const DETAIL_WAVE_TEXELS: f64 = 4.0;

pub(super) fn check(report: &mut Report, texture: &Texture) {
    for channel in [PHOTO, NOISE, DETAIL] {
        tiling::check_seam(report, Role::Clouds, texture, channel);
        let wave = if channel == DETAIL {
            DETAIL_WAVE_TEXELS
        } else {
            SHAPE_WAVE_TEXELS
        };
        tiling::check_smooth(report, Role::Clouds, texture, channel, wave);
        // A channel of two values with mean 0.5 has spread 0.5; one of a dozen byte steps about 0.02.
        let spread = f64::from(texture.view(0, 0).mean_and_spread(channel).1);
        report.measure(
            CLOUD_SPREAD,
            &subject(Role::Clouds, channel),
            spread,
            Bound::Within(0.04, 0.40),
        );
    }
    check_cover(report, texture);
    check_gradient(report, texture);
}

/// How much of the sky has clouds, for two amounts of cover.
///
/// The two shape channels drift against each other, so over time every value of one meets every value
/// of the other: the share is that of pairs with `photo + noise (1 - photo) > 1 - cover`. At cover 0.57
/// (figure 4 of Roden and Parberry, 2005) there must be both cloud and open sky. An overcast, cover 1 at
/// density 0.5, doubles what is left (line 21), and a tenth of the sky at most may then be thinner than a
/// tenth.
fn check_cover(report: &mut Report, texture: &Texture) {
    let [photo, noise] = [PHOTO, NOISE].map(|channel| histogram(texture, channel));
    let share = |threshold: f64| {
        let mut share = 0.0;
        for (p, p_share) in photo.iter().enumerate() {
            for (n, n_share) in noise.iter().enumerate() {
                let (p, n) = (p as f64 / 255.0, n as f64 / 255.0);
                if p + n * (1.0 - p) > threshold {
                    share += p_share * n_share;
                }
            }
        }
        share
    };
    report.measure(
        CLOUD_COVER,
        "cover 0.57",
        share(1.0 - 0.57),
        Bound::Within(0.10, 0.70),
    );
    report.measure(
        CLOUD_COVER,
        "overcast",
        share(0.1 / 2.0),
        Bound::AtLeast(0.9),
    );
}

fn histogram(texture: &Texture, channel: usize) -> Vec<f64> {
    let image = texture.view(0, 0);
    let mut bins = vec![0.0; 256];
    let share = 1.0 / (f64::from(image.width) * f64::from(image.height));
    for value in image.channel(channel) {
        bins[usize::from(crate::texture::unorm8(value))] += share;
    }
    bins
}

fn check_gradient(report: &mut Report, texture: &Texture) {
    let name = subject(Role::Clouds, GRADIENT);
    let (mut fall, mut ends) = (0.0_f32, 0.0_f32);
    for level in 0..texture.levels.len() {
        let image = texture.view(level, 0);
        let at = |x: u32, y: u32| image.texel(x, y)[GRADIENT];
        for y in 0..image.height {
            for x in 0..image.width {
                fall = fall.max((at(x, y) - at(0, y)).abs());
                fall = fall.max(if y > 0 { at(x, y - 1) - at(x, y) } else { 0.0 });
            }
        }
        if image.height > 1 {
            ends = ends.max(at(0, 0)).max(1.0 - at(0, image.height - 1));
        }
    }
    report.measure(
        GRADIENT_MONOTONE,
        &name,
        f64::from(fall),
        Bound::AtMost(0.0),
    );
    report.measure(
        GRADIENT_ENDS,
        &name,
        f64::from(ends),
        Bound::AtMost(f64::from(texture.format.quantisation_error(1.0))),
    );
    let image = texture.view(0, 0);
    let step = (1..image.height)
        .map(|y| image.texel(0, y)[GRADIENT] - image.texel(0, y - 1)[GRADIENT])
        .fold(0.0, f32::max);
    // A texture of fewer than 512 rows cannot have the small steps of one that has them. Rounding adds
    // half a step at either end.
    let rounding = if texture.format == Format::Rgba16Float {
        1e-3
    } else {
        1.0 / 255.0
    };
    let most = (4.0 / f64::from(image.height)).max(1.0 / 128.0) + rounding;
    report.measure(GRADIENT_STEP, &name, f64::from(step), Bound::AtMost(most));
}
