//! A heap: storeys of boxes on each other, narrower towards a rounded top.

use std::f32::consts::TAU;

use super::look::Look;
use crate::settings::BoxSettings;
use crate::stream::Stream;

/// A heap that bulges from a cloud.
struct Heap {
    /// Middle of its foot.
    at_m: [f32; 2],
    /// Height of its foot and of its top above the sea, as they are to be seen.
    foot_m: f32,
    top_m: f32,
    /// Its width below.
    width_m: f32,
    storeys: u32,
    /// The clump of its lowest storey; each has one.
    group: u32,
}

impl Heap {
    /// Adds its boxes. Sprites reach beyond a box, so it is that much smaller than what is to be seen.
    fn add(&self, look: Look, fill: f32, stream: &mut Stream, boxes: &mut Vec<BoxSettings>) {
        let inset = 0.3 * look.height_m[1];
        let height = (self.top_m - inset - self.foot_m).max(20.0);
        let storey = height / self.storeys as f32;
        let [mut x, mut z] = self.at_m;
        for i in 0..self.storeys {
            let middle = (i as f32 + 0.5) / self.storeys as f32;
            // The outline of an ellipse that stands on its wide part, with bulges.
            let round = libm::sqrtf(1.0 - 0.7 * middle * middle);
            let width = self.width_m * round * stream.between([0.88, 1.12]);
            let side = (width - inset).max(0.5 * width);
            let depth = side * stream.between([0.85, 1.15]);
            let y = self.foot_m + storey * (i as f32 + 0.5);
            let group = self.group + i;
            // Storeys overlap a little, so that no seam is seen between them; the last ends at the top.
            let overlap = if i + 1 < self.storeys {
                0.2 * storey
            } else {
                0.0
            };
            let centre = [x, y + 0.5 * overlap, z];
            let size = [side, storey + overlap, depth];
            boxes.push(look.in_box(centre, size, group).filled(fill));
            x += stream.between([-0.06, 0.06]) * width;
            z += stream.between([-0.06, 0.06]) * width;
        }
    }
}

/// Heaps on a cloud's foot: one in the middle, the others around it. Shares are of the cloud's size.
pub(super) struct Heaps {
    pub base_m: f32,
    /// Width, height and depth of the cloud.
    pub size_m: [f32; 3],
    pub count: u32,
    /// How far out the one in the middle is, and its height.
    pub middle: [f32; 2],
    /// How far out the others are, and their heights.
    pub out: [f32; 2],
    pub share: [f32; 2],
    /// How high they begin.
    pub foot: f32,
    /// Width of a heap by its number.
    pub width: fn(u32, &mut Stream) -> f32,
    /// Storeys of a heap by its number and its height in metres.
    pub storeys: fn(u32, f32) -> u32,
}

impl Heaps {
    /// Adds their boxes and gives the next free clump.
    pub fn add(
        &self,
        look: Look,
        fill: f32,
        stream: &mut Stream,
        boxes: &mut Vec<BoxSettings>,
    ) -> u32 {
        let [width, height, depth] = self.size_m;
        let first = stream.between([0.0, 1.0]);
        let mut group = 1;
        for i in 0..self.count {
            let pick = |middle: f32, others, stream: &mut Stream| match i {
                0 => middle,
                _ => stream.between(others),
            };
            let out = pick(self.middle[0], self.out, stream);
            let turn = i as f32 / (self.count - 1) as f32 + stream.between([-0.08, 0.08]);
            let angle = TAU * (first + turn);
            let share = pick(self.middle[1], self.share, stream);
            let heap = Heap {
                at_m: [
                    out * width * libm::cosf(angle),
                    out * depth * libm::sinf(angle),
                ],
                foot_m: self.base_m + self.foot * height,
                top_m: self.base_m + share * height,
                width_m: width * (self.width)(i, stream),
                storeys: (self.storeys)(i, share * height),
                group,
            };
            heap.add(look, fill, stream, boxes);
            group += heap.storeys;
        }
        group
    }
}

/// A flat-bottomed foot of a cloud, an ellipse of two crossed boxes.
pub(super) fn foot(
    base_m: f32,
    [width, height, depth]: [f32; 3],
    look: Look,
    fill: f32,
    boxes: &mut Vec<BoxSettings>,
) {
    let inset = 0.3 * look.width_m[1];
    let centre = [0.0, base_m + 0.5 * height, 0.0];
    for [long, short] in [[width, 0.6 * depth], [0.62 * width, depth]] {
        let sides = [long, short].map(|side| (side - inset).max(0.5 * side));
        let size = [sides[0], height, sides[1]];
        let of_foot = look.in_box(centre, size, 0);
        boxes.push(of_foot.filled(fill).with_flat_bottom());
    }
}
