// The sun: a square that always faces the screen, and what a lens scatters of it. CPU part: sun.rs.

fn sun_radiance(direction: vec3f) -> vec3f {
    let sun = uniforms.sun;
    if sun.is_shown == 0.0 {
        return vec3f(0.0);
    }
    let cosine = dot(direction, sun.direction);
    let root = inverseSqrt(2.0 - 2.0 * min(cosine, 1.0) + SUN_GLARE_CORE);
    let glare = sun.glare * (root * root * root);
    let place = vec2f(dot(direction, sun.right), -dot(direction, sun.up));
    if cosine <= 0.0 || max(abs(place.x), abs(place.y)) >= 1.0 {
        return glare;
    }
    let disc = textureSampleLevel(sun_texture, clamp_sampler, 0.5 + 0.5 * place, sun.lod).r;
    return glare + sun.disc * (disc * smoothstep(-SUN_HORIZON, SUN_HORIZON, direction.y));
}
