// The planets of a date. CPU part: planets.rs.

// Their radiance at the pixel with centre `pixel`.
fn planet_radiance(pixel: vec2f) -> vec3f {
    var light = vec3f(0.0);
    for (var i = 0; i < 5; i++) {
        let place = uniforms.planets.places[i];
        let away = pixel - place.xy;
        let square = dot(away, away);
        if square < PLANET_REACH && place.z > 0.5 {
            let root = inverseSqrt(1.0 + square * PLANET_SPREAD);
            let root_2 = root * root;
            light += uniforms.planets.lights[i].rgb * max(root_2 * root_2 * root - place.w, 0.0);
        }
    }
    return light;
}
