//! The star texture: records, not colours.
//!
//! The statistical rules compare the field with one of independent stars, and are set so that they blame
//! such a field once in a million.

use super::chance::{FALSE_ALARMS, chi_squared, chi_squared_quantile};
use super::report::{Bound, Report};
use super::rule::{
    STAR_CLIP, STAR_CLUSTER, STAR_EMPTY, STAR_LATTICE, STAR_LIGHT, STAR_PHASE, STAR_SHARE,
};
use super::spectrum::Spectrum;
use crate::{Role, Texture};

const NAME: &str = Role::Stars.name();

pub(super) fn check(report: &mut Report, texture: &Texture) {
    let texels = |level: usize| texture.levels[level].chunks_exact(4);
    let all = || (0..texture.levels.len()).flat_map(texels);
    let empty = all()
        .filter(|t| t[0] == 0 && (t[1] | t[2] | t[3]) != 0)
        .count();
    report.measure(STAR_EMPTY, NAME, empty as f64, Bound::AtMost(0.0));
    // Where there is no star, the rule above speaks.
    let clipped = all()
        .filter(|t| t[0] > 0 && (t[2] > t[0] || u16::from(t[0]) + u16::from(t[2]) > 255))
        .count();
    report.measure(STAR_CLIP, NAME, clipped as f64, Bound::AtMost(0.0));

    let stars = lit(texture).count();
    let share = stars as f64 / texels(0).len() as f64;
    // At one star in 16 texels stars touch; below one in 3000 a tile of 256x256 has some twenty.
    report.measure(
        STAR_SHARE,
        NAME,
        share,
        Bound::Within(1.0 / 3000.0, 1.0 / 16.0),
    );
    check_light(report, texture);
    if stars < 20 {
        for rule in [STAR_PHASE, STAR_LATTICE, STAR_CLUSTER] {
            report.skip(rule, NAME, "too few stars for statistics");
        }
        return;
    }
    check_phases(report, texture);
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

/// The sum of intensities times the area of a texel, level by level.
fn check_light(report: &mut Report, texture: &Texture) {
    let sum = |level: usize| {
        let sum: u64 = texture.levels[level]
            .iter()
            .step_by(4)
            .map(|&b| u64::from(b))
            .sum();
        sum as f64
    };
    let base = sum(0);
    let mut worst = 0.0_f64;
    for level in 1..texture.levels.len() {
        let (width, height) = texture.level_size(level);
        let texels = f64::from(width) * f64::from(height);
        let expected = base * texels / (f64::from(texture.width) * f64::from(texture.height));
        // One step of a byte is the least that a level can be wrong by. Each star of level 0 was
        // rounded before the levels were made, by a half step at most; a fiftieth is far above that.
        worst = worst.max((sum(level) - expected).abs() / (1.0 + 0.02 * expected));
    }
    report.measure(STAR_LIGHT, NAME, worst, Bound::AtMost(1.0));
}

/// Pearson's chi-squared test of the phases in 16 bins (K. Pearson, 1900).
fn check_phases(report: &mut Report, texture: &Texture) {
    let mut bins = [0.0_f64; 16];
    lit(texture).for_each(|(_, texel)| bins[usize::from(texel[3] >> 4)] += 1.0);
    // Bytes round to nearest, so byte 0 also stands for what would be 256: half a step, far below the noise.
    let most = chi_squared_quantile(15.0);
    report.measure(STAR_PHASE, NAME, chi_squared(&bins), Bound::AtMost(most));
}

/// The largest peak of the structure factor `S(k) = |sum exp(-2 pi i k.x / size)|^2 / N`.
///
/// For independent stars S is exponentially distributed with mean 1 at every wave vector, for a lattice
/// it is N at the lattice's own. A minimum distance lowers S at small k and lifts it little elsewhere.
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
    report.measure(
        STAR_LATTICE,
        NAME,
        peak,
        Bound::AtMost(libm::log(waves / FALSE_ALARMS)),
    );
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
    let index = chi_squared(&counts) / freedom;
    report.measure(
        STAR_CLUSTER,
        NAME,
        index,
        Bound::AtMost(chi_squared_quantile(freedom) / freedom),
    );
}
