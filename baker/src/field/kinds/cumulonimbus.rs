//! Cumulonimbus: a dark broad foot, a tower of many storeys, and an anvil of ice that the wind draws out.

use std::f32::consts::TAU;

use super::heap::{Heaps, foot};
use super::look::{Look, whole};
use crate::settings::BoxSettings;
use crate::stream::Stream;

pub(super) fn boxes([base_m, top_m]: [f32; 2], stream: &mut Stream) -> Vec<BoxSettings> {
    let width = stream.between([3600.0, 4600.0]);
    let depth = width * stream.between([0.75, 0.95]);
    let height = (top_m - base_m) * stream.between([0.9, 1.0]);
    let look = Look::puffs(1250.0);
    let mut boxes = Vec::new();
    foot(base_m, [width, 0.12 * height, depth], look, 1.5, &mut boxes);
    let towers = Heaps {
        base_m,
        size_m: [width, height, depth],
        count: whole(stream, 3, 4),
        // It reaches into the anvil.
        middle: [0.04, 0.97],
        out: [0.2, 0.28],
        share: [0.3, 0.6],
        foot: 0.08,
        width: |i, stream| match i {
            0 => 0.68,
            _ => stream.between([0.46, 0.56]),
        },
        storeys: |_, height| (libm::roundf(height / 1100.0) as u32).clamp(1, 9),
    };
    let group = towers.add(look, 1.8, stream, &mut boxes);
    anvil([base_m, base_m + height], width, group, stream, &mut boxes);
    boxes
}

/// Boxes from the tower outwards, thinner and higher the farther they are; most of them downwind, to the east.
fn anvil(
    [base_m, top_m]: [f32; 2],
    width: f32,
    group: u32,
    stream: &mut Stream,
    boxes: &mut Vec<BoxSettings>,
) {
    let height = top_m - base_m;
    let look = Look {
        width_m: [1300.0, 1900.0],
        height_m: [650.0, 950.0],
        ..Look::wisps(1500.0)
    };
    let ring = 8;
    for i in 0..ring {
        let angle = TAU * (i as f32 + stream.between([-0.2, 0.2])) / ring as f32;
        let (sin, cos) = (libm::sinf(angle), libm::cosf(angle));
        for (j, out) in [0.42, 0.8].into_iter().enumerate() {
            let reach = width * out * (1.0 + 0.45 * cos);
            let thick = height * if j == 0 { 0.12 } else { 0.06 };
            let centre = [
                reach * cos + 0.12 * width,
                top_m - 0.3 * look.height_m[1] - 0.5 * thick,
                reach * sin * 0.8,
            ];
            let size = [0.42 * width, thick, 0.34 * width];
            boxes.push(look.in_box(centre, size, group + i / 2).filled(1.1));
        }
    }
}
