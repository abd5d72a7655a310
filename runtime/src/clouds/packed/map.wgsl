// The map of the packed method: its photo here and at three places towards the sun. CPU part: map.rs.
@fragment
fn fs_packed_map(@builtin(position) position: vec4f) -> @location(0) vec4f {
    let packed = uniforms.packed;
    let uv = position.xy / packed.map_side;
    let halved = log2(f32(textureDimensions(clouds_texture).x) / packed.map_side);
    return vec4f(
        packed_sample(uv + PACKED_PLACES.x * packed.photo_step, packed.march_levels.x).r,
        packed_sample(uv + PACKED_PLACES.y * packed.photo_step, packed.march_levels.y).r,
        packed_sample(uv + PACKED_PLACES.z * packed.photo_step, packed.march_levels.z).r,
        packed_sample(uv, halved).r,
    );
}
