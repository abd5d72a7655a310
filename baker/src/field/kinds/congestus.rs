//! Cumulus congestus: heaps that have grown into towers, higher than wide.

use super::heap::{Heaps, foot};
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
    let towers = Heaps {
        base_m,
        size_m: [width, height, depth],
        count: whole(stream, 3, 4),
        middle: [0.05, 1.0],
        out: [0.2, 0.3],
        share: [0.4, 0.75],
        foot: 0.1,
        width: |_, stream| stream.between([0.52, 0.62]),
        // A storey is about as high as a sprite and a half.
        storeys: |_, height| (libm::roundf(height / 650.0) as u32).clamp(1, 8),
    };
    towers.add(look, 1.5, stream, &mut boxes);
    boxes
}
