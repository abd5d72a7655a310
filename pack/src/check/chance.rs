//! What chance does: quantiles that the statistical rules compare with.

/// How often a rule may blame what is sound.
pub(super) const FALSE_ALARMS: f64 = 1e-6;

/// The standard normal deviate that is exceeded with probability [`FALSE_ALARMS`].
const FALSE_ALARM_Z: f64 = 4.753_424;

/// Pearson's statistic against equal expectations.
pub(super) fn chi_squared(counts: &[f64]) -> f64 {
    let expected = counts.iter().sum::<f64>() / counts.len() as f64;
    counts
        .iter()
        .map(|n| (n - expected) * (n - expected) / expected)
        .sum()
}

/// The value that chi squared exceeds with probability [`FALSE_ALARMS`].
///
/// E. B. Wilson and M. M. Hilferty, "The distribution of chi-square", 1931: the cube root is near normal.
pub(super) fn chi_squared_quantile(freedom: f64) -> f64 {
    let a = 2.0 / (9.0 * freedom);
    let root = 1.0 - a + FALSE_ALARM_Z * libm::sqrt(a);
    freedom * root * root * root
}

/// The value that Pearson's statistic of counts in `cells` cells, with `expected` in each, exceeds with probability
/// [`FALSE_ALARMS`] at most.
///
/// Counts are whole numbers, so the fewer there are the longer is the tail. Its exact law, summed over all counts of 4, 8
/// and 16 cells, is beyond the quantile of chi squared by 0.39 over the expected count at most; a test has it.
pub(super) fn counts_quantile(cells: usize, expected: f64) -> f64 {
    chi_squared_quantile((cells - 1) as f64) * (1.0 + 0.4 / expected)
}

/// How many standard deviations a value of chi squared is from what it should be, by the same law.
pub(super) fn chi_squared_deviate(value: f64, freedom: f64) -> f64 {
    let a = 2.0 / (9.0 * freedom);
    (libm::cbrt(value / freedom) - (1.0 - a)) / libm::sqrt(a)
}

/// The largest distance of a byte value's count from an equal share of all.
pub(super) fn unevenness(bytes: impl Iterator<Item = u8>) -> usize {
    let mut counts = [0_usize; 256];
    bytes.for_each(|byte| counts[usize::from(byte)] += 1);
    let share = counts.iter().sum::<usize>() / counts.len();
    let distances = counts.iter().map(|count| count.abs_diff(share));
    distances.max().unwrap_or(0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_quantile_is_as_many_deviations_away_as_it_should_be() {
        for freedom in [1.0, 15.0, 735.0] {
            let z = chi_squared_deviate(chi_squared_quantile(freedom), freedom);
            assert!((z - FALSE_ALARM_Z).abs() < 1e-9);
        }
        // Pearson's table: 57.4 at 15 degrees and one in a million, to the approximation's half per cent.
        assert!((chi_squared_quantile(15.0) - 57.4).abs() < 0.3);
    }

    /// The probability that Pearson's statistic of `count` independent places in `cells` cells is above `bound`: the sum
    /// over all counts, cell by cell, of which each is binomial in what is left.
    fn exact_tail(cells: usize, count: usize, bound: f64) -> f64 {
        let ln_factorial: Vec<f64> = (0..=count)
            .scan(0.0, |sum, n| {
                *sum += libm::log(n.max(1) as f64);
                Some(*sum)
            })
            .collect();
        let squares = count * count + 1;
        // By counts so far and by the sum of their squares.
        let mut law = vec![0.0; (count + 1) * squares];
        law[0] = 1.0;
        for left in (1..=cells).rev() {
            let share = 1.0 / left as f64;
            let mut next = vec![0.0; law.len()];
            for placed in 0..=count {
                let rest = count - placed;
                let chances: Vec<f64> = (0..=rest)
                    .map(|n| match left {
                        1 => f64::from(u8::from(n == rest)),
                        _ => libm::exp(
                            ln_factorial[rest] - ln_factorial[n] - ln_factorial[rest - n]
                                + n as f64 * libm::log(share)
                                + (rest - n) as f64 * libm::log1p(-share),
                        ),
                    })
                    .collect();
                for sum in 0..squares {
                    let weight = law[placed * squares + sum];
                    if weight < 1e-20 {
                        continue;
                    }
                    for (n, chance) in chances.iter().enumerate() {
                        next[(placed + n) * squares + sum + n * n] += weight * chance;
                    }
                }
            }
            law = next;
        }
        let expected = count as f64 / cells as f64;
        let of = |sum: usize| sum as f64 / expected - count as f64;
        let all = law[count * squares..].iter().enumerate();
        all.filter(|(sum, _)| of(*sum) > bound)
            .map(|(_, chance)| chance)
            .sum()
    }

    #[test]
    fn counts_exceed_their_quantile_once_in_a_million_however_few_they_are() {
        for (cells, count) in [(4, 20), (4, 40), (8, 20), (8, 40), (16, 20), (16, 48)] {
            let bound = counts_quantile(cells, count as f64 / cells as f64);
            let tail = exact_tail(cells, count, bound);
            assert!(tail < FALSE_ALARMS, "{cells} {count}: {tail}");
            // The bound is no wider than it must be by much.
            assert!(tail > 0.02 * FALSE_ALARMS, "{cells} {count}: {tail}");
        }
    }
}
