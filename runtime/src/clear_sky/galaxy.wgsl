// The galaxy: one texture over the whole dome. CPU part: galaxy.rs.

fn galaxy_brightness(dome: vec2f) -> f32 {
    let uv = 0.5 + dome * GALAXY_UV_SCALE;
    let stored = textureSampleLevel(galaxy_texture, clamp_sampler, uv, 0.0).r;
    let grain = textureSampleLevel(clouds_texture, repeat_sampler, dome * GALAXY_GRAIN_SCALE, uniforms.galaxy.grain_lod);
    let galaxy = uniforms.galaxy;
    return stored * stored * (galaxy.plain + galaxy.noise * grain.g + galaxy.detail * grain.b);
}
