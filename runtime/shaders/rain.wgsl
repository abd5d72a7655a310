// Rain: streaks on cylinders about the viewer, and grey haze. Theory and CPU part: rain.rs.
struct RainUniforms {
    right: vec4f,   // xyz: unit vector across the fall; w: how much rain there is
    up: vec4f,      // xyz: unit vector against the fall; w: a pixel in the middle of the screen, in radians
    forward: vec4f, // xyz: the third one
    streak: vec4f,  // rgb: radiance of a streak; w: opacity of one that is as wide as a pixel
    haze: vec4f,    // rgb: radiance of the haze; w: its opacity at the horizon
    // Of each cylinder, from the nearest. x: columns around it; y: cells along it for each radius; z, w: how many cells the rain has
    // fallen, its fraction and its whole part.
    cylinders: array<vec4f, 3>,
    // x: columns over half the width of a streak; y: 1 / half its length, in cells; z: opacity; w: how little room columns leave it
    widths: array<vec4f, 3>,
}

// A hash of 32 bits: the finaliser of MurmurHash3, A. Appleby, 2011.
fn rain_hash(value: u32) -> u32 {
    var bits = value;
    bits = (bits ^ (bits >> 16u)) * 0x85ebca6bu;
    bits = (bits ^ (bits >> 13u)) * 0xc2b2ae35u;
    return bits ^ (bits >> 16u);
}

// Eight bits of a hash as a number from 0 up to 1, put into the fraction of a float: a conversion takes a GPU several times as long.
fn rain_share(bits: u32, first: u32) -> f32 {
    return bitcast<f32>(0x3f800000u | (((bits >> first) & 255u) << 15u)) - 1.0;
}

// What the streaks on a cylinder leave clear. x of `place`: azimuth in turns, -0.5 to 0.5; y: tangent of the elevation; z: its cosine;
// w: 1 / z.
fn rain_clear(index: i32, place: vec4f) -> f32 {
    let cylinder = uniforms.rain.cylinders[index];
    let width = uniforms.rain.widths[index];
    let column = (place.x + 0.5) * cylinder.x;
    let number = u32(min(column, cylinder.x - 1.0)) + (u32(index) << 10u);
    let along = place.y * cylinder.y + cylinder.z + rain_share(rain_hash(number), 8u);
    let cell = (i32(floor(along)) + i32(cylinder.w)) & 0xffff;
    let bits = rain_hash((u32(cell) << 13u) + number);
    if rain_share(bits, 0u) >= uniforms.rain.right.w {
        return 1.0;
    }
    let middle = 0.3 + 0.4 * rain_share(bits, 8u);
    let profile = max(1.0 - abs(fract(column) - middle) * width.x * place.z, 0.0);
    // Towards the zenith of the fall columns become narrower than their streaks.
    let room = clamp(2.0 - width.w * place.w, 0.0, 1.0);
    let lengthwise = (fract(along) - 0.5) * width.y;
    let ends = max(1.0 - lengthwise * lengthwise, 0.0);
    return 1.0 - width.z * (0.4 + 0.6 * rain_share(bits, 16u)) * profile * ends * room;
}

@fragment
fn fs_rain(in: Varyings) -> @location(0) vec4f {
    let rain = uniforms.rain;
    let direction = in.ray * inverseSqrt(dot(in.ray, in.ray));
    let fall = vec3f(dot(direction, rain.right.xyz), dot(direction, rain.up.xyz), dot(direction, rain.forward.xyz));
    let across = max(length(fall.xz), 1e-4);
    let place = vec4f(atan2(fall.x, fall.z) / TAU, fall.y / across, across, 1.0 / across);
    // Not a loop: constants at known places cost nothing.
    let clear = rain_clear(0, place) * rain_clear(1, place) * rain_clear(2, place);
    let streaks = rain.streak.w * (1.0 - clear);
    let haze = rain.haze.w * (RAIN_HAZE_ABOVE + (1.0 - RAIN_HAZE_ABOVE) * exp2(-RAIN_HAZE_FALL * abs(direction.y)));
    let opacity = 1.0 - (1.0 - haze) * (1.0 - streaks);
    let radiance = mix(rain.haze.rgb, rain.streak.rgb, streaks / max(opacity, 1e-4));
    return vec4f(finish(radiance, in.position.xy).rgb, opacity);
}
