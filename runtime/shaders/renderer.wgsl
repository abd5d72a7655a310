// The whole sky of one pixel: clear sky, then what shows through it at night, the sun, and clouds over all.
@fragment
fn fs_sky(in: Varyings) -> @location(0) vec4f {
    let direction = in.ray * inverseSqrt(dot(in.ray, in.ray));
    var radiance = sky_radiance(direction);
    if NIGHT && direction.y > 0.0 {
        let dome = direction_to_dome(direction);
        let galaxy = galaxy_brightness(dome);
        let night = galaxy * uniforms.galaxy.light.rgb + star_radiance(dome, in.position.xy, galaxy);
        radiance += night * smoothstep(0.0, EXTINCTION, direction.y);
    }
    radiance += sun_radiance(direction);
    if SKYBOX {
        radiance = skybox_mix(radiance, direction);
    }
    if direction.y > 0.0 {
        let clouds = cloud_layer(direction);
        radiance = mix(radiance, clouds.rgb, clouds.a);
    }
    return finish(radiance, in.position.xy);
}
