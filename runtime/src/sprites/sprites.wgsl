// Clouds of sprites in space. Theory and CPU part: mod.rs and the files beside it.

// Outlines of the sheet's cells: eight vertices each, two a vector.
struct SpriteOutlines {
    vertices: array<vec4f, 64>,
}

@group(1) @binding(3) var sheet_texture: texture_2d<f32>;
@group(1) @binding(4) var amounts_texture: texture_2d<f32>;
@group(1) @binding(5) var<uniform> sprite_view: SpriteView;
@group(1) @binding(6) var<uniform> sprite_block: SpriteBlock;
@group(1) @binding(10) var<uniform> sprite_outlines: SpriteOutlines;
@group(1) @binding(11) var instances_texture: texture_2d<u32>;
@group(1) @binding(12) var exposed_sides: texture_3d<f32>;
@group(1) @binding(13) var exposed_above: texture_3d<f32>;

struct SpriteInstance {
    centre: vec3f,      // in its block, m
    turn: f32,          // radians
    half_size: vec2f,   // half width and half height, m
    heights: vec2f,     // fractions of the cloud's height at its lower and upper edge
    from_group: vec3f,  // from the middle of its shading group, m
    lies_flat: bool,
    from_cloud: vec3f,  // from the middle of its cloud, m
    cloud_radius: f32,  // m
    low: vec4f,         // colour level at its lower edge, and opacity
    high: vec4f,        // the same at its upper edge
    cell: u32,          // of the sheet
    cloud: vec2u,       // low and high byte of its cloud's number
    is_billboard: bool, // of a whole cloud
    lock: vec3f,        // the way it faces for ever
    is_locked: f32,     // 1 if it does
}

// A sprite of the block. Read from a texture, since instances of a few vertices each leave most of a GPU's lanes idle.
fn sprite_instance(number: u32) -> SpriteInstance {
    let place = sprite_block.first + number;
    let texel = vec2u((place % SPRITES_A_ROW) * 4u, place / SPRITES_A_ROW);
    let a = textureLoad(instances_texture, texel, 0);
    let b = textureLoad(instances_texture, texel + vec2u(1u, 0u), 0);
    let c = textureLoad(instances_texture, texel + vec2u(2u, 0u), 0);
    let d = textureLoad(instances_texture, texel + vec2u(3u, 0u), 0);
    let position = bitcast<vec4f>(a);
    let from_group = vec4f(unpack2x16snorm(b.z), unpack2x16snorm(b.w));
    let from_cloud = SPRITE_MOST_AWAY * vec4f(unpack2x16snorm(c.x), unpack2x16snorm(c.y));
    let lock = unpack4x8snorm(d.y);
    return SpriteInstance(
        position.xyz,
        position.w,
        SPRITE_MOST_HALF_SIZE * unpack2x16unorm(b.x),
        unpack2x16unorm(b.y),
        SPRITE_MOST_AWAY * from_group.xyz,
        from_group.w > 0.5,
        from_cloud.xyz,
        from_cloud.w,
        unpack4x8unorm(c.z),
        unpack4x8unorm(c.w),
        d.x & 255u,
        vec2u((d.x >> 8u) & 255u, (d.x >> 16u) & 255u),
        (d.x >> 24u) == 1u,
        lock.xyz,
        lock.w,
    );
}

// A vertex, with colours as the target has them.
struct SpriteVaryings {
    @builtin(position) position: vec4f,
    @location(0) uv: vec2f,
    @location(1) @interpolate(flat) level: f32,
    @location(2) light: vec4f,      // rgb: where the picture's greys are one half; w: opacity
    @location(3) sunlit: vec3f,     // what sunlight that is as strong again adds
    @location(4) skylit: vec3f,     // the same of skylight
    @location(5) sun: vec4f,        // shares of it by grey, right and top above one half, and by what is clear
    @location(6) sky: vec3f,        // the same of skylight, without the clear
}

// A cloud forms from its middle to its edge, in two stages: sprites whose centre is within half its radius, then the others.
// `place` of a vertex and `centre` of its sprite are 0 in the middle of the cloud, 1 on the edge.
fn sprite_formed(amount: f32, place: f32, centre: f32) -> f32 {
    let core = min(2.0 * amount, 1.0);
    let edges = 1.0 - max(2.0 * amount - 1.0, 0.0);
    let stage = select(1.0, 1.0 - edges, centre > SPRITE_FIRST_STAGE);
    return clamp(core - edges * place, 0.0, 1.0) * stage;
}

fn sprite_amount(cloud: vec2u) -> f32 {
    return textureLoad(amounts_texture, cloud, 0).r;
}

// What the air between viewer and place leaves of light: its density falls exponentially with height.
fn sprite_clearness(place: vec3f, distance: f32) -> f32 {
    let own = uniforms.sprites;
    let rise = place.y * own.air_height_per_m;
    let mean = select((1.0 - exp(-rise)) / rise, 1.0 - 0.5 * rise, abs(rise) < 1e-3);
    let at_viewer = exp(-max(sprite_view.height_m, 0.0) * own.air_height_per_m);
    return exp(-own.extinction_per_m * at_viewer * mean * distance);
}

// The sprite's right and up, in the order of its own turn; it faces the viewer, or as it is locked, or up.
fn sprite_axes(instance: SpriteInstance, facing: vec3f) -> mat2x3f {
    let turn = vec2f(cos(instance.turn), sin(instance.turn));
    if instance.lies_flat {
        return mat2x3f(vec3f(turn.x, 0.0, -turn.y), vec3f(-turn.y, 0.0, -turn.x));
    }
    let across = vec3f(facing.z, 0.0, -facing.x);
    let width = length(across);
    let right = select(vec3f(1.0, 0.0, 0.0), across / width, width > 1e-4);
    let up = cross(facing, right);
    return mat2x3f(right * turn.x + up * turn.y, up * turn.x - right * turn.y);
}

// What of sun and sky gets to a place.
struct SpriteExposure {
    depth: f32, // halvings of sunlight on its way there
    sky: f32,   // share of skylight
}

// Of a place in the block. Sunlight is dimmed as it is between the three directions about the sun's, by the squares of its cosines to them.
fn sprite_exposure(place: vec3f) -> SpriteExposure {
    let field = place + vec3f(sprite_block.section.x, -sprite_block.exposed_base_m, sprite_block.section.y);
    var uv = field * sprite_block.exposed_per_m.xyx;
    let half_texel = 0.5 / f32(textureDimensions(exposed_above).y);
    uv.y = clamp(uv.y, half_texel, 1.0 - half_texel);
    let sides = textureSampleLevel(exposed_sides, repeat_sampler, uv, 0.0);
    let above = textureSampleLevel(exposed_above, repeat_sampler, uv, 0.0);
    let sun = uniforms.sprites.light_direction;
    let east_west = select(sides.z, sides.x, sun.x > 0.0);
    let south_north = select(sides.w, sides.y, sun.z > 0.0);
    let depth = SPRITE_MOST_DEPTH * dot(sun * sun, vec3f(east_west, above.x, south_north));
    return SpriteExposure(depth, above.y);
}

// What a sprite shows, as radiance.
struct SpriteShade {
    sunlit: vec3f,
    skylit: vec3f,
    sun: vec4f, // see SpriteVaryings
    sky: vec3f,
}

// Share of sunlight that is scattered once, as `single` to this direction, and many times.
fn sprite_sunlit(depth: f32, single: f32) -> f32 {
    return CLOUD_MULTIPLE.x * exp2(-CLOUD_MULTIPLE.y * depth) + single * exp2(-depth);
}

// Light once and many times scattered, with what of it the sides of the picture take: docs/clouds.md. It is that of the place, not of
// the sprite, so that neighbours which overlap are lit alike. What is seen is the near side of a body.
fn sprite_scattered(instance: SpriteInstance, axes: mat2x3f, facing: vec3f, offset: vec3f, direction: vec3f) -> SpriteShade {
    let own = uniforms.sprites;
    let sun = own.light_direction;
    let radius = max(instance.half_size.x, instance.half_size.y);
    let exposure = sprite_exposure(instance.centre + offset + SPRITE_BULGE * radius * facing);
    let depth = own.thickness * exposure.depth;
    let phase = cloud_phase(dot(direction, sun));
    let sunlit = sprite_sunlit(depth, CLOUD_SINGLE.x + SPRITE_PHASE * phase);
    let towards = vec3f(dot(axes[0], sun), dot(axes[1], sun), dot(facing, sun));
    let up = vec3f(axes[0].y, axes[1].y, facing.y);
    let front = mix(SPRITE_FRONT, 1.0, max(towards.z, 0.0));
    let rim = CLOUD_SINGLE.y * max(-towards.z, 0.0) * phase * exp2(-depth);
    return SpriteShade(
        sunlit * own.light,
        (SPRITE_LEAST_SKY + (1.0 - SPRITE_LEAST_SKY) * exposure.sky) * own.ambient,
        own.relief * vec4f(front, SPRITE_SIDES * towards.x, SPRITE_SIDES * towards.y, rim / max(sunlit, 1e-3)),
        own.relief * vec3f(SPRITE_FRONT, SPRITE_SIDES * up.x, SPRITE_SIDES * up.y),
    );
}

// The article's light, to which the grey is added.
fn sprite_article(instance: SpriteInstance, offset: vec3f, up: f32) -> SpriteShade {
    let own = uniforms.sprites;
    let share = mix(instance.heights.x, instance.heights.y, up);
    let ambient = mix(instance.low.rgb, instance.high.rgb, up) * own.ambient * (1.0 - own.dark_base * (1.0 - share));
    let from_group = instance.from_group + offset;
    let towards = dot(from_group, own.light_direction) / max(length(from_group), 1.0);
    let sun = own.light * mix(own.least, own.most, 0.5 + 0.5 * towards);
    return SpriteShade(sun, ambient, vec4f(own.relief, 0.0, 0.0, 0.0), vec3f(own.relief, 0.0, 0.0));
}

fn sprite_flash(place: vec3f) -> vec3f {
    let away = (place - uniforms.sprites.flash_position) * uniforms.sprites.flash_per_m;
    return uniforms.sprites.flash * exp2(-dot(away, away));
}

// What is left of clouds at the rim of sight.
fn sprite_rim(distance: f32) -> f32 {
    return clamp((uniforms.sprites.distance_m - distance) * uniforms.sprites.rim_per_m, 0.0, 1.0);
}

// Far away one billboard a cloud takes the place of its sprites.
fn sprite_drawn(instance: SpriteInstance, distance: f32) -> f32 {
    let near = clamp((uniforms.sprites.billboards_m - distance) * uniforms.sprites.change_per_m, 0.0, 1.0);
    return select(near, 1.0 - near, instance.is_billboard);
}

// How much of a sprite is there so far from its centre, by its cloud's forming and its height in it.
fn sprite_there(instance: SpriteInstance, amount: f32, offset: vec3f, up: f32) -> f32 {
    let places = vec2f(length(instance.from_cloud + offset), length(instance.from_cloud)) / instance.cloud_radius;
    return sprite_formed(amount, places.x, places.y) * mix(instance.low.a, instance.high.a, up);
}

// A vertex of a cell's outline; x and y in half sides, y up.
fn sprite_outline(cell: u32, vertex: u32) -> vec2f {
    let number = cell * 8u + vertex;
    let two = sprite_outlines.vertices[number >> 1u];
    return select(two.xy, two.zw, (number & 1u) == 1u);
}

// A corner of the outline, or of the box around it, anticlockwise.
fn sprite_corner(cell: u32, corner: u32) -> vec2f {
    if sprite_block.vertices_log2 == 3u {
        return sprite_outline(cell, corner);
    }
    let right = corner == 1u || corner == 2u;
    let up = corner >= 2u;
    return vec2f(sprite_outline(cell, select(4u, 0u, right)).x, sprite_outline(cell, select(5u, 1u, up)).y);
}

// A vertex, with colours as radiance.
fn sprite_vertex(index: u32) -> SpriteVaryings {
    let instance = sprite_instance(index >> sprite_block.vertices_log2);
    let own = uniforms.sprites;
    let middle = sprite_block.origin + instance.centre;
    let distance = max(length(middle), 1e-3);
    let radius = max(instance.half_size.x, instance.half_size.y);
    let to_viewer = -middle / distance;

    // In the cloud: facing and opacity of a sprite that is near or was passed.
    let locked = instance.is_locked * (1.0 - smoothstep(SPRITE_LOCK, 1.0, distance / radius));
    let meets = dot(instance.lock, to_viewer);
    let facing = normalize(mix(to_viewer, select(-instance.lock, instance.lock, meets >= 0.0), locked));
    let before = select(dot(facing, -middle), distance, instance.lies_flat) / radius;
    var opacity = mix(1.0, max(meets, 0.0), locked) * smoothstep(0.0, SPRITE_NEAR, before);

    // At the rim of sight clouds take the colour of what is behind them before they go.
    let rim = sprite_rim(distance);
    opacity *= min(SPRITE_RIM_OPAQUE * rim, 1.0) * sprite_drawn(instance, distance);

    let amount = sprite_amount(instance.cloud);
    opacity *= sprite_block.opacity * own.opacity;
    if opacity * amount <= 0.0 {
        return SpriteVaryings(vec4f(0.0, 0.0, 0.0, -1.0), vec2f(0.0), 0.0, vec4f(0.0), vec3f(0.0), vec3f(0.0), vec4f(0.0), vec3f(0.0));
    }

    let texels_a_pixel = sprite_view.cell_texels * sprite_view.pixel_rad * distance / (2.0 * sqrt(instance.half_size.x * instance.half_size.y));
    // Far away a whole level: between two, every texel of every sprite would cost two reads.
    let fine = max(log2(max(texels_a_pixel, 1e-6)), 0.0);
    let level = select(fine, round(fine), sprite_block.vertices_log2 == 2u);
    // A coarser level reaches farther by its texels.
    let spread = 1.0 + exp2(level + 1.0) / sprite_view.cell_texels;
    let outline = sprite_corner(instance.cell, index & ((1u << sprite_block.vertices_log2) - 1u));
    let corner = clamp(outline * spread, vec2f(-1.0), vec2f(1.0));
    let axes = sprite_axes(instance, facing);
    let offset = axes * (corner * instance.half_size);
    let place = middle + offset;
    let away = length(place);
    let direction = place / max(away, 1e-3);
    let up = clamp(0.5 + 0.5 * offset.y / instance.half_size.y, 0.0, 1.0);

    opacity *= sprite_there(instance, amount, offset, up);
    let clearness = sprite_clearness(place, away) * rim;
    let tint = clearness * mix(vec3f(1.0), uniforms.clouds.tint, cloud_tint(direction));
    var shade: SpriteShade;
    var sky_tint = tint;
    if own.thickness > 0.0 {
        shade = sprite_scattered(instance, axes, facing, offset, direction);
    } else {
        shade = sprite_article(instance, offset, up);
        sky_tint = vec3f(clearness);
    }
    let sunlit = shade.sunlit * tint;
    let skylit = shade.skylit * sky_tint;
    let seen = sunlit + skylit + sprite_flash(place) * clearness + sky_radiance(direction) * (1.0 - clearness);

    let clip = vec4f(
        dot(place, sprite_view.clip_x.xyz),
        dot(place, sprite_view.clip_y.xyz),
        dot(place, sprite_view.clip_z.xyz) + sprite_view.clip_z.w,
        dot(place, sprite_view.clip_w.xyz),
    );
    let cell = vec2f(f32(instance.cell & 3u), f32(instance.cell >> 2u));
    let uv = (cell + vec2f(0.5, -0.5) * corner + 0.5) * 0.25;
    return SpriteVaryings(clip, uv, level, vec4f(seen, opacity), sunlit, skylit, shade.sun, shade.sky);
}

// The share of more light at which the tone curve is met again: greys are about one half.
const SPRITE_STEP = 0.25;

// With the target's colours: of the vertex's light, and of what more sunlight and more skylight make of it.
fn sprite_shown(linear: SpriteVaryings, light: vec3f, sunlit: vec3f, skylit: vec3f) -> SpriteVaryings {
    var shown = linear;
    shown.light = vec4f(light, linear.light.w);
    shown.sunlit = (sunlit - light) / SPRITE_STEP;
    shown.skylit = (skylit - light) / SPRITE_STEP;
    return shown;
}

// The tone curve is taken at the vertices and is straight between two greys: sprites overlap by the dozen, and arithmetic for each texel
// is what they cost.
@vertex
fn vs_sprite(@builtin(vertex_index) index: u32) -> SpriteVaryings {
    let linear = sprite_vertex(index);
    let light = linear.light.rgb;
    let sunlit = display_colour(light + SPRITE_STEP * linear.sunlit);
    let skylit = display_colour(light + SPRITE_STEP * linear.skylit);
    return sprite_shown(linear, display_colour(light), sunlit, skylit);
}

// The same for a picture of the ring.
@vertex
fn vs_ring_sprite(@builtin(vertex_index) index: u32) -> SpriteVaryings {
    let linear = sprite_vertex(index);
    let light = linear.light.rgb;
    let sunlit = ring_stored(light + SPRITE_STEP * linear.sunlit);
    let skylit = ring_stored(light + SPRITE_STEP * linear.skylit);
    return sprite_shown(linear, ring_stored(light), sunlit, skylit);
}

@fragment
fn fs_sprite(in: SpriteVaryings) -> @location(0) vec4f {
    let texel = textureSampleLevel(sheet_texture, clamp_sampler, in.uv, in.level);
    if OUTPUT == OUTPUT_OPACITY {
        return vec4f(texel.g * saturate(in.light.w));
    }
    let greys = texel.rba - 0.5;
    let sun = dot(vec4f(greys, 1.0 - texel.g), in.sun);
    let sky = dot(greys, in.sky);
    let colour = in.light.rgb + sun * in.sunlit + sky * in.skylit;
    // Software rasterisers give what is no number at a pixel of a triangle seen edge on; `max` and `saturate` do not hand it on.
    return vec4f(max(colour, vec3f(0.0)), 1.0) * (texel.g * saturate(in.light.w));
}

// A vertex of a shadow.
struct SpriteCast {
    @builtin(position) position: vec4f,
    @location(0) uv: vec2f,
    @location(1) @interpolate(flat) level: f32,
    @location(2) opacity: f32,
}

// A sprite that faces sun or moon, laid on the ground along its light. CPU part: cast.rs.
@vertex
fn vs_sprite_cast(@builtin(vertex_index) index: u32) -> SpriteCast {
    let instance = sprite_instance(index >> sprite_block.vertices_log2);
    let middle = sprite_block.origin + instance.centre;
    let distance = length(middle);
    let amount = sprite_amount(instance.cloud);
    var opacity = min(SPRITE_RIM_OPAQUE * sprite_rim(distance), 1.0) * sprite_drawn(instance, distance);
    opacity *= sprite_block.opacity * uniforms.sprites.opacity;
    if opacity * amount <= 0.0 {
        return SpriteCast(vec4f(0.0, 0.0, 0.0, -1.0), vec2f(0.0), 0.0, 0.0);
    }
    let texels = sprite_view.cell_texels * sprite_view.texel_m / (2.0 * sqrt(instance.half_size.x * instance.half_size.y));
    let level = max(log2(max(texels, 1e-6)), 0.0);
    let spread = 1.0 + exp2(level + 1.0) / sprite_view.cell_texels;
    let outline = sprite_corner(instance.cell, index & ((1u << sprite_block.vertices_log2) - 1u));
    let corner = clamp(outline * spread, vec2f(-1.0), vec2f(1.0));
    let offset = sprite_axes(instance, uniforms.sprites.light_direction) * (corner * instance.half_size);
    let up = clamp(0.5 + 0.5 * offset.y / instance.half_size.y, 0.0, 1.0);
    let place = vec4f(middle + offset, 1.0);
    let clip = vec4f(dot(place, sprite_view.clip_x), dot(place, sprite_view.clip_y), 0.5, 1.0);
    let cell = vec2f(f32(instance.cell & 3u), f32(instance.cell >> 2u));
    let uv = (cell + vec2f(0.5, -0.5) * corner + 0.5) * 0.25;
    return SpriteCast(clip, uv, level, opacity * sprite_there(instance, amount, offset, up));
}

// What it takes of the light.
@fragment
fn fs_sprite_cast(in: SpriteCast) -> @location(0) f32 {
    return textureSampleLevel(sheet_texture, clamp_sampler, in.uv, in.level).g * saturate(in.opacity);
}

// The dome behind the sprites, if no other method's is: clear but for the thin upper layer of the packed method.
fn sprites_layer(direction: vec3f, narrowing: f32) -> vec4f {
    if !UPPER_LAYER {
        return vec4f(0.0);
    }
    let hit = dome_intersect(direction);
    let veil = packed_veil(hit.plane, cloud_level(hit, narrowing));
    return vec4f(packed_white(cloud_tint(direction), direction), veil * cloud_clearness(direction));
}

// What that upper layer hides of sun or moon from the middle of a texel of the shadows.
fn sprites_hidden(texel: vec2f) -> f32 {
    return packed_veil(shadow_plane(0, texel), shadow_level(0));
}
