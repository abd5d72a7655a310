//! Places for clouds, one after another, each over free ground and far from those before.

use super::ground::Ground;
use crate::stream::Stream;

/// Candidates for a place. More would set the clouds out like a lattice, one would leave them clustered.
const CANDIDATES: usize = 12;

/// Places in a square that repeats, so spread that every first few of them are spread evenly.
///
/// D. P. Mitchell, "Spectrally optimal sampling for distribution ray tracing", SIGGRAPH 1991, section 4: of some random
/// candidates the one that is farthest from all places before. Here those candidates come first that have the most
/// free ground around them, so that a sheet is shut with few clouds.
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

    /// The next place, for a cloud that reaches `reach_m` from its middle.
    pub fn next(&mut self, ground: &Ground, reach_m: f32, stream: &mut Stream) -> [f32; 2] {
        let mut best = ([0.0; 2], (0, -1.0));
        for _ in 0..CANDIDATES {
            let place = ground.free_place(stream);
            let worth = (ground.free_around(place, reach_m), self.nearest(place));
            if worth > best.1 {
                best = (place, worth);
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn places_are_farther_from_those_before_than_chance_would_put_them() {
        let ground = Ground::new(2);
        let mut spread = Spread::new(ground.side_m());
        let mut stream = Stream::new(1, "test");
        let mut sum = 0.0;
        let count = 64;
        spread.next(&ground, 500.0, &mut stream);
        for before in 1..=count {
            let known = Spread {
                side_m: spread.side_m,
                places: spread.places.clone(),
            };
            let place = spread.next(&ground, 500.0, &mut stream);
            let spacing = ground.side_m() / libm::sqrtf(before as f32);
            sum += libm::sqrtf(known.nearest(place)) / spacing;
        }
        // The nearest of random places is half the spacing away, give or take 0.26 (P. J. Clark, F. C. Evans, "Distance to
        // Nearest Neighbor", Ecology 35, 1954); four times 0.26 / sqrt(64) more than that.
        let mean = sum / count as f32;
        assert!(mean > 0.63, "{mean}");
    }

    #[test]
    fn free_ground_comes_first() {
        let mut ground = Ground::new(1);
        let sprite = welkin_pack::field::Sprite {
            centre_m: [1000.0, 0.0, 2000.0],
            size_m: [4000.0, 4000.0],
            rotation_rad: 0.0,
            cell: 0,
            cloud_box: 0,
            exposure: welkin_pack::field::Exposure::default(),
        };
        ground.cover_by(&sprite, false);
        let mut spread = Spread::new(ground.side_m());
        let mut stream = Stream::new(1, "test");
        for _ in 0..8 {
            let [x, z] = spread.next(&ground, 100.0, &mut stream);
            let (dx, dz) = (x - 1000.0, z - 2000.0);
            assert!(libm::sqrtf(dx * dx + dz * dz) > 1600.0, "{x} {z}");
        }
    }
}
