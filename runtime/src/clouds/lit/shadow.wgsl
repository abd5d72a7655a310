// What clouds hide of sun or moon from a place on the ground: see clouds/shadow.wgsl.

// What three layers leave of the light, from the first of an iteration. Not a loop: see lit_three.
fn lit_open_three(first: i32, texel: vec2f) -> f32 {
    let sun = uniforms.lit.light_direction;
    let plane = shadow_plane(first, texel);
    let level = lit_shadow_level(first);
    let grain = lit_grain(first, plane, level);
    var clear = 1.0;
    if SCATTERED {
        clear -= lit_opacity(first, lit_low(first, sun, plane, level).b, grain);
    } else {
        clear -= lit_shadow_opacity(first, texel, grain);
    }
    return clear * (1.0 - lit_shadow_opacity(first + 1, texel, grain)) * (1.0 - lit_shadow_opacity(first + 2, texel, grain));
}

fn lit_shadow_opacity(index: i32, texel: vec2f, grain: LitGrain) -> f32 {
    let level = lit_shadow_level(index) + uniforms.lit.layers[index].lod_bias;
    return lit_opacity(index, lit_read(index, shadow_plane(index, texel), level).b, grain);
}

// As soft as a viewer sees a layer before sun or moon.
fn lit_shadow_level(index: i32) -> f32 {
    return shadow_level(index) + select(0.0, lit_softer(uniforms.lit.light_direction), SCATTERED);
}

// Share of the light of sun or moon that the clouds hide from the middle of a texel of the shadows.
fn lit_hidden(texel: vec2f) -> f32 {
    var open = lit_open_three(0, texel);
    if uniforms.lit.count > LIT_LAYERS_AN_ITERATION {
        open *= lit_open_three(LIT_LAYERS_AN_ITERATION, texel);
    }
    return 1.0 - open;
}
