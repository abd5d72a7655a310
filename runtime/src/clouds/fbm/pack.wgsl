// Re-packs an octave of the fbm method for the sun as it stands. CPU part: pack.rs.
@fragment
fn fs_fbm_pack(map: MapVaryings) -> @location(0) vec4f {
    let uv = map.position.xy / vec2f(textureDimensions(layers_texture));
    let step = uniforms.fbm.sun_step;
    let octave = i32(map.layer);
    return vec4f(
        fbm_noise(uv + 3.0 * step, octave),
        fbm_noise(uv + 2.0 * step, octave),
        fbm_noise(uv + step, octave),
        fbm_noise(uv, octave),
    );
}

fn fbm_noise(uv: vec2f, octave: i32) -> f32 {
    return textureSampleLevel(layers_texture, repeat_sampler, uv, octave, 0.0).a;
}
