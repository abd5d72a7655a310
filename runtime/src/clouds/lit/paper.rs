//! The lit method's clouds as the paper lights them: equations 3 to 6, and the light of the sky.

use glam::{Vec3, Vec3Swizzles};

use super::{LitLayerUniforms, LitUniforms, SHADED_BY_LAYER, amounts, layer_opacity};
use crate::clouds::shared::MeanCloud;
use crate::geometry::math::{normal_share, smoothstep};
use crate::geometry::part::{Part, Value};

/// Its part of the shader.
pub const PART: Part = Part {
    constants: &[
        ("LIT_BLUR_LEVEL", Value::F32(BLUR_LEVEL)),
        ("LIT_LONGEST_WAY", Value::F32(LONGEST_WAY)),
        ("LIT_AMBIENT_SHADED", Value::F32(AMBIENT[0])),
        ("LIT_AMBIENT_BRIGHTER", Value::F32(AMBIENT[1])),
        ("LIT_BLUR", Value::Vec3(Vec3::from_array(BLUR))),
    ],
    structs: &[],
    wgsl: include_str!("paper.wgsl"),
};

/// Shares of a place's own shade and of those of two places towards the sun in its blurred shade: nearer cloud counts more.
pub const BLUR: [f32; 3] = [3.0 / 6.0, 2.0 / 6.0, 1.0 / 6.0];
/// How much coarser those two are read: they are several texels apart.
pub const BLUR_LEVEL: f32 = 1.5;
/// The longest way to the sun that the blur takes a share of, in heights of the dome: so far is the sun on it at 22 degrees.
pub const LONGEST_WAY: f32 = 2.5;
/// The light of the sky on a cloud in full shade, and what light adds to it.
pub const AMBIENT: [f32; 2] = [0.62, 0.38];
/// Standard deviation of a component of the clouds' normals: those of the default recipe's layers have 0.33 to 0.39, and two reads are blended.
const NORMAL_SPREAD: f32 = 0.26;
/// Azimuths over which eq. 4 is averaged around half of the horizon; the other half is the same.
const AZIMUTHS: u32 = 8;

/// Radiance of an overcast sky far away: layers where they have their mean, flat, around the whole horizon.
pub fn overcast(lit: &LitUniforms) -> Vec3 {
    let [lowest, ..] = &lit.layers;
    let thickness = (0.5 - lowest.threshold.max(0.0)).max(0.0);
    let shade = (-lit.m * lowest.shade_rate * thickness).exp2() * shade_from_above(lit, 0);
    lit.light * (mean_light(lit) * shade) + lit.ambient * (AMBIENT[0] + AMBIENT[1] * shade)
}

/// Mean opacity of a layer, and the mean of what its clouds leave of the light.
fn layer_means(layer: &LitLayerUniforms, m: f32) -> [f32; 2] {
    let (mut opacity, mut left, mut count) = (0.0, 0.0, 0.0);
    for amount in amounts(0.0) {
        let thickness = (amount - layer.threshold.max(0.0)).max(0.0);
        let cut = (amount - layer.threshold).max(0.0);
        let alpha = layer.opacity * smoothstep(0.0, 1.0, layer.steepness * cut);
        opacity += alpha;
        left += alpha * (-m * layer.shade_rate * thickness).exp2();
        count += 1.0;
    }
    [opacity / count, left / opacity.max(1e-6)]
}

/// What layers over the one of an index leave of the light, on average.
fn shade_from_above(lit: &LitUniforms, index: usize) -> f32 {
    let above = lit.layers[..lit.count as usize].iter().skip(index + 1);
    let left = above.map(|layer| 1.0 - SHADED_BY_LAYER * layer_opacity(layer, 0.0));
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

/// The clouds that are there on average, where [`facing`] is 1: every layer shows through those below it.
pub(crate) fn mean(lit: &LitUniforms, opacity: f32) -> MeanCloud {
    let (mut sums, mut clear) = ([0.0; 2], 1.0);
    for (index, layer) in lit.layers[..lit.count as usize].iter().enumerate() {
        let [opacity, shade] = layer_means(layer, lit.m);
        let shade = shade * shade_from_above(lit, index);
        sums[0] += shade * (clear * opacity);
        sums[1] += (AMBIENT[0] + AMBIENT[1] * shade) * (clear * opacity);
        clear *= 1.0 - opacity;
    }
    let [sunlit, skylit] = sums.map(|sum| sum / f32::max(1.0 - clear, 1e-6));
    MeanCloud {
        opacity,
        sunlit: sunlit * lit.light,
        skylit: skylit * lit.ambient,
    }
}

/// Share of sunlight along a direction: see paper.wgsl.
pub(crate) fn facing(lit: &LitUniforms, direction: Vec3) -> f32 {
    let cosine = direction.dot(lit.light_direction);
    mean_fall(lit.light_direction) + through(lit, cosine)
}
