// Clouds of the lit method: layers with normals on an oblate hemisphere. Theory and CPU part: mod.rs.

// Distance to the dome along a unit direction, in its heights.
fn lit_intersect(direction: vec3f) -> f32 {
    return inverseSqrt(uniforms.lit.flattening_squared + uniforms.lit.one_minus_squared * direction.y * direction.y);
}

// Level of detail of a texture with one texel a height: half way between the sides of the footprint.
fn lit_level(distance: f32, direction: vec3f, narrowing: f32) -> f32 {
    let side = distance * narrowing;
    return 0.5 * log2(max(side * side * max(distance * distance * direction.y, LIT_LEAST_STRETCH), 1e-12));
}

fn lit_uv(index: i32, plane: vec2f) -> vec2f {
    let east = uniforms.lit.layers[index].east_axis * plane.x;
    return east + uniforms.lit.layers[index].south_axis * plane.y + uniforms.lit.layers[index].offset;
}

// The finer read of an iteration, by its lowest layer.
struct LitGrain {
    denser: f32, // than most
    across: f32, // how its normal meets the sun
}

fn lit_grain(index: i32, plane: vec2f, level: f32) -> LitGrain {
    if uniforms.lit.layers[index].grain == 0.0 {
        return LitGrain(0.0, 0.0);
    }
    let uv = lit_uv(index, plane) * LIT_FINER + LIT_FINER_START;
    let kind = i32(uniforms.lit.layers[index].kind);
    let at_level = level + uniforms.lit.layers[index].lod_bias + LIT_FINER_LEVEL;
    let finer = textureSampleLevel(layers_texture, repeat_sampler, uv, kind, at_level);
    return LitGrain(finer.a - 0.5, LIT_FINER_RELIEF * dot(finer.xy * 2.0 - 1.0, uniforms.lit.layers[index].sun_uv));
}

// The way from a place of the plane to where sun or moon is seen, no longer than shade reaches.
fn lit_way(plane: vec2f) -> vec2f {
    let way = uniforms.lit.light_position - plane;
    return way * min(1.0, LIT_LONGEST_WAY * inverseSqrt(max(dot(way, way), 1e-12)));
}

// What a layer leaves of the light: the shade of the place itself and of two towards the sun, a radial blur.
fn lit_blurred(index: i32, plane: vec2f, way: vec2f, level: f32, own: f32) -> f32 {
    let coarse = max(level + uniforms.lit.layers[index].lod_bias, 0.0) + LIT_BLUR_LEVEL;
    let step = uniforms.lit.layers[index].blur_step;
    let near = textureSampleLevel(lit_map_texture, repeat_sampler, lit_uv(index, plane + step * way), index, coarse);
    let far = textureSampleLevel(lit_map_texture, repeat_sampler, lit_uv(index, plane + 2.0 * step * way), index, coarse);
    return dot(LIT_BLUR, vec3f(own, near.a, far.a));
}

// A layer along a ray, roughened by the grain.
struct LitCloud {
    falls: f32, // light that falls on it: eq. 3
    opacity: f32,
    shade: f32, // what it leaves of the light
}

// With the shade of the place alone.
fn lit_cloud(index: i32, plane: vec2f, level: f32, grain: LitGrain) -> LitCloud {
    let at_level = level + uniforms.lit.layers[index].lod_bias;
    let cloud = textureSampleLevel(lit_map_texture, repeat_sampler, lit_uv(index, plane), index, at_level);
    let rough = uniforms.lit.layers[index].grain * vec2f(grain.denser, grain.across);
    let alpha = clamp(cloud.b + rough.x * cloud.b * (1.0 - cloud.b), 0.0, 1.0);
    return LitCloud(max(cloud.r + rough.y, 0.0), alpha * uniforms.lit.layers[index].opacity, cloud.a);
}

// What has been drawn of a sky, from the highest layer down.
struct LitSum {
    sunlight: f32, // of sun or moon, as a factor on its light, times opacity
    skylight: f32, // of the sky, likewise
    clear: f32,    // what is left of the light behind
    shade: f32,    // what is left of the light from above
}

// Draws a layer before those behind it. `through` is eq. 4.
fn lit_over(behind: LitSum, cloud: LitCloud, through: f32) -> LitSum {
    let shade = cloud.shade * behind.shade; // eq. 5
    return LitSum(
        mix(behind.sunlight, (through + cloud.falls) * shade, cloud.opacity), // eq. 6
        mix(behind.skylight, LIT_AMBIENT_SHADED + LIT_AMBIENT_BRIGHTER * shade, cloud.opacity),
        behind.clear * (1.0 - cloud.opacity),
        behind.shade * (1.0 - LIT_SHADED_BY_LAYER * cloud.opacity),
    );
}

// Three layers, their reads first: none waits for another. Not a loop: constants at known places cost nothing.
fn lit_iteration(behind: LitSum, first: i32, plane: vec2f, level: f32, through: f32) -> LitSum {
    let grain = lit_grain(first, plane, level);
    let way = lit_way(plane);
    var low = lit_cloud(first, plane, level, grain);
    var middle = lit_cloud(first + 1, plane, level, grain);
    var high = lit_cloud(first + 2, plane, level, grain);
    low.shade = lit_blurred(first, plane, way, level, low.shade);
    middle.shade = lit_blurred(first + 1, plane, way, level, middle.shade);
    high.shade = lit_blurred(first + 2, plane, way, level, high.shade);
    return lit_over(lit_over(lit_over(behind, high, through), middle, through), low, through);
}

// Radiance and opacity of the clouds along a unit direction above the horizon.
fn lit_layer(direction: vec3f, narrowing: f32) -> vec4f {
    let distance = lit_intersect(direction);
    let plane = direction.xz * distance;
    let level = lit_level(distance, direction, narrowing);
    let scattered = uniforms.lit.k1 + uniforms.lit.k2 * dot(direction, uniforms.lit.light_direction);
    let through = pow(max(scattered, 0.0), uniforms.lit.m); // eq. 4
    var sum = LitSum(0.0, 0.0, 1.0, 1.0);
    if uniforms.lit.count > LIT_LAYERS_AN_ITERATION {
        sum = lit_iteration(sum, LIT_LAYERS_AN_ITERATION, plane, level, through);
    }
    sum = lit_iteration(sum, 0, plane, level, through);
    let alpha = 1.0 - sum.clear;
    // A low sun lights the sides of clouds that are seen away from it, where eq. 3 knows their undersides alone.
    let away = 0.5 - 0.5 * dot(direction, uniforms.lit.light_direction);
    let sides = LIT_SIDES * uniforms.clouds.low_sun * away * sum.skylight;
    let sunlight = sum.sunlight * cloud_facing(direction, alpha) + sides;
    var radiance = sunlight * uniforms.lit.light + sum.skylight * uniforms.lit.ambient;
    if uniforms.clouds.sunset > 0.0 {
        radiance *= mix(vec3f(1.0), uniforms.clouds.tint, cloud_tint(direction));
    }
    return vec4f(radiance / max(alpha, 1e-4), alpha * cloud_clearness(direction));
}
