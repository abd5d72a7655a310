//! Light from all around as nine spherical harmonics.
//!
//! # Theory
//! R. Ramamoorthi, P. Hanrahan, "An Efficient Representation for Irradiance Environment Maps", SIGGRAPH 2001. Irradiance is radiance
//! convolved with a clamped cosine, which keeps little above degree 2: `E(n) = sum A_l L_lm Y_lm(n)`, with `L_lm` the integral of radiance
//! times `Y_lm` (equation 10 there is the same with the constants of `Y` multiplied in) and `A_l` of equation 8: π, 2π/3, π/4.
//!
//! # Practice
//! Basis functions are real and orthonormal, without the phase of Condon and Shortley, of a direction in the axes of the world: x east, y up,
//! z south.

use std::f64::consts::PI;

/// How many there are: degrees 0, 1 and 2.
pub const COUNT: usize = 9;

/// The clamped cosine, of each basis function's degree (equation 8).
pub const CLAMPED_COSINE: [f64; COUNT] = [
    PI,
    2.0 * PI / 3.0,
    2.0 * PI / 3.0,
    2.0 * PI / 3.0,
    PI / 4.0,
    PI / 4.0,
    PI / 4.0,
    PI / 4.0,
    PI / 4.0,
];

/// sqrt(1 / 4π), sqrt(3 / 4π), sqrt(15 / 4π), sqrt(5 / 16π), sqrt(15 / 16π).
const FLAT: f64 = 0.282_094_791_773_878_14;
const FIRST: f64 = 0.488_602_511_902_919_9;
const PRODUCT: f64 = 1.092_548_430_592_079_2;
const ZONAL: f64 = 0.315_391_565_252_520_05;
const DIFFERENCE: f64 = 0.546_274_215_296_039_6;

/// What a basis function's polynomial is multiplied by.
pub const FACTORS: [f64; COUNT] = [
    FLAT, FIRST, FIRST, FIRST, PRODUCT, PRODUCT, ZONAL, PRODUCT, DIFFERENCE,
];

/// The basis functions of a unit direction: equation 3.
pub fn basis([x, y, z]: [f64; 3]) -> [f64; COUNT] {
    let polynomials = [
        1.0,
        y,
        z,
        x,
        x * y,
        y * z,
        3.0 * z * z - 1.0,
        x * z,
        x * x - y * y,
    ];
    let mut terms = FACTORS;
    for (term, polynomial) in terms.iter_mut().zip(polynomials) {
        *term *= polynomial;
    }
    terms
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_basis_is_orthonormal() {
        // Rings of equal height, sectors of equal angle: exact for products of degree 4 but for the rings' steps.
        const RINGS: u32 = 400;
        let mut products = [[0.0; COUNT]; COUNT];
        for (ring, sector) in (0..RINGS).flat_map(|ring| (0..16).map(move |sector| (ring, sector)))
        {
            let y = 2.0 * (f64::from(ring) + 0.5) / f64::from(RINGS) - 1.0;
            let (sin, cos) = (2.0 * PI * f64::from(sector) / 16.0).sin_cos();
            let flat = (1.0 - y * y).sqrt();
            let terms = basis([flat * cos, y, flat * sin]);
            for (i, row) in products.iter_mut().enumerate() {
                for (product, term) in row.iter_mut().zip(terms) {
                    *product += terms[i] * term * 4.0 * PI / f64::from(16 * RINGS);
                }
            }
        }
        for (i, row) in products.iter().enumerate() {
            for (j, product) in row.iter().enumerate() {
                let expected = if i == j { 1.0 } else { 0.0 };
                assert!((product - expected).abs() < 1e-4, "{i} {j}: {product}");
            }
        }
    }
}
