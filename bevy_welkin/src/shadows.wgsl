// The clouds' shadows, turned from the axes of the ground to those of the directional light that they dim. CPU part: shadows.rs.

struct Turn {
    // Unit vector on the ground below the sun (east, south).
    towards: vec2f,
    // From the middle of the shadows to that of the light's texture, over the side of the shadows.
    moved: vec2f,
    // What clouds leave of the light on average.
    mean: f32,
}

@group(0) @binding(0) var<uniform> turn: Turn;
@group(0) @binding(1) var shadow_map: texture_2d<f32>;
@group(0) @binding(2) var shadow_sampler: sampler;

struct Varyings {
    @builtin(position) position: vec4f,
    @location(0) uv: vec2f,
}

@vertex
fn vs_turn(@builtin(vertex_index) index: u32) -> Varyings {
    let uv = vec2f(f32((index << 1u) & 2u), f32(index & 2u));
    return Varyings(vec4f(uv * vec2f(2.0, -2.0) + vec2f(-1.0, 1.0), 0.0, 1.0), uv);
}

@fragment
fn fs_turn(in: Varyings) -> @location(0) vec4f {
    // Bevy reads the texture at -x and +y of the light's own axes; on the ground +y lies away from the sun.
    let place = vec2f(1.0 - 2.0 * in.uv.x, 2.0 * in.uv.y - 1.0);
    let right = vec2f(turn.towards.y, -turn.towards.x);
    let ground = 0.5 * (place.x * right - place.y * turn.towards);
    let shadow = textureSampleLevel(shadow_map, shadow_sampler, 0.5 + turn.moved + ground, 0.0).r;
    // The texture repeats: its edge and its corners are as bright as clouds are on average.
    return vec4f(mix(shadow, turn.mean, smoothstep(0.85, 1.0, length(place))));
}
