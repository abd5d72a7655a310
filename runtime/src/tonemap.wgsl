// The last step: tone curve, dither, encoding. Theory and CPU part: tonemap.rs.

// Linear colour of the display, a step of the encoding away from 0..1. All pixels of a frame take the same side of the branch.
fn tone_curve(radiance: vec3f, step: f32) -> vec3f {
    // The default first: each question costs a pixel something.
    if uniforms.tonemap.curve == TONEMAP_AGX_PUNCHY {
        return tonemap_agx_punchy(radiance, step);
    }
    if uniforms.tonemap.curve == TONEMAP_AGX {
        return tonemap_agx(radiance, step);
    }
    let exposed = max(radiance, vec3f(0.0)) * uniforms.tonemap.exposure;
    var colour = exposed;
    if uniforms.tonemap.curve == TONEMAP_NEUTRAL {
        colour = tonemap_neutral(exposed);
    } else if uniforms.tonemap.curve == TONEMAP_FILMIC {
        colour = tonemap_filmic(exposed);
    }
    colour = min(colour, vec3f(1.0));
    // Around a value x a step of the encoding is as wide as its slope there, and 2 sqrt(x) is the slope of the curve's near
    // relative, the square.
    let root = colour * inverseSqrt(max(colour, vec3f(1e-6)));
    return colour + step * (2.0 * root + abs(step));
}

// IEC 61966-2-1.
fn srgb_encode(linear: vec3f) -> vec3f {
    let curve = 1.055 * pow(max(linear, vec3f(1e-8)), vec3f(1.0 / 2.4)) - 0.055;
    return select(curve, linear * 12.92, linear <= vec3f(0.0031308));
}

// Interleaved gradient noise, -0.5..0.5: J. Jimenez, "Next Generation Post Processing in Call of Duty:
// Advanced Warfare", SIGGRAPH 2014. `pixel` is the middle of a pixel: a half less is its number, without rounding.
fn dither_noise(pixel: vec2f) -> f32 {
    return fract(52.9829189 * fract(dot(pixel - 0.5, vec2f(0.06711056, 0.00583715)))) - 0.5;
}

// What a float target gets: exposed where the application's own light is. The sun's disc may then be more than half floats hold.
fn target_radiance(radiance: vec3f) -> vec3f {
    return min(radiance * uniforms.tonemap.exposure, vec3f(LARGEST_HALF));
}

// As the target has it, without dither: what a frame or a vertex has of one colour can be told once.
fn display_colour(radiance: vec3f) -> vec3f {
    if OUTPUT == OUTPUT_RADIANCE {
        return target_radiance(radiance);
    }
    return encoded_colour(radiance, 0.0);
}

// With a step of dither. What is not encoded here the hardware encodes.
fn encoded_colour(radiance: vec3f, step: f32) -> vec3f {
    if OUTPUT == OUTPUT_ENCODED {
        return srgb_encode(tone_curve(radiance, 0.0)) + step;
    }
    return tone_curve(radiance, step);
}

fn finish(radiance: vec3f, pixel: vec2f) -> vec4f {
    if OUTPUT == OUTPUT_RADIANCE {
        return vec4f(target_radiance(radiance), 1.0);
    }
    return vec4f(encoded_colour(radiance, uniforms.tonemap.dither * dither_noise(pixel)), 1.0);
}
