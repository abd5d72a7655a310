//! The sheet of cloud sprites: what each kind looks like.

#![allow(clippy::unwrap_used, reason = "a test may stop where it fails")]

use std::sync::OnceLock;

use crate::common::{bake, image};
use welkin_baker::{Recipe, sprite_sheet};
use welkin_pack::{Image, Role, SheetCell, SheetKind};

/// The sheet of a recipe's table `[sprites]`.
fn sheet(table: &str, seed: u64) -> Image {
    let recipe = Recipe::parse("sky.toml", &format!("[sprites]\n{table}\n")).unwrap();
    let resolved = recipe.resolve(Some(seed)).unwrap();
    sprite_sheet(&resolved.sprites, seed, None).unwrap()
}

/// The default sheets by three seeds, made once for all tests.
fn by_seeds() -> &'static [Image] {
    static SHEETS: OnceLock<Vec<Image>> = OnceLock::new();
    SHEETS.get_or_init(|| (1..=3).map(|seed| sheet("", seed)).collect())
}

/// The cells.
fn cells(sheet: &Image) -> Vec<(SheetKind, Image)> {
    let side = sheet.width / SheetCell::A_SIDE;
    let cells = (0..SheetCell::COUNT).map(SheetCell).map(|cell| {
        let [left, top] = cell.place().map(|i| i * side);
        let mut image = Image::new(side, side, 4);
        for (x, y) in places(side) {
            image
                .texel_mut(x, y)
                .copy_from_slice(sheet.texel(left + x, top + y));
        }
        (cell.kind(), image)
    });
    cells.collect()
}

fn places(side: u32) -> impl Iterator<Item = (u32, u32)> {
    (0..side).flat_map(move |y| (0..side).map(move |x| (x, y)))
}

fn peak(cell: &Image) -> f32 {
    cell.channel(1).fold(0.0, f32::max)
}

/// Mean and standard deviation of the grey, weighted by opacity.
fn grey(cell: &Image) -> [f32; 2] {
    let weighted = |value: &dyn Fn(f32) -> f32| {
        let texels = cell.texels.chunks_exact(4);
        let sum: f64 = texels.map(|t| f64::from(t[1] * value(t[0]))).sum();
        (sum / cell.channel(1).map(f64::from).sum::<f64>()) as f32
    };
    let mean = weighted(&|grey| grey);
    let variance = weighted(&|grey| (grey - mean) * (grey - mean));
    [mean, libm::sqrtf(variance)]
}

#[test]
fn it_is_the_role_of_the_pack() {
    let (resolved, sources) = bake("[clouds]\nsize = 64\n[sprites]\nsize = 128\n", Some(5));
    let alone = sprite_sheet(&resolved.sprites, 5, None).unwrap();
    assert!(image(&sources, Role::Sprites) == &alone);
    assert_eq!((alone.width, alone.height), (128, 128));
}

#[test]
fn every_sprite_has_faded_out_well_inside_of_its_cell() {
    for text in [
        "",
        "size = 128",
        "softness = 3",
        "softness = 0.5\ndetail = 1.5",
    ] {
        for (kind, cell) in cells(&sheet(text, 4)) {
            let unit = |i: u32| (i as f32 + 0.5) / cell.width as f32 * 2.0 - 1.0;
            for (x, y) in places(cell.width) {
                let radius = libm::sqrtf(unit(x) * unit(x) + unit(y) * unit(y));
                let alpha = cell.texel(x, y)[1];
                assert!(
                    radius <= 0.85 || alpha == 0.0,
                    "{text}: {kind:?} at {radius}"
                );
            }
        }
    }
}

#[test]
fn each_kind_is_as_dense_as_its_name_says() {
    for (seed, sheet) in (1..).zip(by_seeds()) {
        for (kind, cell) in cells(sheet) {
            let peak = peak(&cell);
            let (opacity, _) = cell.mean_and_spread(1);
            let (peaks, opacities) = match kind {
                SheetKind::Foggy => (0.55..0.9, 0.08..0.3),
                SheetKind::Wispy => (0.45..0.85, 0.03..0.25),
                SheetKind::FlatBottomed => (0.97..1.01, 0.15..0.5),
                SheetKind::Puffy => (0.97..1.01, 0.2..0.5),
            };
            assert!(peaks.contains(&peak), "seed {seed}: {kind:?} {peak}");
            assert!(
                opacities.contains(&opacity),
                "seed {seed}: {kind:?} {opacity}"
            );
        }
    }
}

#[test]
fn grey_has_the_mean_one_half_and_fog_hardly_any_relief() {
    for (seed, sheet) in (1..).zip(by_seeds()) {
        for (kind, cell) in cells(sheet) {
            let [mean, spread] = grey(&cell);
            assert!((mean - 0.5).abs() < 1e-3, "seed {seed}: {kind:?} {mean}");
            let spreads = match kind {
                SheetKind::Foggy => 0.01..0.03,
                SheetKind::Wispy => 0.03..0.08,
                SheetKind::FlatBottomed | SheetKind::Puffy => 0.07..0.14,
            };
            assert!(spreads.contains(&spread), "seed {seed}: {kind:?} {spread}");
            assert!(cell.channel(0).all(|grey| (0.02..0.98).contains(&grey)));
        }
    }
}

/// Length of the outline at this opacity over that of a disc of the same area, both along the texels' sides.
fn raggedness(cell: &Image, alpha: f32) -> f32 {
    let is_inside = |x: u32, y: u32| cell.texel(x, y)[1] >= alpha;
    let (mut area, mut outline) = (0, 0);
    for (x, y) in places(cell.width - 1) {
        let here = is_inside(x, y);
        area += u32::from(here);
        outline += u32::from(here != is_inside(x + 1, y)) + u32::from(here != is_inside(x, y + 1));
    }
    // Along the sides of texels a circle of the radius r is 8 r long.
    let radius = libm::sqrtf(area as f32 / std::f32::consts::PI);
    outline as f32 / (8.0 * radius)
}

#[test]
fn puffs_are_no_discs_and_wisps_are_torn() {
    for (seed, sheet) in (1..).zip(by_seeds()) {
        for (kind, cell) in cells(sheet) {
            let ragged = raggedness(&cell, 0.5 * peak(&cell));
            // A disc has 1, and half of one 1.06.
            let expected = match kind {
                SheetKind::Foggy => 0.95..1.5,
                SheetKind::Wispy => 1.5..10.0,
                SheetKind::FlatBottomed => 1.06..2.5,
                SheetKind::Puffy => 1.1..2.5,
            };
            assert!(expected.contains(&ragged), "seed {seed}: {kind:?} {ragged}");
        }
    }
}

#[test]
fn no_two_sprites_are_alike() {
    let cells: Vec<Image> = by_seeds()
        .iter()
        .flat_map(cells)
        .map(|(_, cell)| cell)
        .collect();
    for (i, one) in cells.iter().enumerate() {
        for (j, other) in cells[..i].iter().enumerate() {
            let pairs = one.channel(1).zip(other.channel(1));
            let apart: f32 = pairs.map(|(a, b)| (a - b).abs()).sum();
            // Puffs all fill the middle of their cells; a twentieth is far more than their edges' softness.
            let all: f32 = one.channel(1).sum();
            assert!(apart > 0.05 * all, "{i} and {j}");
        }
    }
}

#[test]
fn grey_goes_on_where_sprites_have_ended_and_is_smoother_there() {
    for (kind, cell) in cells(&by_seeds()[0]) {
        let (mut inside, mut outside) = (0.0_f32, 0.0_f32);
        for (x, y) in places(cell.width - 1) {
            let here = cell.texel(x, y);
            for beside in [cell.texel(x + 1, y), cell.texel(x, y + 1)] {
                let step = (here[0] - beside[0]).abs();
                if here[1] == 0.0 && beside[1] == 0.0 {
                    outside = outside.max(step);
                } else {
                    inside = inside.max(step);
                }
            }
        }
        assert!(outside < inside, "{kind:?}: {outside} {inside}");
    }
}

#[test]
fn contrast_is_a_factor_on_the_relief_alone() {
    let [none, plain, double] =
        ["contrast = 0", "", "contrast = 2"].map(|text| sheet(&format!("size = 128\n{text}"), 2));
    assert!(none.channel(0).all(|grey| (grey - 0.5).abs() < 1e-6));
    for (one, two) in plain.channel(0).zip(double.channel(0)) {
        assert!((2.0 * (one - 0.5) - (two - 0.5)).abs() < 1e-4);
    }
    assert!(plain.channel(1).eq(none.channel(1)) && plain.channel(1).eq(double.channel(1)));
}

#[test]
fn detail_makes_outlines_ragged_and_softness_makes_them_wide() {
    let puffs = |text: &str| -> Vec<Image> {
        let cells = cells(&sheet(text, 6)).into_iter();
        let puffs = cells.filter(|(kind, _)| *kind == SheetKind::Puffy);
        puffs.map(|(_, cell)| cell).collect()
    };
    let ragged = |text| puffs(text).iter().map(|c| raggedness(c, 0.5)).sum::<f32>();
    let (smooth, rough) = (ragged("detail = 0"), ragged("detail = 1.5"));
    assert!(rough > 1.1 * smooth, "{smooth} {rough}");
    let edges = |text| {
        let cells = puffs(text);
        let half = |alpha: f32| (0.1..0.9).contains(&alpha);
        cells
            .iter()
            .flat_map(|c| c.channel(1))
            .filter(|a| half(*a))
            .count()
    };
    let (crisp, soft) = (edges("softness = 0.5"), edges("softness = 3"));
    assert!(2 * soft > 3 * crisp, "{crisp} {soft}");
}
