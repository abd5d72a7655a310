//! Twin of clouds/lit/shadow.wgsl, clouds/shadow.wgsl and clouds/cloud_shadow.wgsl.

use glam::Vec2;
use welkin_runtime::internals::clouds::shadow::SIDE;
use welkin_runtime::params::Shading;

use crate::clouds::{self, Inputs};
use crate::texture::{Texture, smoothstep};
use crate::{lit, lit_paper};

/// The share of direct light that comes through to the middle of each texel, row by row from the north.
pub fn render(inputs: &Inputs) -> Vec<f32> {
    let centres =
        (0..SIDE).flat_map(|y| (0..SIDE).map(move |x| Vec2::new(x as f32 + 0.5, y as f32 + 0.5)));
    centres.map(|texel| through(inputs, texel)).collect()
}

/// The same of one place, in texels from the north-western corner.
pub fn through(inputs: &Inputs, texel: Vec2) -> f32 {
    let uniforms = inputs.uniforms;
    let place = |index: usize| {
        let seen = uniforms.shadow.layers[index];
        (seen.corner + seen.texel * texel, seen.lod)
    };
    let open: f32 = match inputs.shading {
        Shading::Scattered => {
            let seen = lit::seen(inputs, uniforms.lit.light_direction, place);
            seen.iter().map(|cloud| 1.0 - cloud.opacity).product()
        }
        Shading::Paper => {
            let clouds = lit_paper::clouds(inputs, place);
            clouds.iter().map(|cloud| 1.0 - cloud.opacity).product()
        }
    };
    let covered = 1.0 - open;
    1.0 - covered * clouds::clearness(&uniforms.clouds, uniforms.lit.light_direction)
}

/// What an application's shader finds at a place on the ground, in metres east and south of the world's origin.
pub fn cloud_shadow(map: &Texture, area: [f32; 4], position_m: Vec2) -> f32 {
    let [east, south, extent_m, edge_m] = area;
    let from_middle = position_m - Vec2::new(east, south);
    let inside = 0.5 * extent_m - from_middle.abs().max_element();
    if inside <= 0.0 {
        return 1.0;
    }
    let [clear, ..] = map.sample((from_middle / extent_m + 0.5).to_array(), 0.0);
    1.0 + (clear - 1.0) * smoothstep(0.0, edge_m, inside)
}
