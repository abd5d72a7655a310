//! How far each cloud has formed.
//!
//! # Theory
//! Wang, "Formation and Dissipation": a cloud that forms begins with the sprites whose centre is within half its radius; when those have
//! reached a threshold of opacity, the others begin. Listing 1: opacity of a vertex is `alpha_of_cloud - alpha_at_edges * place`, with
//! `place` its distance from the cloud's middle over its radius. A cloud that dissolves loses its edges first (`alpha_at_edges` grows
//! from 0 to 1), then its core (`alpha_of_cloud` falls from 1 to 0); one that forms goes the other way.
//!
//! Both together: in the first stage `alpha_of_cloud` rises and only sprites within half the radius show, the least of them, at that
//! half, by then with an opacity of 1/2: that is the threshold. In the second `alpha_at_edges` falls, and the others show as far as it
//! has fallen.
//!
//! # Changes versus the paper
//! - The listing measures `place` from the edge inwards, by which the core would go first; its text and its heading say the edges do, and
//!   so it is here.
//! - The listing adds up time steps. Here a cloud's amount is a function of cover, its rank and the moment, so any
//!   moment can be drawn at once: clouds near the threshold of cover come and go in some minutes, each in its own time.

use crate::params::SkyParams;

/// Cover over which a cloud forms.
const WIDTH: f32 = 0.08;
/// How far the cover of each cloud swings about [`SkyParams::cover`] where that is one half.
const SWING: f32 = 0.05;
/// The shortest period of that swing and what the longest adds, in seconds.
const PERIOD_S: [f64; 2] = [240.0, 360.0];
/// Fractions of the golden ratio and of the plastic number: multiples of them fill 0..1 evenly, and do not repeat together.
const GOLDEN: f64 = 0.618_033_988_749_895;
const PLASTIC: f64 = 0.754_877_666_246_693;

/// How far the cloud with this number and rank has formed, 0 (nothing) to 1 (whole). `params` are in range.
pub fn amount(index: usize, rank: f32, params: &SkyParams, seconds: f64) -> f32 {
    let cover = params.cover + swing(index, params.cover, seconds);
    formed(cover, rank).min(params.sprites.formation)
}

/// How far a cloud of this rank has formed at this cover: nothing at 0, whole at 1.
pub fn formed(cover: f32, rank: f32) -> f32 {
    ((cover * (1.0 + WIDTH) - rank) / WIDTH).clamp(0.0, 1.0)
}

/// What the moment adds to the cover of a cloud.
fn swing(index: usize, cover: f32, seconds: f64) -> f32 {
    let phase = (index as f64 * GOLDEN).fract();
    let period_s = PERIOD_S[0] + PERIOD_S[1] * (index as f64 * PLASTIC).fract();
    let turns = (seconds / period_s + phase).rem_euclid(1.0);
    let wave = (std::f64::consts::TAU * turns).sin() as f32;
    SWING * 4.0 * cover * (1.0 - cover) * wave
}

/// Sprites whose centre is nearer to the middle of their cloud than this share of its radius come first.
pub const FIRST_STAGE: f32 = 0.5;

/// Opacity of a vertex at a place in its cloud, whose sprite has its centre at another: 0 in the cloud's middle, 1 at its radius.
pub fn opacity(amount: f32, place: f32, centre: f32) -> f32 {
    let alpha_of_cloud = (2.0 * amount).min(1.0);
    let alpha_at_edges = 1.0 - (2.0 * amount - 1.0).max(0.0);
    let stage = if centre > FIRST_STAGE {
        1.0 - alpha_at_edges
    } else {
        1.0
    };
    (alpha_of_cloud - alpha_at_edges * place).clamp(0.0, 1.0) * stage
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_middle_forms_first_and_dissolves_last() {
        let at = |amount: f32, place: f32| opacity(amount, place, place);
        assert_eq!([at(0.0, 0.0), at(0.0, 1.0)], [0.0, 0.0]);
        assert_eq!([at(1.0, 0.0), at(1.0, 1.0)], [1.0, 1.0]);
        // Half way: the core is whole, the edge is not there yet.
        assert_eq!([at(0.5, 0.0), at(0.5, 1.0)], [1.0, 0.0]);
        assert_eq!(at(0.25, 0.0), 0.5);
        for step in 0..20 {
            let amount = step as f32 / 20.0;
            for place in [0.0, 0.3, 0.7, 1.0] {
                assert!(at(amount + 0.05, place) >= at(amount, place));
                assert!(at(amount, place) <= at(amount, 0.0));
            }
        }
    }

    #[test]
    fn sprites_beyond_half_the_radius_wait_until_those_within_are_half_opaque() {
        for step in 0..=100 {
            let amount = step as f32 / 100.0;
            let first = opacity(amount, FIRST_STAGE, FIRST_STAGE);
            // A vertex of a sprite from beyond reaches into the middle of the cloud.
            for (place, centre) in [(0.0, 0.51), (0.3, 0.6), (0.6, 0.6), (1.0, 1.0)] {
                let second = opacity(amount, place, centre);
                assert_eq!(
                    second > 0.0,
                    first > 0.5 && amount > 0.5,
                    "{amount} {place}"
                );
            }
            assert!(first >= opacity(amount, FIRST_STAGE, 0.51));
        }
    }

    #[test]
    fn no_cover_is_no_cloud_and_full_cover_all() {
        for rank in [0.0, 0.2, 0.5, 0.99, 1.0] {
            assert_eq!(formed(0.0, rank), 0.0, "{rank}");
            assert_eq!(formed(1.0, rank), 1.0, "{rank}");
        }
    }

    #[test]
    fn the_swing_is_slow_and_none_where_the_sky_is_clear_or_shut() {
        for index in 0..50 {
            assert_eq!(swing(index, 0.0, 123.0), 0.0);
            assert_eq!(swing(index, 1.0, 123.0), 0.0);
            for seconds in [0.0, 77.0, 1e6, -5e8] {
                assert!(swing(index, 0.5, seconds).abs() <= SWING);
                let step = swing(index, 0.5, seconds + 0.1) - swing(index, 0.5, seconds);
                assert!(step.abs() < 1e-3 * SWING * 10.0, "{step}");
            }
        }
    }
}
