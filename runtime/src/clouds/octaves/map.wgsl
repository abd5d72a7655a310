// The map of the octaves method: every octave up-sampled, filtered, tiled and summed. CPU part: map.rs.

// The four weights of the cubic B-spline between two texels.
fn octaves_spline(t: vec2f) -> array<vec2f, 4> {
    let s = 1.0 - t;
    return array<vec2f, 4>(
        s * s * s / 6.0,
        (4.0 + 3.0 * t * t * (t - 2.0)) / 6.0,
        (4.0 + 3.0 * s * s * (s - 2.0)) / 6.0,
        t * t * t / 6.0,
    );
}

// An octave at a place in texels of its noise: sixteen weighted texels by four bilinear reads (C. Sigg, M. Hadwiger,
// "Fast Third-Order Texture Filtering", GPU Gems 2, 2005).
fn octaves_filtered(place: vec2f, octave: i32) -> f32 {
    let centre = place - 0.5;
    let first = floor(centre);
    let w = octaves_spline(centre - first);
    let near = w[0] + w[1];
    let far = w[2] + w[3];
    let low = (first - 0.5 + w[1] / near) / OCTAVE_NOISE_SIDE;
    let high = (first + 1.5 + w[3] / far) / OCTAVE_NOISE_SIDE;
    let upper = near.x * octaves_noise(low, octave) + far.x * octaves_noise(vec2f(high.x, low.y), octave);
    let lower = near.x * octaves_noise(vec2f(low.x, high.y), octave) + far.x * octaves_noise(high, octave);
    return near.y * upper + far.y * lower;
}

fn octaves_noise(uv: vec2f, octave: i32) -> f32 {
    return textureSampleLevel(layers_texture, repeat_sampler, uv, octave, 0.0).r;
}

// The weighted octaves from the first up to `count`.
fn octaves_sum(uv: vec2f, first: i32, count: i32) -> f32 {
    var sum = 0.0;
    for (var k = first; k < count; k++) {
        sum += octaves_filtered(uv * uniforms.octaves.copies[k >> 2u][k & 3] * OCTAVE_NOISE_SIDE, k);
    }
    return sum;
}

// R: the amount; G: opacity of the low dome; B: of the middle dome; A: what it leaves of sunlight, or its display-referred grey as the paper
// shades it.
@fragment
fn fs_octaves_map(@builtin(position) position: vec4f) -> @location(0) vec4f {
    let octaves = uniforms.octaves;
    let uv = position.xy / octaves.resolution;
    let count = i32(octaves.count);
    let large = min(count, OCTAVE_RELIEF_COUNT);
    // Finer octaves have no slope over a step: they would only add noise to the relief.
    let small = octaves_sum(uv, large, count);
    let amount = normal_share(photo_over(octaves_sum(uv, 0, large) + small, uv));
    let there = uv + octaves.sun_step;
    let towards_sun = normal_share(photo_over(octaves_sum(there, 0, large) + small, there));
    let relief = octaves.relief * (amount - towards_sun);
    let thickness = amount - octaves.low.threshold;
    let low = octaves_alpha(thickness, octaves.exponent);
    let middle = octaves_alpha(amount - octaves.middle.threshold, OCTAVE_THIN * octaves.exponent);
    // In an overcast sky the cut is below 0, and what lies under 0 does not darken.
    let above = max(amount - max(octaves.low.threshold, 0.0), 0.0);
    if SCATTERED {
        return vec4f(amount, low, middle, exp2(-max(octaves.extinction * (above - relief), 0.0)));
    }
    return vec4f(amount, low, middle, octaves.edge_grey + relief - octaves.darkening * above);
}
