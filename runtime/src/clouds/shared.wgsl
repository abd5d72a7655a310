// What the clouds of every method share: light, sunset tint, haze. CPU part: shared.rs.

// Share of sunlight that a cloud of an opacity sends back along a direction. A low sun lights clouds from the side: away from it one
// sees their lit sides, towards it their dark ones, with rims that let its light through.
fn cloud_facing(direction: vec3f, opacity: f32) -> f32 {
    let cosine = dot(direction, uniforms.sky.sun_direction);
    var ahead = max(cosine, 0.0);
    ahead *= ahead;
    ahead *= ahead;
    let thin = (1.0 - opacity) * ahead;
    let rim = CLOUD_RIM * thin * thin;
    return mix(1.0, CLOUD_ABEAM - CLOUD_SIDED * cosine + rim, uniforms.clouds.low_sun);
}

// The phase function against all sides alike, by the cosine to the sun; limited about it.
fn cloud_phase(cosine: f32) -> f32 {
    let root = inverseSqrt(CLOUD_FORWARD.y - CLOUD_FORWARD.z * cosine);
    return min(CLOUD_FORWARD.x * root * root * root + CLOUD_BACKWARD.x - CLOUD_BACKWARD.y * cosine, CLOUD_BRIGHTEST);
}

// Shares of sunlight and of skylight that a cloud sends along a direction: of what came through `depth` halvings from the sun, to a place
// under so much cloud. What was scattered once follows the phase function, and only thin parts show it; what was scattered many times
// comes from all sides, and is weakened less.
fn cloud_scattered(direction: vec3f, depth: f32, height: f32) -> vec2f {
    let cosine = dot(direction, uniforms.sky.sun_direction);
    let phase = cloud_phase(cosine);
    let lacking = 0.5 * CLOUD_POWDER.x * (1.0 - cosine) * clamp(1.0 - CLOUD_POWDER.y * height, 0.0, 1.0);
    // A low sun lights sides: one sees the lit ones away from it.
    let sided = 1.0 + uniforms.clouds.low_sun * ((CLOUD_ABEAM - 1.0) - CLOUD_SIDED * cosine);
    let through = exp2(-depth);
    let rim = CLOUD_SINGLE.y * phase * exp2(-depth - CLOUD_THIN * height);
    let body = (CLOUD_SINGLE.x * through + CLOUD_MULTIPLE.x * exp2(-CLOUD_MULTIPLE.y * depth)) * sided;
    return vec2f((body + rim) * (1.0 - lacking), 1.0 - CLOUD_HIDDEN * min(height, 1.0));
}

// Radiance of what these shares are of, under the sunset tint.
fn cloud_lit(shares: vec2f, tint: f32) -> vec3f {
    let clouds = uniforms.clouds;
    let light = shares.x * clouds.sunlight + shares.y * clouds.ambient;
    if clouds.sunset == 0.0 {
        return light;
    }
    return light * mix(vec3f(1.0), clouds.tint, tint);
}

// Display-referred grey, as the papers compute it, to radiance: sunlight reaches the bright parts,
// the light of the sky the dark ones too. The darkest cores still scatter some of both.
fn cloud_light(grey: vec3f, facing: f32) -> vec3f {
    let clouds = uniforms.clouds;
    let bright = CLOUD_CORE + (1.0 - CLOUD_CORE) * grey;
    return bright * ((bright * facing) * clouds.sunlight + clouds.ambient);
}

// Display-referred colour of a grey under the sunset tint. Unlike the paper's lines 26-27, which go over to one
// flat colour, shading shows through it.
fn cloud_tinted(grey: f32, tint: f32) -> vec3f {
    return grey * mix(vec3f(1.0), uniforms.clouds.tint, tint);
}

// Opacity with its foot softened: where clouds thin out, the papers' opacity has a kink that shows their grain.
fn cloud_soften(alpha: f32, edge: f32) -> f32 {
    return alpha * alpha * (1.0 + edge) / (alpha + edge);
}

// How far the sunset tints clouds in a direction.
fn cloud_tint(direction: vec3f) -> f32 {
    let clouds = uniforms.clouds;
    if clouds.sunset == 0.0 {
        return 0.0;
    }
    let place = 0.5 + 0.5 * dot(direction.xz, clouds.sun_azimuth);
    let uv = vec2f(0.5, clouds.gradient_start + clouds.gradient_span * place);
    return clouds.sunset * textureSampleLevel(clouds_texture, repeat_sampler, uv, 0.0).a;
}

// What the haze of the horizon leaves of a cloud.
fn cloud_clearness(direction: vec3f) -> f32 {
    let t = clamp(direction.y * uniforms.clouds.haze_scale, 0.0, 1.0);
    return t * t * (3.0 - 2.0 * t);
}

// Level of detail of a texture with one texel a height of the layer: half way between the footprint's
// short side and its long one, which is stretched by 1 / cos. Pixels away from the axis of the lens cover
// smaller angles, by the cosine of theirs to it.
fn cloud_level(hit: DomeHit, narrowing: f32) -> f32 {
    let side = hit.distance * narrowing;
    return 0.5 * log2(max(side * side * ((CLOUD_SPHERE_RADIUS + 1.0) * hit.slant), 1e-12));
}

// A wave of period 1 between -1 and 1, of two parabolas.
fn cloud_wave(x: f32) -> f32 {
    let t = 2.0 * fract(x) - 1.0;
    return 4.0 * t * (abs(t) - 1.0);
}
