//! Places for clouds, one after another, each far from those before.

use crate::stream::Stream;

/// Candidates for a place. More would set the clouds out like a lattice, one would leave them clustered.
const CANDIDATES: usize = 10;

/// Places in a square that repeats, so spread that every first few of them are spread evenly.
///
/// D. P. Mitchell, "Spectrally optimal sampling for distribution ray tracing", SIGGRAPH 1991, section 4: of some random
/// candidates the one that is farthest from all places before.
pub(super) struct Spread {
    side_m: f32,
    places: Vec<[f32; 2]>,
}

impl Spread {
    pub fn new(side_m: f32) -> Spread {
        Spread {
            side_m,
            places: Vec::new(),
        }
    }

    /// The next place, one of `free`, which is not empty.
    pub fn next(&mut self, free: &[[f32; 2]], stream: &mut Stream) -> [f32; 2] {
        let mut best = ([0.0; 2], -1.0);
        for _ in 0..CANDIDATES {
            let index = (stream.unit() * free.len() as f64) as usize;
            let place = free[index.min(free.len() - 1)];
            let distance = self.nearest(place);
            if distance > best.1 {
                best = (place, distance);
            }
        }
        self.places.push(best.0);
        best.0
    }

    /// Square of the distance to the nearest place before.
    fn nearest(&self, [x, z]: [f32; 2]) -> f32 {
        let apart = |a: f32, b: f32| {
            let d = (a - b).abs();
            d.min(self.side_m - d)
        };
        let squares = self.places.iter().map(|p| {
            let (dx, dz) = (apart(p[0], x), apart(p[1], z));
            dx * dx + dz * dz
        });
        squares.fold(f32::MAX, f32::min)
    }
}
