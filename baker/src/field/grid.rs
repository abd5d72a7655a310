//! The grid that everything stands on.

/// Steps a metre.
const STEPS_A_M: f32 = 8.0;

/// A length or a coordinate on the grid.
pub(super) fn snapped(metres: f32) -> f32 {
    libm::roundf(metres * STEPS_A_M) / STEPS_A_M
}
