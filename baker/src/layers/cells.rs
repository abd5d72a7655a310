//! Points spread over the tile, one a cell, and round lumps about them.
//!
//! S. Worley, "A Cellular Texture Basis Function", SIGGRAPH 1996: a function of the distance to the nearest of
//! random points. Its negative square is a field of round lumps with creases where two of them meet, as the
//! sprouting parts of a cloud have them.

use crate::fractal::Octaves;
use crate::stream::Stream;

/// Lumps smaller than this many texels are left out: they would not be smooth at the texel.
const FINEST_LUMP_TEXELS: u32 = 5;

/// How much of its cell the middle of a lump may lie in. With all of it some lumps would nearly coincide.
const JITTER: f64 = 0.9;

/// How much lower than the highest lumps the lowest are, as a square of a distance in cells.
const LOWER: f64 = 0.3;

/// One point in each of `count * count` cells of the unit torus, each with a random number.
pub(super) struct Cells {
    count: i64,
    /// Place in its cell, 0..1 in both directions, and the number, 0..1; row by row.
    points: Vec<[f64; 3]>,
}

/// A point as seen from a place.
pub(super) struct Neighbour {
    /// Square of the distance to it, in cells.
    pub square: f64,
    /// Its number, 0..1.
    pub number: f64,
}

impl Cells {
    /// `jitter` is how much of its cell a point may lie in, about the middle of the cell.
    pub(super) fn new(count: u32, jitter: f64, stream: &mut Stream) -> Cells {
        let mut point = || {
            let [x, y] = [(); 2].map(|()| 0.5 + jitter * (stream.unit() - 0.5));
            [x, y, stream.unit()]
        };
        Cells {
            count: i64::from(count),
            points: (0..count * count).map(|_| point()).collect(),
        }
    }

    /// The points of the `2 reach + 1` cells a side about a place in the plane: all that are nearer than `reach`
    /// cells are among them.
    pub(super) fn around(
        &self,
        place: [f64; 2],
        reach: i64,
    ) -> impl Iterator<Item = Neighbour> + '_ {
        let [u, v] = place.map(|p| (p - libm::floor(p)) * self.count as f64);
        let [column, row] = [u, v].map(|p| p as i64);
        let cells = (row - reach..=row + reach)
            .flat_map(move |j| (column - reach..=column + reach).map(move |i| (i, j)));
        cells.map(move |(i, j)| {
            let index = j.rem_euclid(self.count) * self.count + i.rem_euclid(self.count);
            let [x, y, number] = self.points[index as usize];
            let (x, y) = (i as f64 + x - u, j as f64 + y - v);
            Neighbour {
                square: x * x + y * y,
                number,
            }
        })
    }
}

/// Octaves of lumps, each half as large as the ones before.
pub(super) struct Lumps {
    octaves: Vec<Cells>,
    gain: f64,
}

impl Lumps {
    /// `count` is how many of the first octave lie side by side, `size` the texels a side.
    pub(super) fn new(count: u32, octaves: Octaves, size: u32, stream: &mut Stream) -> Lumps {
        let counts = (0..octaves.count)
            .map(|k| count << k)
            .filter(|&n| n <= size / FINEST_LUMP_TEXELS);
        Lumps {
            octaves: counts.map(|n| Cells::new(n, JITTER, stream)).collect(),
            gain: octaves.gain,
        }
    }

    /// The sum over the octaves at a point of the plane: 0 on the highest lumps, below it elsewhere.
    pub(super) fn at(&self, point: [f64; 2]) -> f64 {
        let mut amplitude = 1.0;
        let mut sum = 0.0;
        for cells in &self.octaves {
            // Points that `around` misses have a square of 1 at least, so a bound of 1 keeps the sum continuous.
            let lowest = cells
                .around(point, 1)
                .map(|n| n.square + LOWER * n.number)
                .fold(1.0, f64::min);
            sum -= amplitude * lowest;
            amplitude *= self.gain;
        }
        sum
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_point_within_reach_is_missed() {
        let cells = Cells::new(5, 1.0, &mut Stream::new(1, "test"));
        let mut stream = Stream::new(2, "test");
        for _ in 0..200 {
            let place = [(); 2].map(|()| 3.0 * stream.unit() - 1.0);
            for reach in [1, 2] {
                let near = |reach: i64, within: f64| {
                    let around = cells.around(place, reach);
                    around.filter(|n| n.square < within * within).count()
                };
                assert_eq!(near(reach, reach as f64), near(4, reach as f64));
            }
        }
    }

    #[test]
    fn lumps_tile_and_have_no_step() {
        let octaves = Octaves {
            count: 3,
            gain: 0.5,
        };
        let lumps = Lumps::new(4, octaves, 256, &mut Stream::new(3, "test"));
        // The steepest slope is that of the square at distance 1, 2 a cell, and finer octaves add as much again
        // and again: their cells are half as large, their amplitude is too.
        let steepest = 3.0 * 2.0 * 4.0;
        let step = 1e-4;
        for i in 0..10_000 {
            let point = [f64::from(i) * 1e-4, f64::from(i * 37 % 10_000) * 1e-4];
            let here = lumps.at(point);
            assert!((here - lumps.at([point[0] + 1.0, point[1] - 2.0])).abs() < 1e-9);
            for beside in [[step, 0.0], [0.0, step]] {
                let there = lumps.at([point[0] + beside[0], point[1] + beside[1]]);
                assert!((here - there).abs() <= steepest * step * 1.001, "{point:?}");
            }
        }
    }
}
