//! Twin of lit.wgsl.

use glam::{Vec2, Vec3};
use welkin_runtime::internals::clouds::lit::{
    BANK, BANK_BLUR, DARKEST, FINER, FINER_RELIEF, FINER_START, GRAIN_DEEPER, GRAIN_DEPTH,
    LEAST_STRETCH, SHADED_BY_LAYER, SIDE_FROM, SIDE_LEVELS, SIDE_LIGHT, SOFTER,
};
use welkin_runtime::internals::clouds::lit::{LitLayerUniforms, LitUniforms};
use welkin_runtime::internals::clouds::shared::MULTIPLE;
use welkin_runtime::params::{LAYERS_AN_ITERATION, Shading};

use crate::clouds::{self, Inputs};
use crate::texture::smoothstep;

/// Channels of the map that are read of a layer: by the paper's shading light that falls on it, opacity, shade; else light, opacity, height.
pub const READS: usize = 3;
/// Channels that are read of an iteration's grain: normal towards u and v, rank.
pub const GRAIN_READS: usize = 3;

/// Channels that are read of an iteration's lowest layer beside its base: of the side of its clouds and of those beyond.
const SIDE_READS: usize = 2 * READS;

/// How many channels are read in a place: those of each layer, those of each iteration's grain, and, but for the paper's shading, those of
/// each iteration's sides.
pub fn reads(lit: &LitUniforms, shading: Shading) -> usize {
    let iterations = count(lit).div_ceil(LAYERS_AN_ITERATION);
    let sides = match shading {
        Shading::Scattered => SIDE_READS,
        Shading::Paper => 0,
    };
    READS * count(lit) + (GRAIN_READS + sides) * iterations
}

/// Numbers about the channels of the map's layers in the order of the reads; 0 for what is not read of the map.
pub fn in_order_of_reads(layers: &[[f32; 4]]) -> Vec<f32> {
    let read = |[light, _, opacity, last]: &[f32; 4]| [*light, *opacity, *last];
    let lowest = layers.iter().step_by(LAYERS_AN_ITERATION);
    let grains = lowest.clone().flat_map(|_| [0.0; GRAIN_READS]);
    let sides = lowest
        .flat_map(|layer| [read(layer), read(layer)])
        .flatten();
    layers
        .iter()
        .flat_map(read)
        .chain(grains)
        .chain(sides)
        .collect()
}

pub(crate) fn count(lit: &LitUniforms) -> usize {
    lit.count as usize
}

/// Distance to the oblate hemisphere along a unit direction, in its heights: where
/// `f^2 (x^2 + z^2) + y^2 = 1` in heights, f the flattening.
pub fn distance(lit: &LitUniforms, direction: Vec3) -> f32 {
    let across = direction.x * direction.x + direction.z * direction.z;
    1.0 / libm::sqrtf(lit.flattening_squared * across + direction.y * direction.y)
}

/// Level of detail of a texture with one texel a height: the logarithm of the footprint's geometric mean. Of the place
/// `t cos`, with t the distance, the derivative by the elevation is `-t^3 sin`.
fn level(distance: f32, direction: Vec3, narrowing: f32) -> f32 {
    let tangential = distance * narrowing;
    let stretch = (distance * distance * direction.y).max(LEAST_STRETCH);
    0.5 * libm::log2f((tangential * tangential * stretch).max(1e-12))
}

/// How a finer read of the pack's texture roughens the layers of an iteration.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Grain {
    /// How much denser it is than most.
    pub denser: f32,
    /// What of its normal meets the sun.
    pub across: f32,
}

/// A layer where a ray meets it.
#[derive(Clone, Copy, Debug)]
pub struct Seen {
    /// How often sunlight was halved on its way there.
    pub depth: f32,
    /// How high the cloud is.
    pub height: f32,
    /// Its opacity.
    pub opacity: f32,
    /// That which shades what is below it: under an overcast all of the layer's.
    shading: f32,
}

/// Every layer from the lowest to the highest where a ray meets it, each at its place of the dome's plane and with its level of detail.
pub fn seen(inputs: &Inputs, direction: Vec3, place: impl Fn(usize) -> (Vec2, f32)) -> Vec<Seen> {
    let mut grain = Grain::default();
    let mut all = Vec::new();
    let softer = SOFTER[0] * (1.0 - smoothstep(0.0, SOFTER[1], direction.y));
    for index in 0..count(&inputs.uniforms.lit) {
        let (plane, level) = place(index);
        let level = level + softer;
        let layer = &inputs.uniforms.lit.layers[index];
        let own = &inputs.nudges[index * READS..];
        let base = read(inputs, index, plane, level + layer.lod_bias, own);
        let cloud = match index % LAYERS_AN_ITERATION {
            0 => {
                grain = grain_at(inputs, index, plane, level);
                sided(inputs, index, direction, plane, level, base)
            }
            _ => base,
        };
        let [left, opacity, height] = cloud;
        let deeper = GRAIN_DEEPER[0] + GRAIN_DEEPER[1] * inputs.uniforms.lit.overcast;
        let bump = grain.across - deeper * grain.denser;
        let depth = -libm::log2f(left.max(DARKEST)) / MULTIPLE[1]
            - GRAIN_DEPTH * layer.grain * bump * height;
        let rough = roughened(layer, opacity, grain);
        all.push(Seen {
            depth: depth.max(0.0),
            height,
            opacity: rough,
            shading: rough + (layer.opacity - rough) * inputs.uniforms.lit.overcast,
        });
    }
    all
}

/// Light, opacity and height of a place of the map.
fn read(inputs: &Inputs, index: usize, plane: Vec2, level: f32, nudges: &[f32]) -> [f32; 3] {
    let at = uv(&inputs.uniforms.lit.layers[index], plane).to_array();
    let [light, _, opacity, height] = inputs.map[index].sample(at, level);
    [light + nudges[0], opacity + nudges[1], height + nudges[2]]
}

/// The lowest layer of an iteration with what the ray meets over its base.
fn sided(
    inputs: &Inputs,
    index: usize,
    direction: Vec3,
    plane: Vec2,
    level: f32,
    base: [f32; 3],
) -> [f32; 3] {
    let lit = &inputs.uniforms.lit;
    let layer = &lit.layers[index];
    let iterations = count(lit).div_ceil(LAYERS_AN_ITERATION);
    let iteration = index / LAYERS_AN_ITERATION;
    let nudges =
        &inputs.nudges[READS * count(lit) + GRAIN_READS * iterations + SIDE_READS * iteration..];
    let across = Vec2::new(direction.x, direction.z);
    let way = (layer.side * across.length() / direction.y.max(1e-4)).min(layer.most_side);
    let out = across / across.length().max(1e-4) * way;
    let coarse = (level + layer.lod_bias).max(0.0);
    let side = read(inputs, index, plane + out, coarse + SIDE_LEVELS[0], nudges);
    let far = read(
        inputs,
        index,
        plane + out * 2.0,
        coarse + SIDE_LEVELS[1],
        &nudges[READS..],
    );
    let bank = 1.0 - smoothstep(BANK[0], BANK[1], direction.y);
    let blurred = |i: usize| base[i] + (far[i] - base[i]) * BANK_BLUR * bank;
    let [own, clear] = [blurred(1), 1.0 - blurred(1)];
    let over = clear * ((side[1] - SIDE_FROM) / (1.0 - SIDE_FROM)).clamp(0.0, 1.0);
    let beyond = bank * (clear - over) * (2.0 * far[1] - far[1] * far[1]);
    let opacity = (own + over + beyond).max(1e-4);
    let lighter = |light: f32, by: f32| light * (1.0 - by) + by;
    let light = own * blurred(0)
        + over * lighter(side[0], SIDE_LIGHT[0])
        + beyond * lighter(far[0], SIDE_LIGHT[1]);
    let height = own * blurred(2) + over * side[2] + beyond * far[2];
    [light / opacity, opacity, height / opacity]
}

/// Opacity of a layer, its edges roughened by the grain.
pub(crate) fn roughened(layer: &LitLayerUniforms, opacity: f32, grain: Grain) -> f32 {
    let rough = opacity + layer.grain * grain.denser * opacity * (1.0 - opacity);
    rough.clamp(0.0, 1.0) * layer.opacity
}

/// Where a layer is read.
pub(crate) fn uv(layer: &LitLayerUniforms, plane: Vec2) -> Vec2 {
    layer.east_axis * plane.x + layer.south_axis * plane.y + layer.offset
}

/// The grain of the iteration whose lowest layer this is.
pub(crate) fn grain_at(inputs: &Inputs, lowest: usize, plane: Vec2, level: f32) -> Grain {
    let lit = &inputs.uniforms.lit;
    let layer = &lit.layers[lowest];
    if layer.grain == 0.0 {
        return Grain::default();
    }
    let iteration = lowest / LAYERS_AN_ITERATION;
    let nudges = &inputs.nudges[READS * count(lit) + GRAIN_READS * iteration..];
    let uv = uv(layer, plane) * FINER + Vec2::from(FINER_START);
    let level = level + layer.lod_bias + libm::log2f(FINER);
    let [x, y, _, rank] = inputs.layers[layer.kind as usize].sample(uv.to_array(), level);
    let normal = Vec2::new(x + nudges[0], y + nudges[1]) * 2.0 - 1.0;
    Grain {
        denser: rank + nudges[2] - 0.5,
        across: FINER_RELIEF * normal.dot(layer.sun_uv),
    }
}

/// See [`crate::methods::layer`].
pub fn layer(inputs: &Inputs, direction: Vec3, narrowing: f32) -> (Vec3, f32) {
    let (plane, level) = met(&inputs.uniforms.lit, direction, narrowing);
    let seen = seen(inputs, direction, |_| (plane, level));
    let light = |(index, cloud): (usize, &Seen)| {
        let above = seen[index + 1..].iter().map(|above| left(above.shading));
        let [sunlit, skylit] =
            clouds::scattered(inputs.uniforms, direction, cloud.depth, cloud.height);
        let shares = [sunlit * above.product::<f32>(), skylit];
        (
            clouds::lit(&inputs.uniforms.clouds, shares, 0.0),
            cloud.opacity,
        )
    };
    composed(inputs, direction, seen.iter().enumerate().map(light))
}

/// Where a ray meets the dome, and the level of detail there.
pub(crate) fn met(lit: &LitUniforms, direction: Vec3, narrowing: f32) -> (Vec2, f32) {
    let distance = distance(lit, direction);
    let plane = Vec2::new(direction.x, direction.z) * distance;
    (plane, level(distance, direction, narrowing))
}

/// Radiance and opacity of layers from the lowest to the highest, each with its own.
pub(crate) fn composed(
    inputs: &Inputs,
    direction: Vec3,
    layers: impl Iterator<Item = (Vec3, f32)>,
) -> (Vec3, f32) {
    let uniforms = &inputs.uniforms.clouds;
    let (mut radiance, mut clear) = (Vec3::ZERO, 1.0);
    for (light, opacity) in layers {
        radiance += light * (clear * opacity);
        clear *= 1.0 - opacity;
    }
    let alpha = 1.0 - clear;
    let tint = clouds::tint(uniforms, inputs.clouds, direction);
    let tint = Vec3::ONE.lerp(uniforms.tint, tint);
    (
        radiance * tint / alpha.max(1e-4),
        alpha * clouds::clearness(uniforms, direction),
    )
}

/// What a layer leaves of the light on those below it.
pub(crate) fn left(opacity: f32) -> f32 {
    1.0 - SHADED_BY_LAYER * opacity
}

#[cfg(test)]
mod tests {
    use welkin_pack::LayerKind;
    use welkin_runtime::internals::pack_data::PackData;
    use welkin_runtime::{Camera, Method, SkyParams};

    use super::*;
    use crate::{lit_map, pack};

    /// An overcast's horizon is the twin's cloud where every channel has its mean, averaged over all directions.
    #[test]
    fn a_shut_sky_far_away_is_the_mean_cloud() {
        let facts = PackData::new(pack::default_pack()).expect("the pack has every role");
        let camera = Camera::looking(0.0, 0.3, 1.0, [64, 64]);
        for (time, density) in [(0.5, 0.0), (0.3, 0.6), (0.0, 1.0)] {
            let params = SkyParams {
                method: Method::Lit,
                cover: 1.0,
                density,
                time,
                ..Default::default()
            };
            let uniforms = facts.uniforms(&params, &camera, 0.0, 0.0);
            let (lit, layer) = (&uniforms.lit, &uniforms.lit.layers[0]);
            let rolls = [LayerKind::Cumulus, LayerKind::Cirrus].map(LayerKind::mean_density);
            let height = lit_map::height(lit, layer, 0.5, 0.5 * (rolls[0] + rolls[1]));
            let depth = layer.extinction * lit_map::passed(height, [height; 3]);
            // Layers above shade it, each as where it is full.
            let above = lit.layers[1..count(lit)].iter();
            let left: f32 = above.map(|layer| left(layer.opacity)).product();
            let sun = uniforms.sky.sun_direction;
            let light = |i: i32| {
                let cosine = (i as f32 + 0.5) / 200.0 - 1.0;
                let side = sun.any_orthonormal_vector() * (1.0 - cosine * cosine).sqrt();
                let direction = sun * cosine + side;
                let [sunlit, skylit] =
                    clouds::scattered(&uniforms, direction, depth, height.min(1.0));
                clouds::lit(&uniforms.clouds, [sunlit * left, skylit], 0.0) / 400.0
            };
            let mean = (0..400).map(light).sum::<Vec3>();
            let found = uniforms.sky.overcast;
            // The phase function is cut about the sun.
            let apart = (found - mean).abs();
            assert!(
                apart.cmple(mean * 0.03).all(),
                "{time} {density}: {found}, {mean}"
            );
            assert_eq!(uniforms.sky.overcast_weight, 1.0);
        }
    }
}
