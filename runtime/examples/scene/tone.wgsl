// From linear radiance to the display: a tone curve of the application's own (K. Narkowicz, "ACES Filmic Tone Mapping Curve", 2015).
@group(0) @binding(0) var drawn: texture_2d<f32>;
@group(0) @binding(1) var<uniform> exposure: vec4f;

@vertex
fn vs_tone(@builtin(vertex_index) index: u32) -> @builtin(position) vec4f {
    return vec4f(f32(index & 1u) * 4.0 - 1.0, f32(index >> 1u) * 4.0 - 1.0, 0.0, 1.0);
}

@fragment
fn fs_tone(@builtin(position) position: vec4f) -> @location(0) vec4f {
    // `SkyLight::exposure` is for Welkin's own curve, which is darker in the middle.
    let x = 0.5 * exposure.x * textureLoad(drawn, vec2i(position.xy), 0).rgb;
    return vec4f(clamp(x * (2.51 * x + 0.03) / (x * (2.43 * x + 0.59) + 0.14), vec3f(0.0), vec3f(1.0)), 1.0);
}
