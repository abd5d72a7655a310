//! Vectors from uniforms.

use glam::Vec3;

/// The first three of four numbers.
pub fn xyz(four: [f32; 4]) -> Vec3 {
    Vec3::new(four[0], four[1], four[2])
}
