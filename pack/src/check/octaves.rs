//! The white noise of the octaves.
//!
//! The statistical rule compares a channel with independent random numbers, and is set so that it blames
//! such a channel once in a million.

use super::chance::{FALSE_ALARMS, chi_squared_deviate, unevenness};
use super::report::{Report, subject};
use super::rule::{NOISE_FLAT, NOISE_WHITE};
use super::spectrum::Spectrum;
use crate::role::Role;
use crate::texture::Texture;

/// Bands of wave numbers, each an octave wide, to the shortest wave of 32 texels.
const BANDS: [[usize; 2]; 4] = [[1, 2], [3, 4], [5, 8], [9, 16]];

/// The standard normal deviate that the largest of four strays beyond, to either side, once in a million:
/// its tail is 1e-6 / 8.
const BAND_Z: f64 = 5.157_701;

pub(super) fn check(report: &mut Report, texture: &Texture) {
    for channel in 0..texture.format.channels() {
        check_flat(report, texture, channel);
        check_white(report, texture, channel);
    }
}

fn check_flat(report: &mut Report, texture: &Texture, channel: usize) {
    let channels = texture.format.channels();
    let texels = texture.levels[0].iter().skip(channel).step_by(channels);
    report.at_most(
        NOISE_FLAT,
        &subject(Role::Octaves, channel),
        unevenness(texels.copied()) as f64,
        0.0,
    );
}

/// The spectrum of white noise: at every wave vector the energy, over its mean, is half of chi squared of
/// two degrees of freedom; summed over a band it is chi squared of as many degrees as there are vectors.
fn check_white(report: &mut Report, texture: &Texture, channel: usize) {
    let spectrum = Spectrum::new(texture.width, texture.view(0, 0).channel(channel));
    let (total, vectors) = spectrum.ring(1..=BANDS[3][1]);
    let name = subject(Role::Octaves, channel);
    if total <= 0.0 {
        report.skip(NOISE_WHITE, &name, "the channel is flat");
        return;
    }
    let mean = total / vectors as f64;
    // Of two conjugate vectors one says all.
    let most = libm::log(vectors as f64 / 2.0 / FALSE_ALARMS);
    report.at_most(
        NOISE_WHITE,
        &format!("{name} peak"),
        spectrum.peak() / mean,
        most,
    );
    let worst = BANDS
        .map(|[first, last]| {
            let (energy, vectors) = spectrum.ring(first..=last);
            chi_squared_deviate(energy / mean, vectors as f64).abs()
        })
        .into_iter()
        .fold(0.0, f64::max);
    report.at_most(NOISE_WHITE, &format!("{name} bands"), worst, BAND_Z);
}
