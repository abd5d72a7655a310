// Clouds of the packed texture. Theory, changes, CPU part: mod.rs.

// The lower layer, and the upper one behind it.
fn packed_over_veil(hit: DomeHit, level: f32, direction: vec3f, tint: f32, lower: vec4f) -> vec4f {
    var radiance = lower.rgb;
    var alpha = lower.a;
    if UPPER_LAYER {
        let veil = packed_veil(hit.plane, level);
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

// Height of a cloud where its amount and the detail are these: lines 15-17.
fn packed_height(amount: f32, detail: f32) -> f32 {
    let packed = uniforms.packed;
    return max(amount * packed.contrast - packed.cuts.w + packed.erosion * detail, 0.0);
}

// Opacity of a height.
fn packed_opacity(height: f32) -> f32 {
    let halvings = uniforms.packed.opacity_rate * height * height / (height + PACKED_FOOT);
    return cloud_soften(min(PACKED_FULL * (1.0 - exp2(-halvings)), 1.0), PACKED_EDGE);
}

// Share of the light of sun or moon that the clouds hide from the middle of a texel of the shadows.
fn packed_hidden(texel: vec2f) -> f32 {
    let packed = uniforms.packed;
    let plane = shadow_plane(0, texel);
    let level = shadow_level(0);
    let noise = packed_noise(plane, level);
    let detail = packed_sample(plane * packed.detail_scale + packed.detail_offset, level + packed.detail_lod_bias).b;
    let photo_uv = plane * packed.photo_scale + packed.photo_offset;
    var hidden: f32;
    if SCATTERED {
        let photo = textureSampleLevel(map_texture, repeat_sampler, photo_uv, level + packed.map_lod_bias).w;
        hidden = packed_opacity(packed_height(noise + photo * (1.0 - noise), detail));
    } else {
        let photo = packed_sample(photo_uv, level + packed.photo_lod_bias).r;
        hidden = packed_paper_opacity(photo + noise * (1.0 - photo), detail).x;
    }
    return 1.0 - (1.0 - hidden) * (1.0 - packed_veil(shadow_plane(1, texel), shadow_level(1)));
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
    let heights = amounts.xyz * packed.contrast - packed.cuts.xyz;    // lines 15-17
    let height = packed_height(amounts.w, detail);
    // Where there is no cloud nothing is lit.
    if height <= 0.0 {
        return packed_over_veil(hit, level, direction, tint, vec4f(0.0));
    }
    let detail_beyond = packed_sample(detail_uv + packed.detail_step, detail_level).b;
    let above = max(heights, vec3f(0.0));
    let relief = PACKED_RELIEF * (detail_beyond - detail) * min(PACKED_RELIEF_FULL * height, 1.0);
    let thickness = max(height - packed.shut, 0.0);
    let passed = max(PACKED_OWN * thickness + dot(PACKED_SHARES, above) + relief, 0.0);
    let light = cloud_scattered(direction, packed.extinction * passed, thickness);
    let radiance = cloud_lit(light, tint);
    return packed_over_veil(hit, level, direction, tint, vec4f(radiance, packed_opacity(height)));
}
