//! Rotations as they are in the file.

use crate::field::{ROTATION_STEPS, rotation_step, rounded_rotation};

/// A rotation as a unit quaternion (x, y, z, w) in steps of a signed 16-bit unorm.
///
/// A facing sprite is turned about +Z. A flat one is first laid down, so that it faces +Y and its height points to
/// -Z, and then turned about +Y.
pub(super) fn quaternion(rotation_rad: f32, flat: bool) -> [i16; 4] {
    let half =
        f64::from(rotation_step(rotation_rad)) * std::f64::consts::PI / f64::from(ROTATION_STEPS);
    let (sin, cos) = (libm::sin(half), libm::cos(half));
    let lay = std::f64::consts::FRAC_1_SQRT_2;
    let parts = if flat {
        [-lay * cos, lay * sin, lay * sin, lay * cos]
    } else {
        [0.0, 0.0, sin, cos]
    };
    parts.map(|part| libm::round(part * f64::from(i16::MAX)) as i16)
}

/// The inverse of [`quaternion`]; nothing if it is not one of those.
pub(super) fn rotation(quaternion_steps: [i16; 4], flat: bool) -> Option<f32> {
    let [_, y, z, w] = quaternion_steps.map(f32::from);
    let rotation = rounded_rotation(2.0 * libm::atan2f(if flat { y } else { z }, w));
    (quaternion(rotation, flat) == quaternion_steps).then_some(rotation)
}
