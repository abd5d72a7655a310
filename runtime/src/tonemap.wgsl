// The last step: tone curve, dither, encoding. Theory and CPU part: tonemap.rs.

// Linear colour of the display, 0..1. All pixels of a frame take the same side of the branch.
fn tone_curve(exposed: vec3f) -> vec3f {
    let radiance = max(exposed, vec3f(0.0));
    var colour = radiance;
    switch uniforms.tonemap.curve {
        case TONEMAP_NEUTRAL: {
            colour = tonemap_neutral(radiance);
        }
        case TONEMAP_AGX: {
            colour = tonemap_agx(radiance);
        }
        case TONEMAP_AGX_PUNCHY: {
            colour = tonemap_agx_punchy(radiance);
        }
        case TONEMAP_FILMIC: {
            colour = tonemap_filmic(radiance);
        }
        default: {}
    }
    return min(colour, vec3f(1.0));
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

// As the target has it, without dither: what a frame or a vertex has of one colour can be told once.
fn display_colour(radiance: vec3f) -> vec3f {
    if OUTPUT == OUTPUT_RADIANCE {
        return radiance;
    }
    let display = tone_curve(radiance * uniforms.tonemap.exposure);
    if OUTPUT == OUTPUT_ENCODED {
        return srgb_encode(display);
    }
    return display;
}

fn finish(radiance: vec3f, pixel: vec2f) -> vec4f {
    let colour = display_colour(radiance);
    if OUTPUT == OUTPUT_RADIANCE {
        return vec4f(colour, 1.0);
    }
    let step = uniforms.tonemap.dither * dither_noise(pixel);
    if OUTPUT == OUTPUT_ENCODED {
        return vec4f(colour + step, 1.0);
    }
    // The hardware encodes. Around a value x a step of the encoding is as wide as its slope there, and
    // 2 sqrt(x) is the slope of the curve's near relative, the square.
    let root = colour * inverseSqrt(max(colour, vec3f(1e-6)));
    return vec4f(colour + step * (2.0 * root + abs(step)), 1.0);
}
