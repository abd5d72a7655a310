//! Twin of stars.wgsl: by the pack's own mapping and its own decoding.

use glam::{Vec2, Vec3};
use welkin_pack::mapping::{self, StarPlace};
use welkin_pack::{Pack, Role, StarTexel};
use welkin_runtime::stars::{COLD, GALAXY_BOOST, WARM};
use welkin_runtime::uniforms::Uniforms;

use crate::camera;

/// Radiance of the star whose texel covers `direction`, at the pixel with centre `pixel`.
pub fn radiance(
    uniforms: &Uniforms,
    pack: &Pack,
    direction: Vec3,
    pixel: Vec2,
    seconds: f64,
    galaxy: f32,
) -> Vec3 {
    let [level, side, _, brightness] = uniforms.stars.field;
    let place = mapping::dome_to_star(mapping::direction_to_dome(direction.to_array()));
    let texel = place
        .uv
        .map(|c| ((c * side) as usize).min(side as usize - 1));
    let star = star(pack, level as usize, texel, side as usize);
    if star.intensity == 0.0 {
        return Vec3::ZERO;
    }
    let centre = texel.map(|t| (t as f32 + 0.5) / side);
    let towards = direction_of(StarPlace {
        tile: place.tile,
        uv: centre,
    });
    let offset = (camera::pixel_of(&uniforms.camera, towards) - pixel).abs();
    let tent = (1.0 - offset).max(Vec2::ZERO);
    let narrowing = direction.dot(crate::xyz(uniforms.camera.clip_w));
    let spread = 1.0 + uniforms.stars.spread[0] * (narrowing.powi(-3) - 1.0);
    let light = star.intensity_at(seconds) * brightness * tent.x * tent.y * spread;
    WARM.lerp(COLD, star.phase) * (light * (1.0 + GALAXY_BOOST * galaxy))
}

/// Direction of a place in the star texture; it may lie below the horizon.
pub fn direction_of(place: StarPlace) -> Vec3 {
    let dome = Vec2::from(mapping::star_to_dome(place));
    Vec3::from(mapping::dome_to_direction(dome.to_array()))
}

/// The record of one texel.
///
/// # Panics
/// If the pack has no stars or not that texel.
pub fn star(pack: &Pack, level: usize, texel: [usize; 2], side: usize) -> StarTexel {
    let bytes = &pack
        .texture(Role::Stars)
        .expect("the pack has stars")
        .levels[level];
    let at = (texel[1] * side + texel[0]) * 4;
    StarTexel::decode([bytes[at], bytes[at + 1], bytes[at + 2], bytes[at + 3]])
}
