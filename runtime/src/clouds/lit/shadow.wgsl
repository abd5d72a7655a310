// Shadows of the lit method's clouds on the ground. Theory and CPU part: shadow.rs.

// What three layers leave of the light, from the first of an iteration. Not a loop: see lit_iteration.
fn shadow_iteration(first: i32, texel: vec2f) -> f32 {
    let grain = lit_grain(first, shadow_plane(first, texel), uniforms.shadow.layers[first].lod);
    return shadow_layer(first, texel, grain) * shadow_layer(first + 1, texel, grain) * shadow_layer(first + 2, texel, grain);
}

fn shadow_layer(index: i32, texel: vec2f, grain: LitGrain) -> f32 {
    return 1.0 - lit_cloud(index, shadow_plane(index, texel), uniforms.shadow.layers[index].lod, grain).opacity;
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
