// Lightning: a flash that lights clouds from inside. Theory and CPU part: lightning.rs.

// What a flash adds to clouds of this colour and opacity along a unit direction above the horizon.
fn lightning_light(direction: vec3f, clouds: vec4f) -> vec3f {
    let flash = uniforms.lightning;
    let apart = dome_intersect(direction).plane - flash.position;
    let square = dot(apart, apart);
    let wide = 1.0 / (1.0 + LIGHTNING_GLOW_FALL * square);
    let glow = LIGHTNING_CORE * exp2(-LIGHTNING_CORE_FALL * square) + wide * wide;
    // Light from inside shows most where light from outside shows least.
    let bright = clamp(flash.per_white * dot(clouds.rgb, LUMINANCE), 0.0, 1.0);
    return flash.light * (glow * clouds.a * clouds.a * (1.0 - LIGHTNING_THIN * bright));
}
