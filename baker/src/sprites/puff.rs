//! Puffs: balls that have grown together, covered with knobs that have knobs.

use std::f32::consts::TAU;

use super::march::{Body, Medium};
use super::{REACH, Volumes, between, place_of};
use crate::filter;
use crate::settings::SpriteShape;
use crate::stream::Stream;

/// Radii of the ball in the middle and of those around it.
const MIDDLE: [f32; 2] = [0.50, 0.58];
const AROUND: [f32; 2] = [0.28, 0.42];

/// How many are around it.
const COUNT: u32 = 8;

/// Knobs on knobs: size of a cell, height, and how much more than its depth a crease is hidden from the light.
const KNOBS: [[f32; 3]; 4] = [
    [0.34, 0.15, 1.0],
    [0.17, 0.08, 1.5],
    [0.085, 0.04, 2.0],
    [0.045, 0.02, 2.0],
];

/// Of these the shadows are.
const SHADOW_KNOBS: usize = 2;

/// Depth at which the puff has its full density.
const EDGE: f32 = 0.10;

/// Optical depth a unit of length there.
const EXTINCTION: f32 = 26.0;

/// How fast the light from everywhere falls off with the depth of a crease.
const HIDING: f32 = 5.0;

/// Where the flat bottom is, how far it fades up and down from there, and how uneven it is.
const FLOOR: f32 = -0.2;
const FLOOR_FADE: f32 = 0.08;
const FLOOR_UNEVEN: f32 = 0.03;

pub(super) struct Puff<'a> {
    volumes: &'a Volumes,
    balls: Vec<Ball>,
    /// Where in the volumes of noise it lies, in cells.
    origin: [f32; 3],
    knobs: [[f32; 3]; 4],
    edge: f32,
    is_flat: bool,
}

struct Ball {
    centre: [f32; 3],
    radius: f32,
}

impl<'a> Puff<'a> {
    pub(super) fn new(
        volumes: &'a Volumes,
        shape: &SpriteShape,
        is_flat: bool,
        stream: &mut Stream,
    ) -> Puff<'a> {
        let origin = place_of(stream);
        let mut balls = vec![Ball {
            centre: [0.0; 3],
            radius: between(MIDDLE, stream),
        }];
        let first = between([0.0, 1.0], stream);
        for i in 0..COUNT {
            let turn = (i as f32 + between([-0.35, 0.35], stream)) / COUNT as f32;
            balls.push(Ball::around(TAU * (first + turn), stream));
        }
        if is_flat {
            for ball in &mut balls {
                ball.centre[1] = ball.centre[1].max(FLOOR);
            }
        }
        let mut knobs = KNOBS;
        for [_, height, _] in &mut knobs[1..] {
            *height *= shape.detail;
        }
        Puff {
            volumes,
            balls,
            origin,
            knobs,
            edge: EDGE * shape.softness,
            is_flat,
        }
    }

    /// Depth below the balls' surface.
    fn depth(&self, place: [f32; 3]) -> f32 {
        let depths = self.balls.iter().map(|ball| {
            let [x, y, z] = [0, 1, 2].map(|a| place[a] - ball.centre[a]);
            ball.radius - libm::sqrtf(x * x + y * y + z * z)
        });
        depths.fold(f32::MIN, f32::max)
    }

    /// Depth below the first so many knobs, and how far the place lies in their creases. Where the depth is below 0 there
    /// is nothing, and the finer knobs are not asked.
    fn below(&self, place: [f32; 3], knobs: usize) -> [f32; 2] {
        let (mut depth, mut crease) = (self.depth(place), 0.0);
        for [cell, height, hidden] in &self.knobs[..knobs] {
            if depth <= 0.0 {
                break;
            }
            let there = [0, 1, 2].map(|a| place[a] / cell + self.origin[a] * (1.0 + cell));
            let missing = height * (1.0 - self.volumes.lumps.at(there));
            depth -= missing;
            crease += hidden * missing;
        }
        [depth, crease]
    }

    fn extinction(&self, depth: f32, place: [f32; 3]) -> f32 {
        let density = (depth / self.edge).clamp(0.0, 1.0);
        if !self.is_flat {
            return EXTINCTION * density;
        }
        let rough = self.volumes.gradients.at(place.map(|c| c / 0.2));
        let height = place[1] + FLOOR_UNEVEN * rough - FLOOR;
        EXTINCTION * density * filter::smoothstep(-FLOOR_FADE, FLOOR_FADE, height)
    }
}

impl Ball {
    /// A ball beside the middle, at an angle.
    fn around(angle: f32, stream: &mut Stream) -> Ball {
        let radius = between(AROUND, stream);
        let far = (REACH - radius) * between([0.82, 1.0], stream);
        let near = between([-0.1, 0.35], stream);
        Ball {
            centre: [far * libm::cosf(angle), far * libm::sinf(angle), near],
            radius,
        }
    }
}

impl Body for Puff<'_> {
    const STEP: f32 = 0.025;

    fn medium(&self, place: [f32; 3]) -> Medium {
        let [depth, crease] = self.below(place, self.knobs.len());
        if depth <= 0.0 {
            // The knobs are steeper than the balls, so only half of the way is surely free.
            return Medium::Clear(-0.5 * depth);
        }
        Medium::Cloud {
            extinction: self.extinction(depth, place),
            openness: libm::expf(-HIDING * crease),
        }
    }

    fn shadow(&self, place: [f32; 3]) -> f32 {
        let [depth, _] = self.below(place, SHADOW_KNOBS);
        self.extinction(depth, place)
    }
}
