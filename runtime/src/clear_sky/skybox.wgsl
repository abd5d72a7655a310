// The skybox: a picture of a whole sky in place of the computed one. Theory, CPU part: skybox.rs.

// What is seen along a unit direction, with `radiance` behind the picture. The texture holds radiance times cover.
fn skybox_mix(radiance: vec3f, direction: vec3f) -> vec3f {
    let skybox = uniforms.skybox;
    let picture = textureSampleLevel(skybox_texture, clamp_sampler, direction, skybox.lod);
    return radiance * (1.0 - picture.a * skybox.weight) + picture.rgb * skybox.weight;
}
