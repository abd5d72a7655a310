// The clear sky of the pack's table: what is scattered to all sides, and the aureole. CPU part: table.rs, picture.rs.

// A lobe of the aerosol's phase function: Henyey and Greenstein's. A cosine that is rounded up leaves it as it is.
fn aureole_lobe(lobe: vec2f, cosine: f32) -> f32 {
    let root = inverseSqrt(lobe.x - lobe.y * cosine);
    return root * root * root;
}

// The clear sky along a unit direction; from below the horizon, that of the horizon.
fn table_light(direction: vec3f) -> vec3f {
    var place = vec2f(dot(direction.xz, uniforms.sky.azimuth), 0.0);
    if direction.y > 0.0 {
        place.y = sqrt(direction.y) * (1.0 + SKY_BEND * direction.y);
    } else {
        place.x *= inverseSqrt(max(dot(direction.xz, direction.xz), 1e-12));
    }
    let uv = uniforms.sky.start + uniforms.sky.span * place;
    let sky = textureSampleLevel(sky_texture, clamp_sampler, uv, 0.0);
    let colour = textureSampleLevel(sky_texture, clamp_sampler, vec2f(uniforms.sky.aureole_u, uv.y), 0.0).rgb;
    let cosine = dot(direction, uniforms.sky.sun_direction);
    var phase = aureole_lobe(AUREOLE_WIDE, cosine);
    if cosine > AUREOLE_END {
        phase += aureole_lobe(AUREOLE_NARROW, cosine) - AUREOLE_LEAST;
    }
    return sky.rgb + colour * (sky.a * phase);
}

// The sky behind the clouds along a unit direction above the horizon.
fn sky_above(direction: vec3f) -> vec3f {
    var radiance = clear_sky_light(direction);
    if uniforms.sky.overcast_weight > 0.0 {
        let low = 1.0 - clamp(direction.y, 0.0, 1.0);
        let low_squared = low * low;
        let slit = 1.0 + uniforms.sky.slit * low_squared * low_squared * low_squared;
        radiance = mix(radiance, uniforms.sky.overcast * slit, uniforms.sky.overcast_weight);
    }
    return radiance;
}

// The sky behind the clouds along a unit direction, or what lies below the horizon.
fn sky_radiance(direction: vec3f) -> vec3f {
    let radiance = sky_above(direction);
    if direction.y < 0.0 {
        return below_horizon(radiance, direction);
    }
    return radiance;
}
