// What weather adds to a pixel of the sky: the light of a flash in the clouds, the haze of rain, and its bow.
fn weather_over(radiance: vec3f, direction: vec3f, clouds: vec4f) -> vec3f {
    var light = radiance;
    if uniforms.lightning.light.g > 0.0 {
        light += lightning_light(direction, clouds);
    }
    light = rain_hazed(light, direction);
    if uniforms.rainbow.light.g > 0.0 {
        light += rainbow_light(direction);
    }
    return light;
}
