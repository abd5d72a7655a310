//! The light of a cube map in squares of squares of texels, and its mean under a lobe of GGX.
//!
//! # Theory
//! J. Barnes, P. Hut, "A Hierarchical O(N log N) Force-Calculation Algorithm", Nature 324, 1986: what is far from where it is looked at from, for its size, counts as
//! one mass in its centre. Here a part of the sky is far if the lobe changes little over it.
//!
//! # Changes
//! The weight depends on `μ = n·l` alone, so the mean weight over a part is, up to the third order, the weight at the mean of μ and half its second
//! derivative times the variance of μ. The mean of μ is `n·c`, with c the mean of the part's directions, each weighted by its light; the variance of
//! directions is `1 - |c|²`, of which half goes each way along the sphere. So a sun alone in its part is where it is, whatever the size of the part.

use glam::Vec3;
use rayon::prelude::*;
use welkin_runtime::internals::geometry::math::LUMINANCE;

use super::super::cube::{texel_direction, texel_solid_angle};
use super::super::cubemap::Cubemap;

/// How wide a part may be, from its centre to its furthest corner, by the width of the lobe where it is, `sqrt(4α² + |n - l|²)`.
///
/// Its side h is then at most 0.21 of that width s. What the variance leaves out is of the fourth order, `h⁴ / s⁴` = 0.2 %; and that parts
/// are no squares seen from their side: a third or so of `h² / s²` = 1.5 %, one way on one side of the lobe and the other way on the next.
const REACH: f32 = 0.15;

/// Texels a side of the coarsest parts: no wider than [`REACH`] where the lobe is widest.
const COARSEST: u32 = 8;

/// A square of texels.
#[derive(Clone, Copy, Debug, Default)]
struct Part {
    /// Radiance times solid angle, summed.
    light: Vec3,
    solid_angle: f32,
    /// The mean of the unit directions by solid angle, and by the luminance of their light. Shorter than 1.
    centre: Vec3,
    lit_centre: Vec3,
    /// From the centre to the furthest corner, or a little more.
    reach: f32,
}

impl Part {
    fn texel(map: &Cubemap, face: usize, at: [u32; 2]) -> Part {
        let direction = texel_direction(face, at, map.side);
        let solid_angle = texel_solid_angle(at, map.side) as f32;
        Part {
            light: Vec3::from_slice(map.faces[face].texel(at[0], at[1])) * solid_angle,
            solid_angle,
            centre: direction,
            lit_centre: direction,
            // Half the diagonal of a square of this area.
            reach: (0.5 * solid_angle).sqrt(),
        }
    }

    fn of(parts: [Part; 4]) -> Part {
        let light = parts.iter().map(|part| part.light).sum::<Vec3>();
        let solid_angle = parts.iter().map(|part| part.solid_angle).sum::<f32>();
        let centre = parts.iter().map(|part| part.centre * part.solid_angle);
        let centre = centre.sum::<Vec3>() / solid_angle;
        let luminance = light.dot(LUMINANCE);
        let lit_centre = parts.iter().map(|p| p.lit_centre * p.light.dot(LUMINANCE));
        let lit_centre = lit_centre.sum::<Vec3>() / luminance;
        let reach = parts.iter().map(|p| p.centre.distance(centre) + p.reach);
        Part {
            light,
            solid_angle,
            centre,
            // Where there is no light, it is nowhere.
            lit_centre: if luminance > 0.0 { lit_centre } else { centre },
            reach: reach.fold(0.0, f32::max),
        }
    }
}

/// The distribution of a roughness.
#[derive(Clone, Copy, Debug)]
pub struct Lobe {
    /// α².
    square: f32,
    /// (1 - α²) / 2.
    slope: f32,
}

impl Lobe {
    /// Of a perceptual roughness, above 0.
    pub fn new(roughness: f32) -> Lobe {
        let square = roughness.powi(4);
        Lobe {
            square,
            slope: 0.5 * (1.0 - square),
        }
    }

    /// The mean weight over a part whose directions have the mean `centre`, seen from `normal`.
    fn weight(&self, normal: Vec3, centre: Vec3) -> f32 {
        let cosine = normal.dot(centre);
        if cosine <= 0.0 {
            return 0.0;
        }
        let variance = 0.5 * (1.0 - centre.length_squared()) * (1.0 - cosine * cosine).max(0.0);
        // The weight is μ / A² with A = α² + slope (1 - μ), half its second derivative (2 + 3 μ q) q / A² with q = slope / A.
        let inverse = 1.0 / (self.square + self.slope * (1.0 - cosine).max(0.0));
        let q = self.slope * inverse;
        inverse * inverse * (cosine + variance.max(0.0) * q * (2.0 + 3.0 * cosine * q))
    }
}

/// Squares of texels, in levels from 2x2 texels up.
#[derive(Debug)]
pub struct Tree {
    levels: Vec<Vec<Part>>,
    sides: Vec<u32>,
}

impl Tree {
    pub fn of(map: &Cubemap) -> Tree {
        let side = map.side / 2;
        let mut levels = vec![quarter(side, |face, at| Part::texel(map, face, at))];
        let mut sides = vec![side];
        while let (Some(finer), Some(&side)) = (levels.last(), sides.last())
            && side > COARSEST
        {
            let coarser = quarter(side / 2, |face, at| finer[index(face, at, side)]);
            levels.push(coarser);
            sides.push(side / 2);
        }
        Tree { levels, sides }
    }

    /// The mean radiance under a lobe about a direction.
    pub fn mean(&self, normal: Vec3, lobe: &Lobe) -> Vec3 {
        let coarsest = self.levels.len() - 1;
        let side = self.sides[coarsest];
        let mut sum = Sum::default();
        for face in 0..6 {
            for (x, y) in (0..side).flat_map(|y| (0..side).map(move |x| (x, y))) {
                self.add(&mut sum, coarsest, (face, [x, y]), normal, lobe);
            }
        }
        sum.light / sum.weight
    }

    fn add(
        &self,
        sum: &mut Sum,
        level: usize,
        (face, at): (usize, [u32; 2]),
        normal: Vec3,
        lobe: &Lobe,
    ) {
        let part = &self.levels[level][index(face, at, self.sides[level])];
        // All of it behind.
        if normal.dot(part.centre) + part.reach <= 0.0 {
            return;
        }
        let width_squared = 4.0 * lobe.square + normal.distance_squared(part.centre);
        if level == 0 || part.reach * part.reach <= REACH * REACH * width_squared.min(1.0) {
            let weight = lobe.weight(normal, part.centre);
            sum.weight += weight * part.solid_angle;
            sum.light += lobe.weight(normal, part.lit_centre) * part.light;
            return;
        }
        for [x, y] in QUARTERS {
            let finer = (face, [2 * at[0] + x, 2 * at[1] + y]);
            self.add(sum, level - 1, finer, normal, lobe);
        }
    }
}

#[derive(Debug, Default)]
struct Sum {
    light: Vec3,
    weight: f32,
}

const QUARTERS: [[u32; 2]; 4] = [[0, 0], [1, 0], [0, 1], [1, 1]];

fn index(face: usize, [x, y]: [u32; 2], side: u32) -> usize {
    (face * side as usize + y as usize) * side as usize + x as usize
}

/// A level of `side` parts a side, of four finer ones each.
fn quarter(side: u32, finer: impl Fn(usize, [u32; 2]) -> Part + Sync) -> Vec<Part> {
    let rows: Vec<(usize, u32)> = (0..6)
        .flat_map(|face| (0..side).map(move |y| (face, y)))
        .collect();
    let row = |&(face, y): &(usize, u32)| {
        let part = |x: u32| Part::of(QUARTERS.map(|[i, j]| finer(face, [2 * x + i, 2 * y + j])));
        (0..side).map(part).collect::<Vec<_>>()
    };
    rows.par_iter().flat_map_iter(row).collect()
}
