//! Light from five sides through a small cloud.
//!
//! # Theory
//! Pictures of one cloud lit from the right, left, top, bottom, front and back can be mixed to one that is lit from anywhere. Here light is dimmed
//! along all of these directions but the last through a grid of the cloud's extinction: what shines from behind follows opacity.
//!
//! # Practice
//! The grid is asked [`SIDE`]^3 times for its extinction, and summed up five times.

use rayon::prelude::*;

/// Cells a side of the grid.
const SIDE: usize = 40;

/// A number for the right, left, top, bottom and front.
pub(super) type BySide = [f32; 5];

/// Of each of them, its axis and whether it comes from the axis's end.
const DIRECTIONS: [(usize, bool); 5] = [(0, true), (0, false), (1, true), (1, false), (2, true)];

pub(super) struct Lights {
    /// Half of the side of the grid.
    reach: f32,
    /// Cell by cell along x, y and z.
    cells: Vec<BySide>,
}

impl Lights {
    /// Of a cloud that reaches so far from the middle, by its extinction.
    pub(super) fn new(reach: f32, extinction: impl Fn([f32; 3]) -> f32 + Sync) -> Lights {
        let middle = |i: usize| ((i as f32 + 0.5) / SIDE as f32 * 2.0 - 1.0) * reach;
        let index = |[x, y, z]: [usize; 3]| (z * SIDE + y) * SIDE + x;
        let mut extinctions = vec![0.0; SIDE * SIDE * SIDE];
        let sheets = extinctions.par_chunks_mut(SIDE * SIDE).enumerate();
        sheets.for_each(|(z, sheet)| {
            for (i, cell) in sheet.iter_mut().enumerate() {
                *cell = extinction([middle(i % SIDE), middle(i / SIDE), middle(z)]);
            }
        });
        let step = 2.0 * reach / SIDE as f32;
        let mut cells = vec![BySide::default(); extinctions.len()];
        for (direction, (axis, from_end)) in DIRECTIONS.into_iter().enumerate() {
            for (a, b) in (0..SIDE).flat_map(|a| (0..SIDE).map(move |b| (a, b))) {
                let mut depth = 0.0;
                for i in 0..SIDE {
                    let along = if from_end { SIDE - 1 - i } else { i };
                    let cell = match axis {
                        0 => [along, a, b],
                        1 => [a, along, b],
                        _ => [a, b, along],
                    };
                    let own = step * extinctions[index(cell)];
                    cells[index(cell)][direction] = depth + 0.5 * own;
                    depth += own;
                }
            }
        }
        Lights { reach, cells }
    }

    /// Optical depths on the way to a place.
    pub(super) fn depths(&self, place: [f32; 3]) -> BySide {
        let there = place.map(|c| {
            let cell = (0.5 + 0.5 * c / self.reach) * SIDE as f32 - 0.5;
            cell.clamp(0.0, (SIDE - 1) as f32)
        });
        let from = there.map(|c| (c as usize).min(SIDE - 2));
        let part: [f32; 3] = std::array::from_fn(|a| there[a] - from[a] as f32);
        let mut depths = BySide::default();
        for corner in 0..8_usize {
            let bits = [corner & 1, corner >> 1 & 1, corner >> 2];
            let weights: [f32; 3] =
                std::array::from_fn(|a| if bits[a] == 1 { part[a] } else { 1.0 - part[a] });
            let weight = weights[0] * weights[1] * weights[2];
            let [x, y, z] = [0, 1, 2].map(|a| from[a] + bits[a]);
            let cell = &self.cells[(z * SIDE + y) * SIDE + x];
            for (sum, depth) in depths.iter_mut().zip(cell) {
                *sum += weight * depth;
            }
        }
        depths
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const REACH: f32 = 0.84;

    #[test]
    fn depth_grows_by_the_extinction_along_each_axis() {
        for axis in 0..3 {
            let lights = Lights::new(REACH, |place| if place[axis] > 0.0 { 3.0 } else { 0.0 });
            let mut place = [0.1, -0.2, 0.3];
            place[axis] = 0.5 * REACH;
            let found = lights.depths(place);
            // Half of the filled half is before it, whichever side the light comes from; across, all is filled.
            let before = 3.0 * 0.5 * REACH;
            let along = || (0..5).filter(|direction| DIRECTIONS[*direction].0 == axis);
            for direction in along() {
                assert!((found[direction] - before).abs() < 0.05, "{axis} {found:?}");
            }
            place[axis] = -0.5 * REACH;
            let found = lights.depths(place);
            for direction in along() {
                let all = if DIRECTIONS[direction].1 {
                    2.0 * before
                } else {
                    0.0
                };
                assert!((found[direction] - all).abs() < 0.05, "{found:?}");
            }
        }
    }
}
