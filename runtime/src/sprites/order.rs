//! The order in which the sprites of a block are drawn: the farthest first.
//!
//! # Theory
//! Wang: sprites are blended back to front, by their distance to the camera.
//!
//! # Practice
//! Sorted on the CPU, and only when the viewer has moved enough to matter: the place that distances are measured from is
//! the viewer's on a lattice whose step is a hundredth of the way to the block. So the order is a function of the place alone, and a
//! still viewer sorts nothing. Nothing is allocated after the first frame.

use glam::{DVec3, Vec3};

use super::instances::Instance;

/// Steps of the lattice over the distance to a block, and the least, in metres.
const STEP: f64 = 0.01;
const LEAST_STEP_M: f64 = 4.0;

/// A place that distances are measured from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Station {
    exponent: i32,
    steps: [i64; 3],
}

impl Station {
    /// The place for a viewer and a block at that distance, in metres.
    pub fn of(viewer_m: DVec3, distance_m: f64) -> Station {
        let exponent = (STEP * distance_m).max(LEAST_STEP_M).log2().floor() as i32;
        let step = f64::from(exponent).exp2();
        let steps = (viewer_m / step).round();
        Station {
            exponent,
            steps: steps.to_array().map(|v| v as i64),
        }
    }

    /// How far a viewer may be from the place, in metres.
    pub fn slack_m(self) -> f32 {
        f64::from(self.exponent).exp2() as f32
    }

    /// The place, in metres.
    pub fn place_m(self) -> DVec3 {
        let step = f64::from(self.exponent).exp2();
        DVec3::from(self.steps.map(|v| v as f64)) * step
    }
}

/// Sorts the sprites of a block; keeps the memory that it needs for it.
#[derive(Debug, Default)]
pub struct Order {
    keys: Vec<u64>,
}

impl Order {
    /// Memory for blocks of that many sprites.
    pub fn with_capacity(most: usize) -> Order {
        Order {
            keys: Vec::with_capacity(most),
        }
    }

    /// Indices of the instances that `shown` lets through, the farthest from `from_m`, a place in their block, first.
    pub fn sorted(
        &mut self,
        instances: &[Instance],
        from_m: Vec3,
        shown: impl Fn(&Instance, f32) -> bool,
    ) -> impl Iterator<Item = u32> + '_ {
        self.keys.clear();
        for (index, instance) in instances.iter().enumerate() {
            let distance = instance.centre_m().distance(from_m);
            if shown(instance, distance) {
                // Bits of a positive float are in its order; turned over, the farthest comes first.
                let key = u64::from(!distance.to_bits()) << 32 | index as u64;
                self.keys.push(key);
            }
        }
        self.keys.sort_unstable();
        self.keys.iter().map(|key| *key as u32)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn at(x: f32) -> Instance {
        Instance {
            centre: [x, 0.0, 0.0, 0.0],
            ..Instance::default()
        }
    }

    #[test]
    fn the_farthest_comes_first_and_the_order_is_that_of_all_distances() {
        let places: Vec<f32> = (0..500).map(|i| (i * 7919 % 4001) as f32).collect();
        let instances: Vec<_> = places.iter().map(|&x| at(x)).collect();
        let mut order = Order::with_capacity(instances.len());
        let from = Vec3::new(1234.0, 10.0, 0.0);
        let sorted: Vec<_> = order.sorted(&instances, from, |_, _| true).collect();
        assert_eq!(sorted.len(), instances.len());
        let distance = |i: u32| instances[i as usize].centre_m().distance(from);
        assert!(sorted.windows(2).all(|w| distance(w[0]) >= distance(w[1])));
        let near = order.sorted(&instances, from, |_, d| d < 100.0).count();
        let expected = places.iter().filter(|x| (**x - 1234.0).hypot(10.0) < 100.0);
        assert_eq!(near, expected.count());
    }

    #[test]
    fn a_station_is_near_the_viewer_and_stays_while_the_viewer_does() {
        for distance in [0.0, 900.0, 12_000.0] {
            let viewer = DVec3::new(1003.3, 77.7, -500_007.0);
            let station = Station::of(viewer, distance);
            let off = (station.place_m() - viewer).abs().max_element();
            assert!(off <= 0.5 * (STEP * distance).max(LEAST_STEP_M), "{off}");
            assert_eq!(station, Station::of(viewer + DVec3::splat(1e-6), distance));
        }
    }
}
