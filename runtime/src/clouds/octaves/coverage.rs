//! How much of the sky the octaves method covers: its map holds shares of its own distribution, so every amount is equally likely, and three
//! domes and the finer read are independent.

use super::{
    BODY_HEIGHTS, EDGE, HIGH_OPACITY, MIDDLE_OPACITY, OctaveDome, OctaveUniforms, THIN, THIN_DEPTH,
};
use crate::clouds::shared::{
    CloudUniforms, MeanCloud, behind, inverse_roughen, inverse_soften, scattered, softened,
};
use crate::geometry::math::smoothstep;

/// Points at which smooth functions are averaged or tabulated.
const NODES: usize = 32;
/// Thicknesses of a dome: whether it needs another one to be opaque is no smooth function.
const DOME_NODES: usize = 64;

/// The share of places with more than this opacity.
pub(crate) fn covered(octaves: &OctaveUniforms, opacity: f32) -> f32 {
    let middle = clearness(&octaves.middle, |thickness| {
        let full = 1.0 - (THIN * octaves.exponent * thickness).exp2();
        1.0 - MIDDLE_OPACITY * softened(full, EDGE)
    });
    let high = clearness(&octaves.high, |thickness| {
        1.0 - HIGH_OPACITY * smoothstep(0.0, 1.0, thickness * octaves.high_contrast)
    });
    // The low dome needs no more than the whole opacity, whatever is behind it.
    let steps: Vec<f32> = (0..=NODES)
        .map(|i| low_dome(octaves, opacity * i as f32 / NODES as f32))
        .collect();
    let low = |needed: f32| {
        if needed < 0.0 {
            return 1.0;
        }
        let place = (needed / opacity).min(1.0) * NODES as f32;
        let step = (place as usize).min(NODES - 1);
        steps[step] + (steps[step + 1] - steps[step]) * (place - step as f32)
    };
    let pairs = middle
        .iter()
        .flat_map(|m| high.iter().map(move |h| (m[0] * h[0], m[1] * h[1])));
    pairs
        .map(|(share, clear)| share * low(behind(opacity, clear)))
        .sum()
}

/// The share of the low dome with more than this opacity, averaged over the finer read.
fn low_dome(octaves: &OctaveUniforms, opacity: f32) -> f32 {
    let above = |finer: f32| {
        let alpha = inverse_roughen(opacity, octaves.roughness * finer);
        let full = inverse_soften(alpha, EDGE).min(1.0);
        // At sharpness 0 there is no cloud however thick.
        let thickness = (1.0 - full).log2() / octaves.exponent.min(-1e-6);
        1.0 - (octaves.low.threshold + thickness).clamp(0.0, 1.0)
    };
    let nodes = (0..NODES).map(|i| (i as f32 + 0.5) / NODES as f32 - 0.5);
    nodes.map(above).sum::<f32>() / NODES as f32
}

/// Shares of a dome and what each leaves of the light behind it, by the thickness above its cut.
fn clearness(dome: &OctaveDome, of_thickness: impl Fn(f32) -> f32) -> Vec<[f32; 2]> {
    let open = dome.threshold.clamp(0.0, 1.0);
    let node = |i: usize| {
        let amount = open + (1.0 - open) * (i as f32 + 0.5) / DOME_NODES as f32;
        [
            (1.0 - open) / DOME_NODES as f32,
            of_thickness(amount - dome.threshold),
        ]
    };
    let clouds = (0..DOME_NODES).map(node).filter(|[share, _]| *share > 0.0);
    [[open, 1.0]].into_iter().chain(clouds).collect()
}

/// Mean opacity of its clouds. Finer reads roughen edges evenly.
pub(crate) fn mean_opacity(octaves: &OctaveUniforms) -> f32 {
    let low = mean_over(&octaves.low, &|t| low_opacity(octaves, t));
    1.0 - (1.0 - low) * clear_of_thin(octaves)
}

/// Its clouds on average, as they are lit to all sides: what the low dome shows of its depth, by how opaque it is.
pub(crate) fn mean(octaves: &OctaveUniforms, clouds: &CloudUniforms) -> MeanCloud {
    let clear = clear_of_thin(octaves);
    let (mut sums, mut opacity) = ([0.0; 2], 0.0);
    for i in 0..NODES {
        let amount = (i as f32 + 0.5) / NODES as f32;
        let alpha = low_opacity(octaves, (amount - octaves.low.threshold).max(0.0));
        let above = (amount - octaves.low.threshold.max(0.0)).max(0.0);
        let passed = octaves.base_depth + octaves.extinction * above;
        let depth = THIN_DEPTH + (passed - THIN_DEPTH) * alpha;
        let height = BODY_HEIGHTS[0] + (BODY_HEIGHTS[1] - BODY_HEIGHTS[0]) * alpha;
        let whole = 1.0 - (1.0 - alpha) * clear;
        for (sum, share) in sums.iter_mut().zip(scattered(clouds, None, depth, height)) {
            *sum += whole * share;
        }
        opacity += whole;
    }
    let shares = sums.map(|sum| sum / f32::max(opacity, 1e-6));
    MeanCloud::of_shares(clouds, opacity / NODES as f32, shares)
}

fn low_opacity(octaves: &OctaveUniforms, thickness: f32) -> f32 {
    softened(1.0 - (octaves.exponent * thickness).exp2(), EDGE)
}

/// What the middle and the high dome leave, on average.
fn clear_of_thin(octaves: &OctaveUniforms) -> f32 {
    let middle = mean_over(&octaves.middle, &|t| {
        softened(1.0 - (THIN * octaves.exponent * t).exp2(), EDGE)
    });
    let high = mean_over(&octaves.high, &|t| {
        smoothstep(0.0, 1.0, t * octaves.high_contrast)
    });
    (1.0 - MIDDLE_OPACITY * middle) * (1.0 - HIGH_OPACITY * high)
}

/// Mean of an opacity over the thicknesses of a dome.
fn mean_over(dome: &OctaveDome, opacity: &dyn Fn(f32) -> f32) -> f32 {
    let nodes = (0..NODES).map(|i| (i as f32 + 0.5) / NODES as f32 - dome.threshold);
    let opacities = nodes.map(|thickness| opacity(thickness.max(0.0)));
    opacities.sum::<f32>() / NODES as f32
}
