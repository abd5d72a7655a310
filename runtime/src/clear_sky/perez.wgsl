// The clear sky of Perez and others: luminance and both chromaticities. Theory and CPU part: perez.rs.
// Each of a to e, base and zenith holds, in x, y, z: luminance, chromaticity x, chromaticity y.

// M. Abramowitz, I. A. Stegun, "Handbook of Mathematical Functions", 1964, eq. 4.4.45: off by 7e-5 at most.
fn perez_acos(cosine: f32) -> f32 {
    let x = abs(cosine);
    let angle = sqrt(1.0 - x) * (PEREZ_ACOS.x + x * (PEREZ_ACOS.y + x * (PEREZ_ACOS.z + x * PEREZ_ACOS.w)));
    return select(angle, PI - angle, cosine < 0.0);
}

// Linear BT.709 of a luminance with chromaticities x and y, the latter brought nearer to daylight.
fn perez_rgb(sky: vec3f) -> vec3f {
    let x = sky.y;
    let y = mix(sky.z, PEREZ_DAYLIGHT.x + x * (PEREZ_DAYLIGHT.y + x * PEREZ_DAYLIGHT.z), PEREZ_TO_DAYLIGHT);
    let linear = PEREZ_RGB_X * x + PEREZ_RGB_Y * y + PEREZ_RGB_Z * (1.0 - x - y);
    return max(linear * (sky.x / y), vec3f(0.0));
}

// The clear sky along a unit direction: Perez's by day, the table's by night.
fn perez_light(direction: vec3f) -> vec3f {
    let perez = uniforms.perez;
    if perez.weight == 0.0 {
        return table_light(direction);
    }
    let cosine = clamp(dot(direction, perez.sun_direction), -1.0, 1.0);
    let gradation = 1.0 + perez.a.xyz * exp2(perez.b.xyz / max(direction.y, PEREZ_LEAST_COSINE));
    let aureole = perez.c.xyz * exp2(perez.d.xyz * perez_acos(cosine));
    let indicatrix = perez.base.xyz + aureole + perez.e.xyz * (cosine * cosine);
    let light = perez_rgb(perez.zenith.xyz * gradation * indicatrix);
    if perez.weight == 1.0 {
        return light;
    }
    return mix(table_light(direction), light, perez.weight);
}
