// Clouds of the packed texture as the paper shades them: lines 14 to 28 of its shader. CPU part: paper.rs.

// Lines 22-23, `1 - (r - 1) / 2` beyond 1, with the kink rounded off.
fn packed_fold(grey: f32) -> f32 {
    let beyond = grey - 1.0;
    return grey - 0.75 * (beyond + sqrt(beyond * beyond + PACKED_FOLD * PACKED_FOLD));
}

// Opacity where the amount and the detail are these, and what thick clouds add to grey and opacity: lines 15-17, 19-21, 25.
fn packed_paper_opacity(amount: f32, detail: f32) -> vec2f {
    let packed = uniforms.packed;
    var alpha = (amount - packed.threshold) * packed.contrast;       // lines 15-17
    alpha *= mix(detail, 1.0, packed.smoothness);                    // line 19
    let thick = packed.density * max(alpha, 0.0) * 2.0;              // lines 20-21
    return vec2f(cloud_soften(clamp(alpha + thick, 0.0, 1.0), PACKED_EDGE), thick);
}

fn packed_paper_layer(direction: vec3f, narrowing: f32) -> vec4f {
    let packed = uniforms.packed;
    let hit = dome_intersect(direction);
    let level = cloud_level(hit, narrowing);
    let photo = packed_sample(hit.plane * packed.photo_scale + packed.photo_offset, level + packed.photo_lod_bias).r;
    let noise = packed_noise(hit.plane, level);
    let detail = packed_sample(hit.plane * packed.detail_scale + packed.detail_offset, level + packed.detail_lod_bias).b;
    let tint = cloud_tint(direction);

    let amount = photo + noise * (1.0 - photo);                      // line 14
    let opacity = packed_paper_opacity(amount, detail);
    var grey = amount + detail * (1.0 - amount) + opacity.y;         // lines 18, 20-21
    grey = clamp(packed_fold(grey), 0.0, 1.0);                        // lines 22-25
    let tinted = mix(vec3f(grey), uniforms.clouds.tint, tint);       // lines 26-27
    let radiance = cloud_light(tinted, 1.0);                          // line 28
    return packed_over_veil(hit, level, direction, tint, vec4f(radiance, opacity.x));
}
