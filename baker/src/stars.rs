//! The star texture: a mean intensity, a flicker rate, a variance and a phase for every star.
//!
//! T. Roden, I. Parberry, "Clouds and Stars", ACE 2005, section 4 and figure 6.
//!
//! # Changes versus the paper
//! Stars lie at random but at least two texels apart, so that no two touch; farther apart they would lie
//! so evenly that it shows. Their brightness follows real counts: the number of stars brighter than
//! magnitude m grows as 10^(0.5 m) over the naked-eye range (it would be 10^(0.6 m) in a uniform space; dust
//! and the disc's thickness make it less. J. N. Bahcall, R. M. Soneira, "The Universe at Faint Magnitudes. I",
//! ApJS 44, 1980).

use welkin_pack::{Image, StarTexel};

use crate::settings::StarSettings;
use crate::stream::Stream;

/// Least distance between two stars, in texels, on the tile taken as a torus.
pub(crate) const MIN_DISTANCE_TEXELS: i64 = 2;

/// Slowest and fastest flicker, in hertz. Above 4 Hz a star would seem to blink.
const RATES_HZ: [f64; 2] = [0.2, 3.95];

/// Least and greatest flicker amplitude, as a share of the mean intensity.
const VARIANCE_SHARES: [f64; 2] = [0.1, 0.6];

/// Four channels, as [`StarTexel`] names them; every value is a whole number of 255ths already.
///
/// Each channel has its own random stream. For every star, mean - variance >= 0 and mean + variance <= 1.
pub(crate) fn image(settings: &StarSettings, seed: u64) -> Image {
    let mut image = Image::new(settings.size, settings.size, 4);
    let [mut rates, mut variances, mut phases] =
        ["stars.rate", "stars.variance", "stars.phase"].map(|name| Stream::new(seed, name));
    let intensities = intensities(settings, &mut Stream::new(seed, "stars.intensity"));
    let positions = positions(settings, &mut Stream::new(seed, "stars.position"));
    for ([x, y], intensity) in positions.into_iter().zip(intensities) {
        let rate = between(RATES_HZ, rates.unit()) * (255.0 / f64::from(StarTexel::MAX_RATE_HZ));
        let most = intensity.min(255 - intensity);
        let variance = between(VARIANCE_SHARES, variances.unit()) * f64::from(intensity);
        let bytes = [
            intensity,
            rate as u8,
            (variance + 0.5) as u8,
            (phases.bits() >> 56) as u8,
        ];
        let bytes = [bytes[0], bytes[1], bytes[2].min(most), bytes[3]];
        image
            .texel_mut(x, y)
            .copy_from_slice(&bytes.map(|b| f32::from(b) / 255.0));
    }
    image
}

fn between([low, high]: [f64; 2], share: f64) -> f64 {
    low + (high - low) * share
}

/// Intensities in 255ths: one from each of `count` equal shares of the law N(<m) = 10^(0.5 m), cut at both ends.
fn intensities(settings: &StarSettings, stream: &mut Stream) -> Vec<u8> {
    let count = f64::from(settings.count);
    let least = libm::pow(10.0, -0.5 * f64::from(settings.magnitudes));
    let share = |i: u32, stream: &mut Stream| {
        least + (1.0 - least) * (f64::from(i) + stream.unit()) / count
    };
    let intensity = |share: f64| {
        // Magnitudes below the brightest star, Pogson's ratio: 5 magnitudes are a factor of 100.
        let magnitude = f64::from(settings.magnitudes) + 2.0 * libm::log10(share);
        f64::from(settings.brightest) * libm::pow(10.0, -0.4 * magnitude)
    };
    (0..settings.count)
        .map(|i| (intensity(share(i, stream)) * 255.0 + 0.5) as u8)
        .collect()
}

/// Places by throwing darts: uniform, and thrown again where another star is too near.
fn positions(settings: &StarSettings, stream: &mut Stream) -> Vec<[u32; 2]> {
    let size = settings.size;
    let mut taken = vec![false; (size * size) as usize];
    let mut positions = Vec::new();
    // The settings leave most of the texture free, so this ends soon.
    while positions.len() < settings.count as usize {
        let bits = stream.bits();
        let [x, y] = [bits >> 32, bits & 0xffff_ffff].map(|b| ((b * u64::from(size)) >> 32) as u32);
        if !taken[(y * size + x) as usize] {
            positions.push([x, y]);
            take_around(&mut taken, size, [x, y]);
        }
    }
    positions
}

fn take_around(taken: &mut [bool], size: u32, [x, y]: [u32; 2]) {
    let wrap = |i: u32, d: i64| (i64::from(i) + d).rem_euclid(i64::from(size)) as u32;
    let reach = -MIN_DISTANCE_TEXELS..=MIN_DISTANCE_TEXELS;
    for dy in reach.clone() {
        for dx in reach.clone() {
            if dx * dx + dy * dy < MIN_DISTANCE_TEXELS * MIN_DISTANCE_TEXELS {
                taken[(wrap(y, dy) * size + wrap(x, dx)) as usize] = true;
            }
        }
    }
}
