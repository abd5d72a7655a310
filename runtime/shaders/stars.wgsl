// Stars: one texel is one star, drawn as a point of its own. Theory and CPU part: stars.rs.
struct StarUniforms {
    field: vec4f, // x: level; y: texels a side of that level; z: place in the period, 0..1; w: brightness
    spread: vec4f, // x: 1 if light is spread over the pixel's own solid angle, 0 if over that of one in the middle
}

// The light of a star at this frame's time, from its four numbers.
fn star_intensity(star: vec4f, period: f32) -> f32 {
    let turns = fract(star.g * STAR_RATE_STEPS * period + star.a);
    // sin(2 pi x) = -sin(2 pi (x - 1/2)): inside -pi..pi a GPU's sine is exact enough.
    return star.r - star.b * sin(TAU * (turns - 0.5));
}

// Stars lie at their own mirrored and transposed place in each tile (welkin_pack::mapping::dome_to_star).
fn turn_star(tile: vec2i, uv: vec2f) -> vec2f {
    let flipped = select(uv, 1.0 - uv, (tile & vec2i(1)) == vec2i(1));
    return select(flipped, flipped.yx, star_tile_swaps(tile));
}

fn turn_star_back(tile: vec2i, uv: vec2f) -> vec2f {
    let swapped = select(uv, uv.yx, star_tile_swaps(tile));
    return select(swapped, 1.0 - swapped, (tile & vec2i(1)) == vec2i(1));
}

fn star_tile_swaps(tile: vec2i) -> bool {
    return (((tile.x ^ tile.y) >> 1u) & 1) == 1;
}

// The solid angle of a pixel in the middle of the screen over that of one in a direction, if stars are spread so.
fn star_spread(direction: vec3f) -> f32 {
    let narrowing = pixel_narrowing(direction);
    return mix(1.0, 1.0 / (narrowing * narrowing * narrowing), uniforms.stars.spread.x);
}

// Radiance of the star whose texel covers `dome`, which is in `direction`, at the pixel with centre `pixel`.
fn star_radiance(dome: vec2f, direction: vec3f, pixel: vec2f, galaxy: f32) -> vec3f {
    let field = uniforms.stars.field;
    let scaled = (dome + STAR_START) * (1.0 / STAR_TILE_SIDE);
    let corner = floor(scaled);
    let tile = vec2i(corner);
    let uv = turn_star(tile, scaled - corner);
    let texel = vec2i(min(uv * field.y, vec2f(field.y - 1.0)));
    let star = textureLoad(stars_texture, texel, i32(field.x));
    if star.r == 0.0 {
        return vec3f(0.0);
    }
    let centre = corner + turn_star_back(tile, (vec2f(texel) + 0.5) / field.y);
    let offset = abs(pixel_of(dome_to_direction(centre * STAR_TILE_SIDE - STAR_START)) - pixel);
    // A tent one pixel wide each way: over the pixels of a row its weights add up to 1 wherever the
    // star is between them, so a star that moves never changes its total light.
    let tent = max(1.0 - offset, vec2f(0.0));
    let light = star_intensity(star, field.z) * field.w * tent.x * tent.y * star_spread(direction);
    return mix(STAR_WARM, STAR_COLD, star.a) * (light * (1.0 + STAR_GALAXY_BOOST * galaxy));
}
