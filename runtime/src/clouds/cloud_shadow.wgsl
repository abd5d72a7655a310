// For an application's own shaders: the share of direct sunlight (by night, moonlight) that the clouds let through to a place on the
// ground, 1 where they hide nothing. `map` is the texture and `area` what Welkin's Shadow gives: middle (east, south) and side of the
// square that it covers, and the width of its edge, all in metres. `map_sampler` filters linearly and clamps. `position_m` is east
// and south of the world's origin. Outside the square it is 1, without a step at its edge.
fn cloud_shadow(map: texture_2d<f32>, map_sampler: sampler, area: vec4f, position_m: vec2f) -> f32 {
    return cloud_shadow_or(map, map_sampler, area, position_m, 1.0);
}

// The same with another share outside: that of the clouds' mean, `light.sun / light.clear_sun` of Welkin's SkyLight, where the scene is wider than the square.
fn cloud_shadow_or(map: texture_2d<f32>, map_sampler: sampler, area: vec4f, position_m: vec2f, outside: f32) -> f32 {
    let from_middle = position_m - area.xy;
    let inside = 0.5 * area.z - max(abs(from_middle.x), abs(from_middle.y));
    if inside <= 0.0 {
        return outside;
    }
    let clear = textureSampleLevel(map, map_sampler, from_middle / area.z + 0.5, 0.0).r;
    return mix(outside, clear, smoothstep(0.0, area.w, inside));
}
