//! The irradiance of a sky as nine spherical harmonics.
//!
//! # Theory
//! See [`welkin_runtime::internals::geometry::harmonics`].
//!
//! # Practice
//! The coefficients are `A_l L_lm`: irradiance, and not radiance. Basis functions are real and orthonormal, without the phase of Condon and
//! Shortley, in the order of [`BASIS`], of a direction in the axes of the world: x east, y up, z south. With nine terms the
//! irradiance of a sun alone is off by -4 % (at 58 degrees from it) to 9 % (at 90 degrees) of what it has towards the sun, and below 0 about 122 degrees from it, where 0 is taken.

use rayon::prelude::*;
pub use welkin_runtime::internals::geometry::harmonics::{CLAMPED_COSINE, COUNT, basis};

use super::cube::{texel_direction, texel_solid_angle};
use super::cubemap::Cubemap;

/// The basis functions as a reader computes them, of a unit vector (x, y, z).
pub const BASIS: [&str; COUNT] = [
    "0.282095",
    "0.488603 * y",
    "0.488603 * z",
    "0.488603 * x",
    "1.092548 * x * y",
    "1.092548 * y * z",
    "0.315392 * (3 * z * z - 1)",
    "1.092548 * x * z",
    "0.546274 * (x * x - y * y)",
];

/// Irradiance by direction, red, green and blue of each basis function.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Harmonics {
    /// `A_l L_lm`, in the unit of radiance times steradian.
    pub coefficients: [[f64; 3]; COUNT],
}

impl Harmonics {
    /// Those of a cube map, each texel with its solid angle.
    pub fn of(map: &Cubemap) -> Harmonics {
        let rows: Vec<(usize, u32)> = (0..map.faces.len())
            .flat_map(|face| (0..map.side).map(move |y| (face, y)))
            .collect();
        // Sums of rows, then their sum in order: the same for any number of threads.
        let rows: Vec<Harmonics> = rows
            .par_iter()
            .map(|&(face, y)| Harmonics::of_row(map, face, y))
            .collect();
        let mut all = Harmonics::default();
        for row in &rows {
            for (sum, part) in all.coefficients.iter_mut().zip(&row.coefficients) {
                (0..3).for_each(|i| sum[i] += part[i]);
            }
        }
        for (coefficient, factor) in all.coefficients.iter_mut().zip(CLAMPED_COSINE) {
            coefficient.iter_mut().for_each(|c| *c *= factor);
        }
        all
    }

    fn of_row(map: &Cubemap, face: usize, y: u32) -> Harmonics {
        let mut row = Harmonics::default();
        for x in 0..map.side {
            let direction = texel_direction(face, [x, y], map.side);
            let solid_angle = texel_solid_angle([x, y], map.side);
            let radiance = map.faces[face].texel(x, y);
            let terms = basis(direction.as_dvec3().normalize().to_array());
            for (sum, term) in row.coefficients.iter_mut().zip(terms) {
                for (sum, radiance) in sum.iter_mut().zip(radiance) {
                    *sum += term * solid_angle * f64::from(*radiance);
                }
            }
        }
        row
    }

    /// The irradiance of a plane that faces a unit direction: 0 or more.
    pub fn irradiance(&self, normal: [f64; 3]) -> [f64; 3] {
        let terms = basis(normal);
        let sum = |i: usize| -> f64 {
            let coefficients = self.coefficients.iter().zip(terms);
            coefficients.map(|(c, term)| c[i] * term).sum()
        };
        [0, 1, 2].map(|i| sum(i).max(0.0))
    }
}

#[cfg(test)]
mod tests;
