// The clear sky: day gradient, light scattered around the sun, haze below the horizon. CPU part: gradient.rs.

// The gradient's clear sky along a unit direction.
fn gradient_light(direction: vec3f) -> vec3f {
    let sky = uniforms.sky;
    let up = max(direction.y, 0.0);
    let uv = vec2f(sky.time_u, sky.horizon_v + sky.elevation_v * sqrt(up));
    var radiance = textureSampleLevel(sky_texture, repeat_sampler, uv, 0.0).rgb;

    // No lobes by night.
    if sky.wide.r > 0.0 {
        let from_sun = dot(direction, sky.sun_direction) - 1.0;
        let wide = exp2(sky.wide_sharpness * from_sun);
        // The narrow lobe is the wide one's twelfth power: three squares cost less than an exponential.
        let wide_4 = (wide * wide) * (wide * wide);
        radiance += sky.wide * wide + sky.narrow * (wide_4 * wide_4 * wide_4);
    }
    if sky.band.r > 0.0 {
        let side = 0.5 + 0.5 * dot(direction.xz, uniforms.clouds.sun_azimuth);
        radiance += sky.band * (side * side * exp2(-sky.band_sharpness * abs(direction.y)));
    }
    return radiance;
}

fn sky_radiance(direction: vec3f) -> vec3f {
    var radiance = clear_sky_light(direction);
    if uniforms.sky.overcast_weight > 0.0 {
        radiance = mix(radiance, uniforms.sky.overcast, uniforms.sky.overcast_weight);
    }
    if direction.y < 0.0 {
        radiance *= GROUND_FLOOR + (1.0 - GROUND_FLOOR) / (1.0 - GROUND_FALL * direction.y);
    }
    return radiance;
}
