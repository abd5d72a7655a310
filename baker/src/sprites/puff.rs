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

/// Where the flat bottom is, how far it fades up and down from there, how uneven it is, and how large the unevenness.
const FLOOR: f32 = -0.2;
const FLOOR_FADE: f32 = 0.08;
const FLOOR_UNEVEN: f32 = 0.03;
const FLOOR_CELL: f32 = 0.2;

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
    /// `1 / 2r`.
    scale: f32,
}

impl<'a> Puff<'a> {
    pub(super) fn new(
        volumes: &'a Volumes,
        shape: &SpriteShape,
        is_flat: bool,
        stream: &mut Stream,
    ) -> Puff<'a> {
        let origin = place_of(stream);
        let mut balls = vec![Ball::new([0.0; 3], between(MIDDLE, stream))];
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

    /// Depth below the balls' surface: near a ball of the radius `r`, `(r^2 - d^2) / 2r` is about `r - d`.
    fn depth(&self, place: [f32; 3]) -> f32 {
        let depths = self.balls.iter().map(|ball| {
            let [x, y, z] = [0, 1, 2].map(|a| place[a] - ball.centre[a]);
            0.5 * ball.radius - ball.scale * (x * x + y * y + z * z)
        });
        depths.fold(f32::MIN, |a, b| if b > a { b } else { a })
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

    /// Share of the density that a flat bottom leaves: none below it.
    fn above_floor(&self, place: [f32; 3]) -> f32 {
        if !self.is_flat {
            return 1.0;
        }
        let rough = self.volumes.gradients.at(place.map(|c| c / FLOOR_CELL));
        let height = place[1] + FLOOR_UNEVEN * rough - FLOOR;
        filter::smoothstep(-FLOOR_FADE, FLOOR_FADE, height)
    }

    fn extinction(&self, depth: f32, above_floor: f32) -> f32 {
        EXTINCTION * (depth / self.edge).clamp(0.0, 1.0) * above_floor
    }
}

impl Ball {
    fn new(centre: [f32; 3], radius: f32) -> Ball {
        Ball {
            centre,
            radius,
            scale: 0.5 / radius,
        }
    }

    /// A ball beside the middle, at an angle.
    fn around(angle: f32, stream: &mut Stream) -> Ball {
        let radius = between(AROUND, stream);
        let far = (REACH - radius) * between([0.82, 1.0], stream);
        let near = between([-0.1, 0.35], stream);
        let [x, y] = [libm::cosf(angle), libm::sinf(angle)].map(|c| far * c);
        Ball::new([x, y, near], radius)
    }
}

impl Body for Puff<'_> {
    const STEP: f32 = 0.025;

    fn span(&self, [x, y]: [f32; 2]) -> [f32; 2] {
        let spans = self.balls.iter().filter_map(|ball| {
            let [u, v] = [x - ball.centre[0], y - ball.centre[1]];
            let square = ball.radius * ball.radius - u * u - v * v;
            let half = (square > 0.0).then(|| libm::sqrtf(square))?;
            Some([ball.centre[2] + half, ball.centre[2] - half])
        });
        spans.fold([-1.0, 1.0], |[front, back], [from, to]| {
            [from.max(front), to.min(back)]
        })
    }

    fn medium(&self, place: [f32; 3]) -> Medium {
        let [depth, crease] = self.below(place, self.knobs.len());
        if depth <= 0.0 {
            return Medium::Clear;
        }
        let above_floor = self.above_floor(place);
        Medium::Cloud {
            extinction: self.extinction(depth, above_floor),
            // The floor is thin and would shine, but no light comes to it from below.
            openness: above_floor * libm::expf(-HIDING * crease),
        }
    }

    fn shadow(&self, place: [f32; 3]) -> f32 {
        let [depth, _] = self.below(place, SHADOW_KNOBS);
        self.extinction(depth, self.above_floor(place))
    }
}
