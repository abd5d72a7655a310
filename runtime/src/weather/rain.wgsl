// Rain: streaks of drops that fall about the viewer, a quad each, and grey haze. Theory and CPU part: rain.rs.

struct RainVaryings {
    @builtin(position) position: vec4f,
    // x: across, y: along the streak, both -1 to 1
    @location(0) place: vec2f,
    // rgb: radiance, as the target has it; w: opacity of its middle
    @location(1) @interpolate(flat) colour: vec4f,
}

// A hash of 32 bits: the finaliser of MurmurHash3, A. Appleby, 2011.
fn rain_hash(value: u32) -> u32 {
    var bits = value;
    bits = (bits ^ (bits >> 16u)) * 0x85ebca6bu;
    bits = (bits ^ (bits >> 13u)) * 0xc2b2ae35u;
    return bits ^ (bits >> 16u);
}

// Each byte of a hash as a number from 0 up to 1, from the lowest.
fn rain_shares(bits: u32) -> vec4f {
    return vec4f((vec4u(bits) >> vec4u(0u, 8u, 16u, 24u)) & vec4u(255u)) / 256.0;
}

// Six vertices a drop: two triangles.
@vertex
fn vs_rain(@builtin(vertex_index) index: u32) -> RainVaryings {
    let rain = uniforms.rain;
    let drop = index / 6u;
    let slot = drop % RAIN_SLOTS;
    let column = (u32(rain.first_column) + drop / RAIN_SLOTS) % RAIN_COLUMNS;
    let number = column * RAIN_SLOTS + slot;
    let kind = u32(slot >= RAIN_MIDDLE) + u32(slot >= RAIN_FAR);
    let own = uniforms.rain.drops[kind];

    // Each time that it has fallen the whole height, a drop is another one.
    let fallen = own.fallen_fraction + f32(rain_hash(number) >> 16u) / 65536.0;
    let times = (u32(own.fallen_count) + u32(fallen)) & 0xffffu;
    let shares = rain_shares(rain_hash((times << 15u) | number));
    if shares.w >= rain.amount {
        return RainVaryings(vec4f(0.0, 0.0, 0.0, 1.0), vec2f(0.0), vec4f(0.0));
    }
    let radius = own.radius_m + own.radius_range_m * shares.y;
    let height = RAIN_HEIGHT * (0.5 - fract(fallen));
    // Inside -pi..pi a GPU's sine is exact enough.
    let angle = TAU * ((f32(column) + shares.x) / f32(RAIN_COLUMNS) - 0.5);
    let turned = vec2f(sin(angle), cos(angle));

    // What would be narrower or shorter than a pixel is as large as one, and fainter.
    let distance = length(vec2f(radius, height));
    let size = max(own.half_size_m, rain.pixel_rad * distance * vec2f(1.0, distance / radius));
    let ends = min(RAIN_FADE * min(fract(fallen), 1.0 - fract(fallen)), 1.0);
    let fainter = own.half_size_m / size;
    let opacity = own.opacity * fainter.x * fainter.y * ends * (0.4 + 0.6 * shares.z);

    // Corners 0 to 3 in the order 0, 1, 2, 2, 1, 3: two bits each.
    let corner = (0xda4u >> (2u * (index % 6u))) & 3u;
    let side = vec2f(f32(corner & 1u), f32(corner >> 1u)) * 2.0 - 1.0;
    let across = turned * radius + vec2f(turned.y, -turned.x) * (side.x * size.x);
    let along = height + side.y * size.y;
    let position = rain.right * across.x + rain.up * along + rain.forward * across.y;
    let clip = vec3f(
        dot(position, uniforms.camera.clip_x.xyz),
        dot(position, uniforms.camera.clip_y.xyz),
        dot(position, uniforms.camera.clip_w.xyz),
    );
    let colour = display_colour(rain.streak);
    return RainVaryings(vec4f(clip.xy, FAR_DEPTH * clip.z, clip.z), side, vec4f(colour, opacity));
}

@fragment
fn fs_rain(in: RainVaryings) -> @location(0) vec4f {
    let profile = (1.0 - abs(in.place.x)) * (1.0 - in.place.y * in.place.y);
    // A ray along the fall never meets the plane of a streak, yet rounding may give it the pixel: its place there is not a number.
    let is_met = abs(in.place.x) < 1.0 && abs(in.place.y) < 1.0;
    return vec4f(in.colour.rgb, select(0.0, in.colour.w * profile, is_met));
}

// What the haze leaves of what is seen along a unit direction, and its own light.
fn rain_hazed(radiance: vec3f, direction: vec3f) -> vec3f {
    let rain = uniforms.rain;
    let thick = RAIN_HAZE_ABOVE + (1.0 - RAIN_HAZE_ABOVE) * exp2(-RAIN_HAZE_FALL * abs(direction.y));
    return mix(radiance, rain.haze, rain.haze_opacity * thick);
}
