// The clear sky of the pack's table: what is scattered to all sides, and the aureole. CPU part: table.rs.

// A lobe of the aerosol's phase function: Henyey and Greenstein's, by its scale and b.
fn aureole_lobe(lobe: vec2f, cosine: f32) -> f32 {
    let root = inverseSqrt(lobe.y - min(cosine, 1.0));
    return lobe.x * root * root * root;
}

// The clear sky along a unit direction; from below the horizon, that of the horizon.
fn table_light(direction: vec3f) -> vec3f {
    let up = clamp(direction.y, 0.0, 1.0);
    let flat = inverseSqrt(max(dot(direction.xz, direction.xz), 1e-12));
    let azimuth_cos = dot(direction.xz, uniforms.clouds.sun_azimuth) * flat;
    // 1 - sqrt(1 - up), without the difference of two numbers near 1.
    let row = up / (1.0 + sqrt(1.0 - up));
    let place = vec2f(sqrt(max(0.5 - 0.5 * azimuth_cos, 0.0)), sqrt(row));
    let uv = uniforms.sky.start + uniforms.sky.span * place;
    let texel = textureSampleLevel(sky_texture, clamp_sampler, uv, 0.0);
    let aureole_row = place.y * f32(AUREOLE_ROWS - 1u);
    let below = min(u32(aureole_row), AUREOLE_ROWS - 2u);
    let colour = mix(uniforms.sky.aureole[below].rgb, uniforms.sky.aureole[below + 1u].rgb, aureole_row - f32(below));
    let cosine = dot(direction, uniforms.sky.sun_direction);
    let phase = aureole_lobe(AUREOLE_WIDE, cosine) + aureole_lobe(AUREOLE_NARROW, cosine);
    return texel.rgb + colour * (texel.a * phase);
}

// The sky behind the clouds along a unit direction, or the ground.
fn sky_radiance(direction: vec3f) -> vec3f {
    var radiance = clear_sky_light(direction);
    if uniforms.sky.overcast_weight > 0.0 {
        let low = 1.0 - clamp(direction.y, 0.0, 1.0);
        let low_squared = low * low;
        let slit = 1.0 + uniforms.sky.slit * low_squared * low_squared * low_squared;
        radiance = mix(radiance, uniforms.sky.overcast * slit, uniforms.sky.overcast_weight);
    }
    if direction.y < 0.0 {
        radiance = ground_seen(radiance, direction);
    }
    return radiance;
}
