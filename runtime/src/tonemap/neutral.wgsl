// Khronos PBR Neutral. Theory: neutral.rs.

fn tonemap_neutral(radiance: vec3f) -> vec3f {
    let least = min(min(radiance.r, radiance.g), radiance.b);
    let dark = min(least, 2.0 * NEUTRAL_REFLECTED);
    let colour = radiance - (dark - dark * dark / (4.0 * NEUTRAL_REFLECTED));
    let peak = max(max(colour.r, colour.g), colour.b);
    if peak <= NEUTRAL_START {
        return colour;
    }
    let shown = 1.0 - (1.0 - NEUTRAL_START) * (1.0 - NEUTRAL_START) / (peak + 1.0 - 2.0 * NEUTRAL_START);
    let kept = 1.0 / (NEUTRAL_FADING * (peak - shown) + 1.0);
    return shown + kept * (colour * (shown / peak) - shown);
}

