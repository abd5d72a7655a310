// Shadows of clouds on the ground. Theory and CPU part: shadow.rs.

// Where a viewer in the middle of a texel has sun or moon on the plane of a layer of the method.
fn shadow_plane(index: i32, texel: vec2f) -> vec2f {
    let seen = uniforms.shadow.layers[index];
    return seen.corner + seen.texel * texel;
}

fn shadow_level(index: i32) -> f32 {
    return uniforms.shadow.layers[index].lod;
}

// Share of the direct light that comes through to the middle of a texel.
@fragment
fn fs_shadow(@builtin(position) position: vec4f) -> @location(0) f32 {
    let hidden = cloud_hidden(position.xy);
    return 1.0 - mix(hidden, 1.0, uniforms.shadow.shut) * cloud_clearness(uniforms.sky.sun_direction);
}
