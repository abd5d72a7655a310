//! Cirrus: flat rectangles of fibres, a bundle of them a cloud, all along about one direction.
//!
//! The article: cirrus is almost two-dimensional, and would need many small sprites; so it is flat textured rectangles.

use std::f32::consts::PI;

use welkin_pack::field::Category;

use super::look::{Look, whole};
use crate::settings::BoxSettings;
use crate::stream::Stream;

/// How far fibres are turned from east and west, in radians: the wind up there blows about one way.
const TURN_RAD: f32 = 12.0 * PI / 180.0;

pub(super) fn boxes([base_m, top_m]: [f32; 2], stream: &mut Stream) -> Vec<BoxSettings> {
    let look = Look {
        width_m: [1000.0, 2900.0],
        height_m: [320.0, 620.0],
        category: Category::Wispy,
        turn_rad: TURN_RAD,
    };
    let bundles = whole(stream, 5, 6);
    (0..bundles)
        .map(|bundle| {
            let centre = [
                stream.between([-600.0, 600.0]),
                0.5 * (base_m + top_m),
                stream.between([-150.0, 150.0]) + 420.0 * (bundle as f32 - 2.5),
            ];
            let size = [
                stream.between([1500.0, 2600.0]),
                (0.6 * (top_m - base_m)).max(20.0),
                stream.between([350.0, 500.0]),
            ];
            let mut bundle = look.in_box(centre, size, bundle);
            bundle.sprites = 2;
            bundle
        })
        .collect()
}
