// The domes. Theory and sources: dome.rs; the plane of the dome: welkin_pack::mapping.

struct DomeHit {
    plane: vec2f,       // east and south, in heights of the cloud layer
    distance: f32,      // in the same unit
    slant: f32,         // times (radius + 1): 1 / cosine of the angle between ray and normal
}

// The cloud dome along a unit direction.
fn dome_intersect(direction: vec3f) -> DomeHit {
    let ry = CLOUD_SPHERE_RADIUS * direction.y;
    let square = ry * ry + (2.0 * CLOUD_SPHERE_RADIUS + 1.0);
    let slant = inverseSqrt(square);
    let distance = square * slant - ry;
    return DomeHit(direction.xz * distance, distance, slant);
}

// A unit direction on the plane of Lambert's equal-area projection about the zenith.
fn direction_to_dome(direction: vec3f) -> vec2f {
    return direction.xz * inverseSqrt(max(0.5 + 0.5 * direction.y, 1e-6));
}

fn dome_to_direction(dome: vec2f) -> vec3f {
    let r2 = dot(dome, dome);
    let xz = dome * sqrt(max(1.0 - 0.25 * r2, 0.0));
    return vec3f(xz.x, 1.0 - 0.5 * r2, xz.y);
}
