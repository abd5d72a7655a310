//! Cumulus: a flat foot, and on it a few heaps, the highest in the middle.

use super::heap::{Heaps, foot};
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
    let heaps = Heaps {
        base_m,
        size_m: [width, height, depth],
        count: whole(stream, 3, 5),
        middle: [0.08, 1.0],
        out: [0.2, 0.28],
        share: [0.55, 0.85],
        foot: 0.2,
        width: |_, stream| stream.between([0.4, 0.52]),
        storeys: |i, _| if i == 0 { 2 } else { 1 },
    };
    heaps.add(look, 1.5, stream, &mut boxes);
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
