//! Twin of stars.wgsl: by the pack's own mapping and its own decoding.

use glam::{IVec2, Vec2, Vec3};
use welkin_pack::mapping::{self, STAR_TILE_SIDE, STAR_TILE_START, StarPlace};
use welkin_pack::{Pack, Role, StarTexel};
use welkin_runtime::internals::clear_sky::stars::{COLD, GALAXY_BOOST, WARM};
use welkin_runtime::internals::frame::Uniforms;

use crate::camera;

/// Radiance of the stars around `direction`, at the pixel with centre `pixel`.
pub fn radiance(
    uniforms: &Uniforms,
    pack: &Pack,
    direction: Vec3,
    pixel: Vec2,
    seconds: f64,
    galaxy: f32,
) -> Vec3 {
    let own = &uniforms.stars;
    let dome = Vec2::from(mapping::direction_to_dome(direction.to_array()));
    let cells = if own.is_guided == 1.0 {
        // Every cell that the tent may reach, with or without a guide: a square around the pixel.
        let reach = Vec2::splat(own.reach_rad * 2.0);
        let [low, high] = [dome - reach, dome + reach].map(|p| cell_of(p, own.resolution));
        (low.y..=high.y)
            .flat_map(|y| (low.x..=high.x).map(move |x| IVec2::new(x, y)))
            .collect()
    } else {
        vec![cell_of(dome, own.resolution)]
    };
    let light: Vec3 = cells
        .into_iter()
        .map(|cell| light(uniforms, pack, cell, pixel, seconds))
        .sum();
    let narrowing = direction.dot(uniforms.camera.clip_w.truncate());
    let spread = 1.0 + own.evenness * (narrowing.powi(-3) - 1.0);
    light * (own.brightness * spread * (1.0 + GALAXY_BOOST * galaxy))
}

/// The cell of a level with `side` texels a side that a point of the dome lies in.
fn cell_of(dome: Vec2, side: f32) -> IVec2 {
    ((dome + Vec2::from(STAR_TILE_START)) / STAR_TILE_SIDE * side)
        .floor()
        .as_ivec2()
}

/// What the star of a cell gives to a pixel.
fn light(uniforms: &Uniforms, pack: &Pack, cell: IVec2, pixel: Vec2, seconds: f64) -> Vec3 {
    let (level, side) = (uniforms.stars.level, uniforms.stars.resolution);
    let centre = (cell.as_vec2() + 0.5) / side * STAR_TILE_SIDE - Vec2::from(STAR_TILE_START);
    let place = mapping::dome_to_star(centre.to_array());
    let texel = place
        .uv
        .map(|c| ((c * side) as usize).min(side as usize - 1));
    let star = star(pack, level as usize, texel, side as usize);
    let towards = Vec3::from(mapping::dome_to_direction(centre.to_array()));
    let offset = (camera::pixel_of(&uniforms.camera, towards) - pixel).abs();
    let tent = (1.0 - offset).max(Vec2::ZERO);
    WARM.lerp(COLD, star.phase) * (star.intensity_at(seconds) * tent.x * tent.y)
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
