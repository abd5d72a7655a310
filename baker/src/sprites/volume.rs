//! Small volumes of noise that repeat: what the sprites are made of. Each is made once and read many times, at several
//! sizes and places.

use noise::Vector3;
use noise::core::perlin::perlin_3d;
use noise::permutationtable::NoiseHasher;
use rayon::prelude::*;

use crate::stream::Stream;

/// Voxels a side.
const SIDE: usize = 64;

/// Cells of the noise a side: one has eight voxels a side, so that what is read between them is smooth.
const CELLS: usize = 8;

/// How much of its cell a point of cellular noise may lie in: with all of it some lumps would nearly coincide.
const JITTER: f32 = 0.9;

/// How far lumps are displaced, in cells, so that the creases between them are curled and not planes.
const CURL: f32 = 0.35;

/// How far from each other the displacements in the three directions are read, in cells.
const APART: f32 = 2.7;

/// A cube of noise that repeats in all directions.
pub(super) struct Volume {
    /// Sheets along z, each row by row.
    sheets: Vec<[f32; SIDE * SIDE]>,
}

impl Volume {
    /// Gradient noise, -1..1: the kernel of the `noise` crate on a lattice that repeats.
    pub(super) fn gradients(stream: &mut Stream) -> Volume {
        let count = CELLS * CELLS * CELLS;
        let lattice = Lattice((0..count).map(|_| (stream.bits() >> 56) as u8).collect());
        Volume::new(|place| {
            let [x, y, z] = place.map(f64::from);
            perlin_3d(Vector3::new(x, y, z), &lattice) as f32
        })
    }

    /// Round lumps with curled creases between them, from 0 in the deepest to 1 on the highest: one less the square of the
    /// distance to the nearest of random points, one in each cell. S. Worley, "A Cellular Texture Basis Function",
    /// SIGGRAPH 1996.
    pub(super) fn lumps(gradients: &Volume, stream: &mut Stream) -> Volume {
        let mut unit = || 0.5 + JITTER * (stream.unit() as f32 - 0.5);
        let points: Vec<[f32; 3]> = (0..CELLS * CELLS * CELLS)
            .map(|_| [unit(), unit(), unit()])
            .collect();
        Volume::new(|place| {
            let displaced = [0, 1, 2].map(|axis| {
                let there = [0, 1, 2].map(|a| place[(axis + a) % 3] + APART * axis as f32);
                place[axis] + CURL * gradients.at(there)
            });
            1.0 - nearest(&points, displaced)
        })
    }

    /// A value for each voxel's place, in cells.
    fn new(value: impl Fn([f32; 3]) -> f32 + Sync) -> Volume {
        let mut sheets = vec![[0.0; SIDE * SIDE]; SIDE];
        let scale = CELLS as f32 / SIDE as f32;
        sheets.par_iter_mut().enumerate().for_each(|(z, sheet)| {
            for (i, voxel) in sheet.iter_mut().enumerate() {
                *voxel = value([i % SIDE, i / SIDE, z].map(|i| i as f32 * scale));
            }
        });
        Volume { sheets }
    }

    /// The noise at a place, in cells: linear between voxels.
    pub(super) fn at(&self, place: [f32; 3]) -> f32 {
        let place = place.map(|c| c * (SIDE / CELLS) as f32);
        let corner = place.map(floor);
        let [right, up, near] = [0, 1, 2].map(|a| place[a] - corner[a] as f32);
        // A power of two, so numbers below 0 wrap as they should.
        let [x, y, z] = corner.map(|i| [i, i + 1].map(|i| i as usize % SIDE));
        let sheet = |z: usize| {
            let voxels = &self.sheets[z];
            let row = |y: usize| mix(voxels[y * SIDE + x[0]], voxels[y * SIDE + x[1]], right);
            mix(row(y[0]), row(y[1]), up)
        };
        mix(sheet(z[0]), sheet(z[1]), near)
    }

    /// A sum of `octaves`, each twice as fine as the one before and weaker by `gain`.
    pub(super) fn sum(&self, place: [f32; 3], octaves: u32, gain: f32) -> f32 {
        let (mut sum, mut amplitude, mut scale) = (0.0, 1.0, 1.0);
        for octave in 0..octaves {
            // Apart, so that the octaves' lattices do not lie on each other about the origin.
            sum += amplitude * self.at(place.map(|c| c * scale + APART * octave as f32));
            amplitude *= gain;
            scale *= 2.0;
        }
        sum
    }
}

/// Square of the distance to the nearest point, in cells, 1 at most.
fn nearest(points: &[[f32; 3]], place: [f32; 3]) -> f32 {
    let cell = place.map(floor);
    let mut least = 1.0_f32;
    for step in (0..27).map(|i| [i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1]) {
        let there = [0, 1, 2].map(|a| cell[a] + step[a]);
        let [i, j, k] = there.map(|i| i as usize % CELLS);
        let point = points[(k * CELLS + j) * CELLS + i];
        let [x, y, z] = [0, 1, 2].map(|a| there[a] as f32 + point[a] - place[a]);
        least = least.min(x * x + y * y + z * z);
    }
    least
}

/// The next lower whole number, for what fits into one.
fn floor(value: f32) -> i32 {
    let whole = value as i32;
    whole - i32::from(value < whole as f32)
}

fn mix(a: f32, b: f32, share: f32) -> f32 {
    a + (b - a) * share
}

/// Random gradients at lattice points that repeat.
struct Lattice(Vec<u8>);

impl NoiseHasher for Lattice {
    fn hash(&self, point: &[isize]) -> usize {
        let [i, j, k] = [0, 1, 2].map(|a| point[a] as usize % CELLS);
        usize::from(self.0[(k * CELLS + j) * CELLS + i])
    }
}

/// The noise that all sprites are cut from.
pub(super) struct Volumes {
    pub gradients: Volume,
    pub lumps: Volume,
}

/// A random place in a volume, in cells.
pub(super) fn place_of(stream: &mut Stream) -> [f32; 3] {
    [(); 3].map(|()| stream.between([0.0, CELLS as f32]))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn volumes() -> [Volume; 2] {
        let gradients = Volume::gradients(&mut Stream::new(1, "test"));
        let lumps = Volume::lumps(&gradients, &mut Stream::new(2, "test"));
        [gradients, lumps]
    }

    fn places(count: usize) -> Vec<[f32; 3]> {
        let mut stream = Stream::new(3, "test");
        let mut place = || [(); 3].map(|()| 20.0 * stream.unit() as f32 - 10.0);
        (0..count).map(|_| place()).collect()
    }

    #[test]
    fn volumes_repeat() {
        for volume in volumes() {
            for place in places(500) {
                let away = [place[0] + 8.0, place[1] - 16.0, place[2] + 24.0];
                // Places have seven digits, and a cell at most a slope of 10.
                assert!(
                    (volume.at(place) - volume.at(away)).abs() < 1e-4,
                    "{place:?}"
                );
            }
        }
    }

    #[test]
    fn volumes_have_no_step_and_fill_their_range() {
        let ranges = [[-1.0, 1.0], [0.0, 1.0]];
        for (volume, [low, high]) in volumes().iter().zip(ranges) {
            let (mut least, mut most) = (high, low);
            for place in places(20_000) {
                let here = volume.at(place);
                (least, most) = (here.min(least), here.max(most));
                let beside = volume.at([place[0], place[1] + 1e-3, place[2]]);
                assert!((here - beside).abs() < 1e-2);
            }
            assert!(least >= low && most <= high);
            assert!(most - least > 0.7 * (high - low), "{least} to {most}");
        }
    }

    #[test]
    fn no_nearer_point_is_missed() {
        let mut stream = Stream::new(4, "test");
        let points: Vec<[f32; 3]> = (0..CELLS * CELLS * CELLS)
            .map(|_| [(); 3].map(|()| stream.unit() as f32))
            .collect();
        for place in places(50) {
            let side = CELLS as f32;
            let inside = place.map(|c| c - side * libm::floorf(c / side));
            let squares = points.iter().enumerate().map(|(index, point)| {
                let cell = [index % CELLS, index / CELLS % CELLS, index / CELLS / CELLS];
                let away = [0, 1, 2].map(|a| {
                    let d = (cell[a] as f32 + point[a] - inside[a]).abs();
                    d.min(side - d)
                });
                away.iter().map(|d| d * d).sum::<f32>()
            });
            let least = squares.fold(1.0, f32::min);
            assert!((nearest(&points, place) - least).abs() < 1e-4);
        }
    }
}
