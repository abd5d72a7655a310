//! The energy of a tiling channel over wave vectors.

use std::ops::RangeInclusive;

use crate::image::Image;

/// A complex number: real and imaginary part.
type Complex = [f64; 2];

/// `|F(k)|^2` of a square channel without its mean, where `F(k) = sum f(x) exp(-2 pi i k.x / size)`.
///
/// The numbers are real, so `F(-k)` is the conjugate of `F(k)`, and half of the plane is kept: of a channel of 4096x4096, the
/// largest in four channels of 8 bits that a pack holds, 128 MiB.
pub(super) struct Spectrum {
    size: usize,
    /// Column by column: `kx` from 0 to `size / 2`, in each all `ky`, of which those above `size / 2` stand for negative
    /// ones.
    half: Vec<Complex>,
}

impl Spectrum {
    /// Of `size * size` numbers, row by row; the side is a power of two.
    pub(super) fn new(size: u32, values: impl IntoIterator<Item = f32>) -> Spectrum {
        let size = size as usize;
        let turns = turns(size);
        let mut half = vec![[0.0; 2]; (size / 2 + 1) * size];
        let mut row = vec![[0.0; 2]; size];
        let mut values = values.into_iter();
        for y in 0..size {
            for (place, value) in row.iter_mut().zip(&mut values) {
                *place = [value.into(), 0.0];
            }
            transform(&mut row, &turns);
            for (kx, value) in row[..=size / 2].iter().enumerate() {
                half[kx * size + y] = *value;
            }
        }
        half.chunks_exact_mut(size)
            .for_each(|column| transform(column, &turns));
        half[0] = [0.0; 2];
        Spectrum { size, half }
    }

    /// Numbers a side.
    pub(super) fn size(&self) -> u32 {
        self.size as u32
    }

    /// Sum over all wave vectors but 0.
    pub(super) fn total(&self) -> f64 {
        self.vectors().map(|(_, _, energy)| energy).sum()
    }

    /// Sum over the wave vectors whose larger component is in `waves`, and how many they are.
    pub(super) fn ring(&self, waves: RangeInclusive<usize>) -> (f64, usize) {
        let inside = self.vectors().filter(|(kx, ky, _)| {
            let larger = self.magnitude(*kx).max(self.magnitude(*ky));
            larger > 0 && waves.contains(&larger)
        });
        inside.fold((0.0, 0), |(sum, count), (_, _, energy)| {
            (sum + energy, count + 1)
        })
    }

    /// The largest energy of a wave vector. Those that are their own conjugates count half: their energy is
    /// the square of one normal number and not of two, so it strays twice as far.
    pub(super) fn peak(&self) -> f64 {
        let lone = |k: usize| k == 0 || 2 * k == self.size;
        self.vectors()
            .map(|(kx, ky, energy)| match lone(kx) && lone(ky) {
                true => energy / 2.0,
                false => energy,
            })
            .fold(0.0, f64::max)
    }

    /// Every wave vector, as two wave numbers, with its energy.
    pub(super) fn vectors(&self) -> impl Iterator<Item = (usize, usize, f64)> + '_ {
        let size = self.size;
        let places = (0..size).flat_map(move |kx| (0..size).map(move |ky| (kx, ky)));
        places.map(move |(kx, ky)| {
            let at = if kx <= size / 2 {
                kx * size + ky
            } else {
                (size - kx) * size + (size - ky) % size
            };
            let [re, im] = self.half[at];
            (kx, ky, re * re + im * im)
        })
    }

    /// A wave number without its sign.
    pub(super) fn magnitude(&self, k: usize) -> usize {
        k.min(self.size - k)
    }
}

/// The energy of a channel by wave number: element `k - 1` is the mean of `|F|^2` over the wave vectors whose length rounds to
/// `k`, for `k` from 1 to half the texels of a side, where `F(k) = sum f(x) exp(-2 pi i k.x / size)` and the mean of `f` is
/// left out.
///
/// None where there is no such spectrum: the image is no square whose side is a power of two, or a value is not finite.
pub fn radial_spectrum(image: &Image, channel: usize) -> Option<Vec<f64>> {
    let side = image.width;
    let is_fit = side >= 2 && side.is_power_of_two() && side == image.height;
    if !is_fit || !image.channel(channel).all(f32::is_finite) {
        return None;
    }
    let spectrum = Spectrum::new(side, image.channel(channel));
    let mut rings = vec![(0.0, 0_usize); side as usize / 2];
    for (kx, ky, energy) in spectrum.vectors() {
        let [x, y] = [kx, ky].map(|k| spectrum.magnitude(k) as f64);
        let length = libm::round(libm::sqrt(x * x + y * y)) as usize;
        if let Some(ring) = length.checked_sub(1).and_then(|k| rings.get_mut(k)) {
            *ring = (ring.0 + energy, ring.1 + 1);
        }
    }
    // Every ring has the vector along an axis.
    let means = rings.into_iter().map(|(sum, count)| sum / count as f64);
    Some(means.collect())
}

/// `exp(-2 pi i j / n)` for `j` below `n / 2`.
fn turns(n: usize) -> Vec<Complex> {
    let angle = |j: usize| -std::f64::consts::TAU * j as f64 / n as f64;
    (0..n / 2)
        .map(|j| [libm::cos(angle(j)), libm::sin(angle(j))])
        .collect()
}

/// The discrete Fourier transform in place; the length is a power of two.
///
/// J. W. Cooley, J. W. Tukey, "An algorithm for the machine calculation of complex Fourier series", 1965.
fn transform(line: &mut [Complex], turns: &[Complex]) {
    let n = line.len();
    let unused_bits = n.leading_zeros() + 1;
    for i in 1..n {
        let mirrored = i.reverse_bits() >> unused_bits;
        if i < mirrored {
            line.swap(i, mirrored);
        }
    }
    let mut half = 1;
    while half < n {
        for block in line.chunks_exact_mut(2 * half) {
            let (low, high) = block.split_at_mut(half);
            for (j, (a, b)) in low.iter_mut().zip(high).enumerate() {
                let [cos, sin] = turns[j * n / (2 * half)];
                let turned = [b[0] * cos - b[1] * sin, b[0] * sin + b[1] * cos];
                *b = [a[0] - turned[0], a[1] - turned[1]];
                *a = [a[0] + turned[0], a[1] + turned[1]];
            }
        }
        half *= 2;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_is_the_sum_that_defines_it() {
        let n = 16;
        let line: Vec<Complex> = (0..n)
            .map(|i| [(i * i % 7) as f64, (i % 3) as f64])
            .collect();
        let mut found = line.clone();
        transform(&mut found, &turns(n));
        for (k, value) in found.iter().enumerate() {
            let mut sum = [0.0, 0.0];
            for (x, [re, im]) in line.iter().enumerate() {
                let angle = -std::f64::consts::TAU * (k * x) as f64 / n as f64;
                let (cos, sin) = (libm::cos(angle), libm::sin(angle));
                sum = [sum[0] + re * cos - im * sin, sum[1] + re * sin + im * cos];
            }
            assert!((value[0] - sum[0]).abs() < 1e-10 && (value[1] - sum[1]).abs() < 1e-10);
        }
    }

    #[test]
    fn the_radial_spectrum_finds_a_wave_and_the_level_of_white_noise() {
        let mut image = Image::new(64, 64, 2);
        for y in 0..64 {
            for x in 0..64 {
                // A wave vector of length 5: the ring of 28 vectors that round to it holds two of its energy each.
                let turn = (3 * x + 4 * y) as f32 / 64.0;
                image.texel_mut(x, y)[0] = libm::cosf(std::f32::consts::TAU * turn);
                // One texel alone has the same energy, its square, at every wave vector.
                image.texel_mut(x, y)[1] = if [x, y] == [9, 20] { 3.0 } else { 0.0 };
            }
        }
        let rings = radial_spectrum(&image, 0).unwrap();
        let count = (-6_i32..=6)
            .flat_map(|x| (-6_i32..=6).map(move |y| f64::from(x * x + y * y)))
            .filter(|square| (4.5 * 4.5..5.5 * 5.5).contains(square))
            .count() as f64;
        let each = libm::pow(64.0 * 64.0 / 2.0, 2.0);
        assert!((rings[4] - 2.0 * each / count).abs() < 1e-6 * each);
        let others = rings.iter().enumerate().filter(|(i, _)| *i != 4);
        assert!(others.map(|(_, e)| *e).fold(0.0, f64::max) < 1e-9 * each);
        let flat = radial_spectrum(&image, 1).unwrap();
        assert_eq!(flat.len(), 32);
        assert!(flat.iter().all(|e| (e - 9.0).abs() < 1e-9), "{flat:?}");
    }

    #[test]
    fn there_is_no_spectrum_of_what_has_none() {
        assert_eq!(radial_spectrum(&Image::new(64, 32, 1), 0), None);
        assert_eq!(radial_spectrum(&Image::new(48, 48, 1), 0), None);
        assert_eq!(radial_spectrum(&Image::new(1, 1, 1), 0), None);
        let mut image = Image::new(8, 8, 1);
        image.texels[3] = f32::NAN;
        assert_eq!(radial_spectrum(&image, 0), None);
    }

    #[test]
    fn a_wave_is_in_its_ring_alone() {
        let values = (0..1024).map(|i| {
            let (x, y) = (i % 32, i / 32);
            let turn = (3 * x + 32 - 5 * y % 32) as f32 / 32.0;
            0.5 + 0.25 * libm::cosf(std::f32::consts::TAU * turn)
        });
        let spectrum = Spectrum::new(32, values);
        // A cosine of amplitude a has two waves with the energy (a n^2 / 2)^2 each.
        let each = libm::pow(0.25 * 1024.0 / 2.0, 2.0);
        let close = |a: f64, b: f64| (a - b).abs() < 1e-4 * each;
        assert!(close(spectrum.total(), 2.0 * each));
        assert!(close(spectrum.ring(5..=5).0, 2.0 * each));
        assert!(close(spectrum.peak(), each));
        // 11 wave vectors a side less 9 a side.
        assert_eq!(spectrum.ring(5..=5).1, 121 - 81);
        assert_eq!(spectrum.ring(1..=16).1, 1023);
    }

    #[test]
    fn both_halves_of_the_plane_are_the_sum_that_defines_it() {
        let n = 8;
        let values: Vec<f32> = (0..n * n).map(|i| (i * i % 11) as f32).collect();
        let spectrum = Spectrum::new(n as u32, values.clone());
        assert_eq!(spectrum.vectors().count(), n * n);
        for (kx, ky, energy) in spectrum.vectors().filter(|(kx, ky, _)| kx + ky > 0) {
            let mut sum = [0.0, 0.0];
            for (i, value) in values.iter().enumerate() {
                let turns = (kx * (i % n) + ky * (i / n)) as f64 / n as f64;
                let angle = -std::f64::consts::TAU * turns;
                sum[0] += f64::from(*value) * libm::cos(angle);
                sum[1] += f64::from(*value) * libm::sin(angle);
            }
            let expected = sum[0] * sum[0] + sum[1] * sum[1];
            assert!(
                (energy - expected).abs() < 1e-8,
                "{kx} {ky}: {energy} {expected}"
            );
        }
    }
}
