//! In the cloud: sprites that the viewer has come near to keep facing as they did.
//!
//! # Theory
//! Wang, "In-Cloud Experience": near the middle of a sprite small steps of the viewer turn it far, so that sprites part like the Red
//! Sea. Its facing is locked once the viewer is within half of its radius; its opacity then follows the angle between that facing and
//! the way to the viewer, and a sprite that was passed through is gone.
//!
//! # Changes versus the paper
//! A lock does not end at half of the radius, where the sprite would jump round, but fades out up to the whole radius
//! (sprites.wgsl). A sprite before the viewer's eyes thins out in the last part of the way, so that passing it is no pop.
//!
//! # Practice
//! The one thing that the sprites themselves remember from frame to frame, beside the ring. At most 256 sprites are locked.

use glam::DVec3;

use super::grid::BlockId;

/// Distance at which facing is locked, in radii.
pub const LOCK: f32 = 0.5;
/// Distance along the way it faces at which a sprite begins to thin out, in radii.
pub const NEAR: f32 = 2.0;
/// The most locks; within half a radius there are no more than some dozen sprites.
const MOST: usize = 256;

/// A locked sprite.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lock {
    /// Its block.
    pub block: BlockId,
    /// Its place in the section's instances.
    pub index: u32,
    /// The way it faces, xyz, and 127, in 127ths.
    pub facing: [i8; 4],
}

/// The locked sprites.
#[derive(Debug)]
pub struct Locks {
    locks: Vec<Lock>,
}

impl Default for Locks {
    /// None yet, and room for the most.
    fn default() -> Locks {
        Locks {
            locks: Vec::with_capacity(MOST),
        }
    }
}

impl Locks {
    /// Forgets them all.
    pub fn clear(&mut self) {
        self.locks.clear();
    }

    /// The lock of a sprite.
    pub fn of(&self, block: BlockId, index: u32) -> Option<&Lock> {
        self.locks
            .iter()
            .find(|lock| (lock.block, lock.index) == (block, index))
    }

    /// Sees where the viewer is from the middle of a sprite, in metres. True if the sprite's lock changed.
    pub fn see(&mut self, block: BlockId, index: u32, to_viewer_m: DVec3, radius_m: f64) -> bool {
        let distance = to_viewer_m.length();
        let held = self
            .locks
            .iter()
            .position(|lock| (lock.block, lock.index) == (block, index));
        match held {
            Some(place) if distance > radius_m => {
                self.locks.swap_remove(place);
                true
            }
            None if distance < f64::from(LOCK) * radius_m && self.locks.len() < MOST => {
                let facing = (to_viewer_m / distance.max(1e-3) * 127.0).round();
                let [x, y, z] = facing.to_array().map(|v| v as i8);
                self.locks.push(Lock {
                    block,
                    index,
                    facing: [x, y, z, 127],
                });
                true
            }
            _ => false,
        }
    }

    /// Drops the locks of blocks that are not `near` any more.
    pub fn keep(&mut self, near: impl Fn(BlockId) -> bool) {
        self.locks.retain(|lock| near(lock.block));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const BLOCK: BlockId = BlockId { east: 0, south: 0 };

    #[test]
    fn a_sprite_is_locked_within_half_its_radius_and_free_beyond_its_radius() {
        let mut locks = Locks::default();
        let mut see = |x: f64| locks.see(BLOCK, 7, DVec3::new(x, 0.0, 0.0), 100.0);
        assert!(!see(60.0), "near, but not within half");
        assert!(see(49.0), "locked");
        assert!(!see(-20.0) && !see(-99.0), "it stays so on the way out");
        assert!(see(-101.0), "free");
        assert!(!see(-60.0));
    }

    #[test]
    fn it_keeps_the_facing_it_had() {
        let mut locks = Locks::default();
        locks.see(BLOCK, 3, DVec3::new(0.0, 0.0, 40.0), 100.0);
        locks.see(BLOCK, 3, DVec3::new(30.0, 0.0, -10.0), 100.0);
        assert_eq!(locks.of(BLOCK, 3).map(|l| l.facing), Some([0, 0, 127, 127]));
        assert_eq!(locks.of(BLOCK, 4), None);
    }

    #[test]
    fn there_are_never_more_than_the_most() {
        let mut locks = Locks::default();
        let locked = (0..2 * MOST as u32).filter(|&i| locks.see(BLOCK, i, DVec3::X, 100.0));
        assert_eq!(locked.count(), MOST);
    }
}
