//! Kinds of cloud: how each is put together from boxes.
//!
//! World Meteorological Organization, "International Cloud Atlas", WMO-No. 407, 2017: heights and shapes. Proportions are
//! judged by eye.

mod altocumulus;
mod cirrus;
mod congestus;
mod cumulonimbus;
mod cumulus;
mod heap;
mod stratocumulus;
mod stratus;

use std::f32::consts::PI;

use welkin_pack::field::{Category, CloudKind};

use crate::settings::{BoxSettings, CloudLayerSettings};
use crate::stream::Stream;

/// Base and top of a kind where the recipe says nothing, in metres above the sea.
pub(crate) const fn heights_m(kind: CloudKind) -> [f32; 2] {
    match kind {
        CloudKind::Cumulus => [1000.0, 1800.0],
        CloudKind::Congestus => [1000.0, 4200.0],
        CloudKind::Cumulonimbus => [900.0, 9500.0],
        CloudKind::Stratus => [500.0, 760.0],
        CloudKind::Stratocumulus => [1250.0, 1600.0],
        CloudKind::Altocumulus => [3400.0, 3650.0],
        CloudKind::Cirrus => [8000.0, 8300.0],
    }
}

/// Whether its clouds are pieces of a sheet, and not bodies of their own.
pub(super) const fn is_sheet(kind: CloudKind) -> bool {
    matches!(
        kind,
        CloudKind::Stratus | CloudKind::Stratocumulus | CloudKind::Altocumulus
    )
}

/// Boxes of one cloud of a layer: x and z about its origin, y above the sea.
pub(super) fn boxes(layer: &CloudLayerSettings, stream: &mut Stream) -> Vec<BoxSettings> {
    let heights = [layer.base_m, layer.top_m];
    let mut boxes = match layer.kind {
        CloudKind::Cumulus => cumulus::boxes(heights, stream),
        CloudKind::Congestus => congestus::boxes(heights, stream),
        CloudKind::Cumulonimbus => cumulonimbus::boxes(heights, stream),
        CloudKind::Stratus => stratus::boxes(heights, stream),
        CloudKind::Stratocumulus => stratocumulus::boxes(heights, stream),
        CloudKind::Altocumulus => altocumulus::boxes(heights, stream),
        CloudKind::Cirrus => cirrus::boxes(heights, stream),
    };
    for of_cloud in &mut boxes {
        let sprites = libm::roundf(of_cloud.sprites as f32 * layer.density) as u32;
        of_cloud.sprites = sprites.clamp(1, 100);
        of_cloud.cull = layer.cull;
    }
    boxes
}

/// What the sprites of a box look like.
#[derive(Clone, Copy)]
struct Look {
    width_m: [f32; 2],
    height_m: [f32; 2],
    category: Category,
    /// The most that a sprite is turned either way, in radians.
    turn_rad: f32,
}

impl Look {
    /// Puffs about as high as wide, turned in any way.
    fn puffs(size_m: f32) -> Look {
        Look {
            width_m: [0.85 * size_m, 1.2 * size_m],
            height_m: [0.75 * size_m, 1.05 * size_m],
            category: Category::Cumulus,
            turn_rad: PI,
        }
    }

    /// Wisps, wider than high, a little turned.
    fn wisps(size_m: f32) -> Look {
        Look {
            width_m: [0.9 * size_m, 1.3 * size_m],
            height_m: [0.6 * size_m, 0.85 * size_m],
            category: Category::Wispy,
            turn_rad: 0.4,
        }
    }

    fn in_box(self, centre_m: [f32; 3], size_m: [f32; 3], group: u32) -> BoxSettings {
        BoxSettings {
            centre_m,
            size_m: size_m.map(|side| side.max(1.0)),
            sprites: 1,
            width_m: self.width_m,
            height_m: self.height_m,
            category: self.category,
            rotation_rad: [-self.turn_rad, self.turn_rad],
            group,
            flat_bottom: false,
            cull: 0.0,
            by_hand: Vec::new(),
        }
    }
}

impl BoxSettings {
    /// As many sprites as cover half of the box's surface `fill` times, at least two.
    fn filled(mut self, fill: f32) -> BoxSettings {
        let [a, b, c] = self.size_m;
        let mean = |[least, most]: [f32; 2]| 0.5 * (least + most);
        let sprite = mean(self.width_m) * mean(self.height_m);
        let count = fill * (a * b + b * c + c * a) / sprite;
        self.sprites = (libm::roundf(count) as u32).clamp(2, 100);
        self
    }

    fn with_flat_bottom(mut self) -> BoxSettings {
        self.flat_bottom = true;
        self
    }
}

/// A number between two.
fn between(stream: &mut Stream, from: f32, to: f32) -> f32 {
    from + (to - from) * stream.unit() as f32
}

/// A whole number from `least` to `most`.
fn whole(stream: &mut Stream, least: u32, most: u32) -> u32 {
    least + (stream.unit() * f64::from(most - least + 1)) as u32
}
