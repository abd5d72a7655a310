// Clouds of the packed texture: lines 14 to 28 of the paper's shader. Theory, changes, CPU part: mod.rs.

fn packed_sample(uv: vec2f, level: f32) -> vec4f {
    return textureSampleLevel(clouds_texture, repeat_sampler, uv, level);
}

// Lines 22-23, `1 - (r - 1) / 2` beyond 1, with the kink rounded off.
fn packed_fold(grey: f32) -> f32 {
    let beyond = grey - 1.0;
    return grey - 0.75 * (beyond + sqrt(beyond * beyond + PACKED_FOLD * PACKED_FOLD));
}

// Opacity of the thin upper layer.
fn packed_veil(hit: DomeHit, level: f32) -> f32 {
    let packed = uniforms.packed;
    let wisp = packed_sample(hit.plane * packed.upper_scale + packed.upper_offset, level + packed.upper_lod_bias).g;
    return packed.upper_layer * UPPER_OPACITY * smoothstep(UPPER_THRESHOLD, 1.0, wisp);
}

// Its radiance: white under the sunset tint.
fn packed_white(tint: f32, direction: vec3f) -> vec3f {
    return cloud_light(mix(vec3f(1.0), uniforms.clouds.tint, tint), cloud_facing(direction, 0.0));
}

// Radiance and opacity of the clouds along a unit direction above the horizon.
fn packed_layer(direction: vec3f, narrowing: f32) -> vec4f {
    let packed = uniforms.packed;
    let hit = dome_intersect(direction);
    let level = cloud_level(hit, narrowing);

    let turned = vec2f(
        hit.plane.x * packed.noise_rotation.x - hit.plane.y * packed.noise_rotation.y,
        hit.plane.x * packed.noise_rotation.y + hit.plane.y * packed.noise_rotation.x,
    );
    let photo = packed_sample(hit.plane * packed.photo_scale + packed.photo_offset, level + packed.photo_lod_bias).r;
    let noise = packed_sample(turned + packed.noise_offset, level + packed.noise_lod_bias).g;
    let detail = packed_sample(hit.plane * packed.detail_scale + packed.detail_offset, level + packed.detail_lod_bias).b;
    let tint = cloud_tint(direction);

    let amount = photo + noise * (1.0 - photo);                      // line 14
    var alpha = (amount - packed.threshold) * packed.contrast;       // lines 15-17
    var grey = amount + detail * (1.0 - amount);                     // line 18
    alpha *= mix(detail, 1.0, packed.smoothness);                    // line 19
    let thick = packed.density * max(alpha, 0.0) * 2.0;              // lines 20-21
    grey += thick;
    alpha = clamp(alpha + thick, 0.0, 1.0);                          // line 25
    grey = clamp(packed_fold(grey), 0.0, 1.0);                        // lines 22-25
    let tinted = mix(vec3f(grey), uniforms.clouds.tint, tint);   // lines 26-27
    var radiance = cloud_light(tinted, cloud_facing(direction, alpha)); // line 28

    alpha = cloud_soften(alpha, PACKED_EDGE);
    if UPPER_LAYER {
        let veil = packed_veil(hit, level);
        let over = alpha + veil * (1.0 - alpha);
        radiance = mix(packed_white(tint, direction), radiance, alpha / max(over, 1e-4));
        alpha = over;
    }
    return vec4f(radiance, alpha * cloud_clearness(direction));
}
