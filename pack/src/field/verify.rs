//! What makes a field sound for a reader: every number in its range, every index in its list.

use std::ops::RangeInclusive;

use super::{Cloud, CloudBox, Field, Sprite, bounds};
use crate::error::PackError;
use crate::limits::{MAX_BOXES, MAX_CLOUDS, MAX_GROUPS, MAX_HOURS, MAX_SECTIONS, MAX_SPRITES};
use crate::mapping::SheetCell;

/// Where clouds may be, in metres: some times the largest field.
const PLACES_M: RangeInclusive<f32> = -1e5..=1e5;

/// Sizes of boxes and sprites, in metres.
const SIZES_M: RangeInclusive<f32> = 1e-3..=2e4;

/// Colours, where 1 is the white of a sunlit cloud at noon.
const COLOURS: RangeInclusive<f32> = 0.0..=16.0;

const SHARES: RangeInclusive<f32> = 0.0..=1.0;

impl Field {
    /// Verifies what a reader relies on: counts within [`crate::limits`], numbers finite and in range, ranks and hours in
    /// order, indices in their lists. `file` names the field in errors. What only [`crate::check`] asks is not looked at.
    ///
    /// # Errors
    /// [`PackError::Value`] with the first that is not so.
    pub fn verify(&self, file: &str) -> Result<(), PackError> {
        self.verify_ranges(file)?;
        self.verify_indices(file)?;
        self.verify_ranks(file)?;
        self.verify_hours(file)
    }

    /// Counts and numbers are in range.
    pub(crate) fn verify_ranges(&self, file: &str) -> Result<(), PackError> {
        let counts = [
            ("sections", self.sections as usize, MAX_SECTIONS as usize),
            ("clouds", self.clouds.len(), MAX_CLOUDS),
            ("boxes", self.box_count(), MAX_BOXES),
            ("sprites", self.sprite_count(), MAX_SPRITES),
        ];
        for (key, found, most) in counts {
            if !(1..=most).contains(&found) {
                return Err(PackError::value(file, key, found, format!("1 to {most}")));
            }
        }
        for (index, cloud) in self.clouds.iter().enumerate() {
            let within = |key: &str, values: &[f32], range: &RangeInclusive<f32>| {
                within(file, &format!("clouds[{index}].{key}"), values, range)
            };
            let heights = cloud.levels.map(|level| level.height);
            within("levels.height", &heights, &SHARES)?;
            if heights.windows(2).any(|pair| pair[1] < pair[0]) {
                let key = format!("clouds[{index}].levels.height");
                let found = format!("{heights:?}");
                return Err(PackError::value(file, &key, found, "lowest first"));
            }
            for level in &cloud.levels {
                within("levels.rgba", &level.rgba[..3], &COLOURS)?;
                within("levels.rgba", &level.rgba[3..], &SHARES)?;
            }
            within("groups_m", cloud.groups_m.as_flattened(), &PLACES_M)?;
            cloud
                .boxes
                .iter()
                .try_for_each(|b| box_within(&within, b))?;
            let sprites = &mut cloud.sprites.iter();
            sprites.try_for_each(|s| sprite_within(&within, s))?;
            verify_bounds(file, index, cloud)?;
        }
        Ok(())
    }

    /// Every cell is on the sheet, every box and group in its cloud.
    pub(crate) fn verify_indices(&self, file: &str) -> Result<(), PackError> {
        let below = |key: String, found: usize, count: usize| {
            if found < count {
                return Ok(());
            }
            let expected = format!("below {count}");
            Err(PackError::value(file, &key, found, expected))
        };
        for (i, cloud) in self.clouds.iter().enumerate() {
            let (groups, boxes) = (cloud.groups_m.len(), cloud.boxes.len());
            below(
                format!("count of clouds[{i}].groups_m"),
                groups,
                MAX_GROUPS + 1,
            )?;
            for (j, of_cloud) in cloud.boxes.iter().enumerate() {
                let key = format!("clouds[{i}].boxes[{j}].group");
                below(key, usize::from(of_cloud.group), groups)?;
            }
            for (j, sprite) in cloud.sprites.iter().enumerate() {
                let key = |name: &str| format!("clouds[{i}].sprites[{j}].{name}");
                let cells = usize::from(SheetCell::COUNT);
                below(key("cell"), usize::from(sprite.cell), cells)?;
                below(key("cloud_box"), usize::from(sprite.cloud_box), boxes)?;
            }
        }
        Ok(())
    }

    /// Ranks are 0..1 and never fall.
    pub(crate) fn verify_ranks(&self, file: &str) -> Result<(), PackError> {
        let mut least = 0.0;
        for (index, cloud) in self.clouds.iter().enumerate() {
            let key = format!("clouds[{index}].rank");
            within(file, &key, &[cloud.rank], &(least..=1.0))?;
            least = cloud.rank;
        }
        Ok(())
    }

    /// The hours are in the order of time, and their numbers in range.
    pub(crate) fn verify_hours(&self, file: &str) -> Result<(), PackError> {
        if !(1..=MAX_HOURS).contains(&self.hours.len()) {
            let expected = format!("1 to {MAX_HOURS}");
            return Err(PackError::value(
                file,
                "count of hours",
                self.hours.len(),
                expected,
            ));
        }
        for (index, hour) in self.hours.iter().enumerate() {
            let key = |name: &str| format!("hours[{index}].{name}");
            within(file, &key("time"), &[hour.time], &(0.0..=0.999_999))?;
            if index > 0 && hour.time <= self.hours[index - 1].time {
                let expected = format!("over {}", self.hours[index - 1].time);
                return Err(PackError::value(file, &key("time"), hour.time, expected));
            }
            within(file, &key("ambient"), &[hour.ambient], &SHARES)?;
            within(file, &key("colour"), &hour.colour, &COLOURS)?;
            within(file, &key("least"), &[hour.least], &SHARES)?;
            within(file, &key("most"), &[hour.most], &(hour.least..=1.0))?;
        }
        Ok(())
    }
}

type Within<'a> = dyn Fn(&str, &[f32], &RangeInclusive<f32>) -> Result<(), PackError> + 'a;

fn box_within(within: &Within, of_cloud: &CloudBox) -> Result<(), PackError> {
    within("boxes.centre_m", &of_cloud.centre_m, &PLACES_M)?;
    within("boxes.size_m", &of_cloud.size_m, &SIZES_M)?;
    within("boxes.cull_m", &[of_cloud.cull_m], &(0.0..=*SIZES_M.end()))
}

fn sprite_within(within: &Within, sprite: &Sprite) -> Result<(), PackError> {
    let turn = std::f32::consts::PI;
    within("sprites.centre_m", &sprite.centre_m, &PLACES_M)?;
    within("sprites.size_m", &sprite.size_m, &SIZES_M)?;
    within(
        "sprites.rotation_rad",
        &[sprite.rotation_rad],
        &(-turn..=turn),
    )
}

/// A cloud's own box is the one around its boxes.
fn verify_bounds(file: &str, index: usize, cloud: &Cloud) -> Result<(), PackError> {
    let found = (cloud.centre_m, cloud.size_m);
    let expected = bounds(&cloud.boxes);
    if found == expected {
        return Ok(());
    }
    let key = format!("clouds[{index}].centre_m, size_m");
    Err(PackError::value(
        file,
        &key,
        format!("{found:?}"),
        format!("{expected:?}"),
    ))
}

/// Not a number is within no range.
fn within(
    file: &str,
    key: &str,
    values: &[f32],
    range: &RangeInclusive<f32>,
) -> Result<(), PackError> {
    let outside = values.iter().find(|value| !range.contains(value));
    outside.map_or(Ok(()), |value| {
        let expected = format!("{} to {}", range.start(), range.end());
        Err(PackError::value(file, key, value, expected))
    })
}
