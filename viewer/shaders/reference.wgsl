// What a frame costs that does nothing but read the cloud texture: the yardstick of the benchmark.
// Every fragment takes trilinear samples at scales that a sky would use, and adds them up.

@group(0) @binding(0) var clouds: texture_2d<f32>;
@group(0) @binding(1) var trilinear: sampler;

struct Corner {
    @builtin(position) position: vec4f,
    // 0..1 over the target, x to the right, y downwards.
    @location(0) uv: vec2f,
}

// One triangle that covers the target.
@vertex
fn corner(@builtin(vertex_index) index: u32) -> Corner {
    let p = vec2f(f32((index << 1u) & 2u), f32(index & 2u));
    return Corner(vec4f(p.x * 2.0 - 1.0, 1.0 - p.y * 2.0, 0.0, 1.0), p);
}

@fragment
fn one_sample(in: Corner) -> @location(0) vec4f {
    return vec4f(textureSample(clouds, trilinear, in.uv * vec2f(4.0, 3.0)).rgb, 1.0);
}

@fragment
fn four_samples(in: Corner) -> @location(0) vec4f {
    let uv = in.uv * vec2f(4.0, 3.0);
    // The offsets keep the samples out of each other's cache lines.
    let a = textureSample(clouds, trilinear, uv);
    let b = textureSample(clouds, trilinear, uv * 1.37 + vec2f(0.13, 0.70));
    let c = textureSample(clouds, trilinear, uv * 4.60 + vec2f(0.41, 0.11));
    let d = textureSample(clouds, trilinear, uv.yx * 0.53 + vec2f(0.90, 0.33));
    return vec4f((0.25 * (a + b + c + d)).rgb, 1.0);
}
