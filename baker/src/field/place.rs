//! Sprites in a box: random ones, or those that an artist has placed.

use std::f32::consts::PI;

use welkin_pack::SheetCell;
use welkin_pack::field::{Category, CloudBox, Exposure, Sprite, rounded_rotation};

use super::grid::snapped;
use crate::settings::{BoxSettings, PlacedSprite};
use crate::sprites::FLOOR;
use crate::stream::Stream;

/// How far the flat edge of the flat-bottomed picture is below its middle, as a share of its height: the sheet counts in half heights.
const FLAT_EDGE: f32 = -0.5 * FLOOR;

/// How far below its middle another picture is still dense.
const DENSE_EDGE: f32 = 0.3;

/// The share of a flat-bottomed box, from below, whose sprites are flat.
const FLAT_SHARE: f32 = 1.0 / 3.0;

/// The most that a flat-bottomed sprite is turned, in radians: its edge stays level to the eye.
const FLAT_TURN_RAD: f32 = 3.0 * PI / 180.0;

/// As many sprites as the box asks for, before the cull. `stored` is the box as the pack will have it.
///
/// Centres are even over the box. Width and height grow together from their least to their most. What was placed by hand is as it is, on the
/// grid.
pub(super) fn sprites(
    settings: &BoxSettings,
    stored: &CloudBox,
    index: u16,
    stream: &mut Stream,
) -> Vec<Sprite> {
    if !settings.by_hand.is_empty() {
        let placed = settings.by_hand.iter();
        return placed.map(|own| by_hand(own, index)).collect();
    }
    (0..settings.sprites)
        .map(|_| sprite(settings, stored, index, stream))
        .collect()
}

fn by_hand(own: &PlacedSprite, index: u16) -> Sprite {
    Sprite {
        centre_m: own.centre_m.map(snapped),
        size_m: own.size_m.map(|side| snapped(side).max(0.125)),
        rotation_rad: rounded_rotation(own.rotation_rad),
        cell: own.cell,
        cloud_box: index,
        exposure: Exposure::default(),
    }
}

fn sprite(settings: &BoxSettings, stored: &CloudBox, index: u16, stream: &mut Stream) -> Sprite {
    // Always the same draws, so that one value of a recipe does not move what it has nothing to do with.
    let [size, x, y, z, cell, turn] = std::array::from_fn(|_| stream.unit() as f32);
    let size_m = [settings.width_m, settings.height_m].map(|range| snapped(mix(range, size)));
    let places = [x, y, z];
    let mut centre_m: [f32; 3] = std::array::from_fn(|axis| {
        let half = 0.5 * stored.size_m[axis];
        let place = stored.centre_m[axis] + half * (2.0 * places[axis] - 1.0);
        snapped(place).clamp(stored.centre_m[axis] - half, stored.centre_m[axis] + half)
    });
    let is_flat = settings.flat_bottom && y < FLAT_SHARE;
    if settings.flat_bottom {
        let half = 0.5 * stored.size_m[1];
        let (low, high) = (stored.centre_m[1] - half, stored.centre_m[1] + half);
        // What is flat ends on the base, and nothing dense hangs below it.
        let above = |share: f32| snapped(low + share * size_m[1]).min(high);
        centre_m[1] = if is_flat {
            above(FLAT_EDGE)
        } else {
            centre_m[1].max(above(DENSE_EDGE))
        };
    }
    let (cell, turn) = if is_flat {
        (
            SheetCell::FLAT_BOTTOMED[0],
            mix([-FLAT_TURN_RAD, FLAT_TURN_RAD], turn),
        )
    } else {
        (
            cell_of(settings.category, cell),
            mix(settings.rotation_rad, turn),
        )
    };
    Sprite {
        centre_m,
        size_m,
        rotation_rad: rounded_rotation(turn),
        cell,
        cloud_box: index,
        exposure: Exposure::default(),
    }
}

/// A picture of a category: `unit` is 0..1.
fn cell_of(category: Category, unit: f32) -> u8 {
    let (wisps, others): (f32, &[u8]) = match category {
        Category::Stratus => (0.25, &SheetCell::FOGGY),
        Category::Cumulus => (0.12, &SheetCell::PUFFY),
        Category::Wispy => (1.0, &[]),
    };
    let (cells, unit) = if unit < wisps {
        (&SheetCell::WISPY[..], unit / wisps)
    } else {
        (others, (unit - wisps) / (1.0 - wisps))
    };
    cells[((unit * cells.len() as f32) as usize).min(cells.len() - 1)]
}

fn mix([from, to]: [f32; 2], share: f32) -> f32 {
    from + (to - from) * share
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::field::boxes::default_box;

    fn placed(settings: &BoxSettings) -> (CloudBox, Vec<Sprite>) {
        let stored = crate::field::cloud::stored(settings, 0);
        let mut stream = Stream::new(5, "test");
        let sprites = sprites(settings, &stored, 0, &mut stream);
        (stored, sprites)
    }

    fn large() -> BoxSettings {
        BoxSettings {
            centre_m: [31.3, 1200.0, -77.7],
            size_m: [900.1, 500.0, 700.0],
            sprites: 4000,
            rotation_rad: [-0.5, 1.0],
            ..default_box()
        }
    }

    #[test]
    fn sprites_are_even_over_their_box_and_within_its_ranges() {
        let settings = large();
        let (stored, sprites) = placed(&settings);
        assert_eq!(sprites.len(), 4000);
        for axis in 0..3 {
            let place =
                |s: &Sprite| (s.centre_m[axis] - stored.centre_m[axis]) / stored.size_m[axis];
            assert!(sprites.iter().all(|s| place(s).abs() <= 0.5));
            let mean = sprites.iter().map(place).sum::<f32>() / 4000.0;
            // The mean of n even numbers spreads by 1/sqrt(12 n) = 0.0046; four times that.
            assert!(mean.abs() < 0.0183, "{mean}");
        }
        for sprite in &sprites {
            assert!((180.0..=300.0).contains(&sprite.size_m[0]));
            assert!((160.0..=260.0).contains(&sprite.size_m[1]));
            // Half a 4096th of a turn for the rounding.
            assert!((-0.501..=1.001).contains(&sprite.rotation_rad));
        }
    }

    #[test]
    fn categories_have_the_pictures_that_they_are_named_for() {
        let share = |category, cells: &[u8]| {
            let (_, sprites) = placed(&BoxSettings {
                category,
                ..large()
            });
            let count = sprites.iter().filter(|s| cells.contains(&s.cell)).count();
            count as f32 / 4000.0
        };
        assert_eq!(share(Category::Wispy, &SheetCell::WISPY), 1.0);
        // A share p of n spreads by sqrt(p (1 - p) / n), 0.007 at most; four times that.
        for (category, others) in [
            (Category::Stratus, &SheetCell::FOGGY[..]),
            (Category::Cumulus, &SheetCell::PUFFY[..]),
        ] {
            let wisps = share(category, &SheetCell::WISPY);
            assert!((wisps + share(category, others) - 1.0).abs() < 1e-6);
            assert!((0.08..0.28).contains(&wisps));
            let each = (1.0 - wisps) / others.len() as f32;
            for &cell in others {
                assert!((share(category, &[cell]) - each).abs() < 0.03);
            }
        }
    }

    #[test]
    fn a_flat_bottom_is_one_height_and_nothing_hangs_below_it() {
        let (stored, sprites) = placed(&BoxSettings {
            flat_bottom: true,
            ..large()
        });
        let low = stored.centre_m[1] - 0.5 * stored.size_m[1];
        let edge = |s: &Sprite, share: f32| s.centre_m[1] - share * s.size_m[1] - low;
        let (flat, others): (Vec<_>, Vec<_>) = sprites.iter().partition(|s| s.cell == 3);
        assert!((flat.len() as f32 / 4000.0 - FLAT_SHARE).abs() < 0.03);
        // Half a step of the grid.
        assert!(
            flat.iter()
                .all(|s| edge(s, FLAT_EDGE).abs() <= 0.0625 && s.rotation_rad.abs() < 0.054)
        );
        assert!(others.iter().all(|s| edge(s, DENSE_EDGE) >= -0.0625));
    }
}
