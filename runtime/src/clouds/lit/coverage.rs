//! How much of the sky the lit method covers: the blend of ranks is evenly distributed by construction.

use super::cut::base_share;
use super::{LitLayerUniforms, LitUniforms, layer_opacity, sided_at};
use crate::clouds::histogram::Histogram;
use crate::geometry::math::smoothstep;
use crate::params::LAYERS_AN_ITERATION;

/// The share of places with more than this opacity: layers are independent but for the grain of their iteration, of which every rank is equally likely.
pub(crate) fn covered(lit: &LitUniforms, opacity: f32) -> f32 {
    const RANKS: usize = 8;
    let count = lit.count as usize;
    let open = Histogram::of([1.0].into_iter());
    let clear_with = |rank: usize| {
        let layers = lit.layers[..count].chunks(LAYERS_AN_ITERATION).enumerate();
        layers.fold(open.clone(), |all, (iteration, layers)| {
            // Another iteration's grain is another one: any other order of the ranks.
            let rank = (rank * (1 + 2 * iteration)) % RANKS;
            let finer = (rank as f32 + 0.5) / RANKS as f32 - 0.5;
            let grain = if layers[0].grain > 0.0 { finer } else { 0.0 };
            layers.iter().enumerate().fold(all, |all, (place, layer)| {
                let own = clearness(layer, sided_at(lit, place), grain);
                Histogram::of_pairs(&all, &own, |all, layer| all * layer)
            })
        })
    };
    let shares = (0..RANKS).map(|rank| 1.0 - clear_with(rank).above(1.0 - opacity));
    shares.sum::<f32>() / RANKS as f32
}

/// What a layer leaves of the light behind it: every amount is equally likely, but for the sides that one sees beside bases.
fn clearness(layer: &LitLayerUniforms, sided: f32, grain: f32) -> Histogram {
    const AMOUNTS: usize = 512;
    let clear = (0..AMOUNTS).map(|i| {
        let thinner = (i as f32 + 0.5) / AMOUNTS as f32;
        let amount = 1.0 - base_share(sided, 1.0 - thinner);
        let thickness = (amount - layer.threshold).max(0.0);
        let alpha = smoothstep(0.0, 1.0, layer.steepness * thickness);
        let rough = alpha + layer.grain * grain * alpha * (1.0 - alpha);
        1.0 - layer.opacity * rough.clamp(0.0, 1.0)
    });
    Histogram::of(clear)
}

/// Mean opacity of its clouds: grain roughens edges evenly.
pub(crate) fn mean_opacity(lit: &LitUniforms) -> f32 {
    let layers = lit.layers[..lit.count as usize].iter().enumerate();
    let clear = layers.map(|(index, layer)| 1.0 - layer_opacity(layer, sided_at(lit, index)));
    1.0 - clear.product::<f32>()
}
