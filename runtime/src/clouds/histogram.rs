//! Histograms: how numbers from 0 to 1 are distributed.

/// The distribution of numbers 0..1, as shares at [`Histogram::POINTS`] evenly spaced points.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Histogram {
    shares: Vec<f32>,
    /// Share above each point, its own counted half.
    above: Vec<f32>,
}

impl Histogram {
    /// Twice as many steps as bytes have: each byte is a point.
    const POINTS: usize = 511;
    const LAST: f32 = (Histogram::POINTS - 1) as f32;

    /// Of values, each counted once.
    pub fn of(values: impl Iterator<Item = f32>) -> Histogram {
        let mut shares = vec![0.0; Histogram::POINTS];
        for value in values {
            shares[(value.clamp(0.0, 1.0) * Histogram::LAST + 0.5) as usize] += 1.0;
        }
        Histogram::new(shares)
    }

    /// That of `f(a, b)`, 0..1, for independent a and b.
    pub fn of_pairs(a: &Histogram, b: &Histogram, f: impl Fn(f32, f32) -> f32) -> Histogram {
        let mut shares = vec![0.0; Histogram::POINTS];
        for (a, share_a) in a.points() {
            for (b, share_b) in b.points() {
                let place = f(a, b).clamp(0.0, 1.0) * Histogram::LAST;
                let (below, share) = (place as usize, share_a * share_b);
                // Between two points, so that the mean stays.
                let second = share * (place - below as f32);
                shares[below] += share - second;
                shares[(below + 1).min(Histogram::POINTS - 1)] += second;
            }
        }
        Histogram::new(shares)
    }

    fn new(mut shares: Vec<f32>) -> Histogram {
        let sum = shares.iter().sum::<f32>().max(f32::MIN_POSITIVE);
        shares.iter_mut().for_each(|share| *share /= sum);
        let mut left = 1.0;
        let above = shares.iter().map(|share| {
            left -= share;
            (left + 0.5 * share).max(0.0)
        });
        Histogram {
            above: above.collect(),
            shares,
        }
    }

    /// The points that occur, with their shares.
    fn points(&self) -> impl Iterator<Item = (f32, f32)> {
        let at = |(i, share): (usize, &f32)| (i as f32 / Histogram::LAST, *share);
        self.shares
            .iter()
            .enumerate()
            .map(at)
            .filter(|(_, share)| *share > 0.0)
    }

    /// The mean of a function of the number.
    pub fn mean(&self, f: impl Fn(f32) -> f32) -> f32 {
        self.points().map(|(value, share)| share * f(value)).sum()
    }

    /// The share above a number.
    pub fn above(&self, value: f32) -> f32 {
        let place = value * Histogram::LAST;
        if place < 0.0 {
            1.0
        } else if place < Histogram::LAST {
            let point = place as usize;
            let [near, far] = [self.above[point], self.above[point + 1]];
            near + (far - near) * (place - point as f32)
        } else {
            0.0
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn even() -> Histogram {
        Histogram::of((0..=255).map(|i| i as f32 / 255.0))
    }

    #[test]
    fn a_distribution_counts_what_is_above() {
        let even = even();
        for x in [0.1, 0.25, 0.5, 0.9] {
            // 256 bytes: half of one is 0.002.
            assert!((even.above(x) - (1.0 - x)).abs() < 0.002, "{x}");
        }
        assert_eq!((even.above(-0.1), even.above(1.0)), (1.0, 0.0));
        assert_eq!(even.above(f32::INFINITY), 0.0);
        assert!((even.mean(|v| v) - 0.5).abs() < 1e-5);
    }

    #[test]
    fn independent_numbers_fold() {
        // The mean of two even numbers has a triangle: above x in the upper half are 2 (1 - x)^2.
        let triangle = Histogram::of_pairs(&even(), &even(), |a, b| 0.5 * (a + b));
        for x in [0.5, 0.7, 0.9] {
            let exact = 2.0 * (1.0 - x) * (1.0 - x);
            assert!((triangle.above(x) - exact).abs() < 0.004, "{x}");
        }
        assert!((triangle.mean(|v| v) - 0.5).abs() < 1e-4);
    }
}
