//! Twin of ring.wgsl.

use glam::{Vec2, Vec3};
use welkin_runtime::internals::sprites::station::HALF_SIDE;
use welkin_runtime::internals::sprites::station::{RingSet, RingUniforms};

/// Where a ray from the viewer leaves a ring's octagon: its side, and u and v on that side's picture. v is outside of 0..1 above
/// and below.
pub fn hit(ring: &RingUniforms, octagon: &RingSet, ray: Vec3) -> (usize, Vec2) {
    let azimuth = libm::atan2f(ray.x, -ray.z);
    let side = libm::roundf(azimuth / std::f32::consts::FRAC_PI_4).rem_euclid(8.0) as usize % 8;
    let (mut side, mut along) = (side, reach(ring, octagon, ray, side));
    if along.0.abs() > HALF_SIDE {
        side = (side + if along.0 > 0.0 { 1 } else { 7 }) % 8;
        along = reach(ring, octagon, ray, side);
    }
    let (along, up) = along;
    let u = 0.5 + along * octagon.per_width;
    (side, Vec2::new(u, (octagon.top - up) * octagon.per_height))
}

/// Where a ray meets a side: how far along it and how high, over the radius.
fn reach(ring: &RingUniforms, octagon: &RingSet, ray: Vec3, side: usize) -> (f32, f32) {
    let (sin, cos) = libm::sincosf(side as f32 * std::f32::consts::FRAC_PI_4);
    let (normal, right) = (Vec3::new(sin, 0.0, -cos), Vec3::new(cos, 0.0, sin));
    let (radius, middle) = (ring.radius_m, octagon.centre);
    let reach = (radius + normal.dot(middle)) / ray.dot(normal);
    let place = (ray * reach - middle) / radius;
    (place.dot(right), place.y)
}
