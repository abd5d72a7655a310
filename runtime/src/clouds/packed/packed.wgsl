// Clouds of the packed texture. Theory, changes, CPU part: mod.rs.

// The lower layer, and the upper one behind it.
fn packed_over_veil(hit: DomeHit, level: f32, direction: vec3f, tint: f32, lower: vec4f) -> vec4f {
    var radiance = lower.rgb;
    var alpha = lower.a;
    if UPPER_LAYER {
        let veil = packed_veil(hit, level);
        let over = alpha + veil * (1.0 - alpha);
        radiance = mix(packed_white(tint, direction), radiance, alpha / max(over, 1e-4));
        alpha = over;
    }
    return vec4f(radiance, alpha * cloud_clearness(direction));
}

fn packed_noise(plane: vec2f, level: f32) -> f32 {
    let packed = uniforms.packed;
    let turned = vec2f(
        plane.x * packed.noise_rotation.x - plane.y * packed.noise_rotation.y,
        plane.x * packed.noise_rotation.y + plane.y * packed.noise_rotation.x,
    );
    return packed_sample(turned + packed.noise_offset, level + packed.noise_lod_bias).g;
}

// Radiance and opacity of the clouds along a unit direction above the horizon.
fn packed_layer(direction: vec3f, narrowing: f32) -> vec4f {
    if SCATTERED {
        return packed_scattered_layer(direction, narrowing);
    }
    return packed_paper_layer(direction, narrowing);
}

fn packed_scattered_layer(direction: vec3f, narrowing: f32) -> vec4f {
    let packed = uniforms.packed;
    let hit = dome_intersect(direction);
    let level = cloud_level(hit, narrowing);
    let photo_uv = hit.plane * packed.photo_scale + packed.photo_offset;
    let photos = textureSampleLevel(map_texture, repeat_sampler, photo_uv, level + packed.map_lod_bias);
    let noise = packed_noise(hit.plane, level);
    let detail_uv = hit.plane * packed.detail_scale + packed.detail_offset;
    let detail_level = level + packed.detail_lod_bias;
    let detail = packed_sample(detail_uv, detail_level).b;
    let tint = cloud_tint(direction);

    let amounts = noise + photos * (1.0 - noise);                     // line 14
    let heights = amounts * packed.contrast - packed.cuts;            // lines 15-17
    let height = max(heights.w + packed.erosion * detail, 0.0);
    // Where there is no cloud nothing is lit.
    if height <= 0.0 {
        return packed_over_veil(hit, level, direction, tint, vec4f(0.0));
    }
    let detail_beyond = packed_sample(detail_uv + packed.detail_step, detail_level).b;
    let above = max(heights.xyz, vec3f(0.0));
    let relief = PACKED_RELIEF * (detail_beyond - detail) * min(PACKED_RELIEF_FULL * height, 1.0);
    let thickness = max(height - packed.shut, 0.0);
    let passed = max(PACKED_OWN * thickness + dot(PACKED_SHARES, above) + relief, 0.0);
    let light = cloud_scattered(direction, packed.extinction * passed, thickness);
    let radiance = cloud_lit(light, tint);
    let halvings = packed.opacity_rate * height * height / (height + PACKED_FOOT);
    let alpha = min(PACKED_FULL * (1.0 - exp2(-halvings)), 1.0);
    return packed_over_veil(hit, level, direction, tint, vec4f(radiance, cloud_soften(alpha, PACKED_EDGE)));
}
