//! Named random streams: one a channel, so that a change of one channel never moves another.

use rand::{Rng, SeedableRng};
use rand_xoshiro::Xoshiro256PlusPlus;

/// A stream of random numbers that depends on the recipe's seed and on a channel's name alone.
#[derive(Clone, Debug)]
pub struct Stream(Xoshiro256PlusPlus);

impl Stream {
    /// The stream of `channel` (such as `stars.phase`): xoshiro256++ seeded with the BLAKE3 hash of the
    /// seed's eight little-endian bytes followed by the name.
    ///
    /// D. Blackman, S. Vigna, "Scrambled Linear Pseudorandom Number Generators", ACM TOMS 47(4), 2021.
    pub fn new(seed: u64, channel: &str) -> Stream {
        let mut hasher = blake3::Hasher::new();
        hasher.update(&seed.to_le_bytes());
        hasher.update(channel.as_bytes());
        Stream(Xoshiro256PlusPlus::from_seed(*hasher.finalize().as_bytes()))
    }

    /// The next 64 random bits.
    pub fn bits(&mut self) -> u64 {
        self.0.next_u64()
    }

    /// A number in 0..1 (1 excluded), uniform over multiples of 2^-53.
    pub fn unit(&mut self) -> f64 {
        (self.bits() >> 11) as f64 * (1.0 / (1_u64 << 53) as f64)
    }

    /// A number between two, the second excluded.
    pub fn between(&mut self, [least, most]: [f32; 2]) -> f32 {
        least + (most - least) * self.unit() as f32
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn streams_depend_on_seed_and_name_alone() {
        let first = |seed, name| Stream::new(seed, name).bits();
        assert_eq!(first(1, "stars.phase"), first(1, "stars.phase"));
        assert_ne!(first(1, "stars.phase"), first(2, "stars.phase"));
        assert_ne!(first(1, "stars.phase"), first(1, "stars.rate"));
    }

    #[test]
    fn units_are_even_over_0_to_1() {
        let mut stream = Stream::new(7, "test");
        let units: Vec<f64> = (0..10_000).map(|_| stream.unit()).collect();
        assert!(units.iter().all(|u| (0.0..1.0).contains(u)));
        // The mean of n such numbers spreads by 1/sqrt(12 n) = 0.0029; four times that.
        let mean = units.iter().sum::<f64>() / units.len() as f64;
        assert!((mean - 0.5).abs() < 0.0116, "{mean}");
    }
}
