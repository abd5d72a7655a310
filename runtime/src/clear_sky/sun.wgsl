// The sun: a square that always faces the screen. CPU part: sun.rs.
struct SunUniforms {
    right: vec4f, // xyz: screen's right about the sun, over the half side of the glow; w: glow's half side over the disc's
    up: vec4f,    // xyz: the same upwards; w: 1 if there is a sun to draw
    disc: vec4f,  // rgb: radiance of the disc; w: level of the texture for it
    glow: vec4f,  // rgb: radiance of the glow; w: level of the texture for it
    towards: vec4f, // xyz: unit direction towards what is drawn, the sun or the moon
}

fn sun_radiance(direction: vec3f) -> vec3f {
    let sun = uniforms.sun;
    if sun.up.w == 0.0 {
        return vec3f(0.0);
    }
    let place = vec2f(dot(direction, sun.right.xyz), -dot(direction, sun.up.xyz));
    let ahead = dot(direction, sun.towards.xyz) > 0.0;
    if !ahead || max(abs(place.x), abs(place.y)) >= 1.0 {
        return vec3f(0.0);
    }
    let glow = textureSampleLevel(sun_texture, clamp_sampler, 0.5 + 0.5 * place, sun.glow.w).g;
    var radiance = sun.glow.rgb * glow;
    let inner = place * sun.right.w;
    if max(abs(inner.x), abs(inner.y)) < 1.0 {
        let disc = textureSampleLevel(sun_texture, clamp_sampler, 0.5 + 0.5 * inner, sun.disc.w).r;
        radiance += sun.disc.rgb * disc;
    }
    return radiance * smoothstep(-SUN_HORIZON, SUN_HORIZON, direction.y);
}
