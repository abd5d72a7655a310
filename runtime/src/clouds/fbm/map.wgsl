// The map of the fbm method: octaves moved and summed, remapped, and the march towards the sun. CPU part: map.rs.
fn fbm_offset(octave: i32) -> vec2f {
    let fbm = uniforms.fbm;
    var pair = fbm.offsets_a;
    switch octave >> 1u {
        case 1: { pair = fbm.offsets_b; }
        case 2: { pair = fbm.offsets_c; }
        case 3: { pair = fbm.offsets_d; }
        default: {}
    }
    return select(pair.xy, pair.zw, (octave & 1) == 1);
}

// x, y, z: the sum three, two, one steps towards the sun; w: here.
@fragment
fn fs_fbm_map(@builtin(position) position: vec4f) -> @location(0) vec4f {
    let fbm = uniforms.fbm;
    let uv = position.xy / fbm.remap.w;
    var sum = vec4f(0.0);
    for (var k = 0; k < i32(fbm.remap.z); k++) {
        let weight = select(fbm.weights_a[k & 3], fbm.weights_b[k & 3], k > 3);
        sum += weight * textureSampleLevel(layers_texture, repeat_sampler, uv + fbm_offset(k), k, 0.0);
    }
    let cover = clamp(fbm.remap.x * sum.w + fbm.remap.y, 0.0, 1.0);
    let inside = max(fbm.remap.x * sum + fbm.step.w - FBM_DEPTHS, vec4f(0.0));
    let shade = 1.0 - exp2(-FBM_ABSORPTION * dot(inside, vec4f(0.25)));
    return vec4f(shade, sum.w, 0.0, cover);
}
