//! Stratus: a low sheet of fog. A cloud is a piece of it; pieces overlap.

use welkin_pack::field::Category;

use super::look::Look;
use crate::settings::BoxSettings;
use crate::stream::Stream;

/// Boxes along the sides of a piece.
const COLUMNS: u32 = 3;
const ROWS: u32 = 3;

pub(super) fn boxes([base_m, top_m]: [f32; 2], stream: &mut Stream) -> Vec<BoxSettings> {
    let look = Look {
        width_m: [620.0, 900.0],
        height_m: [430.0, 620.0],
        category: Category::Stratus,
        turn_rad: 0.35,
    };
    let [width, depth] = [
        stream.between([900.0, 1200.0]),
        stream.between([800.0, 1000.0]),
    ];
    let thick = (0.5 * (top_m - base_m)).max(20.0);
    let mut boxes = Vec::new();
    for i in 0..COLUMNS * ROWS {
        let place = |n: u32, of: u32| n as f32 - 0.5 * (of - 1) as f32;
        let centre = [
            width * (place(i % COLUMNS, COLUMNS) + stream.between([-0.12, 0.12])),
            0.5 * (base_m + top_m) + stream.between([-0.15, 0.15]) * thick,
            depth * (place(i / COLUMNS, ROWS) + stream.between([-0.12, 0.12])),
        ];
        let mut of_sheet = look.in_box(centre, [1.1 * width, thick, 1.1 * depth], i);
        of_sheet.sprites = 5;
        boxes.push(of_sheet);
    }
    boxes
}
