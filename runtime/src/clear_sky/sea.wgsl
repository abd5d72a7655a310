// A sea below the horizon. Theory and CPU part: sea.rs.

// Schlick's form of Fresnel's law for water, by the cosine to the facet.
fn sea_fresnel(cosine: f32) -> f32 {
    let lacking = clamp(1.0 - cosine, 0.0, 1.0);
    let squared = lacking * lacking;
    return SEA_WATER + (1.0 - SEA_WATER) * squared * squared * lacking;
}

// What a facet of this slope towards the viewer reflects, and its share of the light.
fn sea_facet(direction: vec3f, heading: vec2f, slope: f32) -> vec4f {
    let normal = vec3f(-slope * heading.x, 1.0, -slope * heading.y) * inverseSqrt(1.0 + slope * slope);
    let cosine = max(-dot(direction, normal), 0.0);
    let back = direction + 2.0 * cosine * normal;
    let towards = normalize(vec3f(back.x, max(back.y, SEA_LEAST_RISE), back.z));
    let sea = uniforms.sea;
    let shares = cloud_scattered(towards, sea.middling.x, sea.middling.y);
    let clouds = shares.x * sea.cloud_sunlit + sea.cloud_skylit;
    let share = sea_fresnel(cosine);
    return vec4f(share * mix(sky_above(towards), clouds, sea.cloud_opacity * cloud_clearness(towards)), share);
}

// What the noise, read so many times finer, has over its mean.
fn sea_wave(uv: vec2f, times: vec2f, drift: vec2f, level: f32) -> f32 {
    return textureSampleLevel(clouds_texture, repeat_sampler, uv * times + drift, level + 0.5 * log2(times.x * times.y)).b - uniforms.ground.mean;
}

// What is seen along a direction below the horizon, where the sky's radiance is `horizon`.
fn sea_seen(horizon: vec3f, direction: vec3f) -> vec3f {
    let ground = uniforms.ground;
    let sea = uniforms.sea;
    let down = max(-direction.y, 1e-6);
    let flat = sqrt(max(1.0 - down * down, 1e-6));
    let heading = direction.xz / flat;
    let away = 1.0 / down;
    let uv = ground.place + direction.xz * (away * ground.height_tiles);
    let level = ground.lod - 1.5 * log2(down);
    let wind = textureSampleLevel(clouds_texture, repeat_sampler, uv, level).b - ground.mean;
    let waves = vec3f(
        sea_wave(uv, vec2f(SEA_FINER.x, SEA_ACROSS.x), sea.long_drift, level),
        sea_wave(uv, vec2f(SEA_FINER.y, SEA_ACROSS.y), sea.short_drift, level),
        sea_wave(uv, vec2f(SEA_FINER.z, SEA_ACROSS.z), -sea.short_drift, level),
    );
    let gust = max(1.0 + SEA_GUSTS * wind, 0.3);
    let ripple = sea.ripple * gust * dot(SEA_SHARES, waves);

    // Where single waves are seen, facets have less of the slopes. Those that are seen lean towards the viewer.
    let alone = clamp(1.0 - (level + log2(SEA_FINER.z)) / SEA_SEEN.y, 0.0, 1.0);
    let deviation = sea.deviation * gust * (1.0 - SEA_SEEN.x * alone);
    let x = down / (deviation * flat);
    let share = 1.0 / (1.0 + exp(-1.702 * x));
    let over = x * share + 0.3989423 * exp(-0.5 * x * x);
    let lean = deviation * share / over + ripple;

    let flatter = sea_facet(direction, heading, lean - SEA_SPREAD * deviation);
    let steeper = sea_facet(direction, heading, lean + SEA_SPREAD * deviation);
    let reflected = 0.5 * (flatter + steeper);

    var glitter = vec3f(0.0);
    let sun = uniforms.sky.sun_direction;
    let between = normalize(sun - direction);
    if sun.y > 0.0 && between.y > 0.05 {
        let hidden = cloud_layer(sun, sea.softer).a;
        let slope = (between.xz / between.y + ripple * heading) / deviation;
        let density = exp(-0.5 * dot(slope, slope)) / (TAU * deviation * deviation);
        let up = between.y * between.y;
        let area = deviation * flat * over + sea.sun_hidden * down;
        glitter = (1.0 - hidden) * sea.sun * (sea_fresnel(dot(between, sun)) * density / (up * up * area));
    }
    let lit = reflected.rgb + glitter + sea.body * (1.0 - reflected.a);
    return mix(horizon, lit, exp2(-ground.depth * away));
}
