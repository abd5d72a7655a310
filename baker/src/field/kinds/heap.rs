//! A heap: storeys of boxes on each other, narrower towards a rounded top.

use super::look::Look;
use crate::settings::BoxSettings;
use crate::stream::Stream;

/// A heap that bulges from a cloud.
pub(super) struct Heap {
    /// Middle of its foot.
    pub at_m: [f32; 2],
    /// Height of its foot and of its top above the sea, as they are to be seen.
    pub foot_m: f32,
    pub top_m: f32,
    /// Its width below.
    pub width_m: f32,
    pub storeys: u32,
    /// The clump of its lowest storey; each has one.
    pub group: u32,
}

impl Heap {
    /// Clumps that it has.
    pub fn groups(&self) -> u32 {
        self.storeys
    }

    /// Adds its boxes. Sprites reach beyond a box, so it is that much smaller than what is to be seen.
    pub fn add(&self, look: Look, fill: f32, stream: &mut Stream, boxes: &mut Vec<BoxSettings>) {
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
