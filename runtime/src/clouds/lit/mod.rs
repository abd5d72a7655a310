//! The lit method: layers of clouds with normals, lit, lighted through and shaded.
//!
//! # Theory
//! K. Mukhina, A. Bezgodov, "The Method for Real-time Cloud Rendering", Procedia Computer Science 66, 2015. Layers lie on an
//! oblate hemisphere about the viewer. Cover takes the brightest parts of a noise; its normals give the light that falls on the cloud,
//! `LT = (n, S) L` (eq. 3); what comes through it is `LS = (k1 + k2 (v, S))^m L` (eq. 4); clouds towards the sun shade it,
//! `SH = (1 - sum C)^m` (eq. 5), blurred radially from where the sun stands; and `F = (LS + LT) SH` (eq. 6). Up to
//! three layers are drawn in an iteration.
//!
//! That is [`Shading::Paper`](crate::params::Shading). By default ([`crate::clouds::lit::light`]) clouds scatter what comes through them, as those of `packed`, `octaves`
//! and `fbm` do, by the depth towards the sun that the map holds.
//!
//! # Changes versus the paper
//! - The dome is intersected for each pixel: with the radius a, the height b and the flattening `f = b / a`, a ray meets it at
//!   `t = 1 / sqrt(f^2 + (1 - f^2) y^2)` heights, y the sine of the elevation. [`mesh`] gives the paper's grid.
//! - The paper's clouds are a noise that is shifted. Here each layer blends two reads that move apart, so clouds form and
//!   dissolve; the blend is brought back to an even distribution, so cover stays the covered share.
//! - Cover is calibrated: shares of [`SkyParams::cover`] go to the layers such that together they cover it.
//! - Normals, opacity and shade are functions of the place in a layer, so they are drawn off screen ([`crate::clouds::lit::map`]). Layers shade
//!   the layers below them by what they leave of the light, a product in place of the paper's sum.
//! - The radial blur has three places on the way to where the sun is seen on the dome ([`paper::BLUR`]), as far apart as the light of a sun at
//!   that place would go through a cloud of the kind's thickness; its length, which the paper does not tell, ends at [`paper::LONGEST_WAY`].
//! - Light of the sky is added: the paper's shaded clouds are black.
//! - The lowest layer of an iteration is read three times by default: where the ray meets its base, and farther away, where the ray has risen into the
//!   clouds. So one sees sides, and towards the horizon clouds close to a bank, which a flat layer's do not.
//! - The second read is of cumulus for every kind: its lumps gather the first read's. Fibres of cirrus are bent ([`map::BENDS`]).
//! - The photograph's large shapes gather clouds ([`crate::clouds::photo`]).
//! - Normals are those of a flat layer, wherever it hangs on the dome: the dome brings the horizon near, clouds do not lean. So all of `LT`
//!   is in the map.
//! - In the night the moon lights the clouds; it is full and stands opposite the sun.
//!
//! - The map has one texel in a degree. So each iteration reads the pack's texture once more, finer, where its lowest layer is: a grain
//!   that roughens the edges and the light of its layers.
//!
//! # Practice
//! Six reads of texture arrays an iteration of three layers, used or not; ten by the paper's shading. Four passes of 256 texels and less an iteration.

pub mod coverage;
mod cut;
pub mod light;
mod look;
pub mod map;
pub mod paper;

use glam::{DMat2, DVec2, Vec2, Vec3, Vec3Swizzles};
use welkin_pack::LayerKind;

use self::cut::{base_share, cut, shut, sided};
use self::look::look;
use crate::clouds::march::SunCell;
use crate::clouds::shared::{CloudUniforms, CloudView, offset, overcast_weight, way_through};
use crate::geometry::dome::{self, Hit, Mesh};
use crate::geometry::math::smoothstep;
use crate::geometry::part::{Part, Value};
use crate::geometry::uniforms::uniforms;
use crate::params::{LAYERS_AN_ITERATION, LitLayer, MAX_LAYERS, SkyParams};

/// Its part of the shader.
pub const PART: Part = Part {
    constants: &[
        ("LIT_FINER", Value::F32(FINER)),
        ("LIT_FINER_LEVEL", Value::Log2(FINER)),
        ("LIT_FINER_RELIEF", Value::F32(FINER_RELIEF)),
        ("LIT_SHADED_BY_LAYER", Value::F32(SHADED_BY_LAYER)),
        ("LIT_LEAST_STRETCH", Value::F32(LEAST_STRETCH)),
        ("LIT_GRAIN_DEPTH", Value::F32(GRAIN_DEPTH)),
        ("LIT_GRAIN_DEEPER", Value::Vec2(GRAIN_DEEPER)),
        ("LIT_DARKEST", Value::F32(DARKEST)),
        ("LIT_SIDE_FROM", Value::F32(SIDE_FROM)),
        ("LIT_SIDE_LIGHT", Value::Vec2(SIDE_LIGHT)),
        ("LIT_SIDE_LEVELS", Value::Vec2(SIDE_LEVELS)),
        ("LIT_BANK", Value::Vec2(BANK)),
        ("LIT_BANK_BLUR", Value::F32(BANK_BLUR)),
        ("LIT_SOFTER", Value::Vec2(SOFTER)),
        ("LIT_FINER_START", Value::Vec2(FINER_START)),
    ],
    structs: &[LitLayerUniforms::WGSL, LitUniforms::WGSL],
    wgsl: include_str!("lit.wgsl"),
};

/// What its clouds hide of the light from places on the ground.
pub const SHADOW: Part = Part {
    constants: &[],
    structs: &[],
    wgsl: include_str!("shadow.wgsl"),
};

uniforms! {
    /// A layer of the lit method.
    LitLayerUniforms {
        /// What a height of the dome to the east adds to uv.
        east_axis: Vec2,
        /// What a height of the dome to the south adds to uv.
        south_axis: Vec2,
        /// Where the first read lies.
        offset: Vec2,
        /// How far the second read is from the first.
        second_offset: Vec2,
        /// The rank from which there is cloud.
        threshold: f32,
        /// 1 / thickness at which it is opaque.
        steepness: f32,
        /// Opacity where it is thick.
        opacity: f32,
        /// How fast shade deepens with thickness.
        shade_rate: f32,
        /// Fraction of the way to the sun that a step of the blur takes.
        blur_step: f32,
        /// Level of detail at distance 1.
        lod_bias: f32,
        /// Layer of the pack's texture.
        kind: f32,
        /// Factor on the horizontal part of normals.
        relief: f32,
        /// Horizontal part of the direction to the sun, along u and v.
        sun_uv: Vec2,
        /// How much the grain roughens it.
        grain: f32,
        /// Level of the second read.
        second_level: f32,
        /// A step towards the sun, in tiles.
        sun_step: Vec2,
        /// Halvings of sunlight by a height of 1.
        extinction: f32,
        /// Height of a cloud against its thickness, a share of the layer's distribution.
        height_rate: f32,
        /// How far from its base one sees the side of a cloud at 45 degrees, in heights of the dome.
        side: f32,
        /// And at most.
        most_side: f32,
        /// Standard deviations of fibres and of lumps as coarse as cirrus reads them; 0 for other kinds, which read ranks.
        spreads: Vec2,
    }

    /// Clouds of the lit method.
    LitUniforms {
        /// Square of the dome's flattening f.
        flattening_squared: f32,
        /// 1 - f^2.
        one_minus_squared: f32,
        /// How many layers are drawn.
        count: f32,
        /// Texels a side of the map.
        resolution: f32,
        /// Light of sun or moon on clouds.
        light: Vec3,
        /// The paper's k1.
        k1: f32,
        /// Unit direction towards sun or moon.
        light_direction: Vec3,
        /// The paper's k2.
        k2: f32,
        /// Where sun or moon is seen on the dome's plane, in its heights.
        light_position: Vec2,
        /// How overcast the sky is, 0..1.
        overcast: f32,
        /// How much more of the sky than by their bases the lowest clouds of an iteration cover by their sides: see `base_share`.
        sided: f32,
        /// Light of the sky on clouds.
        ambient: Vec3,
        /// The paper's m.
        m: f32,
        /// From the lowest to the highest.
        layers: [LitLayerUniforms; MAX_LAYERS],
    }
}

/// How much finer the grain is, a read of the pack's texture. A whole number: offsets are reduced by whole tiles.
pub const FINER: f32 = 5.0;
/// Where the grain starts.
pub const FINER_START: [f32; 2] = [0.29, 0.63];
/// How much of the grain's normal is added, times the layer's share of the grain.
pub const FINER_RELIEF: f32 = 0.12;
/// What a layer behind leaves of the light where it is opaque.
pub const SHADED_BY_LAYER: f32 = 0.45;
/// How much less deep in the cloud a place is whose grain's normal meets the sun, in halvings, and how much of its density makes it deeper; what an
/// overcast, whose rolls are smooth, adds to that.
pub const GRAIN_DEPTH: f32 = 1.2;
pub const GRAIN_DEEPER: [f32; 2] = [0.048, 0.5];
/// The least that the map tells of what was scattered many times.
pub const DARKEST: f32 = 0.02;
/// The opacity at its base from which a cloud has a side, and how much lighter sides are than the base: of the near one, and of the far ones.
pub const SIDE_FROM: f32 = 0.3;
pub const SIDE_LIGHT: [f32; 2] = [0.25, 0.15];
/// How much coarser both are read, and how far from the base the near one is read at most, in heights of the dome.
pub const SIDE_LEVELS: [f32; 2] = [1.2, 2.5];
const MOST_SIDE: f64 = 0.16;
/// Sines of the elevation below which clouds are a bank, and from which they stand alone; how much of a bank is read coarser.
pub const BANK: [f32; 2] = [0.05, 0.32];
pub const BANK_BLUR: f32 = 0.6;
/// How much coarser clouds on the horizon are read, and the sine of the elevation from which all is sharp: there the air and the clouds' height, which
/// a flat layer lacks, take what is small.
pub const SOFTER: [f32; 2] = [3.2, 0.65];
/// The least radial stretch of a texel, over the tangential one, that chooses the level of detail.
pub const LEAST_STRETCH: f32 = 0.25;

/// How layers are turned against the world, in radians: no two alike, none along an axis.
const TURNS: [f64; MAX_LAYERS] = [0.43, 1.29, 2.6, 3.7, 4.4, 5.6];
/// Where the textures lie over the viewer at time 0.
const STARTS: [DVec2; MAX_LAYERS] = [
    DVec2::new(0.13, 0.71),
    DVec2::new(0.57, 0.29),
    DVec2::new(0.83, 0.47),
    DVec2::new(0.31, 0.93),
    DVec2::new(0.07, 0.17),
    DVec2::new(0.69, 0.61),
];
/// Cells of the second read across the tile, roughly: a cloud has formed anew when the second read has gone one.
const CELLS: f64 = 6.0;
/// The way of the second read, turned against the layer.
const CHANGE_WAY: DVec2 = DVec2::new(0.8, -0.6);
/// How fast shade deepens at density 0 and what density 1 adds, as factors on that of the kind. Chosen by eye.
const SHADE_OF_DENSITY: [f32; 2] = [0.6, 0.8];
/// How much less an overcast sky is shaded: light comes from all sides.
const EVENED: f32 = 0.65;

/// Height of a cloud that is as thick as its layer's share of the sky, and the least such share that counts.
const HEIGHT: f32 = 0.7;
const LEAST_SHARE: f32 = 0.4;
/// How high the ray towards the sun has risen after a step, in thicknesses of the clouds.
const FIRST_RISE: f64 = 0.15;
/// The lowest sun that the march knows, in radians: places towards a lower one would lie in other clouds.
const LEAST_MARCH_RAD: f64 = 0.4;
/// How many amounts of cloud a mean is taken of.
const AMOUNTS: usize = 64;

/// Where a ray from the viewer along a unit direction meets the oblate dome of this flattening.
///
/// In heights of the dome, viewer at the origin: 1 overhead, `1 / flattening` on the horizon.
pub fn intersect(flattening: f32, direction: Vec3) -> Hit {
    let f2 = flattening * flattening;
    let distance = (f2 + (1.0 - f2) * direction.y * direction.y).sqrt().recip();
    let position = direction * distance;
    // The gradient of f^2 (x^2 + z^2) + y^2.
    let normal = Vec3::new(f2 * position.x, position.y, f2 * position.z).normalize();
    Hit {
        position,
        distance,
        cos_incidence: normal.dot(direction),
    }
}

/// The paper's grid: the dome as [`dome::mesh`] makes it, with the oblate dome's coordinates, in its heights.
pub fn mesh(flattening: f32, step_deg: f32) -> Mesh {
    dome::mesh_of(step_deg, |direction| {
        intersect(flattening, direction).position
    })
}

/// The method's share of the uniforms. `params` are in range; `sun` is the unit direction towards sun or moon.
pub fn uniforms(
    params: &SkyParams,
    view: &CloudView,
    sun: Vec3,
    clouds: &CloudUniforms,
    spreads: Vec2,
) -> LitUniforms {
    let own = &params.lit;
    let f2 = own.flattening * own.flattening;
    let seen = intersect(own.flattening, sun).position;
    let mut layers = [LitLayerUniforms::default(); MAX_LAYERS];
    let mut count = 0;
    for (slot, (index, cover)) in layers.iter_mut().zip(drawn(params)) {
        *slot = layer_uniforms(params, view, [count, index], cover, sun);
        if params.lit.layers[index].kind == LayerKind::Cirrus {
            slot.spreads = spreads;
        }
        count += 1;
    }
    LitUniforms {
        flattening_squared: f2,
        one_minus_squared: 1.0 - f2,
        count: count as f32,
        resolution: map::SIDE as f32,
        light: clouds.sunlight,
        k1: own.k1,
        light_direction: sun,
        k2: own.k2,
        light_position: seen.xz(),
        overcast: overcast_weight(params.cover),
        sided: sided(params),
        ambient: clouds.ambient,
        m: own.m,
        layers,
    }
}

/// The layers that are drawn, by their index in [`crate::params::LitParams::layers`], with what each covers.
pub(crate) fn drawn(params: &SkyParams) -> impl Iterator<Item = (usize, f32)> {
    let layers = params.lit.layers.iter().enumerate();
    layers
        .map(|(index, layer)| (index, layer_cover(params, layer)))
        .filter(|(_, cover)| *cover > 0.0)
}

/// Height of a layer over the ground, in metres.
pub(crate) fn height_m(params: &SkyParams, index: usize) -> f64 {
    let own = &params.lit;
    let height = own.layers[index].height;
    f64::from(own.radius_m) * f64::from(own.flattening) * f64::from(height)
}

/// The share of the sky that a layer covers: `1 - cover` is the product of what they leave open.
pub(crate) fn layer_cover(params: &SkyParams, layer: &LitLayer) -> f32 {
    let shares: f32 = params.lit.layers.iter().map(|l| l.share).sum();
    if layer.share == 0.0 {
        return 0.0;
    }
    1.0 - (1.0 - params.cover).powf(layer.share / shares)
}

fn layer_uniforms(
    params: &SkyParams,
    view: &CloudView,
    [slot, index]: [usize; 2],
    cover: f32,
    sun: Vec3,
) -> LitLayerUniforms {
    let (own, layer) = (&params.lit, &params.lit.layers[index]);
    let look = look(layer.kind);
    let height_m = height_m(params, index);
    let [low, high] = look.tile_m;
    let tile_m = low + (high - low) * f64::from(params.height);
    let turn = DMat2::from_angle(TURNS[index]);
    // Tiles a height.
    let axes = turn * (height_m / tile_m);
    let [east, south] = layer.velocity_m_s.map(f64::from);
    let way = DVec2::new(east, south) * (f64::from(params.speed) * view.seconds / height_m);
    let intervals = view.seconds / f64::from(own.formation_interval_s);
    let near = view.distance(height_m);
    let texels_a_height = f64::from(map::SIDE) * height_m / tile_m * near;
    // Of two steps each way; a viewer near the layer sees no farther than to the sun.
    let step = 0.5 * (look.thickness_m / (height_m * near)).min(1.0);
    let steepness = (1.0 + params.density) / look.opaque;
    let base = match slot % LAYERS_AN_ITERATION {
        0 => base_share(sided(params), cover),
        _ => cover,
    };
    let threshold = cut(base, steepness, look.opacity) - shut(params.cover);
    let seen = axes * near;
    let [thin, more] = SHADE_OF_DENSITY;
    LitLayerUniforms {
        east_axis: seen.x_axis.as_vec2(),
        south_axis: seen.y_axis.as_vec2(),
        offset: offset(STARTS[index] + axes * (view.place(height_m) - way)),
        second_offset: offset(STARTS[5 - index] + CHANGE_WAY * (intervals / CELLS)),
        threshold,
        steepness,
        opacity: look.opacity,
        shade_rate: look.shade
            * (thin + more * params.density)
            * (1.0 - EVENED * overcast_weight(params.cover)),
        blur_step: step as f32,
        lod_bias: view.level(texels_a_height),
        kind: layer.kind as u32 as f32,
        relief: look.relief,
        sun_uv: (turn * sun.xz().as_dvec2()).as_vec2(),
        grain: look.grain,
        second_level: look.second_level,
        sun_step: (turn * march_step(sun) * (look.thickness_m / tile_m)).as_vec2(),
        extinction: look.extinction * (1.0 + params.density) * way_through(sun.y),
        height_rate: HEIGHT / (1.0 - threshold.max(0.0)).max(LEAST_SHARE),
        side: (0.5 * look.thickness_m / (height_m * near)) as f32,
        most_side: (MOST_SIDE / near) as f32,
        ..Default::default()
    }
}

/// A step towards the sun, in thicknesses of the clouds (east, south).
fn march_step(sun: Vec3) -> DVec2 {
    let cell = SunCell::of(sun);
    cell.towards * (FIRST_RISE / cell.elevation_rad.max(LEAST_MARCH_RAD).tan())
}

/// What sides add to the share of a layer, by its place from the lowest: see [`base_share`].
fn sided_at(lit: &LitUniforms, index: usize) -> f32 {
    match index % LAYERS_AN_ITERATION {
        0 => lit.sided,
        _ => 0.0,
    }
}

/// Mean opacity of a layer to which sides add so much.
fn layer_opacity(layer: &LitLayerUniforms, sided: f32) -> f32 {
    let opacity = |amount: f32| {
        let thickness = (amount - layer.threshold).max(0.0);
        layer.opacity * smoothstep(0.0, 1.0, layer.steepness * thickness)
    };
    amounts(sided).map(opacity).sum::<f32>() / AMOUNTS as f32
}

/// Amounts of cloud, each of which is seen as often as any other where sides add so much: all of them alike but for these.
fn amounts(sided: f32) -> impl Iterator<Item = f32> {
    let thinner = (0..AMOUNTS).map(|i| (i as f32 + 0.5) / AMOUNTS as f32);
    thinner.map(move |thinner| 1.0 - base_share(sided, 1.0 - thinner))
}

#[cfg(test)]
mod tests;
