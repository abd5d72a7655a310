// Re-packs an octave of the fbm method for the sun as it stands. CPU part: fbm_pack.rs.
@fragment
fn fs_fbm_pack(@builtin(position) position: vec4f) -> @location(0) vec4f {
    let uv = position.xy / vec2f(textureDimensions(map_texture));
    let step = uniforms.fbm.step.xy;
    return vec4f(
        fbm_noise(uv + 3.0 * step),
        fbm_noise(uv + 2.0 * step),
        fbm_noise(uv + step),
        fbm_noise(uv),
    );
}

fn fbm_noise(uv: vec2f) -> f32 {
    return textureSampleLevel(map_texture, repeat_sampler, uv, 0.0).a;
}
