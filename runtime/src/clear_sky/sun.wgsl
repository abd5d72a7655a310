// The sun: a square that always faces the screen. CPU part: sun.rs.

fn sun_radiance(direction: vec3f) -> vec3f {
    let sun = uniforms.sun;
    if sun.is_shown == 0.0 {
        return vec3f(0.0);
    }
    let place = vec2f(dot(direction, sun.right), -dot(direction, sun.up));
    let ahead = dot(direction, sun.direction) > 0.0;
    if !ahead || max(abs(place.x), abs(place.y)) >= 1.0 {
        return vec3f(0.0);
    }
    let glow = textureSampleLevel(sun_texture, clamp_sampler, 0.5 + 0.5 * place, sun.glow_lod).g;
    var radiance = sun.glow * glow;
    let inner = place * sun.glow_to_disc;
    if max(abs(inner.x), abs(inner.y)) < 1.0 {
        let disc = textureSampleLevel(sun_texture, clamp_sampler, 0.5 + 0.5 * inner, sun.disc_lod).r;
        radiance += sun.disc * disc;
    }
    return radiance * smoothstep(-SUN_HORIZON, SUN_HORIZON, direction.y);
}
