//! The ring of impostors: far blocks as eight pictures around the viewer.
//!
//! # Theory
//! Wang, "Performance": an octagonal ring of eight pictures of 256x256, 45 degrees each, about the camera. Blocks beyond its radius are
//! drawn into it, those within as sprites. All eight are rebuilt when the camera has moved by 15 % of the radius sideways or 2 % up or
//! down or the sun has moved, one a frame, and old and new are cross-faded. They shift with the camera's height, and are not used when
//! clouds are more than 10,000 feet above or below the camera. Eight pictures of four bytes a texel: 2 MB, 4 MB while they change.
//!
//! # Changes versus the paper
//! - The pictures reach just from the lowest to the highest elevation that the clouds in them can have, so that no row is spent on clear sky.
//! - What is shifted with the viewer is the whole ring, sideways too, by the share that brings clouds at a typical distance to where they
//!   belong.
//! - Old and new are mixed before they are blended, not drawn one over the other: halfway a cloud is as opaque as before.
//! - Pictures are a texel wider than their 45 degrees, so that filtering at a seam sees the neighbour's clouds.
//!
//! # Practice
//! The ring remembers where it was made: with it a frame depends on those before, but for the first one, whose ring is made at once.
//! A frame that draws one picture draws an eighth of the far sprites, at a thirtieth of the pixels of a screen. Where clouds are seen
//! so far that a picture has more than [`BLOCKS_A_FRAME`](super::station::BLOCKS_A_FRAME) blocks, it takes several frames.

use glam::{DVec3, Vec2};

use super::grid::BlockId;
use super::station::{
    BRIGHTEST, COSINE, FADE_FRAMES, HALF_SIDE, PICTURES, RingSet, RingSide, RingUniforms, Station,
    azimuth_rad,
};
use crate::geometry::part::{Part, Value};

/// Its part of the shader.
pub const PART: Part = Part {
    constants: &[
        ("RING_COS", Value::F32(COSINE)),
        ("RING_HALF_SIDE", Value::F32(HALF_SIDE)),
        ("RING_BRIGHTEST", Value::F32(BRIGHTEST)),
    ],
    structs: &[RingSet::WGSL, RingSide::WGSL, RingUniforms::WGSL],
    wgsl: include_str!("ring.wgsl"),
};

/// What the ring is about to do.
#[derive(Clone, Copy, Debug, PartialEq)]
enum State {
    /// Nothing.
    Idle,
    /// Pictures of another one are drawn; so many parts of them are done.
    Building(Station, usize),
    /// From one to another; so many frames have passed.
    Fading(Station, u32),
}

/// What a frame does for the ring.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Step {
    /// Nothing is drawn.
    Keep,
    /// Every picture of the ring in use is drawn at once.
    All,
    /// A part of a picture of the next ring is drawn: picture and part, both 0 for a new ring.
    Part([usize; 2]),
    /// The next ring has taken the place of the one in use.
    Swap,
}

/// What a ring is doing: in use, being rebuilt, or giving way to the next.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ring {
    current: Station,
    state: State,
}

impl Ring {
    /// A ring that is made at once; see [`Step::All`].
    pub fn new(now: Station) -> Ring {
        Ring {
            current: now,
            state: State::Idle,
        }
    }

    /// Goes on by a frame.
    pub fn step(&mut self, now: Station) -> Step {
        if self.current.is_another(&now) {
            *self = Ring::new(now);
            return Step::All;
        }
        match self.state {
            State::Idle if self.current.is_stale(&now) => {
                if now.is_on() {
                    self.state = State::Building(now, 1);
                    Step::Part([0, 0])
                } else {
                    self.state = State::Fading(now, 0);
                    Step::Keep
                }
            }
            State::Idle => Step::Keep,
            State::Building(next, done) if done < PICTURES * next.parts() => {
                self.state = State::Building(next, done + 1);
                Step::Part([done / next.parts(), done % next.parts()])
            }
            State::Building(next, _) => {
                self.state = State::Fading(next, 1);
                Step::Keep
            }
            State::Fading(next, frames) if frames < FADE_FRAMES => {
                self.state = State::Fading(next, frames + 1);
                Step::Keep
            }
            State::Fading(next, _) => {
                self.current = next;
                self.state = State::Idle;
                Step::Swap
            }
        }
    }

    /// The ring in use.
    pub fn current(&self) -> &Station {
        &self.current
    }

    /// The ring that is being drawn or faded to.
    pub fn next(&self) -> Option<&Station> {
        match &self.state {
            State::Idle => None,
            State::Building(next, _) | State::Fading(next, _) => Some(next),
        }
    }

    /// Shares of the ring in use and of the next one.
    pub fn shares(&self) -> [f32; 2] {
        let faded = match self.state {
            State::Fading(_, frames) => frames as f32 / FADE_FRAMES as f32,
            _ => 0.0,
        };
        [1.0 - faded, faded]
    }

    /// The share of a block that is drawn as sprites.
    pub fn share_of_sprites(&self, block: BlockId) -> f32 {
        let [old, new] = self.shares();
        let drawn = |station: &Station, share: f32| if station.holds(block) { 0.0 } else { share };
        drawn(&self.current, old) + self.next().map_or(0.0, |next| drawn(next, new))
    }

    /// The uniforms for a viewer at `now_m`, and whether anything of the ring shows.
    pub fn uniforms(&self, now_m: DVec3) -> (RingUniforms, bool) {
        let [old_share, new_share] = self.shares();
        let used = self.current.set(now_m, old_share);
        let next = self
            .next()
            .filter(|_| new_share > 0.0)
            .map_or(RingSet::default(), |next| next.set(now_m, new_share));
        let (mut bottom, mut top) = (f32::MAX, f32::MIN);
        for set in [used, next].iter().filter(|set| set.weight > 0.0) {
            // A tenth of the radius up or down is more than the ring is ever shifted by.
            bottom = bottom.min(set.top - 1.0 / set.per_height - 0.1);
            top = top.max(set.top + 0.1);
        }
        let side = |side: usize| {
            let (sin, cos) = azimuth_rad(side).sin_cos();
            RingSide {
                normal: Vec2::new(sin, -cos),
                along: Vec2::new(cos, sin),
            }
        };
        let uniforms = RingUniforms {
            used,
            next,
            radius_m: self.current.radius_m as f32,
            bottom,
            top,
            sides: std::array::from_fn(side),
            ..Default::default()
        };
        (uniforms, bottom < top)
    }
}

#[cfg(test)]
mod tests;
