// Hable's filmic curve without a toe. Theory: filmic.rs.

fn tonemap_filmic(radiance: vec3f) -> vec3f {
    let shoulder = FILMIC_SHOULDER * radiance * radiance;
    return (radiance + shoulder) / (1.0 + FILMIC_KNEE * radiance + shoulder);
}

