//! Levels of the role `layers`: normals stay unit vectors.

use super::fold::{fold, mean};
use crate::image::Image;
use crate::texel::LayerTexel;

/// Averages normals as vectors in space and makes them unit vectors again; averages density and rank.
pub(super) fn halve(image: &Image) -> Image {
    fold(image, |texels, out| {
        mean(texels, out);
        let sum = texels.iter().fold([0.0_f32; 3], |sum, texel| {
            let texel = LayerTexel {
                normal_xy: [texel[0], texel[1]].map(|stored| 2.0 * stored - 1.0),
                ..LayerTexel::default()
            };
            let normal = texel.normal();
            [0, 1, 2].map(|i| sum[i] + normal[i])
        });
        let length = libm::sqrtf(sum.iter().map(|v| v * v).sum());
        for (value, component) in out.iter_mut().zip(&sum[..2]) {
            // Vectors that cancel, which no surface seen from above has, become an upright one.
            *value = 0.5
                + 0.5
                    * if length > 0.0 {
                        component / length
                    } else {
                        0.0
                    };
        }
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn halved(normals: [[f32; 2]; 4]) -> Vec<f32> {
        let mut image = Image::new(2, 2, 4);
        for (texel, [x, y]) in image.texels.chunks_exact_mut(4).zip(normals) {
            texel.copy_from_slice(&[0.5 + 0.5 * x, 0.5 + 0.5 * y, x.abs(), y.abs()]);
        }
        halve(&image).texels
    }

    fn assert_close(found: &[f32], expected: [f32; 4]) {
        for (a, b) in found.iter().zip(expected) {
            assert!((a - b).abs() < 1e-6, "{found:?} {expected:?}");
        }
    }

    #[test]
    fn normals_stay_unit_vectors_and_amounts_are_averaged() {
        // Alike: nothing changes.
        assert_close(&halved([[0.6, 0.0]; 4]), [0.8, 0.5, 0.6, 0.0]);
        // (0.6, 0, 0.8) and (0, 0, 1) add up to (1.2, 0, 3.6), of length sqrt(14.4).
        let x = 1.2 / libm::sqrtf(14.4);
        let two = [[0.6, 0.0], [0.6, 0.0], [0.0, 0.0], [0.0, 0.0]];
        assert_close(&halved(two), [0.5 + 0.5 * x, 0.5, 0.3, 0.0]);
        // Opposite slopes make a flat place, not a short vector.
        let ridge = [[0.9, 0.0], [-0.9, 0.0], [0.9, 0.0], [-0.9, 0.0]];
        assert_close(&halved(ridge), [0.5, 0.5, 0.9, 0.0]);
    }

    #[test]
    fn vectors_that_cannot_be_are_no_reason_to_fail() {
        let flat = [[1.0, 0.0], [-1.0, 0.0], [0.0, 1.0], [0.0, -1.0]];
        assert_close(&halved(flat), [0.5, 0.5, 0.5, 0.5]);
        assert!(halved([[1.0, 1.0]; 4]).iter().all(|v| v.is_finite()));
    }
}
