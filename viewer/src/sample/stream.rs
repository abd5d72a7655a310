//! Random numbers that depend on a seed, a line and a key alone: another key, or another count, moves none of them.

use std::f64::consts::TAU;

/// Numbers of one key of one line: the extended output of BLAKE3 (J. O'Connor and others, 2020) of seed and line, eight bytes each, the
/// lowest first, followed by the key.
pub struct Stream(blake3::OutputReader);

impl Stream {
    pub fn new(seed: u64, line: u64, key: &str) -> Stream {
        let mut hasher = blake3::Hasher::new();
        hasher.update(&seed.to_le_bytes());
        hasher.update(&line.to_le_bytes());
        hasher.update(key.as_bytes());
        Stream(hasher.finalize_xof())
    }

    /// 53 random bits.
    pub fn bits(&mut self) -> u64 {
        let mut bytes = [0; 8];
        self.0.fill(&mut bytes);
        u64::from_le_bytes(bytes) >> 11
    }

    /// A number in 0..1 (1 excluded), uniform over multiples of 2^-53.
    pub fn unit(&mut self) -> f64 {
        self.bits() as f64 * (1.0 / (1_u64 << 53) as f64)
    }

    /// A number of the normal distribution of mean 0 and deviation 1: G. E. P. Box, M. E. Muller, "A Note on the Generation of Random Normal
    /// Deviates", Ann. Math. Stat. 29(2), 1958. By `libm`, which gives the same bits everywhere.
    pub fn normal(&mut self) -> f64 {
        let [size, turn] = [1.0 - self.unit(), self.unit()];
        libm::sqrt(-2.0 * libm::log(size)) * libm::cos(TAU * turn)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn streams_depend_on_seed_line_and_key_alone() {
        let first = |seed, line, key| Stream::new(seed, line, key).bits();
        assert_eq!(first(1, 2, "a"), first(1, 2, "a"));
        for other in [first(2, 2, "a"), first(1, 3, "a"), first(1, 2, "b")] {
            assert_ne!(first(1, 2, "a"), other);
        }
    }

    #[test]
    fn numbers_are_distributed_as_they_should() {
        let count = 20_000;
        let mean = |numbers: &[f64]| numbers.iter().sum::<f64>() / f64::from(count);
        let square =
            |numbers: &[f64]| numbers.iter().map(|x| x * x).sum::<f64>() / f64::from(count);
        let mut stream = Stream::new(7, 0, "test");
        let units: Vec<f64> = (0..count).map(|_| stream.unit()).collect();
        assert!(units.iter().all(|u| (0.0..1.0).contains(u)));
        // Four deviations of each mean: 0.2887 / sqrt(n); of squares 0.298 / sqrt(n).
        assert!((mean(&units) - 0.5).abs() < 0.0082 && (square(&units) - 1.0 / 3.0).abs() < 0.0085);
        let normals: Vec<f64> = (0..count).map(|_| stream.normal()).collect();
        // 1 / sqrt(n), and sqrt(2 / n).
        assert!(mean(&normals).abs() < 0.0283 && (square(&normals) - 1.0).abs() < 0.04);
        let beyond = normals.iter().filter(|x| x.abs() > 1.959_964).count();
        // A twentieth, 1000, with a deviation of 31.
        assert!(beyond.abs_diff(1000) < 124, "{beyond}");
    }
}
