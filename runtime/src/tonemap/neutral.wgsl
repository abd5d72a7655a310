// Khronos PBR Neutral. Theory: neutral.rs.

fn tonemap_neutral(radiance: vec3f) -> vec3f {
    let peak = max(max(radiance.r, radiance.g), radiance.b);
    if peak <= NEUTRAL_START {
        return radiance;
    }
    let shown = 1.0 - (1.0 - NEUTRAL_START) * (1.0 - NEUTRAL_START) / (peak + 1.0 - 2.0 * NEUTRAL_START);
    let kept = 1.0 / (NEUTRAL_FADING * (peak - shown) + 1.0);
    return shown + kept * (radiance * (shown / peak) - shown);
}
