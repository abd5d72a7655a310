//! Levels of a cube map for reflections of rough surfaces.
//!
//! # Theory
//! B. Karis, "Real Shading in Unreal Engine 4", SIGGRAPH 2013: the sum over lights is split into one of radiance, which is these levels, and
//! one of the surface's response. Normal and view are taken to be the direction of reflection, N = V = R, and radiance is weighted with
//! the normal's cosine. With half vectors drawn from the distribution of B. Walter et al., "Microfacet Models for Refraction through Rough Surfaces",
//! EGSR 2007, equation 33 (GGX), the density of a direction l is D(h) / 4 there, so that a level is
//!
//! ```text
//! the integral of L(l) D(h) max(0, n·l) over all l, divided by that of D(h) max(0, n·l);
//! D(h) is proportional to 1 / (α² + (1 - α²) (1 - n·l) / 2)²
//! ```
//!
//! with α the square of the perceptual roughness (B. Burley, "Physically-Based Shading at Disney", SIGGRAPH 2012). At roughness 1, D is
//! constant, and the level is the irradiance divided by π.
//!
//! # Changes
//! Karis draws some hundred samples, and M. Colbert, J. Krivanek, "GPU-Based Importance Sampling", GPU Gems 3, chapter 20, reads each from the level that is as
//! coarse as samples are sparse. A sun, a hundred thousand times as bright as the sky and a texel wide, then shows which samples hit the coarse texel that it is
//! in. Here no samples are drawn: all of the sky is summed (`prefilter/tree.rs`), coarsely where the weight changes slowly, and each part lies where its light does.
//!
//! # Practice
//! Level 0 is the map itself, of roughness 0; level i of n has the perceptual roughness `i / (n - 1)`. The last has [`LAST_SIDE`] texels a side: fewer are
//! no sphere.

mod tree;

use rayon::prelude::*;
use welkin_pack::Image;

use super::cube::texel_direction;
use super::cubemap::Cubemap;
use tree::{Lobe, Tree};

/// Texels a side of the last level, 11 degrees each; the irradiance that it holds is smooth over 60.
pub const LAST_SIDE: u32 = 8;

/// The perceptual roughness of each level of a map of `side` texels a side, a power of two from 16: the first is 0 and the last 1.
pub fn roughness(side: u32) -> Vec<f32> {
    let last = (side / LAST_SIDE).ilog2();
    (0..=last).map(|level| level as f32 / last as f32).collect()
}

/// The levels of a map, one for each of [`roughness`]; the first is the map.
pub fn levels(map: Cubemap) -> Vec<Cubemap> {
    let tree = Tree::of(&map);
    let rough = roughness(map.side).into_iter().enumerate().skip(1);
    let side = map.side;
    let rough = rough.map(|(level, roughness)| filtered(&tree, side >> level, roughness));
    std::iter::once(map).chain(rough).collect()
}

/// A level of one roughness.
fn filtered(tree: &Tree, side: u32, roughness: f32) -> Cubemap {
    let lobe = Lobe::new(roughness);
    let face = |face: usize| {
        let mut image = Image::new(side, side, 3);
        let rows = image.texels.par_chunks_exact_mut(3 * side as usize);
        rows.zip(0..side).for_each(|(row, y)| {
            for (texel, x) in row.chunks_exact_mut(3).zip(0..) {
                let direction = texel_direction(face, [x, y], side);
                texel.copy_from_slice(&tree.mean(direction, &lobe).to_array());
            }
        });
        image
    };
    Cubemap {
        side,
        faces: (0..6).map(face).collect(),
    }
}

#[cfg(test)]
mod tests;
