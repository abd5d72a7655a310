// What is behind the clouds: clear sky, what shows through it at night, the sun, a picture in place of them. Clouds leave `clear` of it; of
// the sun's own light they leave its cube, since most of what they scatter goes on nearly straight and is theirs. Over a sky of the
// application's own, that sky, its sun and its ground are there already.
fn behind_clouds(direction: vec3f, pixel: vec2f, clear: f32) -> vec3f {
    var radiance = vec3f(0.0);
    if !OVER {
        radiance = sky_radiance(direction);
    }
    let moon = moon_seen(direction, clear * clear);
    if NIGHT && direction.y > 0.0 {
        var own = star_direction(direction);
        let is_turned = own.y < 0.0;
        if is_turned {
            own = star_turned(own);
        }
        let dome = direction_to_dome(own);
        var galaxy = galaxy_brightness(dome);
        if uniforms.stars.is_placed > 0.5 && own.y < GALAXY_SEAM {
            let other = galaxy_brightness(direction_to_dome(star_turned(own)));
            galaxy = mix(galaxy, other, 0.5 - 0.5 * smoothstep(0.0, GALAXY_SEAM, own.y));
        }
        var night = galaxy * uniforms.galaxy.radiance;
        if !CATALOGUE {
            night += star_radiance(dome, own.y, direction, pixel, galaxy, is_turned);
        }
        if uniforms.stars.is_placed > 0.5 {
            night += planet_radiance(pixel) * star_spread(direction);
        }
        night *= smoothstep(0.0, EXTINCTION, direction.y);
        if CATALOGUE {
            // The air has taken its share of these already.
            night += catalogue_radiance(pixel) * star_spread(direction);
        }
        radiance += night * (1.0 - moon.a);
    }
    if !OVER {
        radiance = sun_added(radiance, direction, clear * clear * (1.0 - moon.a));
    }
    radiance += moon.rgb;
    if SKYBOX && !OVER {
        radiance = skybox_mix(radiance, direction);
    }
    return radiance;
}

// The whole sky of one pixel: clouds, and where they let it through, what is behind them.
@fragment
fn fs_sky(in: Varyings) -> @location(0) vec4f {
    let shortening = inverseSqrt(dot(in.ray, in.ray));
    let direction = in.ray * shortening;
    var clouds = vec4f(0.0);
    if direction.y > 0.0 {
        // Along the axis of the lens a ray of the screen's triangle goes by 1.
        var narrowing = shortening;
        if DOME_MESH {
            narrowing = pixel_narrowing(direction);
        }
        clouds = cloud_layer(direction, narrowing);
    }
    if OUTPUT == OUTPUT_OPACITY {
        return vec4f(vec3f(clouds.a), 1.0);
    }
    var radiance = clouds.rgb;
    if !ASK_OPAQUE || clouds.a < 1.0 {
        radiance = mix(behind_clouds(direction, select(in.pixel, in.position.xy, DOME_MESH), 1.0 - clouds.a), clouds.rgb, clouds.a);
    }
    if OVER {
        // Blended as premultiplied colour: clouds hide what the application drew, what shines is added to it.
        return vec4f(finish(radiance, in.position.xy).rgb, clouds.a);
    }
    radiance = weather(radiance, direction, clouds);
    return finish(radiance, in.position.xy);
}
