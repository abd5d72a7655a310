//! Cumulus congestus: heaps that have grown into towers, higher than wide.

use std::f32::consts::TAU;

use super::heap::{Heap, foot};
use super::look::{Look, whole};
use crate::settings::BoxSettings;
use crate::stream::Stream;

pub(super) fn boxes([base_m, top_m]: [f32; 2], stream: &mut Stream) -> Vec<BoxSettings> {
    let width = stream.between([1500.0, 2300.0]);
    let depth = width * stream.between([0.7, 0.95]);
    let height = (top_m - base_m) * stream.between([0.75, 1.0]);
    let look = Look::puffs((0.28 * width).clamp(400.0, 620.0));
    let mut boxes = Vec::new();
    foot(base_m, [width, 0.16 * height, depth], look, 1.2, &mut boxes);
    let towers = whole(stream, 3, 4);
    let first = stream.between([0.0, 1.0]);
    let mut group = 1;
    for i in 0..towers {
        let out = if i == 0 {
            0.05
        } else {
            stream.between([0.2, 0.3])
        };
        let angle = TAU * (first + i as f32 / (towers - 1) as f32 + stream.between([-0.08, 0.08]));
        let share = if i == 0 {
            1.0
        } else {
            stream.between([0.4, 0.75])
        };
        let tower = Heap {
            at_m: [
                out * width * libm::cosf(angle),
                out * depth * libm::sinf(angle),
            ],
            foot_m: base_m + 0.1 * height,
            top_m: base_m + share * height,
            width_m: width * stream.between([0.52, 0.62]),
            // A storey is about as high as a sprite and a half.
            storeys: (libm::roundf(share * height / 650.0) as u32).clamp(1, 8),
            group,
        };
        tower.add(look, 1.5, stream, &mut boxes);
        group += tower.groups();
    }
    boxes
}
