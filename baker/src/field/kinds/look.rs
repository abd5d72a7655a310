//! What the boxes of all kinds have in common: the look of their sprites.

use std::f32::consts::PI;

use welkin_pack::field::Category;

use crate::settings::BoxSettings;
use crate::stream::Stream;

/// What the sprites of a box look like.
#[derive(Clone, Copy)]
pub(super) struct Look {
    pub width_m: [f32; 2],
    pub height_m: [f32; 2],
    pub category: Category,
    /// The most that a sprite is turned either way, in radians.
    pub turn_rad: f32,
}

impl Look {
    /// Puffs about as high as wide, turned in any way.
    pub(super) fn puffs(size_m: f32) -> Look {
        Look {
            width_m: [0.85 * size_m, 1.2 * size_m],
            height_m: [0.75 * size_m, 1.05 * size_m],
            category: Category::Cumulus,
            turn_rad: PI,
        }
    }

    /// Wisps, wider than high, a little turned.
    pub(super) fn wisps(size_m: f32) -> Look {
        Look {
            width_m: [0.9 * size_m, 1.3 * size_m],
            height_m: [0.6 * size_m, 0.85 * size_m],
            category: Category::Wispy,
            turn_rad: 0.4,
        }
    }

    pub(super) fn in_box(self, centre_m: [f32; 3], size_m: [f32; 3], group: u32) -> BoxSettings {
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
    pub(super) fn filled(mut self, fill: f32) -> BoxSettings {
        let [a, b, c] = self.size_m;
        let mean = |[least, most]: [f32; 2]| 0.5 * (least + most);
        let sprite = mean(self.width_m) * mean(self.height_m);
        let count = fill * (a * b + b * c + c * a) / sprite;
        self.sprites = (libm::roundf(count) as u32).clamp(2, 100);
        self
    }

    pub(super) fn with_flat_bottom(mut self) -> BoxSettings {
        self.flat_bottom = true;
        self
    }
}

/// A whole number from `least` to `most`.
pub(super) fn whole(stream: &mut Stream, least: u32, most: u32) -> u32 {
    least + (stream.unit() * f64::from(most - least + 1)) as u32
}
