// Shadows of the lit method's clouds on the ground. Theory and CPU part: shadow.rs.

// What three layers leave of the light, from the first of an iteration. Not a loop: see lit_three.
fn shadow_iteration(first: i32, texel: vec2f) -> f32 {
    let sun = uniforms.lit.light_direction;
    let plane = shadow_plane(first, texel);
    let level = shadow_level(first);
    let grain = lit_grain(first, plane, level);
    var clear = 1.0;
    if SCATTERED {
        clear -= lit_opacity(first, lit_low(first, sun, plane, level).b, grain);
    } else {
        clear -= shadow_opacity(first, texel, grain);
    }
    return clear * (1.0 - shadow_opacity(first + 1, texel, grain)) * (1.0 - shadow_opacity(first + 2, texel, grain));
}

fn shadow_opacity(index: i32, texel: vec2f, grain: LitGrain) -> f32 {
    let level = shadow_level(index) + uniforms.lit.layers[index].lod_bias;
    return lit_opacity(index, lit_read(index, shadow_plane(index, texel), level).b, grain);
}

// As soft as a viewer sees a layer before sun or moon.
fn shadow_level(index: i32) -> f32 {
    return uniforms.shadow.layers[index].lod + select(0.0, lit_softer(uniforms.lit.light_direction), SCATTERED);
}

fn shadow_plane(index: i32, texel: vec2f) -> vec2f {
    let seen = uniforms.shadow.layers[index];
    return seen.corner + seen.texel * texel;
}

// Share of the direct light that comes through to the middle of a texel.
@fragment
fn fs_shadow(@builtin(position) position: vec4f) -> @location(0) f32 {
    var clear = shadow_iteration(0, position.xy);
    if uniforms.lit.count > LIT_LAYERS_AN_ITERATION {
        clear *= shadow_iteration(LIT_LAYERS_AN_ITERATION, position.xy);
    }
    return 1.0 - (1.0 - clear) * cloud_clearness(uniforms.lit.light_direction);
}
