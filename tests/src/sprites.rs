//! Twin of sprites.wgsl.

use glam::{Vec2, Vec3, Vec3Swizzles, Vec4};
use welkin_pack::field::MOST_DEPTH;
use welkin_runtime::internals::clouds::shared::{MULTIPLE, SINGLE};
use welkin_runtime::internals::frame::Uniforms;
use welkin_runtime::internals::sprites::exposures::Exposures;
use welkin_runtime::internals::sprites::instances::Instance;
use welkin_runtime::internals::sprites::locks::{LOCK, NEAR};
use welkin_runtime::internals::sprites::outline::Outline;
use welkin_runtime::internals::sprites::pipelines::SpriteBlock;
use welkin_runtime::internals::sprites::station::SpriteView;
use welkin_runtime::internals::sprites::{
    BULGE, FRONT, LEAST_SKY, PHASE, RIM_OPAQUE, SIDES, SpriteUniforms, formation,
};

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
    /// Light in the field.
    pub exposures: &'a Exposures,
}

/// A corner of a sprite.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Corner {
    /// Radiance where the greys of the picture are one half.
    pub light: Vec3,
    /// What as much sunlight again adds.
    pub sunlit: Vec3,
    /// What as much skylight again adds.
    pub skylit: Vec3,
    /// Shares of more sunlight by grey, right and top above one half, and by what is clear.
    pub sun: Vec4,
    /// Shares of more skylight by grey, right and top above one half.
    pub sky: Vec3,
    /// Opacity.
    pub opacity: f32,
}

impl Corner {
    /// What it changes by if every grey is one more, the worst way.
    pub fn relief(&self) -> Vec3 {
        let sum = |shares: Vec3| shares.abs().element_sum();
        self.sunlit * sum(self.sun.truncate()) + self.skylit * sum(self.sky)
    }

    /// Radiance at a texel of the sheet, and opacity.
    fn at(&self, [grey, alpha, right, top]: [f32; 4]) -> (Vec3, f32) {
        let greys = Vec3::new(grey, right, top) - 0.5;
        let sun = self.sun.dot(greys.extend(1.0 - alpha));
        let radiance = self.light + self.sunlit * sun + self.skylit * self.sky.dot(greys);
        (radiance.max(Vec3::ZERO), alpha * self.opacity)
    }
}

impl std::ops::Mul<f32> for Corner {
    type Output = Corner;

    fn mul(self, share: f32) -> Corner {
        Corner {
            light: self.light * share,
            sunlit: self.sunlit * share,
            skylit: self.skylit * share,
            sun: self.sun * share,
            sky: self.sky * share,
            opacity: self.opacity * share,
        }
    }
}

impl std::ops::Add for Corner {
    type Output = Corner;

    fn add(self, other: Corner) -> Corner {
        Corner {
            light: self.light + other.light,
            sunlit: self.sunlit + other.sunlit,
            skylit: self.skylit + other.skylit,
            sun: self.sun + other.sun,
            sky: self.sky + other.sky,
            opacity: self.opacity + other.opacity,
        }
    }
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
    let turned = [right, up, facing];
    let axes = [right * half_width, up * half_height];
    let outline = &inputs.outlines[usize::from(instance.names[0])];
    let outline = match block.vertices_log2 {
        2 => around(outline).to_vec(),
        _ => outline.to_vec(),
    };
    let texels_a_pixel = inputs.view.cell_texels * inputs.view.pixel_rad * distance
        / (2.0 * libm::sqrtf(half_width * half_height));
    let fine = libm::log2f(texels_a_pixel.max(1e-6)).max(0.0);
    let level = match block.vertices_log2 {
        2 => libm::roundf(fine),
        _ => fine,
    };
    let spread = 1.0 + 2.0 * libm::exp2f(level) / inputs.view.cell_texels;
    let corners = outline.iter().map(|place| {
        let [x, y] = place.map(|side| (side * spread).clamp(-1.0, 1.0));
        let offset = axes[0] * x + axes[1] * y;
        let share = (0.5 + 0.5 * offset.y / half_height).clamp(0.0, 1.0);
        let shade = if own.thickness > 0.0 {
            scattered(inputs, instance, block, turned, offset)
        } else {
            article(inputs, instance, offset, share)
        };
        let corner = corner(
            inputs, instance, middle, offset, share, opacity, amount, shade,
        );
        (Vec2::new(x, y), corner)
    });
    let cell = instance.names[0];
    Some(Placed {
        middle,
        axes,
        corners: corners.collect(),
        cell: Vec2::new(f32::from(cell % 4), f32::from(cell / 4)),
        level,
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

/// Light from the sun and from the sky, and their shares as of [`Corner`].
struct Shade {
    sunlit: Vec3,
    skylit: Vec3,
    sun: Vec4,
    sky: Vec3,
}

fn scattered(
    inputs: &Inputs,
    instance: &Instance,
    block: &SpriteBlock,
    turned: [Vec3; 3],
    offset: Vec3,
) -> Shade {
    let middle = block.origin + instance.centre_m();
    let own = &inputs.uniforms.sprites;
    let to_sun = own.light_direction;
    let nearer = BULGE * instance.radius_m() * turned[2];
    let place = block.section.extend(0.0).xzy() + instance.centre_m() + offset + nearer;
    let [east, south, west, north, above, open] = exposure(inputs.exposures, place);
    let squares = to_sun * to_sun;
    let side = |positive: f32, negative: f32, cosine: f32| {
        if cosine > 0.0 { positive } else { negative }
    };
    let depths = Vec3::new(
        side(east, west, to_sun.x),
        above,
        side(south, north, to_sun.z),
    );
    let depth = own.thickness * MOST_DEPTH * squares.dot(depths);
    let phase = clouds::phase((middle + offset).normalize().dot(to_sun));
    let sunlit = MULTIPLE[0] * libm::exp2f(-MULTIPLE[1] * depth)
        + (SINGLE[0] + PHASE * phase) * libm::exp2f(-depth);
    let [right, top, front] = turned.map(|axis| axis.dot(to_sun));
    let rim = SINGLE[1] * (-front).max(0.0) * phase * libm::exp2f(-depth);
    Shade {
        sunlit: own.light * sunlit,
        skylit: own.ambient * (LEAST_SKY + (1.0 - LEAST_SKY) * open),
        sun: own.relief
            * Vec4::new(
                FRONT + (1.0 - FRONT) * front.max(0.0),
                SIDES * right,
                SIDES * top,
                rim / sunlit.max(1e-3),
            ),
        sky: own.relief * Vec3::new(FRONT, SIDES * turned[0].y, SIDES * turned[1].y),
    }
}

/// What a place of the field has, 0..1: depths from the east, south, west, north and above, over the most; the sky's share.
fn exposure(grid: &Exposures, place_m: Vec3) -> [f32; 6] {
    let per_m = Vec3::new(grid.span.per_m.x, grid.span.per_m.y, grid.span.per_m.x);
    let share = (place_m - grid.span.base_m * Vec3::Y) * per_m;
    let place = share * Vec3::from(grid.cells.map(|cells| cells as f32)) - 0.5;
    let [across, up, along] = grid.cells.map(i64::from);
    let from = place.floor();
    let mut sums = [0.0; 6];
    for corner in 0..8 {
        let far = Vec3::from([0, 1, 2].map(|axis| f32::from(corner >> axis & 1 == 1)));
        let shares = far * (place - from) + (1.0 - far) * (1.0 - place + from);
        let [x, y, z] = (from + far).to_array().map(|cell| cell as i64);
        let (x, y, z) = (
            x.rem_euclid(across),
            y.clamp(0, up - 1),
            z.rem_euclid(along),
        );
        let cell = ((z * up + y) * across + x) as usize;
        let [above, sky, ..] = grid.above[cell];
        let [east, south, west, north] = grid.sides[cell];
        for (sum, byte) in sums.iter_mut().zip([east, south, west, north, above, sky]) {
            *sum += shares.element_product() * f32::from(byte) / 255.0;
        }
    }
    sums
}

fn article(inputs: &Inputs, instance: &Instance, offset: Vec3, up: f32) -> Shade {
    let own = &inputs.uniforms.sprites;
    let [low, high] = instance.heights();
    let share = low + (high - low) * up;
    let ambient = level(instance, up).truncate() * own.ambient;
    let from_group = instance.from_group_m() + offset;
    let towards = from_group.dot(own.light_direction) / from_group.length().max(1.0);
    let lit = own.least + (own.most - own.least) * (0.5 + 0.5 * towards);
    Shade {
        sunlit: own.light * lit,
        skylit: ambient * (1.0 - own.dark_base * (1.0 - share)),
        sun: Vec4::X * own.relief,
        sky: Vec3::X * own.relief,
    }
}

/// Colour level and opacity between its lower and its upper edge.
fn level(instance: &Instance, up: f32) -> Vec4 {
    let [low, high] =
        [instance.low, instance.high].map(|level| Vec4::from(level.map(|v| f32::from(v) / 255.0)));
    low.lerp(high, up)
}

#[allow(clippy::too_many_arguments, reason = "what a corner is made of")]
fn corner(
    inputs: &Inputs,
    instance: &Instance,
    middle: Vec3,
    offset: Vec3,
    up: f32,
    opacity: f32,
    amount: f32,
    shade: Shade,
) -> Corner {
    let own = &inputs.uniforms.sprites;
    let place = middle + offset;
    let direction = place.normalize();
    let uniforms = inputs.uniforms;
    let tint = clouds::tint(&uniforms.clouds, inputs.clouds, direction);
    let tint = Vec3::ONE.lerp(uniforms.clouds.tint, tint);
    let rim = rim(own, middle.length());
    let clear = clearness(own, inputs.view.height_m, place) * rim;
    let sunlit = shade.sunlit * tint * clear;
    let skylit = if own.thickness > 0.0 {
        shade.skylit * tint * clear
    } else {
        shade.skylit * clear
    };
    let [from_cloud, centre] = [offset, Vec3::ZERO]
        .map(|offset| (instance.from_cloud_m() + offset).length() / instance.cloud_radius_m());
    let flash = (place - own.flash_position) * own.flash_per_m;
    let flash = own.flash * libm::exp2f(-flash.length_squared()) * clear;
    let behind = sky::radiance(uniforms, inputs.sky, inputs.clouds, direction);
    Corner {
        light: sunlit + skylit + flash + behind * (1.0 - clear),
        sunlit,
        skylit,
        sun: shade.sun,
        sky: shade.sky,
        opacity: opacity * formation::opacity(amount, from_cloud, centre) * level(instance, up).w,
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
    let corner = triangles(sprite.corners.len())
        .iter()
        .find_map(|triangle| within(triangle.map(|i| &sprite.corners[i]), place))?;
    let uv = (sprite.cell + Vec2::new(0.5 + 0.5 * s, 0.5 - 0.5 * t)) / 4.0;
    Some(corner.at(inputs.sheet.sample(uv.to_array(), sprite.level)))
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

/// What is at a place, if it is in the triangle: linear in it.
fn within(corners: [&(Vec2, Corner); 3], place: Vec2) -> Option<Corner> {
    let [a, b, c] = corners.map(|(at, _)| *at);
    let whole = (b - a).perp_dot(c - a);
    let shares =
        [(b, c), (c, a), (a, b)].map(|(from, to)| (to - from).perp_dot(place - from) / whole);
    if shares.iter().any(|share| *share < 0.0) {
        return None;
    }
    let parts = corners.into_iter().zip(shares);
    parts
        .map(|((_, corner), share)| *corner * share)
        .reduce(|sum, part| sum + part)
}
