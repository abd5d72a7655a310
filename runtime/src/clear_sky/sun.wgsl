// The sun: a square that always faces the screen, and what a lens scatters of it. CPU part: sun.rs.

// Adds it to a radiance where `share` of its light comes through.
fn sun_added(radiance: vec3f, direction: vec3f, share: f32) -> vec3f {
    let cosine = dot(direction, uniforms.sky.sun_direction);
    if cosine <= uniforms.sun.least_cosine {
        return radiance;
    }
    let sun = uniforms.sun;
    let root = inverseSqrt(2.0 - 2.0 * min(cosine, 1.0) + SUN_GLARE_CORE);
    var glare = sun.glare * max(root * root * root - SUN_GLARE_END, 0.0);
    if sun.has_corona > 0.5 {
        // The inverse square of the distance in radii of the sun; behind its disc there is no more. A cosine has too few digits for it.
        let away = direction - uniforms.sky.sun_direction;
        let near = min(SUN_GLARE_CORE / max(dot(away, away), 1e-9), 1.0);
        // Powers by products: a GPU's logarithm is off by more than the steepest of them bears.
        let side = sqrt(near);
        let square = near * near;
        let profile = 2.565 * square * square * square * square * side + 1.425 * square * near * side + 0.0532 * near * sqrt(side);
        glare += sun.corona * max(profile - SUN_CORONA_END, 0.0);
    }
    let place = vec2f(dot(direction, sun.right), -dot(direction, sun.up));
    let around = radiance + share * glare;
    if max(abs(place.x), abs(place.y)) >= 1.0 {
        return around;
    }
    let covered = textureSampleLevel(sun_texture, clamp_sampler, 0.5 + 0.5 * place, sun.lod).r;
    return around + disc_shown(share * sun.disc) * (covered * smoothstep(-SUN_HORIZON, SUN_HORIZON, direction.y));
}

// What the target shows of the light of a disc, of sun or moon.
fn disc_shown(light: vec3f) -> vec3f {
    return light * min(1.0, uniforms.sun.brightest / max(max(light.r, light.g), max(light.b, 1e-6)));
}
