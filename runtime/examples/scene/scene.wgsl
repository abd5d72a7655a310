// A valley between hills, lit by the sky. The functions of Welkin's light, air and cloud shadows stand before this text.
// The world is that of the sky: metres to the east (x), up (y) and to the south (z).

struct Frame {
    clip_from_world: mat4x4f,
    eye: vec4f,
    shadow_area: vec4f, // all 0 where clouds throw no shadows one by one
    light: SkyLight,
    air: Air,
}
@group(0) @binding(0) var<uniform> frame: Frame;
@group(0) @binding(1) var shadow_map: texture_2d<f32>;
@group(0) @binding(2) var shadow_sampler: sampler;

// Rings of a disc about the origin, of which each is a little wider than the one before, and their corners.
const RINGS: u32 = 320u;
const CORNERS: u32 = 512u;
const FARTHEST_M: f32 = 40000.0;

fn hash(cell: vec2i) -> f32 {
    var h = bitcast<u32>(cell.x) * 0x9e3779b9u ^ bitcast<u32>(cell.y) * 0x85ebca6bu;
    h = (h ^ (h >> 15u)) * 0x2c1b3c6du;
    h = (h ^ (h >> 12u)) * 0x297a2d39u;
    return f32(h >> 8u) / 16777216.0;
}

fn noise(place: vec2f) -> f32 {
    let cell = vec2i(floor(place));
    let f = fract(place);
    let s = f * f * f * (f * (f * 6.0 - 15.0) + 10.0);
    let low = mix(hash(cell), hash(cell + vec2i(1, 0)), s.x);
    let high = mix(hash(cell + vec2i(0, 1)), hash(cell + vec2i(1, 1)), s.x);
    return mix(low, high, s.y);
}

// Height over the bottom of the valley: soft near the viewer, ridges far away.
fn height(place: vec2f, octaves: i32) -> f32 {
    var p = place / 3800.0 + vec2f(11.3, 4.7);
    var sum = 0.0;
    var weight = 1.0;
    for (var i = 0; i < octaves; i++) {
        let ridge = 1.0 - abs(2.0 * noise(p) - 1.0);
        sum += weight * ridge * ridge;
        weight *= 0.42;
        p = mat2x2f(1.6, 1.2, -1.2, 1.6) * p;
    }
    let away = length(place);
    return 90.0 * sum * smoothstep(0.0, 900.0, away) + 900.0 * sum * smoothstep(600.0, 9000.0, away);
}

struct Varyings {
    @builtin(position) position: vec4f,
    @location(0) place: vec3f,
}

@vertex
fn vs_scene(@builtin(vertex_index) index: u32) -> Varyings {
    // Two triangles a cell; their corners by bits.
    let cell = index / 6u;
    let corner = array<u32, 6>(0u, 1u, 2u, 2u, 1u, 3u)[index % 6u];
    let ring = f32(cell / CORNERS + (corner >> 1u)) / f32(RINGS);
    let turn = f32(cell % CORNERS + (corner & 1u)) / f32(CORNERS) * 6.2831853;
    let radius = 1.5 * (pow(FARTHEST_M / 1.5 + 1.0, ring) - 1.0);
    let flat = radius * vec2f(cos(turn), sin(turn));
    let place = vec3f(flat.x, height(flat, 7), flat.y);
    return Varyings(frame.clip_from_world * vec4f(place, 1.0), place);
}

// The share of sun or moon that the hills leave: the nearest miss of a few steps towards it.
fn hills_leave(place: vec3f, towards: vec3f) -> f32 {
    var open = 1.0;
    var step = 12.0;
    var way = step;
    for (var i = 0; i < 14; i++) {
        let at = place + towards * way;
        open = min(open, 0.5 + 12.0 * (at.y - height(at.xz, 4)) / way);
        step *= 1.45;
        way += step;
    }
    return clamp(open, 0.0, 1.0);
}

@fragment
fn fs_scene(in: Varyings) -> @location(0) vec4f {
    let place = in.place;
    let away = distance(place, frame.eye.xyz);
    let reach = max(0.4, 0.004 * away);
    let octaves = 10 - i32(clamp(log2(away / 300.0), 0.0, 3.0));
    let here = height(place.xz, octaves);
    let slope = vec2f(height(place.xz + vec2f(reach, 0.0), octaves), height(place.xz + vec2f(0.0, reach), octaves)) - here;
    let normal = normalize(vec3f(-slope.x, reach, -slope.y));

    // Patches of meadow and heath; blades of grass only where a pixel shows them.
    let patches = 0.5 * noise(place.xz / 310.0) + 0.3 * noise(place.xz / 70.0) + 0.2 * noise(place.xz / 17.0);
    let grain = 2.0 * patches + noise(place.xz / 9.0);
    let blades = mix(noise(place.xz / 0.35) * noise(place.xz / 1.7), 0.25, smoothstep(20.0, 300.0, away));
    let steep = smoothstep(0.72, 0.88, normal.y + 0.04 * grain);
    let grass = mix(vec3f(0.055, 0.070, 0.025), vec3f(0.115, 0.100, 0.055), smoothstep(0.35, 0.75, patches));
    var albedo = mix(vec3f(0.12, 0.105, 0.09), grass * (0.7 + 1.2 * blades), steep);
    let snow = smoothstep(1250.0, 1500.0, place.y + 150.0 * grain) * smoothstep(0.6, 0.8, normal.y);
    albedo = mix(albedo, vec3f(0.75), snow);

    let light = frame.light;
    let up = select(light.moon_direction, light.sun_direction, light.sun_direction.y > light.moon_direction.y);
    var direct = sky_light_direct(light, normal);
    if frame.shadow_area.z > 0.0 {
        // Farther away than the shadows reach clouds count by their mean.
        let mean = max(light.sun.g, light.moon.g) / max(max(light.clear_sun.g, light.clear_moon.g), 1e-9);
        direct = sky_light_clear(light, normal) * cloud_shadow_or(shadow_map, shadow_sampler, frame.shadow_area, place.xz, mean);
    }
    let irradiance = direct * hills_leave(place + normal, up) + sky_light_ambient(light, normal);
    let radiance = albedo / 3.14159265 * irradiance;
    return vec4f(air_between(frame.air, radiance, frame.eye.xyz, place), 1.0);
}
