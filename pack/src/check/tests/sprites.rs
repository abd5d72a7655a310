//! Faults of the sheet of cloud sprites.

use super::{assert_only, change_level, check_pack, each_texel};
use crate::mapping::{SheetCell, SheetKind};
use crate::pack::Pack;
use crate::role::Role;
use crate::test_pack::{with, with_texture};

/// Side of a cell of the test pack.
const SIDE: u32 = 32;

/// A pack with the texels of some cells changed; `change` is given the place in the cell.
fn with_cells(
    is_changed: impl Fn(SheetCell) -> bool,
    change: impl Fn(u32, u32, &mut [f32]),
) -> Pack {
    with(Role::Sprites, |image| {
        each_texel(image, |x, y, t| {
            let cell = SheetCell((y / SIDE * SheetCell::A_SIDE + x / SIDE) as u8);
            if is_changed(cell) {
                change(x % SIDE, y % SIDE, t);
            }
        });
    })
}

fn with_kind(kind: SheetKind, change: impl Fn(u32, u32, &mut [f32])) -> Pack {
    with_cells(|cell| cell.kind() == kind, change)
}

/// The warnings of a pack that is sound.
fn warnings(pack: &Pack) -> Vec<&'static str> {
    let report = check_pack(pack);
    assert!(report.is_sound());
    let mut rules: Vec<_> = report.problems().map(|f| f.rule).collect();
    rules.dedup();
    rules
}

#[test]
fn an_opaque_texel_on_a_border_is_an_error_on_every_level() {
    for level in 0..3 {
        let cell = (SIDE >> level) as usize;
        for [x, y] in [
            [0, 1],
            [cell - 1, 1],
            [2 * cell + 1, cell],
            [1, 4 * cell - 1],
        ] {
            let bleeding = with_texture(Role::Sprites, |t| {
                let width = 4 * cell;
                t.levels[level][4 * (y * width + x) + 1] = 1;
            });
            assert_only("sprite-border", &bleeding);
        }
    }
}

#[test]
fn a_level_that_is_not_the_mean_is_an_error() {
    for level in 1..3 {
        for channel in [0, 1, 2, 3] {
            // In the middle of the last puff, where alpha is high and grey anything.
            let middle = (128_usize >> level) * (112 >> level) + (112 >> level);
            let changed = with_texture(Role::Sprites, |t| {
                change_level(t, level, |i, texel| {
                    if i == middle {
                        texel[channel] = if channel == 1 { texel[1] - 2 } else { 255 };
                    }
                });
            });
            assert_only("sprite-level", &changed);
        }
    }
}

#[test]
fn grey_that_was_averaged_with_nothing_makes_dark_rims_but_no_error() {
    // Not dilated: 0 where there is nothing. Levels weigh it with nearly nothing, so it is no fault of theirs.
    let rims = with_cells(
        |_| true,
        |_, _, t| {
            if t[1] == 0.0 {
                t[0] = 0.0
            }
        },
    );
    assert!(warnings(&rims).is_empty());
}

#[test]
fn an_empty_or_a_full_cell_is_an_error() {
    for index in 0..SheetCell::COUNT {
        let empty = with_cells(|cell| cell.0 == index, |_, _, t| t[1] *= 0.01);
        assert_only("sprite-cells", &empty);
        let full = with_cells(
            |cell| cell.0 == index,
            |x, y, t| {
                let inside = 1..SIDE - 1;
                t[1] = if inside.contains(&x) && inside.contains(&y) {
                    1.0
                } else {
                    0.0
                };
            },
        );
        assert_only("sprite-cells", &full);
    }
}

#[test]
fn what_a_kind_asks_is_a_warning() {
    for channel in [0, 2, 3] {
        let bright = with_kind(SheetKind::Wispy, |_, _, t| t[channel] += 0.1);
        assert_eq!(warnings(&bright), ["sprite-grey"]);
    }
    for kind in [SheetKind::Puffy, SheetKind::FlatBottomed] {
        let thin = with_kind(kind, |_, _, t| t[1] *= 0.8);
        assert_eq!(warnings(&thin), ["sprite-core"]);
    }
    let round = with_kind(SheetKind::FlatBottomed, |x, y, t| {
        let [u, v] = [x, y].map(|i| (i as f32 + 0.5) / SIDE as f32 * 2.0 - 1.0);
        t[1] = ((0.8 - libm::sqrtf(u * u + v * v)) / 0.4).clamp(0.0, 1.0);
    });
    assert_eq!(warnings(&round), ["sprite-flat"]);
    let curly = with_kind(SheetKind::Foggy, |x, y, t| {
        t[0] = 0.5 + if (x / 2 + y / 2) % 2 == 0 { 0.2 } else { -0.2 };
    });
    assert_eq!(warnings(&curly), ["sprite-fog"]);
}
