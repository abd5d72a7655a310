//! Whether a sky moves evenly: a number for pictures that follow on each other.

/// How much one picture differs from another: the root of the mean square difference of their encoded luminances, which is about what an eye
/// sees of it.
///
/// # Panics
/// With pictures of different sizes.
pub fn change(one: &[f32], other: &[f32]) -> f32 {
    assert_eq!(one.len(), other.len(), "pictures of one size are compared");
    let apart = one.iter().zip(other).map(|(a, b)| f64::from(a - b));
    let square: f64 = apart.map(|d| d * d).sum();
    (square / one.len().max(1) as f64).sqrt() as f32
}

/// The largest of some changes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pop {
    /// Which one it is.
    pub index: usize,
    /// How many times the median it is; infinite where more than half of them are none at all.
    pub ratio: f32,
}

/// The largest of some changes; none where there are none.
pub fn pop(changes: &[f32]) -> Option<Pop> {
    let (index, largest) = changes
        .iter()
        .enumerate()
        .max_by(|(_, a), (_, b)| a.total_cmp(b))?;
    let mut sorted = changes.to_vec();
    sorted.sort_by(f32::total_cmp);
    let median = sorted[sorted.len() / 2];
    let ratio = if median > 0.0 {
        largest / median
    } else {
        f32::INFINITY
    };
    Some(Pop { index, ratio })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_step_is_told_with_its_place() {
        let at = |second: f32| -> Vec<f32> {
            let jump = if second > 1.0 { 0.3 } else { 0.0 };
            (0..100)
                .map(|x| (0.1 * (x as f32 + second + jump)).sin())
                .collect()
        };
        let pictures: Vec<_> = (0..60).map(|k| at(k as f32 / 30.0)).collect();
        let changes: Vec<f32> = pictures.windows(2).map(|p| change(&p[0], &p[1])).collect();
        let found = pop(&changes).unwrap();
        // From a 30th to a 30th and 0.3 more.
        assert_eq!(found.index, 30);
        assert!((found.ratio - 10.0).abs() < 0.5, "{found:?}");
        assert!(pop(&changes[..29]).unwrap().ratio < 1.1);
    }

    #[test]
    fn what_stands_still_does_not_move_evenly() {
        assert_eq!(pop(&[]), None);
        assert_eq!(pop(&[0.0; 9]).unwrap().ratio, f32::INFINITY);
    }

    #[test]
    fn a_change_is_the_root_of_the_mean_square() {
        assert_eq!(
            change(&[0.0, 0.5, 1.0, 0.0], &[0.0, 0.0, 0.5, 0.0]),
            0.125_f32.sqrt()
        );
    }
}
