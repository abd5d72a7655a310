// The clear sky: day gradient, light scattered around the sun, haze below the horizon. CPU part: sky.rs.
struct SkyUniforms {
    gradient: vec4f, // x: u of the time; y, z: v = y + z * sqrt(sin elevation); w: share of the night sky
    sun: vec4f,      // xyz: unit direction towards the sun
    wide: vec4f,     // rgb: radiance of the wide lobe towards the sun; w: its sharpness
    narrow: vec4f,   // rgb: radiance of the narrow lobe
    band: vec4f,     // rgb: radiance of the twilight band on the horizon; w: how fast it fades upwards
    overcast: vec4f, // rgb: radiance of a shut sky; w: how far the sky is shut
}

// The gradient's clear sky along a unit direction.
fn gradient_light(direction: vec3f) -> vec3f {
    let sky = uniforms.sky;
    let up = max(direction.y, 0.0);
    let uv = vec2f(sky.gradient.x, sky.gradient.y + sky.gradient.z * sqrt(up));
    var radiance = textureSampleLevel(sky_texture, repeat_sampler, uv, 0.0).rgb;

    // No lobes by night.
    if sky.wide.r > 0.0 {
        let from_sun = dot(direction, sky.sun.xyz) - 1.0;
        let wide = exp2(sky.wide.w * from_sun);
        // The narrow lobe is the wide one's twelfth power: three squares cost less than an exponential.
        let wide_4 = (wide * wide) * (wide * wide);
        radiance += sky.wide.rgb * wide + sky.narrow.rgb * (wide_4 * wide_4 * wide_4);
    }
    if sky.band.r > 0.0 {
        let side = 0.5 + 0.5 * dot(direction.xz, uniforms.clouds.gradient.xy);
        radiance += sky.band.rgb * (side * side * exp2(-sky.band.w * abs(direction.y)));
    }
    return radiance;
}

fn sky_radiance(direction: vec3f) -> vec3f {
    var radiance = clear_sky_light(direction);
    if uniforms.sky.overcast.w > 0.0 {
        radiance = mix(radiance, uniforms.sky.overcast.rgb, uniforms.sky.overcast.w);
    }
    if direction.y < 0.0 {
        radiance *= GROUND_FLOOR + (1.0 - GROUND_FLOOR) / (1.0 - GROUND_FALL * direction.y);
    }
    return radiance;
}
