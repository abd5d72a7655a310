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

fn lit_read(index: i32, plane: vec2f, level: f32) -> vec4f {
    return textureSampleLevel(lit_map_texture, repeat_sampler, lit_uv(index, plane), index, level);
}

// Opacity of a layer, its edges roughened by the grain.
fn lit_opacity(index: i32, opacity: f32, grain: LitGrain) -> f32 {
    let rough = uniforms.lit.layers[index].grain * grain.denser;
    return clamp(opacity + rough * opacity * (1.0 - opacity), 0.0, 1.0) * uniforms.lit.layers[index].opacity;
}

// What has been drawn of a sky, from the highest layer down.
struct LitLight {
    shares: vec2f, // of sunlight and of skylight, times opacity
    clear: f32,    // what is left of the light behind
    shade: f32,    // what is left of the light from above
}

// Draws a layer, as its map has it, before those behind it.
fn lit_before(behind: LitLight, index: i32, cloud: vec4f, grain: LitGrain, direction: vec3f) -> LitLight {
    let opacity = lit_opacity(index, cloud.b, grain);
    let deeper = LIT_GRAIN_DEEPER.x + LIT_GRAIN_DEEPER.y * uniforms.lit.overcast;
    let own = uniforms.lit.layers[index].grain * (grain.across - deeper * grain.denser);
    let depth = -log2(max(cloud.r, LIT_DARKEST)) / CLOUD_MULTIPLE.y - LIT_GRAIN_DEPTH * own * cloud.a;
    let shares = cloud_scattered(direction, max(depth, 0.0), cloud.a);
    // Under an overcast light is even: no layer is seen by its shade.
    let shading = mix(opacity, uniforms.lit.layers[index].opacity, uniforms.lit.overcast);
    return LitLight(
        mix(behind.shares, shares * vec2f(behind.shade, 1.0), opacity),
        behind.clear * (1.0 - opacity),
        behind.shade * (1.0 - LIT_SHADED_BY_LAYER * shading),
    );
}

// A layer with the sides of its clouds: where there is none over the base's place, the ray goes on, and meets what stands farther away. Near
// the horizon it meets so many that they close to a bank.
fn lit_sided(base: vec4f, side: vec4f, far: vec4f, bank: f32) -> vec4f {
    let own = mix(base, far, LIT_BANK_BLUR * bank);
    let clear = 1.0 - own.b;
    let over = clear * clamp((side.b - LIT_SIDE_FROM) / (1.0 - LIT_SIDE_FROM), 0.0, 1.0);
    let beyond = bank * (clear - over) * (1.0 - (1.0 - far.b) * (1.0 - far.b));
    let opacity = max(own.b + over + beyond, 1e-4);
    let shares = vec3f(own.b, over, beyond) / opacity;
    // Less cloud lies over sides.
    let light = dot(shares, vec3f(own.r, mix(side.r, 1.0, LIT_SIDE_LIGHT.x), mix(far.r, 1.0, LIT_SIDE_LIGHT.y)));
    return vec4f(light, own.g, opacity, dot(shares, vec3f(own.a, side.a, far.a)));
}

// The lowest layer of an iteration where a ray meets it, with the sides of its clouds.
fn lit_low(first: i32, direction: vec3f, plane: vec2f, level: f32) -> vec4f {
    let flat = max(length(direction.xz), 1e-4);
    let rise = min(uniforms.lit.layers[first].side * flat / max(direction.y, 1e-4), uniforms.lit.layers[first].most_side);
    let out = direction.xz * (rise / flat);
    let own_level = level + uniforms.lit.layers[first].lod_bias;
    let base = lit_read(first, plane, own_level);
    let side = lit_read(first, plane + out, max(own_level, 0.0) + LIT_SIDE_LEVELS.x);
    let far = lit_read(first, plane + 2.0 * out, max(own_level, 0.0) + LIT_SIDE_LEVELS.y);
    return lit_sided(base, side, far, 1.0 - smoothstep(LIT_BANK.x, LIT_BANK.y, direction.y));
}

// How much coarser clouds are read towards the horizon, in levels.
fn lit_softer(direction: vec3f) -> f32 {
    return LIT_SOFTER.x * (1.0 - smoothstep(0.0, LIT_SOFTER.y, direction.y));
}

// Three layers, their reads first: none waits for another. Not a loop: constants at known places cost nothing.
fn lit_three(behind: LitLight, first: i32, direction: vec3f, plane: vec2f, level: f32) -> LitLight {
    let grain = lit_grain(first, plane, level);
    let low = lit_low(first, direction, plane, level);
    let middle = lit_read(first + 1, plane, level + uniforms.lit.layers[first + 1].lod_bias);
    let high = lit_read(first + 2, plane, level + uniforms.lit.layers[first + 2].lod_bias);
    var sum = lit_before(behind, first + 2, high, grain, direction);
    sum = lit_before(sum, first + 1, middle, grain, direction);
    return lit_before(sum, first, low, grain, direction);
}

// Radiance and opacity of the clouds along a unit direction above the horizon.
fn lit_layer(direction: vec3f, narrowing: f32) -> vec4f {
    if SCATTERED {
        return lit_scattered_layer(direction, narrowing);
    }
    return lit_paper_layer(direction, narrowing);
}

fn lit_scattered_layer(direction: vec3f, narrowing: f32) -> vec4f {
    let distance = lit_intersect(direction);
    let plane = direction.xz * distance;
    let level = lit_level(distance, direction, narrowing) + lit_softer(direction);
    var sum = LitLight(vec2f(0.0), 1.0, 1.0);
    if uniforms.lit.count > LIT_LAYERS_AN_ITERATION {
        sum = lit_three(sum, LIT_LAYERS_AN_ITERATION, direction, plane, level);
    }
    sum = lit_three(sum, 0, direction, plane, level);
    let alpha = 1.0 - sum.clear;
    let radiance = cloud_lit(sum.shares, cloud_tint(direction)) / max(alpha, 1e-4);
    return vec4f(radiance, alpha * cloud_clearness(direction));
}
