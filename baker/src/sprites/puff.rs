//! Puffs: balls that have grown together, covered with knobs that have knobs.

use std::f32::consts::TAU;

use super::march::{Body, Medium, REACH};
use super::volume::{Volumes, place_of};
use crate::filter;
use crate::settings::SpriteShape;
use crate::stream::Stream;

/// Radii of the ball in the middle of a puff and of those around it, and how many these are.
const MIDDLE: [f32; 2] = [0.50, 0.58];
const AROUND: [f32; 2] = [0.28, 0.42];
const COUNT: u32 = 8;

/// Balls side by side on a flat bottom: where from left to right, how high above it, and their radii.
const BASE: [f32; 4] = [-0.38, -0.14, 0.14, 0.38];
const BASE_HEIGHT: f32 = 0.06;
const BASE_RADII: [f32; 2] = [0.40, 0.46];

/// How high above it the one in the middle is.
const HEART_HEIGHT: f32 = 0.28;

/// How many are around these.
const UPPER_COUNT: u32 = 6;

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
const EDGE: f32 = 0.2;

/// Optical depth a unit of length there.
const EXTINCTION: f32 = 20.0;

/// How fast the light from everywhere falls off with the depth of a crease.
const HIDING: f32 = 5.0;

/// Where the flat bottom is, how far it fades up and down from there, how uneven it is, and how large the unevenness.
pub(crate) const FLOOR: f32 = -0.2;
const FLOOR_FADE: f32 = 0.2;
const FLOOR_UNEVEN: f32 = 0.08;
const FLOOR_CELL: f32 = 0.2;

pub(super) struct Puff<'a> {
    volumes: &'a Volumes,
    balls: Vec<Ball>,
    knobs: [Knobs; 4],
    edge: f32,
    is_flat: bool,
}

/// Knobs of one size.
#[derive(Clone, Copy)]
struct Knobs {
    /// Cells a unit of length.
    cells: f32,
    height: f32,
    hidden: f32,
    /// Where in the volume of noise they lie, in cells.
    origin: [f32; 3],
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
        let balls = if is_flat {
            heap(stream)
        } else {
            cluster(stream)
        };
        let mut knobs = KNOBS.map(|[cell, height, hidden]| Knobs {
            cells: 1.0 / cell,
            height,
            hidden,
            origin: place_of(stream),
        });
        for finer in &mut knobs[1..] {
            finer.height *= shape.detail;
        }
        Puff {
            volumes,
            balls,
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
        for knobs in &self.knobs[..knobs] {
            if depth <= 0.0 {
                break;
            }
            let there = [0, 1, 2].map(|a| knobs.cells * place[a] + knobs.origin[a]);
            let missing = knobs.height * (1.0 - self.volumes.lumps.at(there));
            depth -= missing;
            crease += knobs.hidden * missing;
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
    /// A ball that ends within [`REACH`].
    fn new([x, y, z]: [f32; 3], radius: f32) -> Ball {
        let radius = radius.min(REACH - libm::sqrtf(x * x + y * y));
        Ball {
            centre: [x, y, z],
            radius,
            scale: 0.5 / radius,
        }
    }

    /// A ball at the side of a puff; `turn` is 0 to the right, 0.25 above.
    fn around(turn: f32, stream: &mut Stream) -> Ball {
        let radius = stream.between(AROUND);
        let far = (REACH - radius) * stream.between([0.82, 1.0]);
        let [x, y] = [libm::cosf(TAU * turn), libm::sinf(TAU * turn)].map(|c| far * c);
        Ball::new([x, y, stream.between([-0.1, 0.35])], radius)
    }
}

/// A ball with others all around it.
fn cluster(stream: &mut Stream) -> Vec<Ball> {
    let mut balls = vec![Ball::new([0.0; 3], stream.between(MIDDLE))];
    let first = stream.between([0.0, 1.0]);
    for i in 0..COUNT {
        let turn = (i as f32 + stream.between([-0.35, 0.35])) / COUNT as f32;
        balls.push(Ball::around(first + turn, stream));
    }
    balls
}

/// Balls side by side on the floor, and others around and above them.
fn heap(stream: &mut Stream) -> Vec<Ball> {
    let base = BASE.map(|x| {
        let near = stream.between([0.0, 0.2]);
        Ball::new([x, FLOOR + BASE_HEIGHT, near], stream.between(BASE_RADII))
    });
    let mut balls = Vec::from(base);
    balls.push(Ball::new(
        [0.0, FLOOR + HEART_HEIGHT, 0.0],
        stream.between(MIDDLE),
    ));
    for i in 0..UPPER_COUNT {
        let turn = 0.5 * (i as f32 + stream.between([0.15, 0.85])) / UPPER_COUNT as f32;
        balls.push(Ball::around(turn, stream));
    }
    balls
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
        if depth <= 0.0 {
            return 0.0;
        }
        self.extinction(depth, self.above_floor(place))
    }
}
