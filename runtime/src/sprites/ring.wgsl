// The ring of impostors: far clouds as eight pictures around the viewer. Theory and CPU part: sprites/ring.rs.
struct RingSet {
    place: vec4f, // xyz: from the viewer to the middle of the ring, m; w: its share
    span: vec4f,  // x: tangent of the elevation at the upper edge; y: 1 / (that less the lower edge's); z: 1 / width of a picture, over the radius
}

struct RingUniforms {
    used: RingSet,
    next: RingSet,
    walls: vec4f, // x: radius to the middle of a side, m; y, z: tangents at the lower and the upper edge of what is drawn
    sides: array<vec4f, 8>, // xy: outward normal of a side (east, south), from the north to the east; zw: along it, clockwise
}

@group(1) @binding(7) var<uniform> ring: RingUniforms;
@group(1) @binding(8) var used_ring_texture: texture_2d_array<f32>;
@group(1) @binding(9) var next_ring_texture: texture_2d_array<f32>;

struct RingVaryings {
    @builtin(position) position: vec4f,
    @location(0) place: vec3f, // from the viewer, m
}

// Walls of an octagon around the viewer, as a strip.
@vertex
fn vs_ring(@builtin(vertex_index) index: u32) -> RingVaryings {
    let azimuth = (f32(index >> 1u) - 0.5) * (TAU / 8.0);
    let height = select(ring.walls.y, ring.walls.z, (index & 1u) == 1u);
    let place = ring.walls.x * vec3f(sin(azimuth) / RING_COS, height, -cos(azimuth) / RING_COS);
    let clip = vec4f(
        dot(place, sprite_view.clip_x.xyz),
        dot(place, sprite_view.clip_y.xyz),
        dot(place, sprite_view.clip_z.xyz) + sprite_view.clip_z.w,
        dot(place, sprite_view.clip_w.xyz),
    );
    return RingVaryings(clip, place);
}

// The side of an octagon that a direction points at.
fn ring_side(direction: vec2f) -> u32 {
    let size = abs(direction);
    let east = direction.x > 0.0;
    let south = direction.y > 0.0;
    if min(size.x, size.y) > RING_HALF_SIDE * max(size.x, size.y) {
        return select(select(7u, 1u, east), select(5u, 3u, east), south);
    }
    return select(select(0u, 4u, south), select(6u, 2u, east), size.x > size.y);
}

// Where a ray meets a side: its place from the octagon's middle over the radius, and how far along the side.
fn ring_reach(octagon: RingSet, direction: vec3f, side: u32) -> vec4f {
    let normal = ring.sides[side];
    let reach = (ring.walls.x + dot(normal.xy, octagon.place.xz)) / dot(normal.xy, direction.xz);
    let hit = (direction * reach - octagon.place.xyz) / ring.walls.x;
    return vec4f(hit, dot(normal.zw, hit.xz));
}

// Where a ray leaves the octagon: its side, and u and v on that side's picture.
fn ring_hit(octagon: RingSet, direction: vec3f) -> vec3f {
    var side = ring_side(direction.xz);
    var hit = ring_reach(octagon, direction, side);
    // As the viewer is not in the middle, it may be the next one.
    if abs(hit.w) > RING_HALF_SIDE {
        side = (side + select(7u, 1u, hit.w > 0.0)) & 7u;
        hit = ring_reach(octagon, direction, side);
    }
    return vec3f(f32(side), 0.5 + hit.w * octagon.span.z, (octagon.span.x - hit.y) * octagon.span.y);
}

// Radiance as the pictures hold it: bytes, which blend as the target does.
fn ring_stored(radiance: vec3f) -> vec3f {
    if OUTPUT == OUTPUT_RADIANCE {
        return min(radiance / RING_BRIGHTEST, vec3f(1.0));
    }
    return display_colour(radiance);
}

@fragment
fn fs_ring(in: RingVaryings) -> @location(0) vec4f {
    let direction = in.place * inverseSqrt(dot(in.place, in.place));
    var texel = vec4f(0.0);
    if ring.used.place.w > 0.0 {
        let hit = ring_hit(ring.used, direction);
        if hit.z >= 0.0 && hit.z <= 1.0 {
            texel += ring.used.place.w * textureSampleLevel(used_ring_texture, clamp_sampler, hit.yz, i32(hit.x), 0.0);
        }
    }
    if ring.next.place.w > 0.0 {
        let hit = ring_hit(ring.next, direction);
        if hit.z >= 0.0 && hit.z <= 1.0 {
            texel += ring.next.place.w * textureSampleLevel(next_ring_texture, clamp_sampler, hit.yz, i32(hit.x), 0.0);
        }
    }
    if OUTPUT == OUTPUT_RADIANCE {
        texel = vec4f(texel.rgb * RING_BRIGHTEST, texel.a);
    }
    return texel;
}
