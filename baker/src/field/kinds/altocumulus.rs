//! Altocumulus: small lumps in rows at middle height. A cloud is a patch of rows.

use welkin_pack::field::Category;

use super::look::{Look, whole};
use crate::settings::BoxSettings;
use crate::stream::Stream;

/// From row to row, in metres.
const ROW_M: f32 = 330.0;

pub(super) fn boxes([base_m, top_m]: [f32; 2], stream: &mut Stream) -> Vec<BoxSettings> {
    let look = Look {
        width_m: [210.0, 300.0],
        height_m: [170.0, 240.0],
        category: Category::Cumulus,
        turn_rad: 0.8,
    };
    let thick = (0.35 * (top_m - base_m)).max(15.0);
    let rows = whole(stream, 5, 7);
    let mut boxes = Vec::new();
    for row in 0..rows {
        let across = row as f32 - 0.5 * (rows - 1) as f32;
        let half = stream.between([380.0, 560.0]);
        let shift = stream.between([-200.0, 200.0]);
        for (side, group) in [(-1.0, 0), (1.0, 1)] {
            let centre = [
                shift + side * half,
                0.5 * (base_m + top_m) + stream.between([-0.3, 0.3]) * thick,
                ROW_M * (across + stream.between([-0.12, 0.12])),
            ];
            let size = [1.7 * half, thick, 0.2 * ROW_M];
            let mut of_row = look.in_box(centre, size, 2 * (row / 2) + group);
            of_row.sprites = 5;
            boxes.push(of_row);
        }
    }
    boxes
}
