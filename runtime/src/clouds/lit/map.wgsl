// The map of the lit method: light, opacity and shade of three layers at once. CPU part: map.rs.
override FIRST_LAYER: i32 = 0;

struct LitTargets {
    @location(0) first: vec4f,
    @location(1) second: vec4f,
    @location(2) third: vec4f,
}

// The share of places with less than this blend of two even numbers: the integral of a trapezoid.
fn lit_even(blend: f32) -> f32 {
    let foot = LIT_SECOND_WEIGHT;
    let corner = 0.5 / (LIT_FIRST_WEIGHT * LIT_SECOND_WEIGHT);
    if blend < foot {
        return corner * blend * blend;
    }
    if blend > LIT_FIRST_WEIGHT {
        return 1.0 - corner * (1.0 - blend) * (1.0 - blend);
    }
    return (blend - 0.5 * foot) / LIT_FIRST_WEIGHT;
}

// The pack's texture where a layer reads it, both reads blended.
struct LitNoise {
    normal: vec2f,
    density: f32,
    amount: f32,
}

fn lit_noise(layer: LitLayerUniforms, uv: vec2f) -> LitNoise {
    let kind = i32(layer.kind);
    let here = textureSampleLevel(layers_texture, repeat_sampler, uv, kind, 0.0);
    let other = textureSampleLevel(layers_texture, repeat_sampler, uv + layer.second_offset, kind, 0.0);
    let blend = LIT_FIRST_WEIGHT * here + LIT_SECOND_WEIGHT * other;
    return LitNoise(blend.rg, blend.b, lit_even(blend.a));
}

// R: light that falls on the cloud; G: the amount of cloud; B: opacity; A: shade by the place alone.
fn lit_map_texel(index: i32, uv: vec2f) -> vec4f {
    let layer = uniforms.lit.layers[index];
    let cloud = lit_noise(layer, uv);
    let slope = layer.relief * (cloud.normal * 2.0 - 1.0);
    let upward = sqrt(max(1.0 - dot(slope, slope), LIT_LEAST_UP));
    let falls = max(dot(slope, layer.sun_uv) + upward * uniforms.lit.light_direction.y, 0.0); // eq. 3
    let thickness = max(cloud.amount - layer.threshold, 0.0);
    let alpha = smoothstep(0.0, 1.0, layer.steepness * thickness);
    // Eq. 5 with C = 1 - 2^(-w s), so that it never ends: (1 - C)^m.
    let shade = exp2(-uniforms.lit.m * layer.shade_rate * lit_thick(layer, cloud));
    return vec4f(falls, cloud.amount, alpha, shade);
}

// What a place holds back of the light: thickness above the cut, more where it is dense.
fn lit_thick(layer: LitLayerUniforms, cloud: LitNoise) -> f32 {
    return max(cloud.amount - max(layer.threshold, 0.0), 0.0) * (0.5 + cloud.density);
}

@fragment
fn fs_lit_map(@builtin(position) position: vec4f) -> LitTargets {
    let uv = position.xy / uniforms.lit.resolution;
    return LitTargets(
        lit_map_texel(FIRST_LAYER, uv),
        lit_map_texel(FIRST_LAYER + 1, uv),
        lit_map_texel(FIRST_LAYER + 2, uv),
    );
}

// A level from the one above it: the mean of 2x2 texels of three layers.
@fragment
fn fs_lit_level(@builtin(position) position: vec4f) -> LitTargets {
    let corner = vec2i(position.xy) * 2;
    return LitTargets(
        lit_mean(corner, FIRST_LAYER),
        lit_mean(corner, FIRST_LAYER + 1),
        lit_mean(corner, FIRST_LAYER + 2),
    );
}

fn lit_mean(corner: vec2i, layer: i32) -> vec4f {
    let upper = textureLoad(layers_texture, corner, layer, 0)
        + textureLoad(layers_texture, corner + vec2i(1, 0), layer, 0);
    let lower = textureLoad(layers_texture, corner + vec2i(0, 1), layer, 0)
        + textureLoad(layers_texture, corner + vec2i(1, 1), layer, 0);
    return 0.25 * (upper + lower);
}
