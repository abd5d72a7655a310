//! Layers of clouds: density, its rank, and normals.

mod normals;

use super::chance::unevenness;
use super::report::{Report, subject};
use super::rule::{
    CLOUD_SPREAD, LAYER_MEAN, NORMAL_SLOPE, NORMAL_UNIT, RANK_FLAT, RANK_ORDER, SEAM,
};
use super::tiling;
use crate::layer_kind::LayerKind;
use crate::role::Role;
use crate::texture::{Texture, unorm8};
use crate::view::View;

const DENSITY: usize = 2;
const RANK: usize = 3;

/// Smallest mean wavelength of density and rank, in texels, of which the smallest lumps have five: anything finer
/// shows as single texels.
const WAVE_TEXELS: f64 = 5.0;

/// The largest ratio of steps across the edge to those inside, over the usual bound.
///
/// Clouds are long parts of the tile: along a line the mean is of few independent squares. If they are two and
/// there are twelve independent lines, less than a cirrus has, then chance exceeds 1.5 once in ten million
/// (the integral of `f(x) F(x / k^2)^12`, where `f` and `F` are the law of chi squared over its two degrees
/// of freedom and `k` is 1.5 times 2.5). A layer that does not tile has 2.5 and more.
const MOST_SEAM: f64 = 1.5;

/// The least root mean square slope: half of what the format asks, of which rounding takes less than a tenth.
const LEAST_RELIEF: f64 = 0.05;

pub(super) fn check(report: &mut Report, texture: &Texture) {
    for channel in [DENSITY, RANK] {
        // Normals are shown to be periodic differences.
        let seam = tiling::seam(texture, channel);
        report.at_most(SEAM, &subject(Role::Layers, channel), seam, MOST_SEAM);
        tiling::check_smooth(report, Role::Layers, texture, channel, WAVE_TEXELS);
    }
    for (layer, kind) in (0..texture.layers).zip(LayerKind::ALL) {
        let levels = 0..texture.levels.len();
        let levels: Vec<View> = levels.map(|level| texture.view(level, layer)).collect();
        check_amounts(report, levels[0], kind);
        check_normals(report, &levels, kind);
        check_ranks(report, levels[0], kind);
    }
}

/// What a report calls a layer.
fn layer_name(kind: LayerKind) -> String {
    format!("{} {}", Role::Layers.name(), kind.name())
}

fn check_amounts(report: &mut Report, level: View, kind: LayerKind) {
    let name = format!("{} {}", subject(Role::Layers, DENSITY), kind.name());
    let (density, spread) = level.mean_and_spread(DENSITY);
    // As wide as the channels of the role `clouds`.
    report.within(CLOUD_SPREAD, &name, spread, [0.04, 0.40]);
    // The bake meets it to a thousandth; bytes round by half a step, all the same way at worst.
    let mean = f64::from(kind.mean_density());
    let slack = 0.001 + 0.5 / 255.0;
    report.within(
        LAYER_MEAN,
        &layer_name(kind),
        density,
        [mean - slack, mean + slack],
    );
}

fn check_normals(report: &mut Report, levels: &[View], kind: LayerKind) {
    let name = layer_name(kind);
    let length = normals::longest(levels[0]);
    report.at_most(NORMAL_UNIT, &name, length, 1.0);
    let steps = levels.windows(2);
    let steps = steps.map(|pair| normals::off_the_mean(pair[0], pair[1]));
    report.at_most(
        NORMAL_UNIT,
        &format!("{name} levels"),
        steps.fold(0.0, f64::max),
        1.0,
    );
    let disagreement = normals::disagreement(levels[0], DENSITY);
    report.at_most(NORMAL_SLOPE, &name, disagreement, 1.0);
    report.at_least(
        NORMAL_SLOPE,
        &format!("{name} relief"),
        normals::relief(levels[0]),
        LEAST_RELIEF,
    );
}

fn check_ranks(report: &mut Report, image: View, kind: LayerKind) {
    let name = layer_name(kind);
    let pairs = image.texels();
    let pairs = pairs.map(|texel| [texel[DENSITY], texel[RANK]].map(unorm8));
    let uneven = unevenness(pairs.clone().map(|[_, rank]| rank));
    report.at_most(RANK_FLAT, &name, uneven as f64, 0.0);
    let fall = f64::from(largest_fall(pairs));
    report.at_most(RANK_ORDER, &name, fall, 0.0);
}

/// By how many steps the rank of a texel is above that of a denser one at most.
fn largest_fall(texels: impl Iterator<Item = [u8; 2]>) -> u8 {
    let mut ranks: [Option<[u8; 2]>; 256] = [None; 256];
    for [density, rank] in texels {
        let range = ranks[usize::from(density)].get_or_insert([rank; 2]);
        *range = [range[0].min(rank), range[1].max(rank)];
    }
    let (mut highest, mut fall) = (0_u8, 0);
    for [least, most] in ranks.into_iter().flatten() {
        fall = fall.max(highest.saturating_sub(least));
        highest = highest.max(most);
    }
    fall
}
