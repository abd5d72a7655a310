// Where a pixel looks, and where a direction is on the screen. CPU part: camera.rs.

struct Varyings {
    @builtin(position) position: vec4f,
    // Linear over the screen, not normalised: the camera's axis has length 1.
    @location(0) ray: vec3f,
    // Place in the viewport in pixels, (0, 0) in its upper left corner: `position` counts from that of the target.
    @location(1) pixel: vec2f,
}

// One triangle that covers the screen. It lies at the far plane, behind every scene.
@vertex
fn vs_screen(@builtin(vertex_index) index: u32) -> Varyings {
    let ndc = vec2f(f32((index << 1u) & 2u), f32(index & 2u)) * 2.0 - 1.0;
    let camera = uniforms.camera;
    let ray = camera.forward + camera.right * ndc.x + camera.up * ndc.y;
    return Varyings(vec4f(ndc, FAR_DEPTH, 1.0), ray, viewport_pixel(ndc));
}

// The dome as a mesh about the viewer: a point of a facet lies in the direction of its own position.
@vertex
fn vs_dome(@location(0) position: vec3f) -> Varyings {
    let w = dot(position, uniforms.camera.clip_w.xyz);
    let x = dot(position, uniforms.camera.clip_x.xyz);
    let y = dot(position, uniforms.camera.clip_y.xyz);
    // Over a facet it is not linear: whoever draws the mesh draws it into a whole target.
    return Varyings(vec4f(x, y, FAR_DEPTH * w, w), position, vec2f(0.0));
}

// The angle that a pixel covers in a direction, over that of one in the axis of the lens.
fn pixel_narrowing(direction: vec3f) -> f32 {
    return dot(direction, uniforms.camera.clip_w.xyz);
}

// Pixel coordinates of a direction in front of the camera: (0, 0) is the upper left corner.
fn pixel_of(direction: vec3f) -> vec2f {
    let camera = uniforms.camera;
    let w = dot(direction, camera.clip_w.xyz);
    let ndc = vec2f(dot(direction, camera.clip_x.xyz), dot(direction, camera.clip_y.xyz)) / w;
    return viewport_pixel(ndc);
}

fn viewport_pixel(ndc: vec2f) -> vec2f {
    return (ndc * vec2f(0.5, -0.5) + 0.5) * vec2f(uniforms.camera.width_px, uniforms.camera.height_px);
}
