//! A cloud goes to an artist as a model and comes back sprite by sprite.

use std::path::Path;

use welkin_baker::{Recipe, cloud_field, cloud_model};
use welkin_pack::Field;
use welkin_pack::field::{Cloud, CloudKind, Sprite};

use super::{problems, recipe_field};

/// The field of one copy of a model.
fn baked(kind: CloudKind, model: &[u8], folder: &Path) -> Field {
    std::fs::write(folder.join("cloud.glb"), model).unwrap();
    let text = format!(
        "[field]\nsections = 1\n[[field.models]]\nkind = \"{}\"\nfile = \"cloud.glb\"\nbase_m = 1000.0\n",
        kind.name()
    );
    let resolved = Recipe::parse("sky.toml", &text)
        .unwrap()
        .resolve(None)
        .unwrap();
    cloud_field(
        resolved.field.as_ref().unwrap(),
        Some(folder),
        resolved.seed,
    )
    .unwrap()
}

/// Sprites about the middle of all of them, in an order of their own.
fn about_their_middle(sprites: &[Sprite]) -> Vec<[f32; 7]> {
    let low = [0, 1, 2].map(|i| {
        sprites
            .iter()
            .map(|s| s.centre_m[i])
            .fold(f32::MAX, f32::min)
    });
    let row = |s: &Sprite| {
        let [x, y, z] = [0, 1, 2].map(|i| s.centre_m[i] - low[i]);
        [
            x,
            y,
            z,
            s.size_m[0],
            s.size_m[1],
            s.rotation_rad,
            f32::from(s.cell),
        ]
    };
    let mut rows: Vec<[f32; 7]> = sprites.iter().map(row).collect();
    rows.sort_by(|a, b| a.partial_cmp(b).unwrap());
    rows
}

fn first(name: &str, kind: CloudKind) -> Cloud {
    let field = recipe_field(name);
    field
        .clouds
        .into_iter()
        .find(|cloud| cloud.kind == kind)
        .unwrap()
}

#[test]
fn a_cloud_that_is_written_as_a_model_is_baked_again_sprite_by_sprite() {
    let folder = tempfile::tempdir().unwrap();
    for (name, kind) in [
        ("cumulus.toml", CloudKind::Cumulus),
        ("cumulonimbus.toml", CloudKind::Cumulonimbus),
        ("stratus.toml", CloudKind::Stratus),
        ("cirrus.toml", CloudKind::Cirrus),
    ] {
        let cloud = first(name, kind);
        let field = baked(kind, &cloud_model(&cloud), folder.path());
        assert_eq!(field.clouds.len(), 1);
        let again = &field.clouds[0];
        assert_eq!(
            about_their_middle(&again.sprites),
            about_their_middle(&cloud.sprites),
            "{name}"
        );
        assert_eq!(again.groups_m.len(), cloud.groups_m.len(), "{name}");
        let group = |c: &Cloud, s: &Sprite| c.boxes[usize::from(s.cloud_box)].group;
        let count = |c: &Cloud| {
            let mut counts = vec![0; c.groups_m.len()];
            c.sprites
                .iter()
                .for_each(|s| counts[usize::from(group(c, s))] += 1);
            counts
        };
        assert_eq!(count(again), count(&cloud), "{name}: shading groups");
        let counts = problems(&field);
        assert!(
            counts.iter().all(|found| found.contains("field.sections")),
            "{name}: {counts:#?}"
        );
    }
}

/// What an artist does: one sprite is moved, one taken away; all others stay as they were.
#[test]
fn one_sprite_is_moved_and_another_taken_away() {
    let folder = tempfile::tempdir().unwrap();
    let cloud = first("cumulus.toml", CloudKind::Cumulus);
    let mut edited = cloud.clone();
    edited.sprites.pop();
    let lowest = |sprites: &[Sprite], axis: usize| {
        (0..sprites.len())
            .min_by(|a, b| sprites[*a].centre_m[axis].total_cmp(&sprites[*b].centre_m[axis]))
    };
    // Not one of those that the others are measured from.
    let at_the_rim = [0, 1, 2].map(|axis| lowest(&edited.sprites, axis).unwrap());
    let moved = (0..edited.sprites.len())
        .find(|i| !at_the_rim.contains(i))
        .unwrap();
    edited.sprites[moved].centre_m[1] += 12.5;
    let field = baked(cloud.kind, &cloud_model(&edited), folder.path());
    assert_eq!(
        about_their_middle(&field.clouds[0].sprites),
        about_their_middle(&edited.sprites)
    );
    assert_eq!(field.clouds[0].sprites.len(), cloud.sprites.len() - 1);
}
