//! Cumulus: a flat foot, and on it a few heaps, the highest in the middle.

use std::f32::consts::TAU;

use super::heap::{Heap, foot};
use super::look::{Look, whole};
use crate::settings::BoxSettings;
use crate::stream::Stream;

pub(super) fn boxes([base_m, top_m]: [f32; 2], stream: &mut Stream) -> Vec<BoxSettings> {
    let width = stream.between([700.0, 1500.0]);
    let depth = width * stream.between([0.65, 0.95]);
    let height = (width * stream.between([0.45, 0.7])).min(top_m - base_m);
    let look = Look::puffs((0.27 * width).clamp(200.0, 380.0));
    let mut boxes = Vec::new();
    foot(base_m, [width, 0.34 * height, depth], look, 1.1, &mut boxes);
    let heaps = whole(stream, 3, 5);
    let first = stream.between([0.0, 1.0]);
    let mut group = 1;
    for i in 0..heaps {
        // The first in the middle, the others around it.
        let out = if i == 0 {
            0.08
        } else {
            stream.between([0.2, 0.28])
        };
        let angle = TAU * (first + i as f32 / (heaps - 1) as f32 + stream.between([-0.08, 0.08]));
        let share = if i == 0 {
            1.0
        } else {
            stream.between([0.55, 0.85])
        };
        let heap = Heap {
            at_m: [
                out * width * libm::cosf(angle),
                out * depth * libm::sinf(angle),
            ],
            foot_m: base_m + 0.2 * height,
            top_m: base_m + share * height,
            width_m: width * stream.between([0.4, 0.52]),
            storeys: if i == 0 { 2 } else { 1 },
            group,
        };
        heap.add(look, 1.5, stream, &mut boxes);
        group += heap.groups();
    }
    boxes.push(fringe(base_m, width, height, stream));
    boxes
}

/// A few wisps at one end.
fn fringe(base_m: f32, width: f32, height: f32, stream: &mut Stream) -> BoxSettings {
    let side = if stream.unit() < 0.5 { -1.0 } else { 1.0 };
    let look = Look::wisps((0.24 * width).clamp(150.0, 320.0));
    let centre = [side * 0.42 * width, base_m + 0.3 * height, 0.0];
    let mut fringe = look.in_box(centre, [0.16 * width, 0.2 * height, 0.3 * width], 0);
    fringe.sprites = 2;
    fringe
}
