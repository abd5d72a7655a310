// Clouds: lines 14 to 28 of the paper's shader, on the packed texture. Theory, changes, CPU part: clouds.rs.
struct CloudUniforms {
    photo: vec4f,    // x: scale; yz: offset; w: level of detail at distance 1
    noise: vec4f,    // xy: scale times cosine and sine of its turn; zw: offset
    detail: vec4f,   // x: scale; yz: offset; w: level of detail at distance 1
    upper: vec4f,    // xy: scale to the east and to the south; zw: offset
    levels: vec4f,   // x, y: level of detail of noise and upper layer at distance 1; z: smoothness (line 19);
                     // w: sine of the elevation at which clouds are out of the haze
    gradient: vec4f, // xy: unit vector to the sun's azimuth (east, south); zw: v = z + w * place
    shape: vec4f,    // x: the cut of line 15; y: 1 / cover, as clamped in line 16; z: density; w: amount of the upper layer
    sunlight: vec4f, // rgb: light of the sun on clouds
    ambient: vec4f,  // rgb: light of the sky on clouds
    tint: vec4f,     // rgb: the sunset colour, display-referred; w: sunset
}

fn cloud_sample(uv: vec2f, level: f32) -> vec4f {
    return textureSampleLevel(clouds_texture, repeat_sampler, uv, level);
}

// Display-referred grey, as the paper computes it, to radiance: sunlight reaches the bright parts,
// the light of the sky the dark ones too. The darkest cores still scatter some of both.
fn cloud_light(grey: vec3f) -> vec3f {
    let clouds = uniforms.clouds;
    let bright = CLOUD_CORE + (1.0 - CLOUD_CORE) * grey;
    return bright * (bright * clouds.sunlight.rgb + clouds.ambient.rgb);
}

// Lines 22-23, `1 - (r - 1) / 2` beyond 1, with the kink rounded off.
fn cloud_fold(grey: f32) -> f32 {
    let beyond = grey - 1.0;
    return grey - 0.75 * (beyond + sqrt(beyond * beyond + CLOUD_FOLD * CLOUD_FOLD));
}

// Radiance and opacity of the clouds along a unit direction above the horizon.
fn cloud_layer(direction: vec3f) -> vec4f {
    let clouds = uniforms.clouds;
    let hit = dome_intersect(direction);
    // Pixels away from the axis of the lens cover smaller angles, by the cosine of theirs to it.
    let side = hit.distance * dot(direction, uniforms.camera.clip_w.xyz);
    // Half way between the footprint's short side and its long one, which is stretched by 1 / cos.
    let level = 0.5 * log2(side * side * (CLOUD_SPHERE_RADIUS + 1.0) / hit.root);

    let turned = vec2f(
        hit.plane.x * clouds.noise.x - hit.plane.y * clouds.noise.y,
        hit.plane.x * clouds.noise.y + hit.plane.y * clouds.noise.x,
    );
    let photo = cloud_sample(hit.plane * clouds.photo.x + clouds.photo.yz, level + clouds.photo.w).r;
    let noise = cloud_sample(turned + clouds.noise.zw, level + clouds.levels.x).g;
    let detail = cloud_sample(hit.plane * clouds.detail.x + clouds.detail.yz, level + clouds.detail.w).b;
    var gradient = 0.0;
    if clouds.tint.w > 0.0 {
        let place = 0.5 + 0.5 * dot(direction.xz, clouds.gradient.xy);
        gradient = cloud_sample(vec2f(0.5, clouds.gradient.z + clouds.gradient.w * place), 0.0).a;
    }

    let density = clouds.shape.z;
    let amount = photo + noise * (1.0 - photo);                      // line 14
    var alpha = (amount - clouds.shape.x) * clouds.shape.y;          // lines 15-17
    var grey = amount + detail * (1.0 - amount);                     // line 18
    alpha *= mix(detail, 1.0, clouds.levels.z);                      // line 19
    let thick = density * max(alpha, 0.0) * 2.0;                     // lines 20-21
    grey += thick;
    alpha = clamp(alpha + thick, 0.0, 1.0);                          // line 25
    grey = clamp(cloud_fold(grey), 0.0, 1.0);                        // lines 22-25
    let tinted = mix(vec3f(grey), clouds.tint.rgb, gradient * clouds.tint.w);   // lines 26-27
    var radiance = cloud_light(tinted);                              // line 28

    alpha = alpha * alpha * (1.0 + CLOUD_EDGE) / (alpha + CLOUD_EDGE);
    if UPPER_LAYER {
        let uv = hit.plane * clouds.upper.xy + clouds.upper.zw;
        let wisp = cloud_sample(uv, level + clouds.levels.y).g;
        let veil = clouds.shape.w * UPPER_OPACITY * smoothstep(UPPER_THRESHOLD, 1.0, wisp);
        let over = alpha + veil * (1.0 - alpha);
        let white = cloud_light(mix(vec3f(1.0), clouds.tint.rgb, gradient * clouds.tint.w));
        radiance = mix(white, radiance, alpha / max(over, 1e-4));
        alpha = over;
    }
    return vec4f(radiance, alpha * smoothstep(0.0, clouds.levels.w, direction.y));
}
