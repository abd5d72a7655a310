//! The way from one weather to another.
//!
//! Numbers go over smoothly; what is no number changes at once. The time of day takes the shorter way round the clock. A number that a
//! person moves meanwhile is theirs from then on.

use welkin_runtime::params::{Number, SETTINGS, Setting};

use crate::settings::Settings;

/// A way over seconds.
#[derive(Clone, Debug)]
pub struct Blend {
    /// The numbers that change.
    ways: Vec<Way>,
    elapsed_s: f32,
    duration_s: f32,
}

/// A number that changes, and its way.
#[derive(Clone, Copy, Debug)]
struct Way {
    number: &'static Number,
    from: f32,
    to: f32,
    /// What it was set to last.
    last: f32,
}

impl Blend {
    /// Begins the way from `settings` to `goal`: what is no number is set at once. A way of no length is gone at once.
    pub fn begin(settings: &mut Settings, goal: &Settings, duration_s: f32) -> Blend {
        let (mut now, mut start) = (settings.params, *goal);
        let mut ways = Vec::new();
        for number in numbers() {
            let (from, to) = (*(number.place)(&mut now), (number.place)(&mut start.params));
            if from != *to {
                ways.push(Way {
                    number,
                    from,
                    to: *to,
                    last: from,
                });
            }
            *to = from;
        }
        *settings = start;
        let mut blend = Blend {
            ways,
            elapsed_s: 0.0,
            duration_s: duration_s.max(0.0),
        };
        if blend.duration_s == 0.0 {
            blend.advance(settings, 0.0);
        }
        blend
    }

    /// Goes on by `seconds`.
    pub fn advance(&mut self, settings: &mut Settings, seconds: f32) {
        self.elapsed_s += seconds.max(0.0);
        let share = if self.duration_s > 0.0 {
            (self.elapsed_s / self.duration_s).min(1.0)
        } else {
            1.0
        };
        self.ways.retain_mut(|way| {
            let place = (way.number.place)(&mut settings.params);
            if *place != way.last {
                return false;
            }
            way.last = way.at(share);
            *place = way.last;
            true
        });
        if share == 1.0 {
            self.ways.clear();
        }
    }

    /// Whether there is nothing left to change.
    pub fn is_over(&self) -> bool {
        self.ways.is_empty()
    }
}

impl Way {
    fn at(&self, share: f32) -> f32 {
        if share == 1.0 {
            return self.to;
        }
        // No speed at either end.
        let eased = share * share * (3.0 - 2.0 * share);
        if self.number.field == CLOCK {
            let way = (self.to - self.from + 0.5).rem_euclid(1.0) - 0.5;
            return (self.from + way * eased).rem_euclid(1.0);
        }
        self.from + (self.to - self.from) * eased
    }
}

/// The time of day, which goes round.
const CLOCK: &str = "time";

/// Every number of a weather that may stand between two others.
fn numbers() -> impl Iterator<Item = &'static Number> {
    let blended = SETTINGS.iter().filter(|setting| setting.words.blends);
    blended.flat_map(Setting::numbers)
}

#[cfg(test)]
mod tests {
    use crate::{PRESETS, Preset};

    use super::*;

    #[test]
    fn a_way_ends_at_its_goal_exactly() {
        for from in &PRESETS {
            for to in &PRESETS {
                let mut settings = from.of(&Settings::default()).unwrap();
                let goal = to.of(&settings).unwrap();
                let mut blend = Blend::begin(&mut settings, &goal, 3.0);
                for _ in 0..31 {
                    blend.advance(&mut settings, 0.1);
                    assert_eq!(settings.params.check(), Ok(()));
                }
                assert!(blend.is_over() && settings == goal);
            }
        }
    }

    #[test]
    fn numbers_never_leap_on_the_way() {
        let mut settings = Settings::default();
        let goal = Preset::named("storm").unwrap().of(&settings).unwrap();
        let mut blend = Blend::begin(&mut settings, &goal, 4.0);
        for _ in 0..40 {
            let before = settings.params.cover;
            blend.advance(&mut settings, 0.1);
            // The steepest part of the curve: 1.5 times the mean.
            let most = 1.5 * (0.95 - 0.6) * 0.1 / 4.0;
            assert!((settings.params.cover - before).abs() <= most * 1.001);
        }
    }

    #[test]
    fn the_hour_takes_the_shorter_way_round() {
        let mut settings = Settings::default();
        settings.params.time = 0.7;
        let mut goal = settings;
        goal.params.time = 0.0;
        let mut blend = Blend::begin(&mut settings, &goal, 2.0);
        blend.advance(&mut settings, 1.0);
        assert!((settings.params.time - 0.85).abs() < 1e-6);
        blend.advance(&mut settings, 1.0);
        assert_eq!(settings.params.time, 0.0);
    }

    #[test]
    fn what_a_person_moves_is_theirs() {
        let mut settings = Settings::default();
        let goal = Preset::named("storm").unwrap().of(&settings).unwrap();
        let mut blend = Blend::begin(&mut settings, &goal, 2.0);
        blend.advance(&mut settings, 1.0);
        settings.params.cover = 0.25;
        blend.advance(&mut settings, 5.0);
        assert_eq!(settings.params.cover, 0.25);
        assert_eq!(settings.params.density, 0.8);
    }
}
