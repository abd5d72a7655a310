//! The galaxy map.

use super::report::Report;
use super::rule::{GALAXY_BAND, GALAXY_BRIGHTNESS};
use crate::mapping::galaxy_uv_to_direction;
use crate::role::Role;
use crate::texture::Texture;
use crate::view::View;

/// The largest share of the light's second moment across a band: half way between none and the third of an even sky.
const MOST_ACROSS: f64 = 1.0 / 6.0;

/// Looks at the texels above the horizon: the brightest must be seen, the mean must leave dark sky.
pub(super) fn check(report: &mut Report, texture: &Texture) {
    let image = texture.view(0, 0);
    let (mut brightest, mut sum, mut count) = (0.0_f32, 0.0_f64, 0.0_f64);
    for y in 0..image.height {
        for x in 0..image.width {
            let uv = [
                (x as f32 + 0.5) / image.width as f32,
                (y as f32 + 0.5) / image.height as f32,
            ];
            if galaxy_uv_to_direction(uv)[1] > 0.0 {
                let value = image.texel(x, y)[0];
                brightest = brightest.max(value);
                sum += f64::from(value);
                count += 1.0;
            }
        }
    }
    let name = Role::Galaxy.name();
    report.at_least(GALAXY_BRIGHTNESS, &format!("{name} peak"), brightest, 0.25);
    report.at_most(GALAXY_BRIGHTNESS, &format!("{name} mean"), sum / count, 0.5);
    report.at_most(GALAXY_BAND, name, across(image), MOST_ACROSS);
}

/// The smallest eigenvalue of the mean of `d d^T` over directions `d`, weighted by brightness: the mean square of the sine of
/// the distance from the great circle that fits best, and a third where light is even or scattered.
fn across(image: View) -> f64 {
    let (mut moment, mut light) = ([[0.0_f64; 3]; 3], 0.0_f64);
    for (x, y) in (0..image.height).flat_map(|y| (0..image.width).map(move |x| (x, y))) {
        let [u, v] = [x, y].map(|i| (i as f32 + 0.5) / image.width as f32);
        let [du, dv] = [u - 0.5, v - 0.5];
        // Texels beyond the nadir are in no direction.
        if du * du + dv * dv > 0.49 {
            continue;
        }
        let weight = f64::from(image.texel(x, y)[0]);
        let direction = galaxy_uv_to_direction([u, v]).map(f64::from);
        light += weight;
        for (row, a) in moment.iter_mut().zip(direction) {
            for (sum, b) in row.iter_mut().zip(direction) {
                *sum += weight * a * b;
            }
        }
    }
    if light == 0.0 {
        return 1.0 / 3.0;
    }
    smallest_eigenvalue(moment.map(|row| row.map(|sum| sum / light)))
}

/// Of a symmetric matrix, by the trigonometric solution of its characteristic equation (O. K. Smith, "Eigenvalues of a symmetric 3 x
/// 3 matrix", Communications of the ACM 4, 1961).
fn smallest_eigenvalue(m: [[f64; 3]; 3]) -> f64 {
    let mean = (m[0][0] + m[1][1] + m[2][2]) / 3.0;
    let off = m[0][1] * m[0][1] + m[0][2] * m[0][2] + m[1][2] * m[1][2];
    let on: f64 = (0..3).map(|i| (m[i][i] - mean) * (m[i][i] - mean)).sum();
    let p = libm::sqrt((on + 2.0 * off) / 6.0);
    if p == 0.0 {
        return mean;
    }
    let b: [[f64; 3]; 3] = std::array::from_fn(|i| {
        std::array::from_fn(|j| (m[i][j] - if i == j { mean } else { 0.0 }) / p)
    });
    let determinant = b[0][0] * (b[1][1] * b[2][2] - b[1][2] * b[2][1])
        - b[0][1] * (b[1][0] * b[2][2] - b[1][2] * b[2][0])
        + b[0][2] * (b[1][0] * b[2][1] - b[1][1] * b[2][0]);
    let angle = libm::acos((determinant / 2.0).clamp(-1.0, 1.0)) / 3.0;
    mean + 2.0 * p * libm::cos(angle + std::f64::consts::TAU / 3.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_smallest_eigenvalue_is_that_of_the_matrix() {
        assert!(
            (smallest_eigenvalue([[2.0, 0.0, 0.0], [0.0, 7.0, 0.0], [0.0, 0.0, 5.0]]) - 2.0).abs()
                < 1e-12
        );
        // Eigenvalues 1, 3 and 10.
        let turned = [[2.0, 1.0, 0.0], [1.0, 2.0, 0.0], [0.0, 0.0, 10.0]];
        assert!((smallest_eigenvalue(turned) - 1.0).abs() < 1e-12);
        assert_eq!(
            smallest_eigenvalue([[0.5, 0.0, 0.0], [0.0, 0.5, 0.0], [0.0, 0.0, 0.5]]),
            0.5
        );
    }
}
