//! The lit method: layers of clouds with normals, lit, lighted through and shaded.
//!
//! # Theory
//! K. Mukhina, A. Bezgodov, "The Method for Real-time Cloud Rendering", Procedia Computer Science 66, 2015. Layers lie on an
//! oblate hemisphere about the viewer. Cover takes the brightest parts of a noise; its normals give the light that falls on the cloud,
//! `LT = (n, S) L` (eq. 3); what comes through it is `LS = (k1 + k2 (v, S))^m L` (eq. 4); clouds towards the sun shade it,
//! `SH = (1 - sum C)^m` (eq. 5), blurred radially from where the sun stands; and `F = (LS + LT) SH` (eq. 6). Up to
//! three layers are drawn in an iteration.
//!
//! # Changes versus the paper
//! - The dome is intersected for each pixel: with the radius a, the height b and the flattening `f = b / a`, a ray meets it at
//!   `t = 1 / sqrt(f^2 + (1 - f^2) y^2)` heights, y the sine of the elevation. [`mesh`] gives the paper's grid.
//! - The paper's clouds are a noise that is shifted. Here each layer blends two reads that move apart, so clouds form and
//!   dissolve; the blend is brought back to an even distribution, so cover stays the covered share.
//! - Cover is calibrated: shares of [`SkyParams::cover`] go to the layers such that together they cover it.
//! - Normals, opacity and shade are functions of the place in a layer, so they are drawn off screen ([`crate::clouds::lit::map`]). Layers shade
//!   the layers below them by what they leave of the light, a product in place of the paper's sum.
//! - The radial blur has three places on the way to where the sun is seen on the dome ([`BLUR`]), as far apart as the light of a sun at
//!   that place would go through a cloud of the kind's thickness; its length, which the paper does not tell, ends at [`LONGEST_WAY`].
//! - Light of the sky is added: the paper's shaded clouds are black.
//! - Normals are those of a flat layer, wherever it hangs on the dome: the dome brings the horizon near, clouds do not lean. So all of `LT`
//!   is in the map.
//! - In the night the moon lights the clouds; it is full and stands opposite the sun.
//!
//! - The map has one texel in a degree. So each iteration reads the pack's texture once more, finer, where its lowest layer is: a grain
//!   that roughens the edges and the light of its layers.
//!
//! # Practice
//! Ten reads of texture arrays an iteration of three layers, used or not. Four passes of 256 texels and less an iteration.

pub mod coverage;
pub mod map;
pub mod shadow;

use glam::{DMat2, DVec2, Vec2, Vec3, Vec3Swizzles};
use welkin_pack::LayerKind;

use crate::clouds::shared::{
    self, CloudUniforms, CloudView, OPAQUE, inverse_smoothstep, offset, overcast_weight,
};
use crate::geometry::dome::{self, Hit, Mesh};
use crate::geometry::math::{normal_share, smoothstep};
use crate::geometry::part::{Part, Value};
use crate::geometry::uniforms::uniforms;
use crate::params::{LitLayer, MAX_LAYERS, SkyParams};

/// Its part of the shader.
pub const PART: Part = Part {
    constants: &[
        ("LIT_FINER", Value::F32(FINER)),
        ("LIT_FINER_LEVEL", Value::Log2(FINER)),
        ("LIT_FINER_RELIEF", Value::F32(FINER_RELIEF)),
        ("LIT_SHADED_BY_LAYER", Value::F32(SHADED_BY_LAYER)),
        ("LIT_LEAST_STRETCH", Value::F32(LEAST_STRETCH)),
        ("LIT_BLUR_LEVEL", Value::F32(BLUR_LEVEL)),
        ("LIT_LONGEST_WAY", Value::F32(LONGEST_WAY)),
        ("LIT_FINER_START", Value::Vec2(FINER_START)),
        ("LIT_SIDES", Value::F32(SIDES)),
        ("LIT_AMBIENT_SHADED", Value::F32(AMBIENT[0])),
        ("LIT_AMBIENT_BRIGHTER", Value::F32(AMBIENT[1])),
        ("LIT_BLUR", Value::Vec3(Vec3::from_array(BLUR))),
    ],
    structs: &[LitLayerUniforms::WGSL, LitUniforms::WGSL],
    wgsl: include_str!("lit.wgsl"),
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
        /// Nothing.
        _pad: f32,
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
        /// Nothing.
        _pad: Vec2,
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
pub const FINER_RELIEF: f32 = 0.19;
/// What a layer behind leaves of the light where it is opaque.
pub const SHADED_BY_LAYER: f32 = 0.45;
/// Shares of a place's own shade and of those of two places towards the sun in its blurred shade: nearer cloud counts more.
pub const BLUR: [f32; 3] = [3.0 / 6.0, 2.0 / 6.0, 1.0 / 6.0];
/// How much coarser those two are read: they are several texels apart.
pub const BLUR_LEVEL: f32 = 1.5;
/// The longest way to the sun that the blur takes a share of, in heights of the dome: so far is the sun on it at 22 degrees.
pub const LONGEST_WAY: f32 = 2.5;
/// The light of the sky on a cloud in full shade, and what light adds to it.
pub const AMBIENT: [f32; 2] = [0.62, 0.38];
/// The least radial stretch of a texel, over the tangential one, that chooses the level of detail.
pub const LEAST_STRETCH: f32 = 0.25;

/// How layers of a kind look.
struct Look {
    /// How far the texture reaches, in metres, at height 0 and 1.
    tile_m: [f64; 2],
    /// Thickness, as a share of the layer's distribution, at which it is opaque.
    opaque: f32,
    /// Opacity where it is thick.
    opacity: f32,
    /// How fast shade deepens.
    shade: f32,
    /// Factor on the horizontal part of normals.
    relief: f32,
    /// How much the grain roughens it, 0 for not at all.
    grain: f32,
    /// How thick such clouds are, in metres: how far their shade reaches.
    thickness_m: f64,
}

const fn look(kind: LayerKind) -> Look {
    match kind {
        LayerKind::Stratocumulus => Look {
            tile_m: [10_000.0, 5_000.0],
            opaque: 0.30,
            opacity: 1.0,
            shade: 2.1,
            relief: 1.0,
            grain: 2.6,
            thickness_m: 350.0,
        },
        LayerKind::Cumulus => Look {
            tile_m: [10_500.0, 5_500.0],
            opaque: 0.20,
            opacity: 1.0,
            shade: 3.0,
            relief: 1.0,
            grain: 2.6,
            thickness_m: 700.0,
        },
        LayerKind::Cirrus => Look {
            tile_m: [42_000.0, 24_000.0],
            opaque: 0.9,
            opacity: 0.65,
            shade: 0.5,
            relief: 0.5,
            grain: 0.0,
            thickness_m: 200.0,
        },
    }
}

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
/// Cells of the kinds' noise across the tile, roughly: a cloud has formed anew when the second read has gone one.
const CELLS: f64 = 12.0;
/// The way of the second read, turned against the layer.
const CHANGE_WAY: DVec2 = DVec2::new(0.8, -0.6);
/// How fast shade deepens at density 0 and what density 1 adds, as factors on that of the kind. Chosen by eye.
const SHADE_OF_DENSITY: [f32; 2] = [0.6, 0.8];
/// How much less an overcast sky is shaded: light comes from all sides.
const EVENED: f32 = 0.65;
/// Cover of a layer below which it is a trace.
const TRACE: f32 = 0.02;
/// Cover of a layer from which it shuts: more than seven oktas, which are to be seven.
const SHUTTING: f32 = 0.9;
/// Standard deviation of a component of the clouds' normals: those of the default recipe's layers have 0.33 to 0.39, and two reads are blended.
const NORMAL_SPREAD: f32 = 0.26;
/// Light of a sun on the horizon on the sides of clouds opposite it, where shade leaves all: chosen by eye.
pub const SIDES: f32 = 0.5;

/// How much the cut goes below 0 in an overcast.
const OVERCAST: f32 = 0.5;
/// Azimuths over which eq. 4 is averaged around half of the horizon; the other half is the same.
const AZIMUTHS: u32 = 8;
/// The opacity above which a direction counts as covered: where the cut lies.
const COVERED: f32 = OPAQUE;

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
) -> LitUniforms {
    let own = &params.lit;
    let f2 = own.flattening * own.flattening;
    let seen = intersect(own.flattening, sun).position;
    let mut layers = [LitLayerUniforms::default(); MAX_LAYERS];
    let mut count = 0;
    for (slot, (index, cover)) in layers.iter_mut().zip(drawn(params)) {
        *slot = layer_uniforms(params, view, index, cover, sun);
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
        ambient: clouds.ambient,
        m: own.m,
        layers,
        ..Default::default()
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
    index: usize,
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
    let seen = axes * near;
    let [thin, more] = SHADE_OF_DENSITY;
    LitLayerUniforms {
        east_axis: seen.x_axis.as_vec2(),
        south_axis: seen.y_axis.as_vec2(),
        offset: offset(STARTS[index] + axes * (view.place(height_m) - way)),
        second_offset: offset(STARTS[5 - index] + CHANGE_WAY * (intervals / CELLS)),
        threshold: cut(cover, steepness, look.opacity),
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
        ..Default::default()
    }
}

/// The amount from which there is cloud, such that the densest `cover` of the layer counts as covered.
fn cut(cover: f32, steepness: f32, opacity: f32) -> f32 {
    let thin = inverse_smoothstep(COVERED / opacity) / steepness;
    // A trace of cover brings its thin edge in by degrees.
    let edge = thin * (cover / TRACE).min(1.0);
    1.0 - cover - edge - OVERCAST * smoothstep(SHUTTING, 1.0, cover)
}

/// Radiance of an overcast sky far away: layers where they have their mean, flat, around the whole horizon.
pub fn overcast(lit: &LitUniforms) -> Vec3 {
    let [lowest, ..] = &lit.layers;
    let thickness = (0.5 - lowest.threshold.max(0.0)).max(0.0);
    let shade = (-lit.m * lowest.shade_rate * thickness).exp2() * shade_from_above(lit, 0);
    lit.light * (mean_light(lit) * shade) + lit.ambient * (AMBIENT[0] + AMBIENT[1] * shade)
}

/// Mean opacity of a layer.
pub(crate) fn layer_opacity(layer: &LitLayerUniforms) -> f32 {
    layer_means(layer, 0.0)[0]
}

/// Mean opacity of a layer, and the mean of what its clouds leave of the light.
fn layer_means(layer: &LitLayerUniforms, m: f32) -> [f32; 2] {
    const AMOUNTS: usize = 32;
    let (mut opacity, mut left) = (0.0, 0.0);
    for i in 0..AMOUNTS {
        let thickness = ((i as f32 + 0.5) / AMOUNTS as f32 - layer.threshold.max(0.0)).max(0.0);
        let cut = ((i as f32 + 0.5) / AMOUNTS as f32 - layer.threshold).max(0.0);
        let alpha = layer.opacity * smoothstep(0.0, 1.0, layer.steepness * cut);
        opacity += alpha;
        left += alpha * (-m * layer.shade_rate * thickness).exp2();
    }
    [opacity / AMOUNTS as f32, left / opacity.max(1e-6)]
}

/// What layers over the one of an index leave of the light, on average.
fn shade_from_above(lit: &LitUniforms, index: usize) -> f32 {
    let above = lit.layers[..lit.count as usize].iter().skip(index + 1);
    let left = above.map(|layer| 1.0 - SHADED_BY_LAYER * layer_opacity(layer));
    left.product()
}

/// Sunlight of a flat cloud around the whole horizon: what falls on it and the mean of eq. 4.
fn mean_light(lit: &LitUniforms) -> f32 {
    let sun = lit.light_direction;
    let level = sun.xz().length();
    let azimuth_rad = |i: u32| (i as f32 + 0.5) / AZIMUTHS as f32 * std::f32::consts::PI;
    let through = (0..AZIMUTHS).map(|i| through(lit, level * azimuth_rad(i).cos()));
    sun.y.max(0.0) + through.sum::<f32>() / AZIMUTHS as f32
}

/// Eq. 4 over L, by the cosine to the sun.
fn through(lit: &LitUniforms, cosine: f32) -> f32 {
    (lit.k1 + lit.k2 * cosine).max(0.0).powf(lit.m)
}

/// Mean of eq. 3 over clouds whose normals lean to all sides: of a normal distribution about that of a flat one, what is above 0.
fn mean_fall(sun: Vec3) -> f32 {
    let spread = NORMAL_SPREAD * sun.xz().length();
    let flat = sun.y * (1.0 - 2.0 * NORMAL_SPREAD * NORMAL_SPREAD).sqrt();
    if spread < 1e-3 {
        return flat.max(0.0);
    }
    let place = flat / spread;
    let density = (-0.5 * place * place).exp() / std::f32::consts::TAU.sqrt();
    flat * normal_share(place) + spread * density
}

/// Mean radiance of the clouds that are there, where [`facing`] is 1: every layer shows through those below it.
pub(crate) fn mean_radiance(lit: &LitUniforms) -> Vec3 {
    let (mut sum, mut clear) = (Vec3::ZERO, 1.0);
    for (index, layer) in lit.layers[..lit.count as usize].iter().enumerate() {
        let [opacity, shade] = layer_means(layer, lit.m);
        let shade = shade * shade_from_above(lit, index);
        let radiance = lit.light * shade + lit.ambient * (AMBIENT[0] + AMBIENT[1] * shade);
        sum += radiance * (clear * opacity);
        clear *= 1.0 - opacity;
    }
    sum / (1.0 - clear).max(1e-6)
}

/// Share of sunlight along a direction: see the end of lit.wgsl.
pub(crate) fn facing(
    lit: &LitUniforms,
    clouds: &CloudUniforms,
    direction: Vec3,
    opacity: f32,
) -> f32 {
    let cosine = direction.dot(lit.light_direction);
    let falls = mean_fall(lit.light_direction);
    let sides = SIDES * clouds.low_sun * (0.5 - 0.5 * cosine) * (AMBIENT[0] + AMBIENT[1]);
    (falls + through(lit, cosine)) * shared::facing(clouds, cosine, opacity) + sides
}

#[cfg(test)]
mod tests;
