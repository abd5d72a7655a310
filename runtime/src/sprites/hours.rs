//! Light on clouds at a moment of the day, from the sky or from the pack's table.
//!
//! # Theory
//! Wang, "Shading": for a range of times an artist gives a factor on the ambient colours, the most colour that the sun adds, and
//! the least and the most share of it. Between two times each number is interpolated; after the last comes the first.
//!
//! # Changes versus the paper
//! A sky that is computed knows its light: [`of_sky`] takes colours from there, and the table stands behind a switch
//! ([`crate::params::SpriteParams::hours`]). The ambient light of a cloud is the sky's and what its own parts scatter on each other. Its factors
//! give the table's levels at noon.

use glam::Vec3;
use welkin_pack::field::Hour;

use crate::clear_sky::moment;
use crate::clouds::shared::CloudUniforms;

/// Light on the clouds of a moment.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SpriteLight {
    /// Factor on the colour levels.
    pub ambient: Vec3,
    /// The most that sun or moon add.
    pub direct: Vec3,
    /// Share of it on the far side of a group.
    pub least: f32,
    /// Share of it on the near side.
    pub most: f32,
}

/// Factors on the light of the sky and of the sun that make the ambient one, and on the sun's for the direct one.
const FROM_SKY: f32 = 3.0;
const FROM_SUN: f32 = 0.45;
const DIRECT: f32 = 0.67;
/// Share of the direct light on the far side of a group: the table's by day.
const LEAST: f32 = 0.05;

/// The light that the clouds of every method have, in the article's shading.
pub fn of_sky(clouds: &CloudUniforms) -> SpriteLight {
    SpriteLight {
        ambient: FROM_SKY * clouds.ambient + FROM_SUN * clouds.sunlight,
        direct: DIRECT * clouds.sunlight,
        least: LEAST,
        most: 1.0,
    }
}

/// The same where it is scattered: as it is, with no part for a group.
pub fn of_scattered(clouds: &CloudUniforms) -> SpriteLight {
    SpriteLight {
        ambient: clouds.ambient,
        direct: clouds.sunlight,
        least: 0.0,
        most: 0.0,
    }
}

/// The light of an hour, with a factor on its direct one.
pub fn of_hour(hour: &Hour, factor: f32) -> SpriteLight {
    SpriteLight {
        ambient: Vec3::splat(hour.ambient),
        direct: Vec3::from(hour.colour) * factor,
        least: hour.least,
        most: hour.most,
    }
}

/// The table at `time` (0..1); no light at all if it is empty. `hours` are in the order of time.
pub fn at(hours: &[Hour], time: f32) -> Hour {
    let (Some(first), Some(last)) = (hours.first(), hours.last()) else {
        return Hour {
            time,
            ambient: 0.0,
            colour: [0.0; 3],
            least: 0.0,
            most: 0.0,
        };
    };
    let after = hours.iter().find(|hour| hour.time > time);
    let before = hours.iter().rev().find(|hour| hour.time <= time);
    let (before, after) = (before.unwrap_or(last), after.unwrap_or(first));
    let turn = |span: f32| if span <= 0.0 { span + 1.0 } else { span };
    let passed = (time - before.time).rem_euclid(1.0);
    let share = (passed / turn(after.time - before.time)).clamp(0.0, 1.0);
    let mix = |from: f32, to: f32| from + (to - from) * share;
    let colour = Vec3::from(before.colour).lerp(Vec3::from(after.colour), share);
    Hour {
        time,
        ambient: mix(before.ambient, after.ambient),
        colour: colour.to_array(),
        least: mix(before.least, after.least),
        most: mix(before.most, after.most),
    }
}

/// The table between two times of day, by their weights.
pub fn between(hours: &[Hour], [first, second]: &[moment::Hour; 2]) -> Hour {
    let (from, to) = (at(hours, first.time), at(hours, second.time));
    let share = second.weight;
    if share == 0.0 {
        return from;
    }
    let mix = |from: f32, to: f32| from + (to - from) * share;
    let colour = Vec3::from(from.colour).lerp(Vec3::from(to.colour), share);
    Hour {
        time: from.time,
        ambient: mix(from.ambient, to.ambient),
        colour: colour.to_array(),
        least: mix(from.least, to.least),
        most: mix(from.most, to.most),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn hour(time: f32, ambient: f32) -> Hour {
        Hour {
            time,
            ambient,
            colour: [ambient; 3],
            least: 0.0,
            most: 1.0,
        }
    }

    #[test]
    fn it_is_the_tables_at_its_times_and_between_them_halfway() {
        let hours = [hour(0.25, 0.2), hour(0.5, 1.0), hour(0.75, 0.4)];
        for row in hours {
            assert_eq!(at(&hours, row.time).ambient, row.ambient);
        }
        assert!((at(&hours, 0.375).ambient - 0.6).abs() < 1e-6);
        assert!((at(&hours, 0.625).colour[1] - 0.7).abs() < 1e-6);
    }

    #[test]
    fn between_two_times_it_is_what_their_weights_say() {
        let hours = [hour(0.25, 0.2), hour(0.5, 1.0), hour(0.75, 0.4)];
        let of = |weight: f32| {
            let at = |time, weight| moment::Hour { time, weight };
            between(&hours, &[at(0.25, 1.0 - weight), at(0.75, weight)])
        };
        assert_eq!(of(0.0), at(&hours, 0.25));
        assert!((of(0.5).ambient - 0.3).abs() < 1e-6);
        assert!((of(1.0).colour[2] - 0.4).abs() < 1e-6);
    }

    #[test]
    fn it_wraps_at_midnight() {
        let hours = [hour(0.25, 0.2), hour(0.75, 0.4)];
        assert!((at(&hours, 0.0).ambient - 0.3).abs() < 1e-6);
        assert!((at(&hours, 0.999_999).ambient - at(&hours, 0.0).ambient).abs() < 1e-4);
        assert!((at(&hours, 0.125).ambient - 0.25).abs() < 1e-6);
    }

    #[test]
    fn one_row_is_the_same_all_day_and_no_row_is_dark() {
        for time in [0.0, 0.3, 0.5, 0.9] {
            assert_eq!(at(&[hour(0.5, 0.7)], time).ambient, 0.7);
            assert_eq!(at(&[], time).ambient, 0.0);
        }
    }
}
