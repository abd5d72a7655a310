// For an application's own shaders: the light of the sky on a scene. `light` is what Welkin's SkyLight gives. Directions are to the east, up and to
// the south; a surface of an albedo sends on albedo / pi of the irradiance.

struct SkyLight {
    sun_direction: vec3f,     // unit vector towards it
    _pad_0: f32,
    sun: vec3f,               // irradiance of a plane that faces it, after the clouds
    _pad_1: f32,
    clear_sun: vec3f,         // the same without clouds: to be multiplied by the shadow of each of them
    _pad_2: f32,
    moon_direction: vec3f,
    _pad_3: f32,
    moon: vec3f,
    _pad_4: f32,
    clear_moon: vec3f,
    _pad_5: f32,
    ambient: array<vec4f, 9>, // spherical harmonics of the irradiance by all else, factors multiplied in
}

// Irradiance of a plane of this unit normal by sky, clouds and ground.
fn sky_light_ambient(light: SkyLight, normal: vec3f) -> vec3f {
    let n = normal;
    let flat = light.ambient[0] + light.ambient[1] * n.y + light.ambient[2] * n.z + light.ambient[3] * n.x;
    let products = light.ambient[4] * (n.x * n.y) + light.ambient[5] * (n.y * n.z) + light.ambient[7] * (n.x * n.z);
    let squares = light.ambient[6] * (3.0 * n.z * n.z - 1.0) + light.ambient[8] * (n.x * n.x - n.y * n.y);
    return max((flat + products + squares).xyz, vec3f(0.0));
}

// That by sun and moon, after the clouds.
fn sky_light_direct(light: SkyLight, normal: vec3f) -> vec3f {
    return light.sun * max(dot(normal, light.sun_direction), 0.0) + light.moon * max(dot(normal, light.moon_direction), 0.0);
}

// The same under a clear sky: what the shadow of each cloud is multiplied with.
fn sky_light_clear(light: SkyLight, normal: vec3f) -> vec3f {
    return light.clear_sun * max(dot(normal, light.sun_direction), 0.0)
        + light.clear_moon * max(dot(normal, light.moon_direction), 0.0);
}
