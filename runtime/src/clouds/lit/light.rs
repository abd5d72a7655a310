//! What the lit method's clouds scatter of the light that comes through them: the mean of what lit.wgsl draws.

use glam::Vec3;
use welkin_pack::LayerKind;

use super::map::{OWN, RISES, ROLLS, SHARES};
use super::{LitLayerUniforms, LitUniforms, SHADED_BY_LAYER, amounts, layer_opacity, sided_at};
use crate::clouds::shared::{CloudUniforms, scattered};
use crate::geometry::math::smoothstep;

/// Height of a cloud where this is its amount and an overcast's rolls have their mean.
fn height(lit: &LitUniforms, layer: &LitLayerUniforms, amount: f32) -> f32 {
    let alone = layer.height_rate * (amount - layer.threshold.max(0.0)).max(0.0);
    let mean = 0.5 * (LayerKind::Cumulus.mean_density() + LayerKind::Cirrus.mean_density());
    let [least, rolls, more, round] = ROLLS;
    let rolls = least + rolls * (mean - 0.5) + more * (amount - 0.5);
    let shut = 0.5 * (rolls + (rolls * rolls + round).sqrt());
    alone + (shut - alone) * lit.overcast
}

/// Shares of sunlight and skylight that a place sends to all sides, where clouds are as high all the way to the sun.
fn shares(
    lit: &LitUniforms,
    clouds: &CloudUniforms,
    layer: &LitLayerUniforms,
    amount: f32,
) -> [f32; 2] {
    let height = height(lit, layer, amount);
    let above = (height - Vec3::from(RISES)).max(Vec3::ZERO);
    let passed = OWN * height + Vec3::from(SHARES).dot(above);
    scattered(clouds, None, layer.extinction * passed, height.min(1.0))
}

/// What layers over the one of an index leave of the light: under an overcast the same everywhere.
fn shade_from_above(lit: &LitUniforms, index: usize) -> f32 {
    let layers = lit.layers[..lit.count as usize].iter().enumerate();
    let shading = |(index, layer): (usize, &LitLayerUniforms)| {
        let opacity = layer_opacity(layer, sided_at(lit, index));
        opacity + (layer.opacity - opacity) * lit.overcast
    };
    let above = layers.skip(index + 1);
    above
        .map(|layer| 1.0 - SHADED_BY_LAYER * shading(layer))
        .product()
}

/// Radiance of an overcast sky far away: its lowest layer, with the mean amount of cloud.
pub fn overcast(lit: &LitUniforms, clouds: &CloudUniforms) -> Vec3 {
    let [sunlit, skylit] = shares(lit, clouds, &lit.layers[0], 0.5);
    clouds.sunlight * (sunlit * shade_from_above(lit, 0)) + clouds.ambient * skylit
}

/// Shares of sunlight and skylight that the clouds that are there send to all sides: every layer shows through those below it.
pub(crate) fn mean_shares(lit: &LitUniforms, clouds: &CloudUniforms) -> [f32; 2] {
    let (mut sums, mut clear) = ([0.0; 2], 1.0);
    for (index, layer) in lit.layers[..lit.count as usize].iter().enumerate() {
        let (mut whole, mut light, mut count) = (0.0, [0.0; 2], 0.0);
        for amount in amounts(sided_at(lit, index)) {
            let thickness = (amount - layer.threshold).max(0.0);
            let alpha = layer.opacity * smoothstep(0.0, 1.0, layer.steepness * thickness);
            for (sum, share) in light.iter_mut().zip(shares(lit, clouds, layer, amount)) {
                *sum += alpha * share;
            }
            whole += alpha;
            count += 1.0;
        }
        let opacity = whole / count;
        let shown = clear * opacity / f32::max(whole, 1e-6);
        sums[0] += light[0] * shade_from_above(lit, index) * shown;
        sums[1] += light[1] * shown;
        clear *= 1.0 - opacity;
    }
    sums.map(|sum| sum / f32::max(1.0 - clear, 1e-6))
}
