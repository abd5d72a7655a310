// The map of the fbm method: octaves moved and summed, remapped, and the march towards the sun. CPU part: map.rs.
fn fbm_offset(octave: i32) -> vec2f {
    let pair = uniforms.fbm.offsets[octave >> 1u];
    return select(pair.xy, pair.zw, (octave & 1) == 1);
}

// x, y, z: the sum three, two, one steps towards the sun; w: here.
@fragment
fn fs_fbm_map(@builtin(position) position: vec4f) -> @location(0) vec4f {
    let fbm = uniforms.fbm;
    let uv = position.xy / fbm.resolution;
    var sum = vec4f(0.0);
    for (var k = 0; k < i32(fbm.count); k++) {
        let weight = uniforms.fbm.weights[k >> 2u][k & 3];
        sum += weight * textureSampleLevel(layers_texture, repeat_sampler, uv + fbm_offset(k), k, 0.0);
    }
    if uniforms.photo.weight > 0.0 {
        let place = uv + fbm_offset(0);
        let photo = vec4f(
            photo_deviation(place + 3.0 * fbm.sun_step),
            photo_deviation(place + 2.0 * fbm.sun_step),
            photo_deviation(place + fbm.sun_step),
            photo_deviation(place),
        );
        sum = fbm.mean + photo_rest() * (sum - fbm.mean) + fbm.spread * uniforms.photo.weight * photo;
    }
    let cover = clamp(fbm.slope * sum.w + fbm.intercept, 0.0, 1.0);
    let inside = max(fbm.ray_slope * sum + fbm.ray_intercept - FBM_DEPTHS, vec4f(0.0));
    let shade = 1.0 - exp2(-FBM_ABSORPTION * dot(inside, vec4f(0.25)));
    return vec4f(shade, sum.w, 0.0, cover);
}
