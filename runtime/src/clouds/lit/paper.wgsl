// Clouds of the lit method as the paper lights them: equations 4 to 6. CPU part: paper.rs.

// The way from a place of the plane to where sun or moon is seen, no longer than shade reaches.
fn lit_way(plane: vec2f) -> vec2f {
    let way = uniforms.lit.light_position - plane;
    return way * min(1.0, LIT_LONGEST_WAY * inverseSqrt(max(dot(way, way), 1e-12)));
}

// What a layer leaves of the light: the shade of the place itself and of two towards the sun, a radial blur.
fn lit_blurred(index: i32, plane: vec2f, way: vec2f, level: f32, own: f32) -> f32 {
    let coarse = max(level + uniforms.lit.layers[index].lod_bias, 0.0) + LIT_BLUR_LEVEL;
    let step = uniforms.lit.layers[index].blur_step;
    let near = lit_read(index, plane + step * way, coarse);
    let far = lit_read(index, plane + 2.0 * step * way, coarse);
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
    let cloud = lit_read(index, plane, level + uniforms.lit.layers[index].lod_bias);
    let across = uniforms.lit.layers[index].grain * grain.across;
    return LitCloud(max(cloud.r + across, 0.0), lit_opacity(index, cloud.b, grain), cloud.a);
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

fn lit_paper_layer(direction: vec3f, narrowing: f32) -> vec4f {
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
    var radiance = sum.sunlight * uniforms.lit.light + sum.skylight * uniforms.lit.ambient;
    if uniforms.clouds.sunset > 0.0 {
        radiance *= mix(vec3f(1.0), uniforms.clouds.tint, cloud_tint(direction));
    }
    return vec4f(radiance / max(alpha, 1e-4), alpha * cloud_clearness(direction));
}
