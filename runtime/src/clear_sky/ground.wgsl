// The ground below the horizon, seen through the air. CPU part: ground.rs.

// What is seen along a direction below the horizon, where the sky's radiance is `horizon`.
fn ground_seen(horizon: vec3f, direction: vec3f) -> vec3f {
    let ground = uniforms.ground;
    let down = max(-direction.y, 1e-6);
    // One division for both: away is 1 / down.
    let both = 1.0 / (down * (ground.sun_sin + down));
    let away = both * (ground.sun_sin + down);
    let uv = ground.place + direction.xz * (away * ground.height_tiles);
    // Half way between the short side of a pixel's footprint, the distance, and its long one, the square of it.
    let level = ground.lod - 1.5 * log2(down);
    let noise = textureSampleLevel(clouds_texture, repeat_sampler, uv, level).b - ground.mean;
    let finer = textureSampleLevel(clouds_texture, repeat_sampler, uv * GROUND_FINER, level + GROUND_FINER_LEVEL).b - ground.mean;
    let facing = 1.0 - GROUND_BACKSCATTER * dot(direction, uniforms.sky.sun_direction);
    let lit = ground.skylit + ground.sunlit * (facing * (both * down));
    let radiance = lit * (1.0 + GROUND_MOTTLING * noise) * (1.0 + ground.finer_mottling * finer);
    return mix(horizon, radiance, exp2(-ground.depth * away));
}
