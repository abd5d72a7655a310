// What every map shares: the triangle over its target, and its levels. CPU part: map.rs.
struct MapVaryings {
    @builtin(position) position: vec4f,
    @location(0) @interpolate(flat) layer: u32, // of an array that is drawn a layer at a time
}

@vertex
fn vs_map(@builtin(vertex_index) index: u32, @builtin(instance_index) layer: u32) -> MapVaryings {
    return MapVaryings(vec4f(f32(index & 1u) * 4.0 - 1.0, f32(index >> 1u) * 4.0 - 1.0, 0.0, 1.0), layer);
}

// A level from the one above it: the mean of 2x2 texels.
@fragment
fn fs_level(@builtin(position) position: vec4f) -> @location(0) vec4f {
    let corner = vec2i(position.xy) * 2;
    let upper = textureLoad(map_texture, corner, 0) + textureLoad(map_texture, corner + vec2i(1, 0), 0);
    let lower = textureLoad(map_texture, corner + vec2i(0, 1), 0) + textureLoad(map_texture, corner + vec2i(1, 1), 0);
    return 0.25 * (upper + lower);
}
