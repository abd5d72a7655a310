//! Gradient noise that tiles: the kernel is the `noise` crate's (K. Perlin, "Improving Noise", SIGGRAPH 2002), this
//! file gives it lattices that repeat.
//!
//! Let two vectors of whole lattice points be the tile's sides. Giving points that differ by a sum of multiples
//! of them the same gradient makes the noise tile exactly, and the lattice stands at an angle to the tile. Octaves
//! with other angles let no direction of the lattice show: a rotation of the domain that still tiles. Sides of
//! different lengths stretch the noise.
//!
//! The kernel is read on the plane half way between two layers of a three-dimensional lattice: there, unlike
//! on a layer, the noise is not zero at lattice points, and twelve gradients instead of four hide its axes.

use noise::Vector3;
use noise::core::perlin::perlin_3d;
use noise::permutationtable::NoiseHasher;

use crate::stream::Stream;

/// Gradient noise on the unit torus: a lattice whose points repeat along the sides of the tile.
pub(crate) struct Lattice {
    /// The tile's sides along u and along v, in lattice points.
    sides: [[i64; 2]; 2],
    /// The lattice points that the tile reaches: first column and row, and columns.
    origin: [i64; 2],
    columns: i64,
    /// Gradient index of each, row by row, in the two layers that the slice lies between.
    gradients: Vec<[u8; 2]>,
}

impl Lattice {
    /// About `cells` cells along u and along v, turned by about `angle` radians: both are rounded to whole lattice
    /// points.
    pub(crate) fn new(cells: [f64; 2], angle: f64, stream: &mut Stream) -> Lattice {
        // A quarter turn is a symmetry of the lattice, so the angle can be taken in the first quadrant.
        let (sin, cos) = (libm::sin(angle).abs(), libm::cos(angle).abs());
        let [along, across] = cells.map(|n| {
            let a = (libm::round(n * cos) as i64).max(1);
            [a, libm::round(n * sin) as i64]
        });
        let ([a, b], [c, d]) = (along, [-across[1], across[0]]);
        // The tile's corners are 0, the two sides and their sum; one more point on every side.
        let (origin, columns, rows) = ([c - 1, -1], a - c + 4, b + d + 4);
        let mut lattice = Lattice {
            sides: [[a, b], [c, d]],
            origin,
            columns,
            gradients: vec![[0; 2]; (columns * rows) as usize],
        };
        lattice.draw(rows, stream);
        lattice
    }

    fn draw(&mut self, rows: i64, stream: &mut Stream) {
        let points = (0..rows).flat_map(|r| (0..self.columns).map(move |c| (c, r)));
        let points: Vec<[i64; 2]> = points
            .map(|(c, r)| [self.origin[0] + c, self.origin[1] + r])
            .collect();
        // Only a class's representative draws, so that the stream does not depend on the margin.
        for &point in &points {
            if self.representative(point) == point {
                let index = self.index(point);
                let bits = stream.bits();
                self.gradients[index] = [(bits >> 56) as u8, (bits >> 48) as u8];
            }
        }
        for &point in &points {
            let (from, to) = (self.index(self.representative(point)), self.index(point));
            self.gradients[to] = self.gradients[from];
        }
    }

    /// The one point in the tile that differs from `point` by whole sides.
    fn representative(&self, [x, y]: [i64; 2]) -> [i64; 2] {
        let [[a, b], [c, d]] = self.sides;
        let area = a * d - b * c;
        let s = (x * d - y * c).div_euclid(area);
        let t = (y * a - x * b).div_euclid(area);
        [x - s * a - t * c, y - s * b - t * d]
    }

    fn index(&self, [x, y]: [i64; 2]) -> usize {
        ((y - self.origin[1]) * self.columns + x - self.origin[0]) as usize
    }

    /// Noise in -1..1 at a point of the plane, with period 1 along u and v.
    pub(crate) fn noise(&self, point: [f64; 2]) -> f64 {
        self.noise_in_tile(point.map(|p| p - libm::floor(p)))
    }

    /// The same where both are in 0..=1.
    fn noise_in_tile(&self, [u, v]: [f64; 2]) -> f64 {
        let [[a, b], [c, d]] = self.sides.map(|side| side.map(|n| n as f64));
        perlin_3d(Vector3::new(u * a + v * c, u * b + v * d, 0.5), self)
    }
}

impl NoiseHasher for Lattice {
    fn hash(&self, point: &[isize]) -> usize {
        usize::from(
            self.gradients[self.index([point[0] as i64, point[1] as i64])][(point[2] & 1) as usize],
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeSet;

    fn lattices() -> Vec<Lattice> {
        let mut stream = Stream::new(1, "test");
        let even = [(1.0, 0.0), (4.0, 0.7), (8.0, 3.1), (13.0, 5.5)];
        let long = [([1.0, 9.0], 0.0), ([2.0, 12.0], 0.7), ([7.0, 3.0], 2.4)];
        let even = even.map(|(c, a)| Lattice::new([c, c], a, &mut stream));
        let long = long.map(|(c, a)| Lattice::new(c, a, &mut stream));
        even.into_iter().chain(long).collect()
    }

    #[test]
    fn points_a_side_apart_are_one() {
        for lattice in lattices() {
            let [[a, b], [c, d]] = lattice.sides;
            let mut classes = BTreeSet::new();
            for (x, y) in (-20..20).flat_map(|x| (-20..20).map(move |y| (x, y))) {
                let here = lattice.representative([x, y]);
                assert_eq!(here, lattice.representative([x + a, y + b]));
                assert_eq!(here, lattice.representative([x + c, y + d]));
                assert_eq!(here, lattice.representative(here));
                classes.insert(here);
            }
            // The tile's area counts the classes; 40 points a side reach all.
            assert_eq!(classes.len() as i64, a * d - b * c);
        }
    }

    #[test]
    fn opposite_sides_are_equal() {
        for lattice in lattices() {
            for i in 0..50 {
                let t = f64::from(i) / 50.0;
                // Lattice coordinates of a few cells carry errors of 1e-15; the slope is below 10 a cell.
                let difference =
                    |p: [f64; 2], q| (lattice.noise_in_tile(p) - lattice.noise_in_tile(q)).abs();
                assert!(difference([0.0, t], [1.0, t]) < 1e-12);
                assert!(difference([t, 0.0], [t, 1.0]) < 1e-12);
                let away = lattice.noise([t - 2.0, 3.0 + t]);
                assert!((away - lattice.noise_in_tile([t, t])).abs() < 1e-12);
            }
        }
    }
}
