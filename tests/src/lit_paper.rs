//! Twin of lit/paper.wgsl: the paper's equations, one function each.

use glam::{Vec2, Vec3};
use welkin_runtime::internals::clouds::lit::LitUniforms;
use welkin_runtime::internals::clouds::lit::paper::{AMBIENT, BLUR, BLUR_LEVEL, LONGEST_WAY};
use welkin_runtime::params::LAYERS_AN_ITERATION;

use crate::clouds::Inputs;
use crate::lit::{Grain, READS, composed, count, grain_at, left, met, roughened, uv};

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

/// A layer at a place of its dome, by the paper's shading.
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
    Cloud {
        falls: (falls + layer.grain * grain.across).max(0.0),
        opacity: roughened(layer, thin, grain),
        shade: shade + nudges[2],
    }
}

/// See [`crate::methods::layer`].
pub fn layer(inputs: &Inputs, direction: Vec3, narrowing: f32) -> (Vec3, f32) {
    let lit = &inputs.uniforms.lit;
    let (plane, level) = met(lit, direction, narrowing);
    let through = through(lit, direction);
    let clouds = clouds(inputs, |_| (plane, level));
    let light = |(index, cloud): (usize, &Cloud)| {
        let above = clouds[index + 1..].iter().map(|above| left(above.opacity));
        let shade = cloud.shade * above.product::<f32>();
        (light(lit, through, cloud.falls, shade), cloud.opacity)
    };
    composed(inputs, direction, clouds.iter().enumerate().map(light))
}

#[cfg(test)]
mod tests {
    use std::f32::consts::TAU;

    use welkin_runtime::internals::clouds::lit::LitLayerUniforms;
    use welkin_runtime::internals::pack_data::PackData;
    use welkin_runtime::params::Shading;
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
                shading: Shading::Paper,
                cover: 1.0,
                density,
                time,
                ..Default::default()
            };
            let uniforms = facts.uniforms(&params, &camera, 0.0, 0.0);
            let lit = &uniforms.lit;
            let [falls, _, _, shade] = lit_map::texel(lit, &lit.layers[0], [0.5; 4], 0.5);
            // Layers above shade it, each by its mean opacity.
            let above = &lit.layers[1..count(lit)];
            let opacity = |layer: &LitLayerUniforms| {
                let amounts = (0..4096).map(|i| (i as f32 + 0.5) / 4096.0 - layer.threshold);
                let opacities = amounts.map(|a| smoothstep(0.0, 1.0, layer.steepness * a.max(0.0)));
                layer.opacity * opacities.sum::<f32>() / 4096.0
            };
            let shaded = above.iter().map(|layer| left(opacity(layer)));
            let shade = shade * shaded.product::<f32>();
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
