// AgX. Theory: agx.rs.

// Where inset radiance, exposed by so many stops, lies between the first stop and the last.
fn agx_shares(unbounded: vec3f) -> vec3f {
    let radiance = max(unbounded, vec3f(0.0));
    // What is added keeps the logarithm from 0.
    let stops = log2((1.0 - AGX_INSET) * radiance + (dot(radiance, AGX_INSET * AGX_WEIGHTS) + AGX_BLACK));
    return clamp(stops * (1.0 / AGX_STOPS) + uniforms.tonemap.agx_start, vec3f(0.0), vec3f(1.0));
}

// The sigmoid.
fn agx_encoded(x: vec3f) -> vec3f {
    var sum = vec3f(AGX_X6);
    sum = sum * x + AGX_X5;
    sum = sum * x + AGX_X4;
    sum = sum * x + AGX_X3;
    sum = sum * x + AGX_X2;
    sum = sum * x + AGX_X1;
    return max(sum * x + AGX_X0, vec3f(0.0));
}

// The sigmoid with the power of the look "Punchy".
fn agx_contrasted(x: vec3f) -> vec3f {
    var sum = vec3f(AGX_PUNCHY_X7);
    sum = sum * x + AGX_PUNCHY_X6;
    sum = sum * x + AGX_PUNCHY_X5;
    sum = sum * x + AGX_PUNCHY_X4;
    sum = sum * x + AGX_PUNCHY_X3;
    sum = sum * x + AGX_PUNCHY_X2;
    return sum * (x * x);
}

// Undoes inset and power, a step of the encoding away.
fn agx_display(encoded: vec3f, own: f32, weights: vec3f, step: f32) -> vec3f {
    let outset = own * encoded + (dot(encoded, weights) + step);
    let x = clamp(outset, vec3f(0.0), vec3f(1.0));
    var sum = vec3f(AGX_POWER_X6);
    sum = sum * x + AGX_POWER_X5;
    sum = sum * x + AGX_POWER_X4;
    sum = sum * x + AGX_POWER_X3;
    sum = sum * x + AGX_POWER_X2;
    return sum * (x * x);
}

fn tonemap_agx(radiance: vec3f, step: f32) -> vec3f {
    return agx_display(agx_encoded(agx_shares(radiance)), AGX_OUTSET, AGX_OUTSET_WEIGHTS, step);
}

fn tonemap_agx_punchy(radiance: vec3f, step: f32) -> vec3f {
    return agx_display(agx_contrasted(agx_shares(radiance)), AGX_PUNCHY_OUTSET, AGX_PUNCHY_WEIGHTS, step);
}
