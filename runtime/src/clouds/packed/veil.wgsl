// The thin upper layer of the packed texture, and reads of that. CPU part: mod.rs.

fn packed_sample(uv: vec2f, level: f32) -> vec4f {
    return textureSampleLevel(clouds_texture, repeat_sampler, uv, level);
}

// Opacity of the thin upper layer.
fn packed_veil(plane: vec2f, level: f32) -> f32 {
    let packed = uniforms.packed;
    let wisp = packed_sample(plane * packed.upper_scale + packed.upper_offset, level + packed.upper_lod_bias).g;
    return packed.upper_layer * UPPER_OPACITY * smoothstep(UPPER_THRESHOLD, 1.0, wisp);
}

// Its radiance: white under the sunset tint.
fn packed_white(tint: f32, direction: vec3f) -> vec3f {
    return cloud_light(mix(vec3f(1.0), uniforms.clouds.tint, tint), cloud_facing(direction, 0.0));
}
