// Stars of a catalogue: those near a pixel are in the list of its cell. CPU part: catalogue.rs, cells.rs.

fn catalogue_texel(index: u32) -> vec4f {
    return textureLoad(catalogue_texture, vec2u(index % CATALOGUE_WIDTH, index / CATALOGUE_WIDTH), 0);
}

// Their radiance at the pixel with centre `pixel`.
fn catalogue_radiance(pixel: vec2f) -> vec3f {
    let own = uniforms.catalogue;
    let cell = vec2u(min(pixel * own.cells_a_pixel, own.last_cell));
    let list = vec2u(catalogue_texel(cell.y * u32(own.columns) + cell.x).xy);
    var light = vec3f(0.0);
    for (var i = 0u; i < list.y; i++) {
        let star = catalogue_texel(list.x + 2u * i);
        let away = pixel - star.xy;
        let tents = max(1.0 - abs(away), vec2f(0.0));
        let tent = tents.x * tents.y;
        let root = inverseSqrt(dot(away, away) + star.z);
        let wing = max(root * root * root - star.w, 0.0);
        if tent + wing > 0.0 {
            let own_light = catalogue_texel(list.x + 2u * i + 1u);
            light += own_light.rgb * (own_light.a * tent + wing);
        }
    }
    return light;
}
