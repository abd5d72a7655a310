// Clouds of the fbm method: one map of drifting octaves. Theory and CPU part: fbm.rs.
struct FbmUniforms {
    axes: vec4f,   // xy: what a height to the east, zw: to the south adds to uv
    place: vec4f,  // xy: offset; z: level of detail at distance 1
    remap: vec4f,  // x: m; y: n; z: octaves; w: texels a side of the map
    lit: vec4f,    // rgb: the lit colour; w: what the shade is multiplied by
    shaded: vec4f, // rgb: the shaded colour; w: share of the finer read
    step: vec4f,   // xy: a step of the ray towards the sun, in tiles; z: mean of the sum of octaves; w: n for the ray's heights
    offsets_a: vec4f, // offsets of octaves 1 and 2
    offsets_b: vec4f, // 3 and 4
    offsets_c: vec4f, // 5 and 6
    offsets_d: vec4f, // 7 and 8
    weights_a: vec4f, // weights of octaves 1 to 4
    weights_b: vec4f, // 5 to 8
}

// Radiance and opacity of the clouds along a unit direction above the horizon.
fn fbm_layer(direction: vec3f, narrowing: f32) -> vec4f {
    let fbm = uniforms.fbm;
    let hit = dome_intersect(direction);
    let level = cloud_level(hit, narrowing) + fbm.place.z;
    let uv = fbm.axes.xy * hit.plane.x + fbm.axes.zw * hit.plane.y + fbm.place.xy;
    let cloud = textureSampleLevel(map_texture, repeat_sampler, uv, level);
    let finer_uv = uv * FBM_FINER + FBM_FINER_START;
    let finer = textureSampleLevel(map_texture, repeat_sampler, finer_uv, level + FBM_FINER_LEVEL).g - fbm.step.z;
    // Finer octaves roughen edges and mottle what is full; they neither open nor close the sky.
    let rough = 4.0 * fbm.shaded.w * finer * cloud.a * (1.0 - cloud.a);
    let alpha = smoothstep(0.0, FBM_FULL, cloud.a + rough);
    let shade = clamp(fbm.lit.w * (cloud.r + FBM_ROUGH_SHADE * finer * cloud.a), 0.0, 1.0);
    let colour = mix(fbm.lit.rgb, fbm.shaded.rgb, shade);
    let tinted = colour * mix(vec3f(1.0), uniforms.clouds.tint.rgb, cloud_tint(direction));
    let radiance = tinted * (uniforms.clouds.sunlight.rgb + uniforms.clouds.ambient.rgb);
    return vec4f(radiance, alpha * cloud_clearness(direction));
}
