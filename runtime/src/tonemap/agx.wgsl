// AgX. Theory: agx.rs.

fn agx_encoded(radiance: vec3f) -> vec3f {
    let inset = radiance + AGX_INSET * (dot(radiance, AGX_WEIGHTS) - radiance);
    let stops = log2(max(inset, vec3f(AGX_BLACK)));
    let x = clamp((stops - AGX_FIRST) / AGX_STOPS, vec3f(0.0), vec3f(1.0));
    var sum = vec3f(AGX_X6);
    sum = sum * x + AGX_X5;
    sum = sum * x + AGX_X4;
    sum = sum * x + AGX_X3;
    sum = sum * x + AGX_X2;
    sum = sum * x + AGX_X1;
    return max(sum * x + AGX_X0, vec3f(0.0));
}

fn agx_display(shown: vec3f) -> vec3f {
    let outset = (shown - AGX_INSET * dot(shown, AGX_WEIGHTS)) / (1.0 - AGX_INSET);
    return pow(max(outset, vec3f(AGX_BLACK)), vec3f(AGX_GAMMA));
}

fn tonemap_agx(radiance: vec3f) -> vec3f {
    return agx_display(agx_encoded(radiance));
}

fn tonemap_agx_punchy(radiance: vec3f) -> vec3f {
    let contrasted = pow(max(agx_encoded(radiance), vec3f(AGX_BLACK)), vec3f(AGX_PUNCHY_POWER));
    let grey = vec3f(dot(contrasted, LUMINANCE));
    return agx_display(grey + AGX_PUNCHY_SATURATION * (contrasted - grey));
}
