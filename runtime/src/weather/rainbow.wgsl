// The rainbow about the antisolar point. Theory and CPU part: rainbow.rs.

// What drops send along a unit direction beyond what they send to all sides.
fn rainbow_light(direction: vec3f) -> vec3f {
    let cosine = dot(direction, uniforms.rainbow.antisolar);
    let last = f32(RAINBOW_LAST);
    var colour: vec3f;
    if cosine > uniforms.rainbow.band {
        let place = clamp((uniforms.rainbow.primary_from - cosine) * uniforms.rainbow.primary_per_cosine, 0.0, last);
        let here = u32(place);
        let next = min(here + 1u, RAINBOW_LAST);
        colour = mix(uniforms.rainbow.primary[here].colour, uniforms.rainbow.primary[next].colour, fract(place));
    } else {
        let place = clamp((uniforms.rainbow.secondary_from - cosine) * uniforms.rainbow.secondary_per_cosine, 0.0, last);
        let here = u32(place);
        let next = min(here + 1u, RAINBOW_LAST);
        colour = mix(uniforms.rainbow.secondary[here].colour, uniforms.rainbow.secondary[next].colour, fract(place));
        let beyond = uniforms.rainbow.secondary_from - last / uniforms.rainbow.secondary_per_cosine - cosine;
        colour *= clamp(1.0 - RAINBOW_ENDS * beyond, 0.0, 1.0);
    }
    // Less rain lies before near ground.
    let over = clamp(1.0 + direction.y / RAINBOW_GROUND, 0.0, 1.0);
    return uniforms.rainbow.light * colour * over;
}
