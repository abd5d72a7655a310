// The lens flare: discs and rings on the line from the sun through the middle of the screen. CPU part: flares.rs.

struct FlareVaryings {
    @builtin(position) position: vec4f,
    @location(0) uv: vec2f,
    @location(1) @interpolate(flat) colour: vec4f,
    @location(2) @interpolate(flat) level: f32,
}

// What the clouds leave of the sun: its middle and four points around it.
fn flare_clearness() -> f32 {
    let sun = uniforms.sky.sun_direction;
    let right = normalize(uniforms.camera.right) * uniforms.flares.sun_radius;
    let up = normalize(uniforms.camera.up) * uniforms.flares.sun_radius;
    var covered = flare_cover(sun) * 2.0;
    covered += flare_cover(sun + right) + flare_cover(sun - right) + flare_cover(sun + up) + flare_cover(sun - up);
    return 1.0 - covered / 6.0;
}

fn flare_cover(towards: vec3f) -> f32 {
    let unit = normalize(towards);
    let direction = vec3f(unit.x, max(unit.y, 0.0), unit.z);
    return cloud_layer(direction, pixel_narrowing(direction)).a;
}

@vertex
fn vs_flare(@builtin(vertex_index) vertex: u32, @builtin(instance_index) instance: u32) -> FlareVaryings {
    let square = uniforms.flares.squares[instance];
    let corner = vec2f(f32(vertex & 1u), f32(vertex >> 1u));
    // Its colours are the display's. A darker picture has less of it, a brighter one no more than its own opacity.
    let exposure = select(min(uniforms.tonemap.exposure, 1.0), 1.0, OUTPUT == OUTPUT_RADIANCE);
    let opacity = square.opacity * (uniforms.flares.strength * flare_clearness() * exposure);
    // The first row of the atlas is up.
    let position = square.position + square.half_size * (corner * vec2f(2.0, -2.0) - vec2f(1.0, -1.0));
    let uv = square.cell + square.cell_size * corner;
    return FlareVaryings(vec4f(position, FAR_DEPTH, 1.0), uv, vec4f(square.colour, opacity), square.lod);
}

@fragment
fn fs_flare(in: FlareVaryings) -> @location(0) vec4f {
    let light = textureSampleLevel(flares_texture, clamp_sampler, in.uv, in.level).r;
    return vec4f(in.colour.rgb, in.colour.a * light);
}
