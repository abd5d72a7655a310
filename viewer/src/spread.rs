//! What is left of many times: their mean, their middle, and how far they spread.

/// The mean and the middle of many times, and how far they spread.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Spread {
    /// Their sum over their count.
    pub mean: f64,
    /// Half of the times are below.
    pub median: f64,
    /// One in ten is below.
    pub p10: f64,
    /// One in ten is above.
    pub p90: f64,
}

impl Spread {
    /// Of times in any order and any unit. Of no times at all it is not a number.
    ///
    /// Between two times it is interpolated (R. J. Hyndman, Y. Fan, "Sample Quantiles in Statistical
    /// Packages", The American Statistician 50(4), 1996, definition 7).
    pub fn of(times: &[f64]) -> Spread {
        let mut sorted = times.to_vec();
        sorted.sort_by(f64::total_cmp);
        if sorted.is_empty() {
            return Spread {
                mean: f64::NAN,
                median: f64::NAN,
                p10: f64::NAN,
                p90: f64::NAN,
            };
        }
        let quantile = |q: f64| {
            let at = q * (sorted.len() - 1) as f64;
            let (low, high) = (sorted[at.floor() as usize], sorted[at.ceil() as usize]);
            low + (high - low) * at.fract()
        };
        Spread {
            mean: sorted.iter().sum::<f64>() / sorted.len() as f64,
            median: quantile(0.5),
            p10: quantile(0.1),
            p90: quantile(0.9),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::Spread;

    #[test]
    fn quantiles_of_a_ramp_lie_on_the_ramp() {
        let times: Vec<f64> = (0..=100).rev().map(f64::from).collect();
        assert_eq!(
            Spread::of(&times),
            Spread {
                mean: 50.0,
                median: 50.0,
                p10: 10.0,
                p90: 90.0
            }
        );
    }

    #[test]
    fn one_time_has_no_spread() {
        assert_eq!(
            Spread::of(&[2.5]),
            Spread {
                mean: 2.5,
                median: 2.5,
                p10: 2.5,
                p90: 2.5
            }
        );
    }

    #[test]
    fn one_long_time_moves_the_mean_and_not_the_median() {
        let spread = Spread::of(&[1.0, 1.0, 10.0, 1.0, 1.0]);
        assert_eq!((spread.mean, spread.median), (2.8, 1.0));
    }

    #[test]
    fn an_even_count_has_its_median_between_the_middle_two() {
        assert_eq!(Spread::of(&[4.0, 1.0]).median, 2.5);
    }
}
