//! The discrete Fourier transform of a square whose side is a power of two.
//!
//! J. W. Cooley, J. W. Tukey, "An Algorithm for the Machine Calculation of Complex Fourier Series", Math. Comput. 19, 1965. Sums run in
//! one order, so that the bytes are the same with any number of threads.

use std::f64::consts::TAU;

use rayon::prelude::*;

/// A complex number.
type Complex = [f64; 2];

/// A square of complex numbers, row by row.
#[derive(Clone, Debug)]
pub(super) struct Plane {
    side: usize,
    values: Vec<Complex>,
}

impl Plane {
    pub fn new(side: usize) -> Plane {
        Plane {
            side,
            values: vec![[0.0; 2]; side * side],
        }
    }

    /// Adds a real number at a column and a row.
    pub fn add(&mut self, [x, y]: [usize; 2], value: f64) {
        self.values[y * self.side + x][0] += value;
    }

    /// Multiplies by a real factor for each column and row.
    pub fn scale(&mut self, factor: impl Fn([usize; 2]) -> f64 + Sync) {
        let side = self.side;
        let rows = self.values.par_chunks_mut(side).enumerate();
        rows.for_each(|(y, row)| {
            for (x, value) in row.iter_mut().enumerate() {
                let factor = factor([x, y]);
                *value = value.map(|part| part * factor);
            }
        });
    }

    /// Real parts, row by row.
    pub fn real(&self) -> impl Iterator<Item = f64> {
        self.values.iter().map(|value| value[0])
    }

    fn transposed(&self) -> Plane {
        let side = self.side;
        let values = (0..side * side).map(|i| self.values[i % side * side + i / side]);
        Plane {
            side,
            values: values.collect(),
        }
    }
}

/// Transforms in place, or back with the factor that makes it the same again.
pub(super) fn transform(plane: &mut Plane, back: bool) {
    let side = plane.side;
    let sign = if back { 1.0 } else { -1.0 };
    let roots: Vec<Complex> = (0..side / 2)
        .map(|i| {
            let angle = sign * TAU * i as f64 / side as f64;
            [libm::cos(angle), libm::sin(angle)]
        })
        .collect();
    for _ in 0..2 {
        let rows = plane.values.par_chunks_mut(side);
        rows.for_each(|row| transform_row(row, &roots));
        *plane = plane.transposed();
    }
    if back {
        let factor = 1.0 / (side * side) as f64;
        plane.scale(|_| factor);
    }
}

fn transform_row(row: &mut [Complex], roots: &[Complex]) {
    let side = row.len();
    let bits = side.ilog2();
    for i in 0..side {
        let j = i.reverse_bits() >> (usize::BITS - bits.max(1));
        if i < j {
            row.swap(i, j);
        }
    }
    let mut half = 1;
    while half < side {
        let stride = side / (2 * half);
        for block in row.chunks_exact_mut(2 * half) {
            let (low, high) = block.split_at_mut(half);
            for (i, (a, b)) in low.iter_mut().zip(high).enumerate() {
                let [c, s] = roots[i * stride];
                let turned = [b[0] * c - b[1] * s, b[0] * s + b[1] * c];
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
    fn there_and_back_is_the_same_and_a_wave_is_one_number() {
        let mut plane = Plane::new(16);
        for i in 0..256_usize {
            let [x, y] = [i % 16, i / 16];
            plane.add([x, y], libm::cos(TAU * (3 * x + 2 * y) as f64 / 16.0));
        }
        let before = plane.clone();
        transform(&mut plane, false);
        for (i, value) in plane.values.iter().enumerate() {
            let is_wave = [2 * 16 + 3, 14 * 16 + 13].contains(&i);
            let expected = if is_wave { 128.0 } else { 0.0 };
            assert!(
                (value[0] - expected).abs() < 1e-9 && value[1].abs() < 1e-9,
                "{i}: {value:?}"
            );
        }
        transform(&mut plane, true);
        for (a, b) in plane.real().zip(before.real()) {
            assert!((a - b).abs() < 1e-12);
        }
    }
}
