// The ring of impostors: far clouds as eight pictures around the viewer. Theory and CPU part: ring.rs.

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
    let height = select(ring.bottom, ring.top, (index & 1u) == 1u);
    let place = ring.radius_m * vec3f(sin(azimuth) / RING_COS, height, -cos(azimuth) / RING_COS);
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

// How high a ray meets a side, and how far along it, from its middle over the radius.
struct RingReach {
    up: f32,
    along: f32,
}

fn ring_reach(octagon: RingSet, direction: vec3f, side: u32) -> RingReach {
    let normal = ring.sides[side].normal;
    let reach = (ring.radius_m + dot(normal, octagon.centre.xz)) / dot(normal, direction.xz);
    let hit = (direction * reach - octagon.centre) / ring.radius_m;
    return RingReach(hit.y, dot(ring.sides[side].along, hit.xz));
}

// Where a ray leaves the octagon: its side, and where on that side's picture.
struct RingHit {
    side: u32,
    uv: vec2f,
}

fn ring_hit(octagon: RingSet, direction: vec3f) -> RingHit {
    var side = ring_side(direction.xz);
    var hit = ring_reach(octagon, direction, side);
    // As the viewer is not in the middle, it may be the next one.
    if abs(hit.along) > RING_HALF_SIDE {
        side = (side + select(7u, 1u, hit.along > 0.0)) & 7u;
        hit = ring_reach(octagon, direction, side);
    }
    let uv = vec2f(0.5 + hit.along * octagon.per_width, (octagon.top - hit.up) * octagon.per_height);
    return RingHit(side, uv);
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
    if ring.used.weight > 0.0 {
        let hit = ring_hit(ring.used, direction);
        if hit.uv.y >= 0.0 && hit.uv.y <= 1.0 {
            texel += ring.used.weight * textureSampleLevel(used_ring_texture, clamp_sampler, hit.uv, i32(hit.side), 0.0);
        }
    }
    if ring.next.weight > 0.0 {
        let hit = ring_hit(ring.next, direction);
        if hit.uv.y >= 0.0 && hit.uv.y <= 1.0 {
            texel += ring.next.weight * textureSampleLevel(next_ring_texture, clamp_sampler, hit.uv, i32(hit.side), 0.0);
        }
    }
    if OUTPUT == OUTPUT_RADIANCE {
        texel = vec4f(texel.rgb * (RING_BRIGHTEST * uniforms.tonemap.exposure), texel.a);
    }
    if OUTPUT == OUTPUT_OPACITY {
        // Of the bytes alpha alone is not encoded.
        texel = vec4f(texel.a);
    }
    return texel;
}
