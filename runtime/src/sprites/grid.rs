//! The blocks of the field around the viewer.
//!
//! Blocks are squares of [`SECTION_SIDE_M`] that go on for ever; each shows a section of the field. Blocks in sight
//! have a slot of a buffer each: those with the same remainder of their numbers share one, and are never in sight together.

use glam::{DVec2, DVec3};
use welkin_pack::field::SECTION_SIDE_M;

const SIDE_M: f64 = SECTION_SIDE_M as f64;

/// A block, by how many others lie between it and the origin of the field.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct BlockId {
    /// To the east.
    pub east: i64,
    /// To the south.
    pub south: i64,
}

impl BlockId {
    /// The block of a place in the field, in metres.
    pub fn of(place_m: DVec3) -> BlockId {
        BlockId {
            east: (place_m.x / SIDE_M).floor() as i64,
            south: (place_m.z / SIDE_M).floor() as i64,
        }
    }

    /// Its north-west corner, in metres: east and south.
    pub fn corner_m(self) -> DVec2 {
        DVec2::new(self.east as f64, self.south as f64) * SIDE_M
    }

    /// Horizontal distance from its middle to a place, in metres.
    pub fn distance_of_middle_m(self, place_m: DVec3) -> f64 {
        let middle = self.corner_m() + DVec2::splat(0.5 * SIDE_M);
        middle.distance(DVec2::new(place_m.x, place_m.z))
    }

    /// Horizontal distance from its nearest point to a place, in metres: 0 from inside.
    pub fn distance_m(self, place_m: DVec3) -> f64 {
        let from = DVec2::new(place_m.x, place_m.z) - self.corner_m();
        from.distance(from.clamp(DVec2::ZERO, DVec2::splat(SIDE_M)))
    }

    /// Which of `a_side` times `a_side` things that repeat it shows: row by row from the north.
    pub fn index(self, a_side: usize) -> usize {
        let wrapped = |number: i64| number.rem_euclid(a_side as i64) as usize;
        wrapped(self.south) * a_side + wrapped(self.east)
    }
}

/// Slots along a side that blocks within that distance need.
pub fn slots_a_side(distance_m: f32) -> usize {
    2 * (f64::from(distance_m) / SIDE_M).ceil() as usize + 1
}

/// The blocks that come within a distance of a place, row by row.
pub fn around(place_m: DVec3, distance_m: f64) -> impl Iterator<Item = BlockId> {
    let reach = DVec3::new(distance_m, 0.0, distance_m);
    let (first, last) = (BlockId::of(place_m - reach), BlockId::of(place_m + reach));
    let rows = first.south..=last.south;
    let blocks = rows
        .flat_map(move |south| (first.east..=last.east).map(move |east| BlockId { east, south }));
    blocks.filter(move |block| block.distance_m(place_m) <= distance_m)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_block_is_found_by_its_places() {
        let place = DVec3::new(-10.0, 900.0, 4001.0);
        let block = BlockId::of(place);
        assert_eq!(block, BlockId { east: -1, south: 1 });
        assert_eq!(block.distance_m(place), 0.0);
        assert_eq!(block.corner_m(), DVec2::new(-4000.0, 4000.0));
        // Two blocks a side: -1 is 1 again.
        assert_eq!(block.index(2), 3);
        assert_eq!(block.distance_m(DVec3::new(300.0, 0.0, 3600.0)), 500.0);
    }

    #[test]
    fn blocks_in_sight_have_slots_of_their_own() {
        for (distance, place) in [
            (8000.0, DVec3::new(1.0, 0.0, 3999.0)),
            (30_000.0, DVec3::new(123_456.0, 0.0, -98_765.4)),
            (12_345.6, DVec3::ZERO),
        ] {
            let side = slots_a_side(distance);
            let mut slots: Vec<_> = around(place, f64::from(distance))
                .map(|block| block.index(side))
                .collect();
            let count = slots.len();
            slots.sort_unstable();
            slots.dedup();
            assert_eq!(slots.len(), count, "{distance} {place}");
            // As many as a disc holds, more or less a ring of blocks.
            let disc = std::f64::consts::PI * f64::from(distance).powi(2) / (SIDE_M * SIDE_M);
            assert!(
                count as f64 > disc
                    && (count as f64) < disc + 8.0 * f64::from(distance) / SIDE_M + 8.0
            );
        }
    }
}
