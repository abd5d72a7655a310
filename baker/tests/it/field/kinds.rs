//! The recipes of fields, one a kind and some more: sound by the rules of `welkin check`, and each as it is meant.

use welkin_pack::field::{Category, Cloud, CloudKind};
use welkin_pack::{Field, SheetCell, SheetKind};

use super::{field, problems, recipe_field};

#[test]
fn every_recipe_of_the_folder_makes_a_sound_field_without_a_warning() {
    let mut count = 0;
    for entry in std::fs::read_dir(super::folder()).unwrap() {
        let name = entry.unwrap().file_name().into_string().unwrap();
        let found = problems(&recipe_field(&name));
        assert!(found.is_empty(), "{name}: {found:#?}");
        count += 1;
    }
    assert_eq!(count, CloudKind::ALL.len() + 2);
    let found = problems(&field(""));
    assert!(found.is_empty(), "default: {found:#?}");
}

#[test]
fn clouds_of_every_kind_have_the_articles_counts_with_any_seed() {
    for kind in CloudKind::ALL {
        for seed in 0..12 {
            let layer = format!(
                "[[field.clouds]]\nkind = \"{}\"\ncover = 0.9\n",
                kind.name()
            );
            let field = field(&format!("seed = {seed}\n[field]\nsections = 2\n{layer}"));
            for cloud in &field.clouds {
                let (boxes, sprites) = (cloud.boxes.len(), cloud.sprites.len());
                assert!((5..=400).contains(&sprites), "{kind:?} {seed}: {sprites}");
                let most = (0..boxes).map(|i| {
                    let of_box = cloud.sprites.iter();
                    of_box.filter(|s| usize::from(s.cloud_box) == i).count()
                });
                assert!(most.into_iter().all(|count| (1..=100).contains(&count)));
            }
        }
    }
}

#[test]
fn every_kind_has_a_recipe_that_makes_it() {
    for kind in CloudKind::ALL {
        let field = recipe_field(&format!("{}.toml", kind.name()));
        assert_eq!(field.clouds[0].kind, kind);
        let is_flat = |cloud: &Cloud| cloud.size_m[1] < 500.0;
        let is_high = |cloud: &Cloud| cloud.size_m[1] > cloud.size_m[0].min(cloud.size_m[2]);
        let of_kind = || field.clouds.iter().filter(|cloud| cloud.kind == kind);
        match kind {
            CloudKind::Cumulus => {}
            CloudKind::Congestus | CloudKind::Cumulonimbus => assert!(of_kind().all(is_high)),
            _ => assert!(of_kind().all(is_flat)),
        }
    }
}

fn sprites_of(cloud: &Cloud, kind: SheetKind) -> usize {
    let cells = cloud.sprites.iter().map(|s| SheetCell(s.cell).kind());
    cells.filter(|k| *k == kind).count()
}

#[test]
fn heaps_have_flat_bottoms_at_one_height() {
    for name in ["cumulus.toml", "congestus.toml", "cumulonimbus.toml"] {
        for cloud in &recipe_field(name).clouds {
            assert!(sprites_of(cloud, SheetKind::FlatBottomed) > 0, "{name}");
            let base = cloud.centre_m[1] - 0.5 * cloud.size_m[1];
            let flat = cloud.sprites.iter();
            let flat = flat.filter(|s| SheetCell(s.cell).kind() == SheetKind::FlatBottomed);
            // The picture's flat edge is 0.1 of its height below the middle; a sixteenth is half a step of the grid.
            let edges: Vec<f32> = flat.map(|s| s.centre_m[1] - 0.1 * s.size_m[1]).collect();
            assert!(
                edges.iter().all(|edge| (edge - base).abs() <= 0.0626),
                "{name}"
            );
        }
    }
}

#[test]
fn pictures_are_those_that_the_article_uses() {
    let share = |name: &str, kind: SheetKind| {
        let field = recipe_field(name);
        let found: usize = field.clouds.iter().map(|c| sprites_of(c, kind)).sum();
        found as f32 / field.sprite_count() as f32
    };
    assert!(share("stratus.toml", SheetKind::Foggy) > 0.6);
    assert!(share("stratus.toml", SheetKind::Wispy) > 0.1);
    assert!(share("stratocumulus.toml", SheetKind::Foggy) > 0.1);
    assert!(share("cumulus.toml", SheetKind::Puffy) > 0.6);
    assert!((0.01..0.3).contains(&share("cumulus.toml", SheetKind::Wispy)));
    assert_eq!(share("cirrus.toml", SheetKind::Wispy), 1.0);
}

#[test]
fn a_storm_cloud_has_an_anvil_of_wisps_wider_than_its_tower() {
    for cloud in recipe_field("cumulonimbus.toml").clouds {
        if cloud.kind != CloudKind::Cumulonimbus {
            continue;
        }
        let top = cloud.centre_m[1] + 0.25 * cloud.size_m[1];
        let width = |category: Category| {
            let boxes = cloud.boxes.iter();
            let boxes = boxes.filter(|b| b.category == category && b.centre_m[1] > top);
            let ends = boxes.flat_map(|b| [-0.5, 0.5].map(|s| b.centre_m[0] + s * b.size_m[0]));
            let ends: Vec<f32> = ends.collect();
            let pick = |pick: fn(f32, f32) -> f32| ends.iter().copied().reduce(pick).unwrap();
            pick(f32::max) - pick(f32::min)
        };
        assert!(width(Category::Wispy) > 2.0 * width(Category::Cumulus));
    }
}

#[test]
fn an_overcast_sky_has_a_hundred_thousand_sprites_in_sight() {
    let field = recipe_field("overcast.toml");
    let sections = (field.sections * field.sections) as usize;
    // Within 30 km are 30^2 pi / 16 = 177 sections.
    assert!(field.sprite_count() * 177 / sections >= 100_000);
}

#[test]
fn every_picture_of_the_sheet_is_in_the_default_field() {
    let field = field("");
    for cell in 0..SheetCell::COUNT {
        let mut sprites = field.clouds.iter().flat_map(|cloud| &cloud.sprites);
        assert!(sprites.any(|sprite| sprite.cell == cell), "{cell}");
    }
}

/// Sprites of each shading group of clouds that have two groups of thirty or more.
fn group_sizes(field: &Field) -> Vec<usize> {
    let large = field.clouds.iter().filter(|c| c.sprites.len() >= 60);
    let sizes = large.flat_map(|cloud| {
        let mut sizes = vec![0; cloud.groups_m.len()];
        for sprite in &cloud.sprites {
            sizes[usize::from(cloud.boxes[usize::from(sprite.cloud_box)].group)] += 1;
        }
        sizes
    });
    sizes.collect()
}

/// The article's groups are of some 30 sprites; a cloud of fewer is one.
#[test]
fn shading_groups_have_about_thirty_sprites() {
    for name in ["", "congestus.toml", "cumulonimbus.toml", "overcast.toml"] {
        let field = if name.is_empty() {
            field("")
        } else {
            recipe_field(name)
        };
        for cloud in &field.clouds {
            let groups = cloud.groups_m.len();
            assert!(groups == 1 || cloud.sprites.len() >= 45, "{name}: {groups}");
            let filled = (0..groups).all(|g| cloud.boxes.iter().any(|b| usize::from(b.group) == g));
            assert!(filled, "{name}: every group has a box");
        }
        let sizes = group_sizes(&field);
        let mean = sizes.iter().sum::<usize>() as f32 / sizes.len().max(1) as f32;
        println!("{name}: {} groups of {mean} sprites", sizes.len());
        assert!(
            sizes.is_empty() || (24.0..38.0).contains(&mean),
            "{name}: {mean}"
        );
    }
}

#[test]
fn an_artists_shading_groups_are_as_the_artist_says() {
    let of_box = |x: i32, group: u32| {
        format!(
            "[[field.models.boxes]]\ncentre_m = [{x}, 100, 0]\nsize_m = [600, 200, 600]\nsprites = 8\ngroup = {group}\n"
        )
    };
    let boxes: String = (0..3).map(|i| of_box(900 * i, i as u32)).collect();
    let cloud = &field(&format!("[[field.models]]\nkind = \"cumulus\"\n{boxes}")).clouds[0];
    assert_eq!(cloud.groups_m.len(), 3);
}

#[test]
fn the_default_field_is_small() {
    let field = field("");
    assert!(
        (5000..=7000).contains(&field.sprite_count()),
        "{}",
        field.sprite_count()
    );
    let kinds: Vec<CloudKind> = field.clouds.iter().map(|c| c.kind).collect();
    assert_eq!(kinds[0], CloudKind::Cumulus);
    assert_eq!(kinds[kinds.len() - 1], CloudKind::Stratocumulus);
}
