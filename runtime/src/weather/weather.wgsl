// What weather adds to a pixel of the sky: the light of a flash in the clouds, and the haze of rain.
fn weather_over(radiance: vec3f, direction: vec3f, clouds: vec4f) -> vec3f {
    var light = radiance;
    if uniforms.lightning.light.g > 0.0 {
        light += lightning_light(direction, clouds);
    }
    return rain_hazed(light, direction);
}
