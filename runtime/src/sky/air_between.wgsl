// For an application's own shaders: what the air between two places does to light. `air` is what Welkin's Air gives. Places are metres to the
// east, up and to the south, heights over the ground.

struct Air {
    horizon_towards: vec3f,   // radiance of the horizon below sun or moon
    sun_east: f32,
    horizon_away: vec3f,      // and opposite
    sun_south: f32,
    molecules_per_m: vec3f,   // extinction at height 0
    molecules_height_m: f32,  // over which it falls to 1 / e
    aerosol_per_m: vec3f,
    aerosol_height_m: f32,
}

// Metres of the air at height 0 that lie on a way of `distance_m` between two heights, in a layer of a scale height.
fn air_metres(scale_m: f32, from_m: f32, to_m: f32, distance_m: f32) -> f32 {
    let low = min(from_m, to_m) / scale_m;
    let rise = abs(to_m - from_m) / scale_m;
    // (1 - exp(-x)) / x, by its series where the difference of two numbers near 1 would leave nothing.
    let mean = select((1.0 - exp(-rise)) / max(rise, 1e-6), 1.0 - 0.5 * rise, rise < 1e-3);
    return distance_m * exp(-low) * mean;
}

// The share of light that comes through.
fn air_transmittance(air: Air, viewer: vec3f, to: vec3f) -> vec3f {
    let distance_m = distance(viewer, to);
    let molecules = air_metres(air.molecules_height_m, viewer.y, to.y, distance_m);
    let aerosol = air_metres(air.aerosol_height_m, viewer.y, to.y, distance_m);
    return exp(-(air.molecules_per_m * molecules + air.aerosol_per_m * aerosol));
}

// Radiance of the horizon, which endless air along a way has.
fn air_horizon(air: Air, viewer: vec3f, to: vec3f) -> vec3f {
    let way = to.xz - viewer.xz;
    let flat = inverseSqrt(max(dot(way, way), 1e-12));
    let facing = 0.5 + 0.5 * flat * dot(way, vec2f(air.sun_east, air.sun_south));
    return mix(air.horizon_away, air.horizon_towards, facing * facing);
}

// What a viewer sees of a radiance at `to`.
fn air_between(air: Air, radiance: vec3f, viewer: vec3f, to: vec3f) -> vec3f {
    return mix(air_horizon(air, viewer, to), radiance, air_transmittance(air, viewer, to));
}
