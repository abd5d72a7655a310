// The ground below the horizon, seen through the air. CPU part: ground.rs.

// What is seen along a direction below the horizon, where the sky's radiance is `horizon`.
fn ground_seen(horizon: vec3f, direction: vec3f) -> vec3f {
    let ground = uniforms.ground;
    let down = max(-direction.y, 1e-6);
    // One division for both: away is 1 / down.
    let both = 1.0 / (down * (ground.sun_sin + down));
    let away = both * (ground.sun_sin + down);
    let uv = ground.place + direction.xz * (away * ground.height_tiles);
    // A pixel covers the square of the distance: as much more along the view as it is flatter.
    let noise = textureSampleLevel(clouds_texture, repeat_sampler, uv, ground.lod - 2.0 * log2(down)).b;
    let facing = 1.0 - GROUND_BACKSCATTER * dot(direction, uniforms.sky.sun_direction);
    let lit = ground.skylit + ground.sunlit * (facing * (both * down));
    let radiance = lit * (ground.plain + GROUND_MOTTLING * noise);
    return mix(horizon, radiance, exp2(-ground.depth * away));
}
