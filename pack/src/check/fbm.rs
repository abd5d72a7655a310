//! Smooth noise, an octave a layer, and the same noise displaced towards the sun.

mod band;

use super::chance::FALSE_ALARMS;
use super::report::{Bound, Report, subject};
use super::rule::{DISPLACED, OCTAVE_BAND, OCTAVE_EVEN};
use super::spectrum::Spectrum;
use super::tiling;
use crate::mapping::{FBM_LEAST_CELLS, FBM_STEPS_A_TILE};
use crate::role::Role;
use crate::texture::Texture;
use crate::view::View;
use band::Interpolation;

/// The channel of the noise itself; the channels before it are three, two and one steps away.
const NOISE: usize = 3;

/// Share of the energy that rounding to bytes makes, all over the spectrum: a step's variance, 1/12 of its
/// square, over that of the noise. Numbers even over 0..1 have the variance 1/12, and interpolation leaves
/// 26/35 of it in either direction: the mean of `h(t)^2 + h(1 - t)^2`.
const ROUNDING: f64 = 1.0 / (255.0 * 255.0) / (26.0 * 26.0 / (35.0 * 35.0));

pub(super) fn check(report: &mut Report, texture: &Texture) {
    let layers: Vec<View> = (0..texture.layers).map(|i| texture.view(0, i)).collect();
    for channel in 0..NOISE {
        let worst = layers
            .iter()
            .map(|view| displacement(*view, channel))
            .fold(0.0, f32::max);
        // Both come from the same numbers, so a step of a byte is rounding.
        report.at_most(
            DISPLACED,
            &subject(Role::Fbm, channel),
            worst,
            1.001 / 255.0,
        );
    }
    for channel in 0..=NOISE {
        tiling::check_seam(report, Role::Fbm, texture, channel);
    }
    check_bands(report, &layers);
}

/// The largest difference between a channel and the noise that many steps to the right.
fn displacement(image: View, channel: usize) -> f32 {
    let away = (NOISE - channel) as u32 * image.width / FBM_STEPS_A_TILE;
    let texels = (0..image.width * image.height).map(|i| (i % image.width, i / image.width));
    texels
        .map(|(x, y)| {
            let noise = image.texel((x + away) % image.width, y)[NOISE];
            (image.texel(x, y)[channel] - noise).abs()
        })
        .fold(0.0, f32::max)
}

/// Noise on a lattice of `c` cells lies below the wave number `c`, and a good part of it above `c / 2`,
/// where the octave before ends. The first layer tells what `c` is: each has twice that of the one before.
fn check_bands(report: &mut Report, layers: &[View]) {
    let spectrum = |view: &View| Spectrum::new(view.width, view.channel(NOISE));
    let spectra: Vec<Spectrum> = layers.iter().map(spectrum).collect();
    let Some(size) = layers.first().map(|image| image.width) else {
        return;
    };
    let cells = cells_of_the_first(&spectra, size);
    for (index, spectrum) in spectra.iter().enumerate() {
        let (cells, layer) = ((cells << index).min(size / 2), index + 1);
        check_even(report, layers[index], cells, layer);
        let octave = Interpolation::new(size, cells);
        let mut measure = |cut: u32, bound| {
            let name = format!("{} {layer} below {cut}", subject(Role::Fbm, NOISE));
            report.measure(OCTAVE_BAND, &name, share(spectrum, cut), bound);
        };
        measure(
            cells,
            Bound::AtLeast(octave.share_below(cells)[0] - ROUNDING),
        );
        measure(cells / 2, Bound::AtMost(octave.share_below(cells / 2)[1]));
    }
}

/// The largest distance of the lattice values' distribution from an even one.
///
/// Of `n` independent values it exceeds `e` with a probability of at most `2 exp(-2 n e^2)` (P. Massart, "The tight
/// constant in the Dvoretzky-Kiefer-Wolfowitz inequality", Annals of Probability 18, 1990).
fn check_even(report: &mut Report, image: View, cells: u32, layer: usize) {
    let step = (image.width / cells).max(1);
    let lattice = (0..image.height).step_by(step as usize);
    let lattice =
        lattice.flat_map(|y| (0..image.width).step_by(step as usize).map(move |x| (x, y)));
    let mut values: Vec<f64> = lattice
        .map(|(x, y)| f64::from(image.texel(x, y)[NOISE]))
        .collect();
    values.sort_unstable_by(f64::total_cmp);
    let count = values.len() as f64;
    let distances = values.iter().enumerate().map(|(i, value)| {
        let i = i as f64;
        (value - i / count)
            .abs()
            .max((value - (i + 1.0) / count).abs())
    });
    let most = libm::sqrt(libm::log(2.0 / FALSE_ALARMS) / (2.0 * count));
    report.measure(
        OCTAVE_EVEN,
        &format!("{} {layer}", subject(Role::Fbm, NOISE)),
        distances.fold(0.0, f64::max),
        // Half a step of rounding.
        Bound::AtMost(most + 0.5 / 255.0),
    );
}

/// The least power of two below which the first layer has the energy that it should have. Its bound is so
/// near to 1 that no sound octave reaches that of half its cells.
fn cells_of_the_first(spectra: &[Spectrum], size: u32) -> u32 {
    // The finest cell of the last layer has two texels; the layout is refused if that leaves the first too few.
    let most = (size >> spectra.len()).max(FBM_LEAST_CELLS);
    let candidates = (0..).map(|i| FBM_LEAST_CELLS << i);
    let candidates = candidates.take_while(|&n| n < most);
    let fits = |cells: u32| {
        let least = Interpolation::new(size, cells).share_below(cells)[0];
        share(&spectra[0], cells) >= least - ROUNDING
    };
    candidates.into_iter().find(|&n| fits(n)).unwrap_or(most)
}

/// Share of the energy at wave numbers up to `cut` in both directions; 0 in a flat channel.
fn share(spectrum: &Spectrum, cut: u32) -> f64 {
    spectrum.ring(1..=cut as usize).0 / spectrum.total().max(f64::MIN_POSITIVE)
}
