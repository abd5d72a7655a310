// The map of the fbm method: octaves moved and summed, remapped, and the march towards the sun. CPU part: map.rs.
fn fbm_offset(octave: i32) -> vec2f {
    let pair = uniforms.fbm.offsets[octave >> 1u];
    return select(pair.xy, pair.zw, (octave & 1) == 1);
}

// An octave at a place, with all digits of it. A sampler rounds places to 1/256 of a texel: octaves that drift by about as much in a frame would go by
// one of these steps and by two, all texels at once.
fn fbm_octave(uv: vec2f, octave: i32) -> vec4f {
    let side = vec2i(textureDimensions(layers_texture));
    let place = fract(uv) * vec2f(side) - 0.5;
    let corner = floor(place);
    let share = place - corner;
    let left = vec2i(corner);
    let first = select(left, side - 1, left < vec2i(0));
    let next = select(left + 1, vec2i(0), left + 1 == side);
    let upper = mix(
        textureLoad(layers_texture, first, octave, 0),
        textureLoad(layers_texture, vec2i(next.x, first.y), octave, 0),
        share.x,
    );
    let lower = mix(
        textureLoad(layers_texture, vec2i(first.x, next.y), octave, 0),
        textureLoad(layers_texture, next, octave, 0),
        share.x,
    );
    return mix(upper, lower, share.y);
}

// x, y, z: the sum three, two, one steps towards the sun; w: here.
@fragment
fn fs_fbm_map(@builtin(position) position: vec4f) -> @location(0) vec4f {
    let fbm = uniforms.fbm;
    let uv = position.xy / fbm.resolution;
    var sum = vec4f(0.0);
    for (var k = 0; k < i32(fbm.count); k++) {
        let weight = uniforms.fbm.weights[k >> 2u][k & 3];
        sum += weight * fbm_octave(uv + fbm_offset(k), k);
    }
    let cover = clamp(fbm.slope * sum.w + fbm.intercept, 0.0, 1.0);
    let inside = max(fbm.slope * sum + fbm.ray_intercept - FBM_DEPTHS, vec4f(0.0));
    let shade = 1.0 - exp2(-FBM_ABSORPTION * dot(inside, vec4f(0.25)));
    return vec4f(shade, sum.w, 0.0, cover);
}
