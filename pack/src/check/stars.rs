//! The star texture: records, not colours.
//!
//! The statistical rules compare the field with one of independent stars, and are set so that they blame
//! such a field once in a million.

use super::chance::{FALSE_ALARMS, chi_squared, counts_quantile};
use super::report::{Bound, Report};
use super::rule::{
    STAR_BRIGHTEST, STAR_CLIP, STAR_CLUSTER, STAR_EMPTY, STAR_FLICKER, STAR_LATTICE, STAR_LIGHT,
    STAR_PHASE, STAR_RATE, STAR_RECORD, STAR_SHARE,
};
use super::spectrum::Spectrum;
use crate::role::Role;
use crate::texture::Texture;

const NAME: &str = Role::Stars.name();

pub(super) fn check(report: &mut Report, texture: &Texture) {
    let texels = |level: usize| texture.levels[level].chunks_exact(4);
    let all = || (0..texture.levels.len()).flat_map(texels);
    let empty = all()
        .filter(|t| t[0] == 0 && (t[1] | t[2] | t[3]) != 0)
        .count();
    report.at_most(STAR_EMPTY, NAME, empty as f64, 0.0);
    // Where there is no star, the rule above speaks.
    let clipped = all()
        .filter(|t| t[0] > 0 && (t[2] > t[0] || u16::from(t[0]) + u16::from(t[2]) > 255))
        .count();
    report.at_most(STAR_CLIP, NAME, clipped as f64, 0.0);

    let stars = lit(texture).count();
    let share = stars as f64 / texels(0).len() as f64;
    // A lone star is a sky, as over a city; at one star in 16 texels stars touch.
    let one = 1.0 / texels(0).len() as f64;
    report.within(STAR_SHARE, NAME, share, [one, 1.0 / 16.0]);
    check_levels(report, texture);
    check_level_flicker(report, texture);
    if stars < 20 {
        for rule in [
            STAR_FLICKER,
            STAR_BRIGHTEST,
            STAR_RATE,
            STAR_PHASE,
            STAR_LATTICE,
            STAR_CLUSTER,
        ] {
            report.skip(rule, NAME, "too few stars for statistics");
        }
        return;
    }
    check_flicker(report, texture);
    check_brightest(report, texture, stars);
    check_rates(report, texture, stars);
    check_phases(report, texture, stars);
    check_lattice(report, texture, stars);
    check_clusters(report, texture, stars);
}

/// The stars of level 0: where each is, and its four bytes. There may be millions in a texture that is none, so they are
/// not kept.
fn lit(texture: &Texture) -> impl Iterator<Item = ([usize; 2], &[u8])> {
    let width = texture.width as usize;
    let texels = texture.levels[0].chunks_exact(4).enumerate();
    let stars = texels.filter(|(_, texel)| texel[0] > 0);
    stars.map(move |(i, texel)| ([i % width, i / width], texel))
}

/// Each texel of a level against the stars under it.
///
/// Intensities are added up and divided by the level's unit: the least whole number by which all sums, and their flicker,
/// fit a byte. Where it is 1 nothing is rounded; elsewhere rounding, and what is carried from texel to texel, are a step
/// each. Rate and phase are those of one of the texels above.
fn check_levels(report: &mut Report, texture: &Texture) {
    let (mut light, mut strangers) = (0.0_f64, 0_usize);
    let mut sums: Vec<[u32; 2]> = texture.levels[0]
        .chunks_exact(4)
        .map(|t| [t[0], t[2]].map(u32::from))
        .collect();
    for level in 1..texture.levels.len() {
        let (width, height) = texture.level_size(level);
        let above = texture.level_size(level - 1);
        let [step_x, step_y] = [above.0 / width, above.1 / height].map(|n| n as usize);
        let under = |i: usize| {
            let (x, y) = (i % width as usize * step_x, i / width as usize * step_y);
            (0..step_x * step_y).map(move |j| (y + j / step_x) * above.0 as usize + x + j % step_x)
        };
        let texels = texture.levels[level].chunks_exact(4);
        sums = (0..texels.len())
            .map(|i| [0, 1].map(|channel| under(i).map(|j| sums[j][channel]).sum()))
            .collect();
        let largest = sums.iter().map(|[light, flicker]| light + flicker).max();
        let unit = f64::from(largest.unwrap_or(0).div_ceil(255).max(1));
        let slack = if unit > 1.0 { 2.0 * unit } else { 0.5 };
        for (i, texel) in texels.enumerate() {
            let off = f64::from(texel[0]) * unit - f64::from(sums[i][0]);
            light = light.max(off.abs() / slack);
            let mut stars = under(i)
                .map(|j| &texture.levels[level - 1][4 * j..][..4])
                .filter(|t| t[0] > 0)
                .peekable();
            let is_empty = texel[0] == 0 && stars.peek().is_none();
            let is_one = stars.any(|t| t[1] == texel[1] && t[3] == texel[3]);
            strangers += usize::from(!is_one && !is_empty);
        }
    }
    report.at_most(STAR_LIGHT, NAME, light, 1.0);
    report.at_most(STAR_RECORD, NAME, strangers as f64, 0.0);
}

/// The mean amplitude of a star as a share of its intensity: the records have 0.1 to 0.6, evenly.
const MEAN_AMPLITUDE: f64 = 0.35;

/// The flicker of all stars over what it is with the mean amplitude: one star that outshines the others has 0.29 to 1.71.
const FLICKER: Bound = Bound::Within(0.25, 1.75);

fn check_flicker(report: &mut Report, texture: &Texture) {
    let stars = texture.levels[0].chunks_exact(4);
    let expected = stars.clone().map(|t| {
        // It reaches no further than 0 and 1.
        let [intensity, room] = [t[0], 255 - t[0]].map(f64::from);
        (MEAN_AMPLITUDE * intensity).min(room)
    });
    let found: f64 = stars.map(|t| f64::from(t[2])).sum();
    let figure = found / expected.sum::<f64>().max(f64::MIN_POSITIVE);
    report.measure(STAR_FLICKER, NAME, figure, FLICKER);
}

/// How far the relative amplitude of a level may be from that of level 0.
const FLICKER_ERROR: f64 = 0.02;

/// Summed variance over summed intensity, level by level.
fn check_level_flicker(report: &mut Report, texture: &Texture) {
    let sums = |level: &Vec<u8>| {
        let sum = |channel: usize| -> f64 {
            let bytes = level.iter().skip(channel).step_by(4);
            bytes.map(|&byte| f64::from(byte)).sum()
        };
        [sum(0), sum(2)]
    };
    let relative = |[light, amplitude]: [f64; 2]| amplitude / light.max(1.0);
    let base = relative(sums(&texture.levels[0]));
    let worst = texture.levels[1..].iter().map(sums).map(|level| {
        // Half a step of the level's sum is left over.
        let rounding = 0.5 / level[0].max(1.0);
        ((relative(level) - base).abs() - rounding).max(0.0) / base.max(1e-6)
    });
    report.at_most(
        STAR_FLICKER,
        &format!("{NAME} levels"),
        worst.fold(0.0, f64::max),
        FLICKER_ERROR,
    );
}

/// The brightest star of `n`: brightness falls by the law N(>I) = I^(-1.25) over five magnitudes at most from 0.8 at
/// least, and one star is drawn from each of `n` equal shares of it. So the brightest has `0.8 (1 + 10^2.5 / n)^(-0.8)`, less
/// half a step of rounding.
fn check_brightest(report: &mut Report, texture: &Texture, stars: usize) {
    let brightest = lit(texture).map(|(_, texel)| texel[0]).max();
    let brightest = f64::from(brightest.unwrap_or(0)) / 255.0;
    let least = 0.8 * libm::pow(1.0 + libm::pow(10.0, 2.5) / stars as f64, -0.8) - 0.5 / 255.0;
    report.at_least(STAR_BRIGHTEST, NAME, brightest, least);
}

/// Rates that stars have, in 64ths of a hertz: 0.2 to 3.95 Hz, even between them, and cut to whole ones.
const RATES: [f64; 2] = [12.8, 252.8];

/// Pearson's chi-squared test of the rates in bins of 16 bytes.
fn check_rates(report: &mut Report, texture: &Texture, stars: usize) {
    const BINS: usize = 15;
    let [first, last] = RATES.map(|rate| rate as u8);
    let mut outside = 0;
    let mut bins = [0.0_f64; BINS];
    for (_, texel) in lit(texture) {
        outside += u32::from(!(first..=last).contains(&texel[1]));
        bins[usize::from(texel[1].saturating_sub(first) / 16).min(BINS - 1)] += 1.0;
    }
    report.at_most(STAR_RATE, &format!("{NAME} outside"), outside, 0.0);
    let edge = |bin: usize| (f64::from(first) + 16.0 * bin as f64).max(RATES[0]);
    let chi_squared = bins.iter().enumerate().map(|(bin, &found)| {
        let end = if bin + 1 == BINS {
            RATES[1]
        } else {
            edge(bin + 1)
        };
        let expected = stars as f64 * (end - edge(bin)) / (RATES[1] - RATES[0]);
        (found - expected) * (found - expected) / expected
    });
    report.at_most(
        STAR_RATE,
        NAME,
        chi_squared.sum::<f64>(),
        counts_quantile(BINS, stars as f64 / BINS as f64),
    );
}

/// Pearson's chi-squared test of the phases in 16 bins (K. Pearson, 1900).
fn check_phases(report: &mut Report, texture: &Texture, stars: usize) {
    let mut bins = [0.0_f64; 16];
    lit(texture).for_each(|(_, texel)| bins[usize::from(texel[3] >> 4)] += 1.0);
    // Bytes round to nearest, so byte 0 also stands for what would be 256: half a step, far below the noise.
    let most = counts_quantile(bins.len(), stars as f64 / bins.len() as f64);
    report.at_most(STAR_PHASE, NAME, chi_squared(&bins), most);
}

/// The largest peak of the structure factor `S(k) = |sum exp(-2 pi i k.x / size)|^2 / N`.
///
/// For independent stars S is exponentially distributed with mean 1 at every wave vector, for a lattice
/// it is N at the lattice's own. Stars that never touch have none of the others in the eight texels beside them: to first
/// order in the share `c` of texels with a star, `S = 1 - c ((1 + 2 cos kx) (1 + 2 cos ky) - 1)`, which is `1 + 4c` at most.
fn check_lattice(report: &mut Report, texture: &Texture, stars: usize) {
    let side = texture.width;
    let intensities = texture.view(0, 0).channel(0);
    let is_star = intensities.map(|i| if i > 0.0 { 1.0 } else { 0.0 });
    let half = side as usize / 2;
    let spectrum = Spectrum::new(side, is_star);
    // The conjugate half of the plane says nothing new.
    let one_of_each = |kx: usize, ky: usize| kx < half && (kx > 0 || (1..=half).contains(&ky));
    let peak = spectrum
        .vectors()
        .filter(|&(kx, ky, _)| one_of_each(kx, ky))
        .map(|(_, _, energy)| energy / stars as f64)
        .fold(0.0, f64::max);
    let waves = (half * side as usize) as f64;
    let share = stars as f64 / (f64::from(side) * f64::from(side));
    let most = libm::log(waves / FALSE_ALARMS) * (1.0 + 4.0 * share);
    report.at_most(STAR_LATTICE, NAME, peak, most);
}

/// The index of dispersion of counts in cells of about four stars (variance over mean, 1 if independent).
fn check_clusters(report: &mut Report, texture: &Texture, stars: usize) {
    let (width, height) = (texture.width as usize, texture.height as usize);
    let aim = libm::sqrt(stars as f64 / 4.0);
    let mut cells = 2_usize;
    while cells * 2 <= aim as usize {
        cells *= 2;
    }
    let mut counts = vec![0.0; cells * cells];
    for ([x, y], _) in lit(texture) {
        counts[(y * cells / height) * cells + x * cells / width] += 1.0;
    }
    let freedom = (counts.len() - 1) as f64;
    let most = counts_quantile(counts.len(), stars as f64 / counts.len() as f64);
    report.at_most(
        STAR_CLUSTER,
        NAME,
        chi_squared(&counts) / freedom,
        most / freedom,
    );
}
