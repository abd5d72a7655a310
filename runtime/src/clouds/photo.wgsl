// The pack's photograph as large shapes. Theory and CPU part: photo.rs.

// The share of a normal distribution below z: E. Page, "Approximations to the Cumulative Normal Function and its
// Inverse for Use on a Pocket Calculator", Applied Statistics 26(1), 1977.
fn normal_share(z: f32) -> f32 {
    return 0.5 + 0.5 * tanh(clamp(NORMAL_SLOPE * z * (1.0 + NORMAL_BEND * z * z), -9.0, 9.0));
}

// How many deviations the photo at a place of a map's tile lies over its mean.
fn photo_deviation(uv: vec2f) -> f32 {
    let photo = uniforms.photo;
    return photo.per_spread * (textureSampleLevel(clouds_texture, repeat_sampler, uv, photo.level).r - photo.mean);
}

// What a method's own noise is multiplied by.
fn photo_rest() -> f32 {
    return sqrt(1.0 - uniforms.photo.weight * uniforms.photo.weight);
}

// A normal number of variance 1 whose large shapes are the photo's.
fn photo_over(z: f32, uv: vec2f) -> f32 {
    if uniforms.photo.weight == 0.0 {
        return z;
    }
    return photo_rest() * z + uniforms.photo.weight * photo_deviation(uv);
}

// The same of an amount that is evenly distributed, 0 to 1.
fn photo_over_even(amount: f32, uv: vec2f) -> f32 {
    let photo = uniforms.photo;
    if photo.weight == 0.0 {
        return amount;
    }
    let share = photo.weight / (photo.weight + photo_rest());
    return even_blend(mix(amount, normal_share(photo_deviation(uv)), share), share);
}

// The share of places with less than this blend of two even numbers, of which the second has that share: the integral of a trapezoid.
fn even_blend(blend: f32, share: f32) -> f32 {
    let foot = min(share, 1.0 - share);
    if blend < foot || blend > 1.0 - foot {
        let away = min(blend, 1.0 - blend);
        let corner = 0.5 * away * away / (share * (1.0 - share));
        return select(corner, 1.0 - corner, blend > 0.5);
    }
    return (blend - 0.5 * foot) / (1.0 - foot);
}
