// Crepuscular rays: shafts of light and shade from the sun through the clouds. Theory and CPU part: rays.rs.

// The direction of a place in the maps: x goes once around the sun, y away from it.
fn rays_direction(place: vec2f) -> vec3f {
    let rays = uniforms.rays;
    let chord = place.y * RAYS_REACH;
    let angle = TAU * place.x;
    let around = rays.right * cos(angle) + rays.up * sin(angle);
    return rays.sun_direction * (1.0 - 0.5 * chord * chord) + around * (chord * sqrt(1.0 - 0.25 * chord * chord));
}

// How much of the sun's light comes through: x: what the clouds leave, y: of how much, both 0 below the horizon.
@fragment
fn fs_rays_mask(@builtin(position) position: vec4f) -> @location(0) vec4f {
    let place = position.xy / RAYS_SIZE;
    let direction = rays_direction(place);
    if direction.y <= 0.0 {
        return vec4f(0.0);
    }
    // In the detail of the longer side of the texel, whatever the screen's.
    let texel = max(RAYS_TEXEL.x * place.y, RAYS_TEXEL.y);
    let left = 1.0 - cloud_layer(direction, texel * uniforms.rays.pixels_per_rad).a;
    return vec4f(vec2f(left, 1.0) * smoothstep(0.0, RAYS_HORIZON, direction.y), 0.0, 0.0);
}

// The light that comes along the way from the sun to a place, over that of a clear sky: Mitchell's sum over its own
// brightest value. x: the share; y: how much of the way is in the sky.
@fragment
fn fs_rays_sum(@builtin(position) position: vec4f) -> @location(0) vec4f {
    let place = position.xy / RAYS_SIZE;
    var light = vec2f(0.0);
    var all = 0.0;
    var weight = 1.0;
    for (var i = 0; i < RAYS_TAPS; i++) {
        let nearer = place.y * (1.0 - (f32(i) + 0.5) / f32(RAYS_TAPS));
        let at = vec2f(place.x, max(nearer, 0.5 / RAYS_SIZE.y));
        let source = weight / (1.0 + RAYS_SOURCE * nearer * nearer);
        light += source * textureSampleLevel(map_texture, repeat_sampler, at, 0.0).rg;
        all += source;
        weight *= RAYS_DECAY;
    }
    return vec4f(light.x / max(light.y, 1e-3), light.y / all, 0.0, 0.0);
}

// What is brighter and darker than its surroundings, as far from the sun: a byte of 128 is neither.
@fragment
fn fs_rays_streaks(@builtin(position) position: vec4f) -> @location(0) vec4f {
    let place = position.xy / RAYS_SIZE;
    let here = textureSampleLevel(map_texture, repeat_sampler, place, 0.0).rg;
    var sum = 0.0;
    var all = 1e-3;
    for (var i = 0; i < RAYS_AROUND; i++) {
        let away = (f32(i) + 0.5) / f32(RAYS_AROUND) * 2.0 - 1.0;
        let there = vec2f(place.x + away * RAYS_WINDOW, place.y);
        let look = textureSampleLevel(map_texture, repeat_sampler, there, 0.0).rg;
        let weight = (1.0 - away * away) * look.y;
        sum += weight * look.x;
        all += weight;
    }
    let streak = (here.x - sum / all) * here.y;
    return vec4f((128.0 + 127.0 * clamp(RAYS_GAIN * streak, -1.0, 1.0)) / 255.0, 0.0, 0.0, 0.0);
}

// The haze of a pixel, in the light or in the shade.
@fragment
fn fs_rays(in: Varyings) -> @location(0) vec4f {
    let rays = uniforms.rays;
    let direction = in.ray * inverseSqrt(dot(in.ray, in.ray));
    let away = direction - rays.sun_direction;
    let chord = length(away);
    if chord >= RAYS_REACH {
        return vec4f(0.0);
    }
    let angle = atan2(dot(away, rays.up), dot(away, rays.right));
    let half_row = 0.5 / RAYS_SIZE.y;
    let place = vec2f(angle / TAU, clamp(chord / RAYS_REACH, half_row, 1.0 - half_row));
    let streak = (textureSampleLevel(map_texture, repeat_sampler, place, 0.0).r * 255.0 - 128.0) / 127.0;
    let ends = smoothstep(0.0, RAYS_CORE, chord) * (1.0 - smoothstep(0.5 * RAYS_REACH, RAYS_REACH, chord));
    let ground = smoothstep(-RAYS_GROUND, 0.0, direction.y);
    let colour = select(rays.dark, rays.bright, streak > 0.0);
    let opacity = rays.opacity * exp2(-rays.fall * chord) * ends * ground * abs(streak);
    return vec4f(finish(colour, in.position.xy).rgb, opacity);
}
