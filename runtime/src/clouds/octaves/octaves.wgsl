// Clouds of the octaves method: three domes over one map of summed octaves. Theory and CPU part: mod.rs.

fn octaves_uv(dome: OctaveDome, plane: vec2f) -> vec2f {
    return dome.east_axis * plane.x + dome.south_axis * plane.y + dome.offset;
}

// Fibres are bent by a shear along them, or they would be streaks from one point of the horizon. Areas stay, and so does the share of the sky.
fn octaves_bent(uv: vec2f) -> vec2f {
    return vec2f(uv.x + OCTAVE_BEND * cloud_wave(uv.y), uv.y);
}

// What the map holds: see map.wgsl.
fn octaves_map_at(uv: vec2f, level: f32) -> vec4f {
    return textureSampleLevel(map_texture, repeat_sampler, uv, level);
}

// Opacity of a thickness: the paper's exponentiation, with a soft foot.
fn octaves_alpha(thickness: f32, exponent: f32) -> f32 {
    return cloud_soften(1.0 - exp2(exponent * max(thickness, 0.0)), OCTAVE_EDGE);
}

// The opacity of the low dome with its edges roughened by a finer read, and what that has over its mean.
fn octaves_rough(uv: vec2f, level: f32, opacity: f32) -> vec2f {
    let finer = octaves_map_at(uv * OCTAVE_FINER + OCTAVE_FINER_START, level + OCTAVE_FINER_LEVEL).r - 0.5;
    let rough = uniforms.octaves.roughness * finer * opacity * (1.0 - opacity);
    return vec2f(clamp(opacity + rough, 0.0, 1.0), finer);
}

// Opacity of the middle dome.
fn octaves_middle(plane: vec2f, level: f32) -> f32 {
    let middle = uniforms.octaves.middle;
    return OCTAVE_MIDDLE_OPACITY * octaves_map_at(octaves_uv(middle, plane), level + middle.lod_bias).b;
}

// Opacity of the high dome.
fn octaves_high(plane: vec2f, level: f32) -> f32 {
    let high = uniforms.octaves.high;
    let uv = octaves_bent(octaves_uv(high, plane));
    let thickness = octaves_map_at(uv, level + high.lod_bias + OCTAVE_VEIL_LEVEL).r - high.threshold;
    let full = clamp(thickness * uniforms.octaves.high_contrast, 0.0, 1.0);
    return OCTAVE_HIGH_OPACITY * full * full * (3.0 - 2.0 * full);
}

// Share of the light of sun or moon that the clouds hide from the middle of a texel of the shadows.
fn octaves_hidden(texel: vec2f) -> f32 {
    let octaves = uniforms.octaves;
    var open = 1.0;
    if octaves.low.threshold < 1.0 {
        let uv = octaves_uv(octaves.low, shadow_plane(0, texel));
        let level = shadow_level(0) + octaves.low.lod_bias;
        open = 1.0 - octaves_rough(uv, level, octaves_map_at(uv, level).g).x;
    }
    if octaves.middle.threshold < 1.0 {
        open *= 1.0 - octaves_middle(shadow_plane(1, texel), shadow_level(1));
    }
    if octaves.high.threshold < 1.0 {
        open *= 1.0 - octaves_high(shadow_plane(2, texel), shadow_level(2));
    }
    return 1.0 - open;
}

// Radiance and opacity of the clouds along a unit direction above the horizon.
fn octaves_layer(direction: vec3f, narrowing: f32) -> vec4f {
    let octaves = uniforms.octaves;
    let hit = dome_intersect(direction);
    let level = cloud_level(hit, narrowing);
    let thin_grey = 0.5 + 0.5 * octaves.edge_grey;
    // One grey, or one depth, for all domes: from that of thin cloud to that of the low dome where it is opaque.
    var grey = thin_grey;
    var depth = OCTAVE_THIN_DEPTH;
    var body = 0.0;
    var clear = 1.0;
    if octaves.low.threshold < 1.0 {
        let uv = octaves_uv(octaves.low, hit.plane);
        let at_level = level + octaves.low.lod_bias;
        let cloud = octaves_map_at(uv, at_level);
        // Where there is no cloud nothing is roughened.
        if cloud.g > 0.0 {
            let rough = octaves_rough(uv, at_level, cloud.g);
            let alpha = rough.x;
            let finer = rough.y;
            grey = mix(thin_grey, cloud.a + OCTAVE_ROUGH_GREY * finer, alpha);
            let passed = octaves.base_depth + max(OCTAVE_ROUGH_DEPTH * finer - log2(max(cloud.a, OCTAVE_LEAST_LIGHT)), 0.0);
            depth = mix(OCTAVE_THIN_DEPTH, passed, alpha);
            body = alpha;
            clear = 1.0 - alpha;
        }
    }
    if octaves.middle.threshold < 1.0 {
        clear *= 1.0 - octaves_middle(hit.plane, level);
    }
    if octaves.high.threshold < 1.0 {
        clear *= 1.0 - octaves_high(hit.plane, level);
    }
    if clear >= 1.0 {
        return vec4f(0.0);
    }
    let tint = cloud_tint(direction);
    let alpha = (1.0 - clear) * cloud_clearness(direction);
    if SCATTERED {
        let height = mix(OCTAVE_HEIGHTS.x, OCTAVE_HEIGHTS.y, body);
        return vec4f(cloud_lit(cloud_scattered(direction, depth, height), tint), alpha);
    }
    let tinted = cloud_tinted(clamp(grey, 0.0, 1.0), tint);
    return vec4f(cloud_light(tinted, 1.0), alpha);
}
