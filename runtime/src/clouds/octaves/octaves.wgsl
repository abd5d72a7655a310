// Clouds of the octaves method: three domes over one map of summed octaves. Theory and CPU part: octaves.rs.
struct OctaveDome {
    axes: vec4f,  // xy: what a height to the east, zw: to the south adds to uv
    place: vec4f, // xy: offset; z: level of detail at distance 1; w: the cut, 1 - cover
}

struct OctaveUniforms {
    low: OctaveDome,
    middle: OctaveDome,
    high: OctaveDome,
    shape: vec4f,   // x: log2 of (1 - sharpness)^255; y: how thickness darkens; z: relief; w: share of the finer read
    sun: vec4f,     // xy: a step of the low dome towards the sun, in uv
    cells_a: vec4f, // copies of the noise across the map, octaves 1 to 4
    cells_b: vec4f, // the same, octaves 5 to 8
    map: vec4f,     // x: octaves; y: texels a side of the map; z: grey of a thin edge; w: 1 / thickness at which the high dome is full
}

fn octaves_uv(dome: OctaveDome, plane: vec2f) -> vec2f {
    return dome.axes.xy * plane.x + dome.axes.zw * plane.y + dome.place.xy;
}

// What the map holds: see map.wgsl.
fn octaves_map_at(uv: vec2f, level: f32) -> vec4f {
    return textureSampleLevel(map_texture, repeat_sampler, uv, level);
}

// Opacity of a thickness: the paper's exponentiation, with a soft foot.
fn octaves_alpha(thickness: f32, exponent: f32) -> f32 {
    return cloud_soften(1.0 - exp2(exponent * max(thickness, 0.0)), OCTAVE_EDGE);
}

// Radiance and opacity of the clouds along a unit direction above the horizon.
fn octaves_layer(direction: vec3f, narrowing: f32) -> vec4f {
    let octaves = uniforms.octaves;
    let hit = dome_intersect(direction);
    let level = cloud_level(hit, narrowing);
    let thin_grey = 0.5 + 0.5 * octaves.map.z;
    // One grey for all domes: from that of thin cloud to that of the low dome where it is opaque.
    var grey = thin_grey;
    var clear = 1.0;
    if octaves.low.place.w < 1.0 {
        let uv = octaves_uv(octaves.low, hit.plane);
        let at_level = level + octaves.low.place.z;
        let cloud = octaves_map_at(uv, at_level);
        let finer = octaves_map_at(uv * OCTAVE_FINER + OCTAVE_FINER_START, at_level + OCTAVE_FINER_LEVEL).r - 0.5;
        let alpha = clamp(cloud.g + octaves.shape.w * finer * cloud.g * (1.0 - cloud.g), 0.0, 1.0);
        grey = mix(thin_grey, cloud.a + OCTAVE_ROUGH_GREY * finer, alpha);
        clear = 1.0 - alpha;
    }
    if octaves.middle.place.w < 1.0 {
        let uv = octaves_uv(octaves.middle, hit.plane);
        let alpha = OCTAVE_MIDDLE_OPACITY * octaves_map_at(uv, level + octaves.middle.place.z).b;
        clear *= 1.0 - alpha;
    }
    if octaves.high.place.w < 1.0 {
        let uv = octaves_uv(octaves.high, hit.plane);
        let thickness = octaves_map_at(uv, level + octaves.high.place.z).r - octaves.high.place.w;
        let full = clamp(thickness * octaves.map.w, 0.0, 1.0);
        let alpha = OCTAVE_HIGH_OPACITY * full * full * (3.0 - 2.0 * full);
        clear *= 1.0 - alpha;
    }
    let radiance = cloud_light(cloud_tinted(clamp(grey, 0.0, 1.0), cloud_tint(direction)));
    return vec4f(radiance, (1.0 - clear) * cloud_clearness(direction));
}
