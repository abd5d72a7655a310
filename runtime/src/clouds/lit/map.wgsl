// The map of the lit method: light, opacity and shade of three layers at once. CPU part: map.rs.
override FIRST_LAYER: i32 = 0;

struct LitTargets {
    @location(0) first: vec4f,
    @location(1) second: vec4f,
    @location(2) third: vec4f,
}

// The pack's texture where a layer reads it, both reads blended.
struct LitNoise {
    normal: vec2f,
    density: f32,
    amount: f32,
}

// The place whose fibres a place of cirrus has. Two shears bend them: areas stay as large as they are, and shares of the layer with them.
fn lit_bent(uv: vec2f) -> vec2f {
    let v = uv.y + LIT_BENDS.x * cloud_wave(uv.x) + LIT_BENDS.y * cloud_wave(2.0 * uv.x + 0.16);
    return vec2f(uv.x + LIT_BENDS.z * cloud_wave(v + 0.32) + LIT_BENDS.w * cloud_wave(3.0 * v), v);
}

// Fibres by the cubic B-spline, of which two texels each way are one linear read: between coarse texels a linear one leaves stairs along the bends.
fn lit_fibres(uv: vec2f, level: f32) -> vec4f {
    let size = max(f32(textureDimensions(layers_texture).x) * exp2(-floor(level)), 1.0);
    let place = uv * size - 0.5;
    let f = fract(place);
    let g = 1.0 - f;
    let last = f * f * f / 6.0;
    let first = g * g * g / 6.0;
    let upper = last + (4.0 - 3.0 * g * g * (1.0 + f)) / 6.0;
    let low = (floor(place) - 0.5 + (1.0 - first / (1.0 - upper))) / size;
    let high = (floor(place) + 1.5 + last / upper) / size;
    let north = mix(lit_fibre(low, level), lit_fibre(vec2f(high.x, low.y), level), upper.x);
    let south = mix(lit_fibre(vec2f(low.x, high.y), level), lit_fibre(high, level), upper.x);
    return mix(north, south, upper.y);
}

fn lit_fibre(uv: vec2f, level: f32) -> vec4f {
    return textureSampleLevel(layers_texture, repeat_sampler, uv, LIT_CIRRUS, level);
}

// The first read of a layer.
fn lit_first(kind: i32, uv: vec2f, level: f32) -> vec4f {
    if kind == LIT_CIRRUS {
        return lit_fibres(2.0 * lit_bent(uv), level + LIT_FIBRE_LEVEL);
    }
    return textureSampleLevel(layers_texture, repeat_sampler, uv, kind, level);
}

// The second, of lumps, which moves against the first.
fn lit_second(layer: LitLayerUniforms, uv: vec2f, level: f32) -> vec4f {
    return textureSampleLevel(layers_texture, repeat_sampler, uv + layer.second_offset, LIT_CUMULUS, level);
}

fn lit_noise(layer: LitLayerUniforms, uv: vec2f, level: f32) -> LitNoise {
    var first = lit_first(i32(layer.kind), uv, level);
    var second = lit_second(layer, uv, level + layer.second_level);
    if layer.spreads.x > 0.0 {
        first.a = normal_share((first.a - 0.5) / layer.spreads.x);
        second.a = normal_share((second.a - 0.5) / layer.spreads.y);
    }
    let blend = LIT_FIRST_WEIGHT * first + LIT_SECOND_WEIGHT * second;
    return LitNoise(blend.rg, blend.b, photo_over_even(even_blend(blend.a, LIT_SECOND_WEIGHT), uv));
}

// How high the cloud of a place is, 1 for a thick one. An overcast is as high everywhere but for its rolls.
fn lit_height(layer: LitLayerUniforms, uv: vec2f, amount: f32, level: f32) -> f32 {
    let height = layer.height_rate * max(amount - max(layer.threshold, 0.0), 0.0);
    if uniforms.lit.overcast == 0.0 {
        return height;
    }
    let lumps = lit_second(layer, uv, level + LIT_ROLL_LEVELS.x).b;
    let bands = textureSampleLevel(layers_texture, repeat_sampler, lit_bent(uv), LIT_CIRRUS, level + LIT_ROLL_LEVELS.y).b;
    let rolls = LIT_ROLLS.x + LIT_ROLLS.y * (0.5 * (lumps + bands) - 0.5) + LIT_ROLLS.z * (amount - 0.5);
    return mix(height, 0.5 * (rolls + sqrt(rolls * rolls + LIT_ROLLS.w)), uniforms.lit.overcast);
}

// The same so many steps towards the sun.
fn lit_height_towards(layer: LitLayerUniforms, uv: vec2f, steps: f32, level: f32) -> f32 {
    let there = uv + steps * layer.sun_step;
    return lit_height(layer, there, lit_noise(layer, there, level).amount, level);
}

// R: what is left of light that was scattered many times; G: the amount of cloud; B: opacity; A: height.
fn lit_scattered_texel(layer: LitLayerUniforms, uv: vec2f, cloud: LitNoise, slope: vec2f, alpha: f32) -> vec4f {
    let height = lit_height(layer, uv, cloud.amount, 0.0);
    let step_texels = length(layer.sun_step) * f32(textureDimensions(layers_texture).x);
    let levels = max(log2(0.5 * step_texels * LIT_APART), vec3f(0.0));
    let towards = vec3f(
        lit_height_towards(layer, uv, LIT_STEPS.x, levels.x),
        lit_height_towards(layer, uv, LIT_STEPS.y, levels.y),
        lit_height_towards(layer, uv, LIT_STEPS.z, levels.z),
    );
    let evened = 1.0 - LIT_EVENED_RELIEF * uniforms.lit.overcast;
    let relief = LIT_RELIEF * evened * dot(slope, layer.sun_uv) * min(LIT_RELIEF_FULL * height, 1.0);
    let above = max(towards - LIT_RISES, vec3f(0.0));
    let passed = max(LIT_OWN * height + dot(LIT_SHARES, above) - relief, 0.0);
    return vec4f(exp2(-CLOUD_MULTIPLE.y * layer.extinction * passed), cloud.amount, alpha, min(height, 1.0));
}

// With the paper's shading R: light that falls on the cloud; G: the amount of cloud; B: opacity; A: shade by the place alone.
fn lit_map_texel(index: i32, uv: vec2f) -> vec4f {
    let layer = uniforms.lit.layers[index];
    let cloud = lit_noise(layer, uv, 0.0);
    let slope = layer.relief * (cloud.normal * 2.0 - 1.0);
    let thickness = max(cloud.amount - layer.threshold, 0.0);
    let alpha = smoothstep(0.0, 1.0, layer.steepness * thickness);
    if SCATTERED {
        return lit_scattered_texel(layer, uv, cloud, slope, alpha);
    }
    let upward = sqrt(max(1.0 - dot(slope, slope), LIT_LEAST_UP));
    let falls = max(dot(slope, layer.sun_uv) + upward * uniforms.lit.light_direction.y, 0.0); // eq. 3
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
