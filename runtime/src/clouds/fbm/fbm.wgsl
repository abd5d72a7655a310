// Clouds of the fbm method: one map of drifting octaves. Theory and CPU part: mod.rs.

// Radiance and opacity of the clouds along a unit direction above the horizon.
fn fbm_layer(direction: vec3f, narrowing: f32) -> vec4f {
    let fbm = uniforms.fbm;
    let hit = dome_intersect(direction);
    let level = cloud_level(hit, narrowing) + fbm.lod_bias;
    let uv = fbm.east_axis * hit.plane.x + fbm.south_axis * hit.plane.y + fbm.offset;
    let cloud = textureSampleLevel(map_texture, repeat_sampler, uv, level);
    if cloud.a <= 0.0 {
        return vec4f(0.0);
    }
    let finer_uv = uv * FBM_FINER + FBM_FINER_START;
    let finer = textureSampleLevel(map_texture, repeat_sampler, finer_uv, level + FBM_FINER_LEVEL).g - fbm.mean;
    // Finer octaves roughen edges and mottle what is full; they neither open nor close the sky.
    let rough = 4.0 * fbm.roughness * finer * cloud.a * (1.0 - cloud.a);
    let alpha = smoothstep(0.0, FBM_FULL, cloud.a + rough);
    let shade = clamp(fbm.shade_strength * (cloud.r + FBM_ROUGH_SHADE * finer * cloud.a), 0.0, 1.0);
    let colour = mix(fbm.lit, fbm.shaded, shade);
    var light = colour * (uniforms.clouds.sunlight + uniforms.clouds.ambient);
    if SCATTERED {
        let shares = cloud_scattered(direction, FBM_DEPTH * shade, FBM_THICK * cloud.a);
        light = fbm.lit * (shares.x * uniforms.clouds.sunlight) + colour * (shares.y * uniforms.clouds.ambient);
    }
    if uniforms.clouds.sunset > 0.0 {
        light *= mix(vec3f(1.0), uniforms.clouds.tint, cloud_tint(direction));
    }
    return vec4f(light, alpha * cloud_clearness(direction));
}
