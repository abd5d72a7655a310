//! Twin of octaves.wgsl.

use glam::{Vec2, Vec3};
use welkin_runtime::internals::clouds::octaves::OctaveDome;
use welkin_runtime::internals::clouds::octaves::{
    BEND, BODY_HEIGHTS, EDGE, FINER, FINER_START, HIGH_OPACITY, LEAST_LIGHT, MIDDLE_OPACITY,
    ROUGH_DEPTH, ROUGH_GREY, THIN_DEPTH, VEIL_LEVEL,
};
use welkin_runtime::params::Shading;

use crate::clouds::{self, Inputs, light, soften, tinted};
use crate::dome;
use crate::texture::smoothstep;

/// The paper's exponentiation of a thickness, with its foot softened.
pub fn alpha(thickness: f32, exponent: f32) -> f32 {
    soften(1.0 - libm::exp2f(exponent * thickness.max(0.0)), EDGE)
}

/// Where a dome reads the map.
fn uv(dome: &OctaveDome, plane: Vec2) -> Vec2 {
    dome.east_axis * plane.x + dome.south_axis * plane.y + dome.offset
}

/// Where the fibres of the high dome are read.
fn bent(uv: Vec2) -> Vec2 {
    uv + Vec2::new(BEND * clouds::wave(uv.y), 0.0)
}

/// See [`crate::methods::layer`]. Reads: opacity and grey of the low clouds, the finer amount, opacity of the middle clouds,
/// amount of the high ones.
pub fn layer(inputs: &Inputs, direction: Vec3, narrowing: f32) -> (Vec3, f32) {
    let (octaves, uniforms) = (&inputs.uniforms.octaves, &inputs.uniforms.clouds);
    let hit = dome::intersect(direction);
    let level = clouds::level(&hit, narrowing);
    let thin_grey = 0.5 + 0.5 * octaves.edge_grey;
    let map =
        |dome: &OctaveDome| inputs.map_at(uv(dome, hit.plane).to_array(), level + dome.lod_bias);
    // One grey for all domes: that of thin clouds, and where the low dome is opaque, its own.
    let (mut grey, mut clear) = (thin_grey, 1.0);
    let (mut depth, mut body) = (THIN_DEPTH, 0.0);
    if octaves.low.threshold < 1.0 {
        let [_, alpha, _, own] = map(&octaves.low);
        let (alpha, own) = (alpha + inputs.nudges[0], own + inputs.nudges[1]);
        let finer_uv = uv(&octaves.low, hit.plane) * FINER + Vec2::from(FINER_START);
        let finer_level = level + octaves.low.lod_bias + libm::log2f(FINER);
        let [finer, ..] = inputs.map_at(finer_uv.to_array(), finer_level);
        let finer = finer + inputs.nudges[2] - 0.5;
        let rough = octaves.roughness * finer * alpha * (1.0 - alpha);
        let alpha = (alpha + rough).clamp(0.0, 1.0);
        grey += (own + ROUGH_GREY * finer - grey) * alpha;
        clear *= 1.0 - alpha;
        let passed = ROUGH_DEPTH * finer - libm::log2f(own.max(LEAST_LIGHT));
        depth += (octaves.base_depth + passed.max(0.0) - depth) * alpha;
        body = alpha;
    }
    if octaves.middle.threshold < 1.0 {
        let [_, _, alpha, _] = map(&octaves.middle);
        clear *= 1.0 - MIDDLE_OPACITY * (alpha + inputs.nudges[3]);
    }
    if octaves.high.threshold < 1.0 {
        let place = bent(uv(&octaves.high, hit.plane));
        let [amount, ..] =
            inputs.map_at(place.to_array(), level + octaves.high.lod_bias + VEIL_LEVEL);
        let thickness = amount + inputs.nudges[4] - octaves.high.threshold;
        clear *= 1.0 - HIGH_OPACITY * smoothstep(0.0, 1.0, thickness * octaves.high_contrast);
    }
    let tint = clouds::tint(uniforms, inputs.clouds, direction);
    let radiance = match inputs.shading {
        Shading::Scattered => {
            let height = BODY_HEIGHTS[0] + (BODY_HEIGHTS[1] - BODY_HEIGHTS[0]) * body;
            let shares = clouds::scattered(inputs.uniforms, direction, depth, height);
            clouds::lit(uniforms, shares, tint)
        }
        Shading::Paper => light(uniforms, tinted(uniforms, grey.clamp(0.0, 1.0), tint), 1.0),
    };
    (
        radiance,
        (1.0 - clear) * clouds::clearness(uniforms, direction),
    )
}
