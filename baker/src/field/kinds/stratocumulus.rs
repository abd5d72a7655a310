//! Stratocumulus: rounded lumps in rolls, with gaps between them. A cloud is a patch of them, each roll over a band of fog, as
//! the article fills its sheets.

use welkin_pack::field::Category;

use super::look::Look;
use crate::settings::BoxSettings;
use crate::stream::Stream;

/// Rolls of a patch, and lumps along the longest of them.
const ROLLS: u32 = 3;
const LUMPS: u32 = 4;

/// From roll to roll, and from lump to lump along a roll, in metres.
const ROLL_M: f32 = 720.0;
const LUMP_M: f32 = 600.0;

pub(super) fn boxes([base_m, top_m]: [f32; 2], stream: &mut Stream) -> Vec<BoxSettings> {
    let look = Look {
        width_m: [520.0, 740.0],
        height_m: [380.0, 520.0],
        category: Category::Cumulus,
        turn_rad: 0.6,
    };
    let fog = Look {
        width_m: [620.0, 900.0],
        height_m: [380.0, 520.0],
        category: Category::Stratus,
        turn_rad: 0.35,
    };
    let thick = (0.4 * (top_m - base_m)).max(20.0);
    let mut boxes = Vec::new();
    for roll in 0..ROLLS {
        // The outer rolls are shorter, so that a patch is round.
        let lumps = LUMPS - u32::from(roll != ROLLS / 2);
        let bend = stream.between([-0.2, 0.2]);
        let across = roll as f32 - 0.5 * (ROLLS - 1) as f32 + bend;
        let first = roll * LUMPS.div_ceil(2);
        let band = [0.8 * LUMP_M * lumps as f32, 0.6 * thick, 0.5 * ROLL_M];
        let centre = [0.0, 0.5 * (base_m + top_m) - 0.2 * thick, ROLL_M * across];
        let mut of_fog = fog.in_box(centre, band, first);
        of_fog.sprites = 2 + lumps;
        boxes.push(of_fog);
        for lump in 0..lumps {
            let along = lump as f32 - 0.5 * (lumps - 1) as f32;
            let centre = [
                LUMP_M * (along + stream.between([-0.15, 0.15])),
                0.5 * (base_m + top_m) + stream.between([-0.25, 0.25]) * thick,
                ROLL_M * (across + stream.between([-0.12, 0.12])),
            ];
            let size = [0.7 * LUMP_M, thick, 0.45 * ROLL_M];
            let mut of_roll = look.in_box(centre, size, first + lump / 2);
            of_roll.sprites = 3;
            boxes.push(of_roll);
        }
    }
    boxes
}
