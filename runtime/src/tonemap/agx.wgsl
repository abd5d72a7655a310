// AgX. Theory: agx.rs.

// Where inset radiance, exposed by so many stops, lies between the first stop and the last.
fn agx_shares(radiance: vec3f) -> vec3f {
    let inset = (1.0 - AGX_INSET) * radiance + dot(radiance, AGX_INSET * AGX_WEIGHTS);
    let stops = log2(max(inset, vec3f(AGX_BLACK)));
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
    return pow(clamp(outset, vec3f(0.0), vec3f(1.0)), vec3f(AGX_GAMMA));
}

fn tonemap_agx(radiance: vec3f, step: f32) -> vec3f {
    return agx_display(agx_encoded(agx_shares(radiance)), AGX_OUTSET, AGX_OUTSET_WEIGHTS, step);
}

fn tonemap_agx_punchy(radiance: vec3f, step: f32) -> vec3f {
    return agx_display(agx_contrasted(agx_shares(radiance)), AGX_PUNCHY_OUTSET, AGX_PUNCHY_WEIGHTS, step);
}
