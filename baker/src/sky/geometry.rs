//! Rays in the shell between the ground and the top of the atmosphere. Lengths are kilometres.

use crate::filter::smoothstep;

/// Radius of the ground, and of the top of the atmosphere (S. Hillaire 2020, section 4).
pub(super) const GROUND_KM: f32 = 6360.0;
pub(super) const TOP_KM: f32 = 6460.0;

/// Half the sun's angular diameter, in radians: 16 minutes of arc. It softens the edge of the Earth's shadow.
const SUN_RADIUS_RAD: f32 = 0.004_65;

/// Altitude, and sine of the sun's elevation, at a distance along a ray that starts at `radius`. The ray
/// and the sun are given by their parts along the ray's horizontal direction and upwards.
pub(super) fn along(radius: f32, ray: [f32; 2], distance: f32, sun: [f32; 2]) -> (f32, f32) {
    let (x, y) = (ray[0] * distance, radius + ray[1] * distance);
    let here = libm::sqrtf(x * x + y * y);
    (here - GROUND_KM, (x * sun[0] + y * sun[1]) / here)
}

pub(super) fn cosine(sine: f32) -> f32 {
    libm::sqrtf((1.0 - sine * sine).max(0.0))
}

/// Sine of the elevation of the horizon, at or below 0.
pub(super) fn horizon_sin(radius: f32) -> f32 {
    let ratio = (GROUND_KM / radius).min(1.0);
    -libm::sqrtf(1.0 - ratio * ratio)
}

/// Share of the sun's disc above the horizon, smoothed over its diameter.
pub(super) fn sun_above_horizon(radius: f32, sun_sin: f32) -> f32 {
    let edge = horizon_sin(radius);
    smoothstep(edge - SUN_RADIUS_RAD, edge + SUN_RADIUS_RAD, sun_sin)
}

pub(super) fn distance_to_top(radius: f32, sine: f32) -> f32 {
    let b = radius * sine;
    -b + libm::sqrtf((b * b + (TOP_KM - radius) * (TOP_KM + radius)).max(0.0))
}

pub(super) fn distance_to_ground(radius: f32, sine: f32) -> Option<f32> {
    let b = radius * sine;
    let root = b * b - (radius - GROUND_KM) * (radius + GROUND_KM);
    (sine < 0.0 && root >= 0.0).then(|| -b - libm::sqrtf(root))
}
