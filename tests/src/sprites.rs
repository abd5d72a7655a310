//! Twin of sprites.wgsl.

use glam::{Vec2, Vec3, Vec4};
use welkin_runtime::internals::frame::Uniforms;
use welkin_runtime::internals::sprites::instances::Instance;
use welkin_runtime::internals::sprites::locks::{LOCK, NEAR};
use welkin_runtime::internals::sprites::outline::Outline;
use welkin_runtime::internals::sprites::pipelines::SpriteBlock;
use welkin_runtime::internals::sprites::station::SpriteView;
use welkin_runtime::internals::sprites::{RIM_OPAQUE, SpriteUniforms, formation};

use crate::texture::{Texture, smoothstep};
use crate::{clouds, sky};

/// What sprites are computed from.
#[derive(Clone, Copy, Debug)]
pub struct Inputs<'a> {
    /// The frame's constants.
    pub uniforms: &'a Uniforms,
    /// The viewpoint.
    pub view: &'a SpriteView,
    /// The pack's clouds.
    pub clouds: &'a Texture,
    /// The pack's day gradient.
    pub sky: &'a Texture,
    /// The pack's sheet.
    pub sheet: &'a Texture,
    /// Outlines of its cells.
    pub outlines: &'a [Outline],
}

/// A corner of a sprite.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Corner {
    /// Radiance at a grey of one half.
    pub light: Vec3,
    /// What a grey of one more adds.
    pub relief: Vec3,
    /// Opacity.
    pub opacity: f32,
}

/// A sprite as it stands: a polygon in a plane.
#[derive(Clone, Debug, PartialEq)]
pub struct Placed {
    /// Its middle, from the viewpoint.
    pub middle: Vec3,
    /// From the middle to its right and to its upper side.
    pub axes: [Vec3; 2],
    /// Its corners, anticlockwise: places in half sides from its middle, and what is there.
    pub corners: Vec<(Vec2, Corner)>,
    /// Column and row of its cell.
    pub cell: Vec2,
    /// Level of detail.
    pub level: f32,
}

/// A sprite whose cloud has formed so far; none if nothing of it shows.
pub fn placed(
    inputs: &Inputs,
    instance: &Instance,
    block: &SpriteBlock,
    amount: f32,
) -> Option<Placed> {
    let own = &inputs.uniforms.sprites;
    let middle = block.origin + instance.centre_m();
    let distance = middle.length().max(1e-3);
    let [half_width, half_height] = instance.half_size_m();
    let radius = half_width.max(half_height);
    let to_viewer = -middle / distance;

    let [x, y, z, w] = instance.lock.map(|v| (f32::from(v) / 127.0).max(-1.0));
    let lock = Vec3::new(x, y, z);
    let locked = w * (1.0 - smoothstep(LOCK, 1.0, distance / radius));
    let meets = lock.dot(to_viewer);
    let side = if meets < 0.0 { -lock } else { lock };
    let facing = to_viewer.lerp(side, locked).normalize();
    let before = if instance.lies_flat() {
        distance
    } else {
        -facing.dot(middle)
    };
    let near = ((own.billboards_m - distance) * own.change_per_m).clamp(0.0, 1.0);
    let opacity = (1.0 + (meets.max(0.0) - 1.0) * locked)
        * smoothstep(0.0, NEAR, before / radius)
        * (RIM_OPAQUE * rim(own, distance)).min(1.0)
        * if instance.is_billboard() {
            1.0 - near
        } else {
            near
        }
        * block.opacity
        * own.opacity;
    if opacity * amount <= 0.0 {
        return None;
    }
    let [right, up] = axes(instance, facing);
    let axes = [right * half_width, up * half_height];
    let outline = &inputs.outlines[usize::from(instance.names[0])];
    let outline = match block.vertices_log2 {
        2 => around(outline).to_vec(),
        _ => outline.to_vec(),
    };
    let corners = outline.iter().map(|&[x, y]| {
        let offset = axes[0] * x + axes[1] * y;
        let share = (0.5 + 0.5 * offset.y / half_height).clamp(0.0, 1.0);
        let corner = corner(inputs, instance, middle, offset, share, opacity, amount);
        (Vec2::new(x, y), corner)
    });
    let texels_a_pixel = inputs.view.cell_texels * inputs.view.pixel_rad * distance
        / (2.0 * libm::sqrtf(half_width * half_height));
    let fine = libm::log2f(texels_a_pixel.max(1e-6)).max(0.0);
    let cell = instance.names[0];
    Some(Placed {
        middle,
        axes,
        corners: corners.collect(),
        cell: Vec2::new(f32::from(cell % 4), f32::from(cell / 4)),
        level: if block.vertices_log2 == 2 {
            libm::roundf(fine)
        } else {
            fine
        },
    })
}

/// Unit vectors to its right and up.
fn axes(instance: &Instance, facing: Vec3) -> [Vec3; 2] {
    let (sin, cos) = libm::sincosf(instance.centre[3]);
    if instance.lies_flat() {
        return [Vec3::new(cos, 0.0, -sin), Vec3::new(-sin, 0.0, -cos)];
    }
    let across = Vec3::Y.cross(facing);
    let right = across.try_normalize().unwrap_or(Vec3::X);
    let up = facing.cross(right);
    [right * cos + up * sin, up * cos - right * sin]
}

fn corner(
    inputs: &Inputs,
    instance: &Instance,
    middle: Vec3,
    offset: Vec3,
    up: f32,
    opacity: f32,
    amount: f32,
) -> Corner {
    let own = &inputs.uniforms.sprites;
    let place = middle + offset;
    let away = place.length();
    let direction = place / away;
    let level = |level: [u8; 4]| Vec4::from(level.map(|v| f32::from(v) / 255.0));
    let level = level(instance.low).lerp(level(instance.high), up);
    let [low, high] = instance.heights();
    let share = low + (high - low) * up;
    let ambient = level.truncate() * own.ambient * (1.0 - own.dark_base * (1.0 - share));
    let from_group = instance.from_group_m() + offset;
    let towards = from_group.dot(own.light_direction) / from_group.length().max(1.0);
    let share = own.least + (own.most - own.least) * (0.5 + 0.5 * towards);
    let sun = own.light * share;
    let uniforms = inputs.uniforms;
    let tint = clouds::tint(&uniforms.clouds, inputs.clouds, direction);
    let light = ambient + sun * Vec3::ONE.lerp(uniforms.clouds.tint, tint);
    let [from_cloud, centre] = [offset, Vec3::ZERO]
        .map(|offset| (instance.from_cloud_m() + offset).length() / instance.cloud_radius_m());
    let rim = rim(own, middle.length());
    let clear = clearness(own, inputs.view.height_m, place) * rim;
    let flash = (place - own.flash_position) * own.flash_per_m;
    let flash = own.flash * libm::exp2f(-flash.length_squared());
    let behind = sky::radiance(uniforms, inputs.sky, inputs.clouds, direction);
    Corner {
        light: (light + flash) * clear + behind * (1.0 - clear),
        relief: light * clear * own.relief,
        opacity: opacity * formation::opacity(amount, from_cloud, centre) * level.w,
    }
}

/// What the rim of sight leaves of a sprite at a distance.
fn rim(own: &SpriteUniforms, distance: f32) -> f32 {
    ((own.distance_m - distance) * own.rim_per_m).clamp(0.0, 1.0)
}

/// What the air leaves of light from a place: the integral of exp(-height / scale) along the way, in closed form.
pub fn clearness(own: &SpriteUniforms, viewer_height_m: f32, place: Vec3) -> f32 {
    let per_scale = own.air_height_per_m;
    let rise = f64::from(place.y * per_scale);
    let mean = if rise.abs() < 1e-6 {
        1.0
    } else {
        -libm::expm1(-rise) / rise
    };
    let at_viewer = libm::exp(f64::from(-viewer_height_m.max(0.0) * per_scale));
    let depth = f64::from(own.extinction_per_m) * at_viewer * mean * f64::from(place.length());
    libm::exp(-depth) as f32
}

/// Radiance and opacity of a sprite along a ray; none where the ray passes it by or is before the viewpoint.
pub fn along(inputs: &Inputs, sprite: &Placed, ray: Vec3) -> Option<(Vec3, f32)> {
    let [right, up] = sprite.axes;
    let normal = right.cross(up);
    let reach = sprite.middle.dot(normal) / ray.dot(normal);
    if !reach.is_finite() || reach <= 0.0 {
        return None;
    }
    let off = ray * reach - sprite.middle;
    let s = off.dot(right) / right.length_squared();
    let t = off.dot(up) / up.length_squared();
    let place = Vec2::new(s, t);
    // No outline leaves its cell.
    if place.abs().max_element() > 1.0 {
        return None;
    }
    let (light, relief) = triangles(sprite.corners.len())
        .iter()
        .find_map(|triangle| within(triangle.map(|i| &sprite.corners[i]), place))?;
    let uv = (sprite.cell + Vec2::new(0.5 + 0.5 * s, 0.5 - 0.5 * t)) / 4.0;
    let [grey, alpha, ..] = inputs.sheet.sample(uv.to_array(), sprite.level);
    let radiance = light.truncate() + (grey - 0.5) * relief;
    Some((radiance.max(Vec3::ZERO), alpha * light.w))
}

/// The box around an outline, from its lower left corner anticlockwise.
fn around(outline: &Outline) -> [[f32; 2]; 4] {
    let most = |axis: usize, sign: f32| {
        let along = outline.iter().map(|place| sign * place[axis]);
        sign * along.fold(f32::MIN, f32::max)
    };
    let [left, right, down, up] = [most(0, -1.0), most(0, 1.0), most(1, -1.0), most(1, 1.0)];
    [[left, down], [right, down], [right, up], [left, up]]
}

/// The triangles of an outline or a box, whose strip goes to and fro between its sides.
fn triangles(corners: usize) -> &'static [[usize; 3]] {
    match corners {
        4 => &[[0, 1, 3], [1, 3, 2]],
        _ => &[
            [0, 1, 7],
            [1, 7, 2],
            [7, 2, 6],
            [2, 6, 3],
            [6, 3, 5],
            [3, 5, 4],
        ],
    }
}

/// Light with opacity, and relief, at a place, if it is in the triangle: linear in it.
fn within(corners: [&(Vec2, Corner); 3], place: Vec2) -> Option<(Vec4, Vec3)> {
    let [a, b, c] = corners.map(|(at, _)| *at);
    let whole = (b - a).perp_dot(c - a);
    let shares =
        [(b, c), (c, a), (a, b)].map(|(from, to)| (to - from).perp_dot(place - from) / whole);
    if shares.iter().any(|share| *share < 0.0) {
        return None;
    }
    let (mut light, mut relief) = (Vec4::ZERO, Vec3::ZERO);
    for ((_, corner), share) in corners.into_iter().zip(shares) {
        light += corner.light.extend(corner.opacity) * share;
        relief += corner.relief * share;
    }
    Some((light, relief))
}
