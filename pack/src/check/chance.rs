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

/// How many standard deviations a value of chi squared is from what it should be, by the same law.
pub(super) fn chi_squared_deviate(value: f64, freedom: f64) -> f64 {
    let a = 2.0 / (9.0 * freedom);
    (libm::cbrt(value / freedom) - (1.0 - a)) / libm::sqrt(a)
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
}
