//! Twin of lit.wgsl: the paper's equations, one function each.

use glam::{Vec2, Vec3};
use welkin_runtime::internals::clouds::lit::{
    AMBIENT, BLUR, BLUR_LEVEL, FINER, FINER_RELIEF, FINER_START, LEAST_STRETCH, LONGEST_WAY,
    SHADED_BY_LAYER, SIDES,
};
use welkin_runtime::internals::clouds::lit::{LitLayerUniforms, LitUniforms};
use welkin_runtime::params::LAYERS_AN_ITERATION;

use crate::clouds::{self, Inputs};

/// Channels of the map that are read of a layer: light that falls on it, opacity, shade.
pub const READS: usize = 3;
/// Channels that are read of an iteration's grain: normal towards u and v, rank.
pub const GRAIN_READS: usize = 3;

/// How many channels are read in a place: those of each layer, then those of each iteration's grain.
pub fn reads(lit: &LitUniforms) -> usize {
    let count = count(lit);
    READS * count + GRAIN_READS * count.div_ceil(LAYERS_AN_ITERATION)
}

fn count(lit: &LitUniforms) -> usize {
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

/// What comes through a cloud: equation 4 over L.
pub fn through(lit: &LitUniforms, direction: Vec3) -> f32 {
    let scattered = lit.k1 + lit.k2 * direction.dot(lit.light_direction);
    libm::powf(scattered.max(0.0), lit.m)
}

/// Light of a cloud: equation 6, and that of the sky.
pub fn light(lit: &LitUniforms, through: f32, falls: f32, shade: f32) -> Vec3 {
    let [least, more] = AMBIENT;
    lit.light * ((through + falls) * shade) + lit.ambient * (least + more * shade)
}

/// How a finer read of the pack's texture roughens the layers of an iteration.
#[derive(Clone, Copy, Debug, Default)]
struct Grain {
    /// How much denser it is than most.
    denser: f32,
    /// What of its normal meets the sun.
    across: f32,
}

/// A layer at a place of its dome.
#[derive(Clone, Copy, Debug)]
pub struct Cloud {
    /// What of the light falls on it: equation 3 over L.
    pub falls: f32,
    /// Its opacity.
    pub opacity: f32,
    /// What the layer's cloud leaves of the light.
    pub shade: f32,
}

/// Every layer from the lowest to the highest, each at its place of the dome's plane and with its level of detail. The
/// lowest of an iteration has the grain of all three.
pub fn clouds(inputs: &Inputs, place: impl Fn(usize) -> (Vec2, f32)) -> Vec<Cloud> {
    let mut grain = Grain::default();
    let mut clouds = Vec::new();
    for index in 0..count(&inputs.uniforms.lit) {
        let (plane, level) = place(index);
        if index % LAYERS_AN_ITERATION == 0 {
            grain = grain_at(inputs, index, plane, level);
        }
        clouds.push(cloud(inputs, index, plane, level, grain));
    }
    clouds
}

/// The places of the plane whose shade is blurred to that of the first: on the straight line to where sun or moon is seen.
pub fn places(lit: &LitUniforms, index: usize, plane: Vec2) -> [Vec2; 3] {
    let way = (lit.light_position - plane).clamp_length_max(LONGEST_WAY);
    [0.0, 1.0, 2.0].map(|step| plane + way * (step * lit.layers[index].blur_step))
}

/// Where a layer is read.
fn uv(layer: &LitLayerUniforms, plane: Vec2) -> Vec2 {
    layer.east_axis * plane.x + layer.south_axis * plane.y + layer.offset
}

/// The grain of the iteration whose lowest layer this is.
fn grain_at(inputs: &Inputs, lowest: usize, plane: Vec2, level: f32) -> Grain {
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

fn cloud(inputs: &Inputs, index: usize, plane: Vec2, level: f32, grain: Grain) -> Cloud {
    let layer = &inputs.uniforms.lit.layers[index];
    let at = uv(layer, plane).to_array();
    let [falls, _, thin, own] = inputs.map[index].sample(at, level + layer.lod_bias);
    let coarse = (level + layer.lod_bias).max(0.0) + BLUR_LEVEL;
    let shade: f32 = BLUR
        .iter()
        .zip(places(&inputs.uniforms.lit, index, plane))
        .enumerate()
        .map(|(k, (share, place))| match k {
            0 => share * own,
            _ => share * inputs.map[index].sample(uv(layer, place).to_array(), coarse)[3],
        })
        .sum();
    let nudges = &inputs.nudges[index * READS..];
    let (falls, thin) = (falls + nudges[0], thin + nudges[1]);
    let share = layer.grain;
    let opacity = thin + share * grain.denser * thin * (1.0 - thin);
    Cloud {
        falls: (falls + share * grain.across).max(0.0),
        opacity: opacity.clamp(0.0, 1.0) * layer.opacity,
        shade: shade + nudges[2],
    }
}

/// See [`crate::methods::layer`].
pub fn layer(inputs: &Inputs, direction: Vec3, narrowing: f32) -> (Vec3, f32) {
    let (lit, uniforms) = (&inputs.uniforms.lit, &inputs.uniforms.clouds);
    let distance = distance(lit, direction);
    let plane = Vec2::new(direction.x, direction.z) * distance;
    let level = level(distance, direction, narrowing);
    let through = through(lit, direction);
    let clouds = clouds(inputs, |_| (plane, level));
    let open: f32 = clouds.iter().map(|cloud| 1.0 - cloud.opacity).product();
    let mut lit = *lit;
    let full = lit.light;
    lit.light *= clouds::facing(inputs.uniforms, direction, 1.0 - open);
    // The sides take the structure of the light of the sky.
    let away = 0.5 - 0.5 * direction.dot(lit.light_direction);
    lit.ambient += full * (SIDES * uniforms.low_sun * away);
    // From the lowest to the highest: each shows through those below it, and is shaded by those above it.
    let (mut radiance, mut clear) = (Vec3::ZERO, 1.0);
    for (index, cloud) in clouds.iter().enumerate() {
        let above = clouds[index + 1..].iter();
        let left: f32 = above.map(|c| 1.0 - SHADED_BY_LAYER * c.opacity).product();
        let light = light(&lit, through, cloud.falls, cloud.shade * left);
        radiance += light * (clear * cloud.opacity);
        clear *= 1.0 - cloud.opacity;
    }
    let alpha = 1.0 - clear;
    let tint = clouds::tint(uniforms, inputs.clouds, direction);
    let tint = Vec3::ONE.lerp(uniforms.tint, tint);
    (
        radiance * tint / alpha.max(1e-4),
        alpha * clouds::clearness(uniforms, direction),
    )
}

#[cfg(test)]
mod tests {
    use std::f32::consts::TAU;

    use welkin_runtime::internals::pack_data::PackData;
    use welkin_runtime::{Camera, Method, SkyParams};

    use super::*;
    use crate::texture::smoothstep;
    use crate::{lit_map, pack};

    /// An overcast's horizon is the twin's cloud where every channel has its mean, averaged around the horizon.
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
            let lit = &uniforms.lit;
            let [falls, _, _, shade] = lit_map::texel(lit, &lit.layers[0], [0.5; 4]);
            // Layers above shade it, each by its mean opacity.
            let above = &lit.layers[1..count(lit)];
            let opacity = |layer: &LitLayerUniforms| {
                let amounts = (0..4096).map(|i| (i as f32 + 0.5) / 4096.0 - layer.threshold);
                let opacities = amounts.map(|a| smoothstep(0.0, 1.0, layer.steepness * a.max(0.0)));
                layer.opacity * opacities.sum::<f32>() / 4096.0
            };
            let left = above
                .iter()
                .map(|layer| 1.0 - SHADED_BY_LAYER * opacity(layer));
            let shade = shade * left.product::<f32>();
            let steps = 360;
            let mean = (0..steps)
                .map(|i| {
                    let (south, east) = (TAU * i as f32 / steps as f32).sin_cos();
                    let through = through(lit, Vec3::new(east, 0.0, south));
                    light(lit, through, falls, shade) / steps as f32
                })
                .sum::<Vec3>();
            let found = uniforms.sky.overcast;
            // The runtime takes few azimuths, which is exact up to the sixteenth power of a cosine.
            let apart = (found - mean).abs();
            assert!(
                apart.cmple(mean * 1e-3).all(),
                "{time} {density}: {found}, {mean}"
            );
            assert_eq!(uniforms.sky.overcast_weight, 1.0);
        }
    }
}
