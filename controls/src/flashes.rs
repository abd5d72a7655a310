//! Lightning that comes again and again: which flash belongs to a moment. A function of the moment, as everything of a frame is.

use welkin_runtime::params::Lightning;

/// Seconds before the end of its interval by which a flash is over.
const OVER_S: f64 = 1.0;

/// Half of the side of the square about the world's origin in which flashes are, in metres.
const REACH_M: f64 = 9_000.0;

/// The flash of the interval in which this second is: one each, at its own place and moment.
pub fn flash(flashes_per_min: f32, at_s: f64) -> Lightning {
    let interval_s = 60.0 / f64::from(flashes_per_min);
    let number = (at_s / interval_s).floor();
    let share = |part: u64| {
        let hash = mix((number as i64 as u64).wrapping_mul(4).wrapping_add(part));
        (hash >> 11) as f64 / (1_u64 << 53) as f64
    };
    let place = |part| ((share(part) * 2.0 - 1.0) * REACH_M).round() as f32;
    Lightning {
        strength: 0.4 + 0.6 * share(0) as f32,
        start_s: number * interval_s + share(1) * (interval_s - OVER_S).max(0.0),
        place_m: [place(2), place(3)],
    }
}

/// SplitMix64's finaliser: G. Steele, D. Lea, C. Flood, "Fast Splittable Pseudorandom Number Generators", OOPSLA 2014, figure 16.
fn mix(number: u64) -> u64 {
    let z = number.wrapping_add(0x9e37_79b9_7f4a_7c15);
    let z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    z ^ (z >> 31)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_interval_has_one_flash_that_ends_in_it() {
        for number in 0..200 {
            let middle_s = f64::from(number) * 6.0 + 3.0;
            let one = flash(10.0, middle_s);
            assert_eq!(one, flash(10.0, middle_s + 2.9), "of the whole interval");
            assert!(one.start_s >= middle_s - 3.0 && one.start_s + OVER_S <= middle_s + 3.0);
            assert!((0.4..=1.0).contains(&one.strength));
            assert_ne!(one.place_m, flash(10.0, middle_s + 6.0).place_m);
        }
    }
}
