// The galaxy: one texture over the whole dome. CPU part: galaxy.rs.
struct GalaxyUniforms {
    light: vec4f, // rgb: radiance of the brightest place, times the share of the night sky; w: level of detail of the grain
    grain: vec4f, // x: the grain without noise and detail; y, z: what noise and detail add where they are 1
}

fn galaxy_brightness(dome: vec2f) -> f32 {
    let uv = 0.5 + dome * (0.25 * SQRT_2);
    let stored = textureSampleLevel(galaxy_texture, clamp_sampler, uv, 0.0).r;
    let grain = textureSampleLevel(clouds_texture, repeat_sampler, dome * GALAXY_GRAIN_SCALE, uniforms.galaxy.light.w);
    let parts = uniforms.galaxy.grain;
    return stored * stored * (parts.x + parts.y * grain.g + parts.z * grain.b);
}
