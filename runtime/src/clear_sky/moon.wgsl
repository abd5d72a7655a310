// The moon of a date. CPU part: moon.rs.

// Its radiance along a unit direction, of which a share comes through, and how far it covers what is behind it.
fn moon_seen(direction: vec3f, share: f32) -> vec4f {
    let moon = uniforms.moon;
    if dot(direction, moon.direction) <= moon.least_cosine {
        return vec4f(0.0);
    }
    let place = vec2f(dot(direction, moon.right), dot(direction, moon.up));
    let square = dot(place, place);
    let covered = 1.0 - smoothstep(1.0 - moon.edge, 1.0 + moon.edge, sqrt(square));
    let towards = sqrt(max(1.0 - square, 0.0));
    let sunny = max(dot(moon.sunwards, vec3f(place, towards)), 0.0);
    let lit = 2.0 * sunny / max(sunny + towards, 1e-4);
    let risen = smoothstep(-SUN_HORIZON, SUN_HORIZON, direction.y);
    let light = share * (moon.lit * lit + moon.earthlit);
    return vec4f(disc_shown(light) * (covered * risen), covered);
}
