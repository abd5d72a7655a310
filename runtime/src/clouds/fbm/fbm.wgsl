// Clouds of the fbm method: one map of drifting octaves. Theory and CPU part: mod.rs.

fn fbm_uv(plane: vec2f) -> vec2f {
    return uniforms.fbm.east_axis * plane.x + uniforms.fbm.south_axis * plane.y + uniforms.fbm.offset;
}

// A finer read of the map, against its mean.
fn fbm_finer(uv: vec2f, level: f32) -> f32 {
    let finer_uv = uv * FBM_FINER + FBM_FINER_START;
    return textureSampleLevel(map_texture, repeat_sampler, finer_uv, level + FBM_FINER_LEVEL).g - uniforms.fbm.mean;
}

// Opacity of a cover. Finer octaves roughen edges and mottle what is full; they neither open nor close the sky.
fn fbm_opacity(cover: f32, finer: f32) -> f32 {
    return smoothstep(0.0, FBM_FULL, cover + 4.0 * uniforms.fbm.roughness * finer * cover * (1.0 - cover));
}

// Share of the light of sun or moon that the clouds hide from the middle of a texel of the shadows.
fn fbm_hidden(texel: vec2f) -> f32 {
    let level = shadow_level(0) + uniforms.fbm.lod_bias;
    let uv = fbm_uv(shadow_plane(0, texel));
    return fbm_opacity(textureSampleLevel(map_texture, repeat_sampler, uv, level).a, fbm_finer(uv, level));
}

// Radiance and opacity of the clouds along a unit direction above the horizon.
fn fbm_layer(direction: vec3f, narrowing: f32) -> vec4f {
    let fbm = uniforms.fbm;
    let hit = dome_intersect(direction);
    let level = cloud_level(hit, narrowing) + fbm.lod_bias;
    let uv = fbm_uv(hit.plane);
    let cloud = textureSampleLevel(map_texture, repeat_sampler, uv, level);
    if cloud.a <= 0.0 {
        return vec4f(0.0);
    }
    let finer = fbm_finer(uv, level);
    let alpha = fbm_opacity(cloud.a, finer);
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
