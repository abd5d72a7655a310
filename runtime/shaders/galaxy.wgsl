// The galaxy: one texture over the whole dome. CPU part: galaxy.rs.
struct GalaxyUniforms {
    light: vec4f, // rgb: radiance of the brightest place, times the share of the night sky; w: level of detail of the grain
}

fn galaxy_brightness(dome: vec2f) -> f32 {
    let uv = 0.5 + dome * (0.25 * SQRT_2);
    let stored = textureSampleLevel(galaxy_texture, clamp_sampler, uv, 0.0).r;
    let grain = textureSampleLevel(clouds_texture, repeat_sampler, dome * GALAXY_GRAIN_SCALE, uniforms.galaxy.light.w);
    return stored * stored * (0.4 + 1.15 * grain.g + 0.6 * grain.b);
}
