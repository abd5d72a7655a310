//! Twin of stars.wgsl: by the pack's own mapping and its own decoding.

use std::f32::consts::PI;

use glam::{IVec2, Quat, Vec2, Vec3};
use welkin_pack::mapping::{self, STAR_TILE_SIDE, STAR_TILE_START, StarPlace};
use welkin_pack::{Pack, Role, StarTexel};
use welkin_runtime::almanac::refraction::lift;
use welkin_runtime::internals::clear_sky::stars::{COLD, GALAXY_BOOST, WARM};
use welkin_runtime::internals::frame::Uniforms;

use crate::camera;

/// A direction on the stars' own dome.
#[derive(Clone, Copy, Debug)]
pub struct Place {
    /// On its upper half.
    pub direction: Vec3,
    /// Whether it was on the lower one, and was turned.
    pub is_turned: bool,
}

/// Where a pixel looks.
#[derive(Clone, Copy, Debug)]
pub struct Seen {
    /// Into the world.
    pub direction: Vec3,
    /// Its centre on the screen.
    pub pixel: Vec2,
}

/// Half a turn about the galaxy's nodes.
pub fn turned(uniforms: &Uniforms, direction: Vec3) -> Vec3 {
    let own = &uniforms.stars;
    let node = Vec3::new(own.node_east, 0.0, own.node_south);
    Quat::from_axis_angle(node, PI) * direction
}

/// What the air lifts to a direction, by halving.
fn airless(seen: Vec3) -> Vec3 {
    let lifted = |true_sine: f32| {
        let flat = (1.0 - true_sine * true_sine).max(0.0).sqrt();
        let high = true_sine + lift(true_sine);
        high / high.hypot(flat)
    };
    let (mut low, mut high) = (seen.y - 0.02, seen.y);
    for _ in 0..40 {
        let middle = 0.5 * (low + high);
        if lifted(middle) < seen.y {
            low = middle;
        } else {
            high = middle;
        }
    }
    let flat = Vec2::new(seen.x, seen.z).normalize_or(Vec2::X) * (1.0 - low * low).max(0.0).sqrt();
    Vec3::new(flat.x, low, flat.y)
}

/// Where a direction above the horizon is on the dome of the stars.
pub fn place(uniforms: &Uniforms, direction: Vec3) -> Place {
    let own = &uniforms.stars;
    if own.is_placed == 0.0 {
        return Place {
            direction,
            is_turned: false,
        };
    }
    let airless = airless(direction);
    let on_dome = [own.east, own.zenith, own.south].map(|axis| axis.dot(airless));
    let on_dome = Vec3::from(on_dome);
    match on_dome.y < 0.0 {
        true => Place {
            direction: turned(uniforms, on_dome),
            is_turned: true,
        },
        false => Place {
            direction: on_dome,
            is_turned: false,
        },
    }
}

/// Where a direction of the dome is seen in the world.
pub fn seen(
    uniforms: &Uniforms,
    Place {
        direction,
        is_turned,
    }: Place,
) -> Vec3 {
    let own = &uniforms.stars;
    if own.is_placed == 0.0 {
        return direction;
    }
    let on_dome = match is_turned {
        true => turned(uniforms, direction),
        false => direction,
    };
    let world = own.east * on_dome.x + own.zenith * on_dome.y + own.south * on_dome.z;
    (world + Vec3::Y * lift(world.y)).normalize()
}

/// Radiance of the stars around a pixel, which looks at `place` of their dome.
pub fn radiance(
    uniforms: &Uniforms,
    pack: &Pack,
    Seen { direction, pixel }: Seen,
    place: Place,
    seconds: f64,
    galaxy: f32,
) -> Vec3 {
    let own = &uniforms.stars;
    let dome = Vec2::from(mapping::direction_to_dome(place.direction.to_array()));
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
        .map(|cell| light(uniforms, pack, cell, pixel, place.is_turned, seconds))
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
fn light(
    uniforms: &Uniforms,
    pack: &Pack,
    cell: IVec2,
    pixel: Vec2,
    is_turned: bool,
    seconds: f64,
) -> Vec3 {
    let (level, side) = (uniforms.stars.level, uniforms.stars.resolution);
    let centre = (cell.as_vec2() + 0.5) / side * STAR_TILE_SIDE - Vec2::from(STAR_TILE_START);
    let place = mapping::dome_to_star(centre.to_array());
    let texel = place
        .uv
        .map(|c| ((c * side) as usize).min(side as usize - 1));
    let star = star(pack, level as usize, texel, side as usize);
    // Beyond the equator is the other half.
    if uniforms.stars.is_placed == 1.0 && centre.length_squared() > 2.0 {
        return Vec3::ZERO;
    }
    let direction = Vec3::from(mapping::dome_to_direction(centre.to_array()));
    let towards = seen(
        uniforms,
        Place {
            direction,
            is_turned,
        },
    );
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
