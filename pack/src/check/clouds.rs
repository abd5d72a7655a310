//! The packed cloud texture.

mod character;

use super::report::{Report, subject};
use super::rule::{
    CLOUD_APART, CLOUD_BAND, CLOUD_CLEAR, CLOUD_COVER, CLOUD_MEAN, CLOUD_SPREAD, CLOUD_WAVES,
    GRADIENT_ENDS, GRADIENT_MONOTONE, GRADIENT_STEP,
};
use super::spectrum::Spectrum;
use super::tiling;
use crate::format::Format;
use crate::manifest::{FractalNoise, TextureEntry};
use crate::role::Role;
use crate::texture::Texture;
use crate::view::View;

const PHOTO: usize = 0;
const NOISE: usize = 1;
const DETAIL: usize = 2;
const GRADIENT: usize = 3;

/// Smallest mean wavelength of the two channels that shape the clouds, in texels: they are thresholded
/// and their contrast is multiplied, so anything finer shows as single texels.
const SHAPE_WAVE_TEXELS: f64 = 6.0;

/// The same for the detail channel, which only modulates.
const DETAIL_WAVE_TEXELS: f64 = 4.0;

/// Share of the texels that are quite clear, 0: of photo, noise and detail, at least.
const CLEAR_SHARES: [f64; 3] = [0.05, 0.002, 0.002];

/// The most that the gradients of two channels may be alike: copies have 0.9 and more, even where a steep curve and
/// bytes have rounded half of them away; noise of a single cell reached 0.6.
const MOST_ALIKE: f64 = 0.8;

/// The same if one of the two has few cells: chance can make waves alike that are few, 0.904 in one of 3200 random recipes.
const MOST_ALIKE_FEW: f64 = 0.98;

/// Noise of fewer cells across the tile has so few waves that chance rules it.
const FEW_CELLS: u32 = 4;

/// Effective waves of a photograph: three pairs. The built-in one has 40.
const LEAST_PHOTO_WAVES: f64 = 6.0;

/// `entry` is what the manifest says of it, if it is in a pack.
pub(super) fn check(report: &mut Report, texture: &Texture, entry: Option<&TextureEntry>) {
    check_character(report, texture, entry);
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
        report.within(
            CLOUD_SPREAD,
            &subject(Role::Clouds, channel),
            spread,
            [0.04, 0.40],
        );
    }
    check_cover(report, texture);
    check_gradient(report, texture);
}

/// What tells the three channels from each other and from anything else.
fn check_character(report: &mut Report, texture: &Texture, entry: Option<&TextureEntry>) {
    let image = texture.view(0, 0);
    for channel in [PHOTO, NOISE, DETAIL] {
        let name = subject(Role::Clouds, channel);
        check_clear(report, image, channel);
        let noise = entry.and_then(|e| e.channels.get(channel)?.fractal.as_ref());
        let view = character::view(texture, noise.map_or(0, |noise| noise.cells));
        let ranks = character::ranks(view, channel);
        let spectrum = Spectrum::new(ranks.width, ranks.channel(0));
        let least = match noise {
            Some(noise) if noise.cells < FEW_CELLS => None,
            Some(noise) => Some(character::least_waves(noise, view.width)),
            None if channel == PHOTO => Some(LEAST_PHOTO_WAVES),
            None => Some(character::STRIPES),
        };
        match least {
            Some(least) => {
                let waves = character::waves(&spectrum);
                report.at_least(CLOUD_WAVES, &name, waves, least);
            }
            None => report.skip(
                CLOUD_WAVES,
                &name,
                "noise of fewer than four cells may be a single wave",
            ),
        }
        match noise {
            Some(noise) => check_fractal(report, image, channel, noise, &spectrum),
            None if channel == PHOTO => {}
            None => {
                for rule in [CLOUD_BAND, CLOUD_MEAN] {
                    report.skip(rule, &name, "no manifest tells its octaves");
                }
            }
        }
    }
    let view = character::view(texture, 0);
    let ranks = [PHOTO, NOISE, DETAIL].map(|channel| character::ranks(view, channel));
    for (a, b) in [(PHOTO, NOISE), (NOISE, DETAIL), (PHOTO, DETAIL)] {
        let [first, second] = [a, b].map(|c| Role::Clouds.spec().channels[c].name);
        let cells = [a, b].map(|c| Some(entry?.channels.get(c)?.fractal?.cells));
        let are_few = cells.iter().any(|n| n.is_some_and(|n| n < FEW_CELLS));
        let most = if are_few { MOST_ALIKE_FEW } else { MOST_ALIKE };
        report.at_most(
            CLOUD_APART,
            &format!("{} {first}, {second}", Role::Clouds.name()),
            character::likeness(&ranks[a], &ranks[b]),
            most,
        );
    }
}

/// Channels end at 0 with a share of quite clear texels, and touch 1: neither their inverse does, nor what was shifted.
fn check_clear(report: &mut Report, image: View, channel: usize) {
    let name = subject(Role::Clouds, channel);
    let count = f64::from(image.width) * f64::from(image.height);
    let clear = image.channel(channel).filter(|v| *v == 0.0).count() as f64;
    // The share of ranks below the quantile, whose rank is rounded.
    let least = (CLEAR_SHARES[channel] * (count - 1.0) - 0.5).max(1.0) / count;
    report.at_least(CLOUD_CLEAR, &name, clear / count, least);
    let peak = image.channel(channel).fold(0.0, f32::max);
    report.within(CLOUD_CLEAR, &format!("{name} peak"), peak, [1.0, 1.0]);
}

fn check_fractal(
    report: &mut Report,
    image: View,
    channel: usize,
    noise: &FractalNoise,
    spectrum: &Spectrum,
) {
    let name = subject(Role::Clouds, channel);
    let expected = character::expected_band(noise, image.width, spectrum.size());
    // Up to two steps of a byte: what is as thin is as good as clear to ranks of bytes.
    let clear = image.channel(channel).filter(|v| *v < 2.5 / 255.0).count() as f64
        / (f64::from(image.width) * f64::from(image.height));
    let [below, above] = character::band_slack(noise, clear);
    report.within(
        CLOUD_BAND,
        &name,
        character::band(spectrum),
        [expected - below, expected + above],
    );
    // The bake meets it to a thousandth; bytes round by half a step, all the same way at worst.
    let (mean, declared) = (image.mean_and_spread(channel).0, noise.mean);
    let slack = 0.001 + 0.5 / 255.0;
    report.within(
        CLOUD_MEAN,
        &name,
        mean,
        [f64::from(declared) - slack, f64::from(declared) + slack],
    );
}

/// A cover of two oktas, "few" in weather reports.
const FEW: f64 = 2.0 / 8.0;

/// The most of the sky that may have cloud at that cover: five oktas, from which on it is "broken" (World
/// Meteorological Organization, "Manual on Codes", WMO-No. 306, code table 2700).
const BROKEN: f64 = 5.0 / 8.0;

/// The least of the sky that has cloud at full cover: three oktas, from which on it is "scattered" in the same table.
const LEAST_OVERCAST: f64 = 3.0 / 8.0;

/// What is thinner than this shows no cloud.
const THIN: f64 = 0.1;

/// How much of the sky has clouds, for two amounts of cover.
///
/// The two shape channels drift against each other, so over time every value of one meets every value
/// of the other: the share is that of pairs with `photo + noise (1 - photo) > 1 - cover`. How thick clouds are is free, but
/// the parameter must be able to open the sky and to shut it: little cover leaves more sky open than a broken one has, and
/// at full cover and density 0.5, which doubles what is left (line 21 of Roden and Parberry, 2005), more than three oktas of it are
/// thicker than a tenth.
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
    report.at_most(CLOUD_COVER, "cover 0.25", share(1.0 - FEW), BROKEN);
    report.at_least(CLOUD_COVER, "overcast", share(THIN / 2.0), LEAST_OVERCAST);
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
    report.at_most(GRADIENT_MONOTONE, &name, fall, 0.0);
    report.at_most(
        GRADIENT_ENDS,
        &name,
        ends,
        f64::from(texture.format.quantisation_error(1.0)),
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
    report.at_most(GRADIENT_STEP, &name, step, most);
}
