//! Twin of dome.wgsl.

use glam::{Vec2, Vec3};
use welkin_runtime::internals::geometry::dome::CLOUD_SPHERE_RADIUS;

/// Where a ray meets the cloud dome: place on the plane, distance, and what gives the incidence.
pub struct DomeHit {
    /// East and south, in heights of the cloud layer.
    pub plane: Vec2,
    /// Distance in the same unit.
    pub distance: f32,
    /// Cosine of the angle between ray and normal.
    pub cos_incidence: f32,
}

/// The cloud dome along a unit direction.
pub fn intersect(direction: Vec3) -> DomeHit {
    let ry = CLOUD_SPHERE_RADIUS * direction.y;
    let root = libm::sqrtf(ry * ry + 2.0 * CLOUD_SPHERE_RADIUS + 1.0);
    let distance = root - ry;
    DomeHit {
        plane: Vec2::new(direction.x, direction.z) * distance,
        distance,
        cos_incidence: root / (CLOUD_SPHERE_RADIUS + 1.0),
    }
}
