// Stars: one texel is one star, drawn as a point of its own. Theory and CPU part: stars.rs.

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

fn star_tile_swaps(tile: vec2i) -> bool {
    return (((tile.x ^ tile.y) >> 1u) & 1) == 1;
}

// The solid angle of a pixel in the middle of the screen over that of one in a direction, if stars are spread so.
fn star_spread(direction: vec3f) -> f32 {
    let narrowing = pixel_narrowing(direction);
    return mix(1.0, 1.0 / (narrowing * narrowing * narrowing), uniforms.stars.evenness);
}

// How much the air adds to the height of a unit vector (almanac/refraction.rs).
fn star_lift(sine: f32) -> f32 {
    let y = max(sine, STAR_LEAST_SINE);
    return STAR_LIFT.x / (y + STAR_LIFT.y / (1.0 + STAR_LIFT.z * max(y, 0.0)));
}

// The other half of the dome, turned about the line through its nodes.
fn star_turned(direction: vec3f) -> vec3f {
    let node = vec3f(uniforms.stars.node_east, 0.0, uniforms.stars.node_south);
    return 2.0 * dot(node, direction) * node - direction;
}

// A direction above the horizon on the dome of the stars, before its lower half is turned up.
fn star_direction(direction: vec3f) -> vec3f {
    let stars = uniforms.stars;
    if stars.is_placed < 0.5 {
        return direction;
    }
    // What is seen there stands lower without air.
    let flat = 1.0 - direction.y * direction.y;
    let guess = direction.y - star_lift(direction.y - star_lift(direction.y) * flat) * flat;
    let lift = star_lift(guess);
    let airless = normalize(direction * (1.0 + lift * direction.y) - vec3f(0.0, lift, 0.0));
    return vec3f(dot(airless, stars.east), dot(airless, stars.zenith), dot(airless, stars.south));
}

// Where a direction of the dome of the stars is seen.
fn star_seen(own: vec3f, is_turned: bool) -> vec3f {
    let stars = uniforms.stars;
    if stars.is_placed < 0.5 {
        return own;
    }
    let place = select(own, star_turned(own), is_turned);
    let airless = place.x * stars.east + place.y * stars.zenith + place.z * stars.south;
    return normalize(airless + vec3f(0.0, star_lift(airless.y), 0.0));
}

// The texel of a cell: cells of a level cover the plane of the tiles, `side` of them a tile.
fn star_texel(cell: vec2i, side: f32) -> vec2i {
    let tile = vec2i(floor(vec2f(cell) / side));
    let uv = turn_star(tile, (vec2f(cell) + 0.5) / side - vec2f(tile));
    return vec2i(uv * side);
}

// What the star of a cell gives to the pixel with centre `pixel`, by its tent. A tent one pixel wide each way: over the pixels of a row
// its weights add up to 1 wherever the star is between them, so a star that moves never changes its total light.
fn star_light(cell: vec2i, pixel: vec2f, is_turned: bool) -> vec3f {
    let stars = uniforms.stars;
    let star = textureLoad(stars_texture, star_texel(cell, stars.resolution), i32(stars.level));
    if star.r == 0.0 {
        return vec3f(0.0);
    }
    let centre = (vec2f(cell) + 0.5) * (STAR_TILE_SIDE / stars.resolution) - STAR_START;
    // Beyond the equator is the other half.
    if stars.is_placed > 0.5 && dot(centre, centre) > 2.0 {
        return vec3f(0.0);
    }
    let offset = abs(pixel_of(star_seen(dome_to_direction(centre), is_turned)) - pixel);
    let tent = max(1.0 - offset, vec2f(0.0));
    return mix(STAR_WARM, STAR_COLD, star.a) * (star_intensity(star, stars.period) * tent.x * tent.y);
}

// The light of all stars whose tents may reach the pixel: a cell of the level above is empty if the four below it are.
fn stars_around(dome: vec2f, height: f32, pixel: vec2f, is_turned: bool) -> vec3f {
    let side = 0.5 * uniforms.stars.resolution;
    let level = i32(uniforms.stars.level) + 1;
    // The projection widens angles across the direction to the zenith by the most.
    let reach = uniforms.stars.reach_rad * inverseSqrt(0.5 + 0.5 * max(height, 0.0));
    let low = vec2i(floor((dome + STAR_START - reach) * (side / STAR_TILE_SIDE)));
    let high = vec2i(floor((dome + STAR_START + reach) * (side / STAR_TILE_SIDE)));
    var light = vec3f(0.0);
    for (var y = low.y; y <= high.y; y++) {
        for (var x = low.x; x <= high.x; x++) {
            let cell = vec2i(x, y);
            if textureLoad(stars_texture, star_texel(cell, side), level).r > 0.0 {
                for (var i = 0; i < 4; i++) {
                    light += star_light(2 * cell + vec2i(i & 1, i >> 1u), pixel, is_turned);
                }
            }
        }
    }
    return light;
}

// Radiance of the stars around `dome`, a place of their dome at that height, seen in `direction`, at the pixel with centre `pixel`.
fn star_radiance(dome: vec2f, height: f32, direction: vec3f, pixel: vec2f, galaxy: f32, is_turned: bool) -> vec3f {
    let stars = uniforms.stars;
    var light: vec3f;
    if stars.is_guided > 0.5 {
        light = stars_around(dome, height, pixel, is_turned);
    } else {
        light = star_light(vec2i(floor((dome + STAR_START) * (stars.resolution / STAR_TILE_SIDE))), pixel, is_turned);
    }
    return light * (stars.brightness * star_spread(direction) * (1.0 + STAR_GALAXY_BOOST * galaxy));
}
