//! The promise of the same bytes: threads, seeds, and channels that do not disturb each other.

use std::ops::ControlFlow;
use std::sync::Mutex;

use crate::common::{self, image, images};
use welkin_baker::{BakeError, Recipe, bake};
use welkin_pack::{Role, Source};

fn bake_images(text: &str, seed: Option<u64>) -> Vec<Source> {
    common::bake(text, seed).1
}

fn channel(sources: &[Source], role: Role, channel: usize) -> Vec<f32> {
    image(sources, role).channel(channel).collect()
}

const SMALL: &str = "[clouds]\nsize = 128\n";

#[test]
fn threads_change_nothing() {
    let with = |threads| {
        let pool = rayon::ThreadPoolBuilder::new()
            .num_threads(threads)
            .build()
            .unwrap();
        pool.install(|| bake_images("", None))
    };
    assert!(with(1) == with(8));
}

#[test]
fn another_seed_changes_every_random_channel_and_no_other() {
    let (one, two) = (bake_images(SMALL, Some(1)), bake_images(SMALL, Some(2)));
    for (role, c) in [
        (Role::Clouds, 1),
        (Role::Clouds, 2),
        (Role::Stars, 0),
        (Role::Stars, 1),
        (Role::Stars, 3),
        (Role::Galaxy, 0),
        (Role::Octaves, 0),
        (Role::Octaves, 3),
        (Role::Fbm, 3),
        (Role::Flares, 0),
        (Role::Layers, 2),
        (Role::Sprites, 0),
        (Role::Sprites, 1),
    ] {
        assert!(
            channel(&one, role, c) != channel(&two, role, c),
            "{role:?} {c}"
        );
    }
    for (role, c) in [(Role::Clouds, 0), (Role::Clouds, 3)] {
        assert!(
            channel(&one, role, c) == channel(&two, role, c),
            "{role:?} {c}"
        );
    }
    for role in [Role::Sky, Role::Sun] {
        assert!(image(&one, role) == image(&two, role), "{role:?}");
    }
}

#[test]
fn settings_of_one_channel_leave_the_others_alone() {
    let plain = bake_images(SMALL, None);
    let noise = bake_images(
        &format!("{SMALL}[clouds.noise]\ncells = 6\noctaves = 2\n"),
        None,
    );
    assert!(channel(&plain, Role::Clouds, 1) != channel(&noise, Role::Clouds, 1));
    for c in [0, 2, 3] {
        assert!(
            channel(&plain, Role::Clouds, c) == channel(&noise, Role::Clouds, c),
            "clouds {c}"
        );
    }
    for role in [
        Role::Stars,
        Role::Galaxy,
        Role::Sky,
        Role::Sun,
        Role::Octaves,
        Role::Fbm,
        Role::Flares,
        Role::Layers,
        Role::Sprites,
    ] {
        assert!(image(&plain, role) == image(&noise, role), "{role:?}");
    }
    // Fewer magnitudes dim no star's neighbours: places and phases stay.
    let stars = bake_images(&format!("{SMALL}[stars]\nmagnitudes = 3\n"), None);
    assert!(channel(&plain, Role::Stars, 0) != channel(&stars, Role::Stars, 0));
    assert!(channel(&plain, Role::Stars, 3) == channel(&stars, Role::Stars, 3));
    // More layers leave the first ones as they were.
    let more = bake_images(&format!("{SMALL}[fbm]\noctaves = 5\n"), None);
    let (few, many) = (images(&plain, Role::Fbm), images(&more, Role::Fbm));
    assert!(many.len() == 5 && few == &many[..4]);
    // Each kind of cloud has a stream and settings of its own.
    let heaps = bake_images(&format!("{SMALL}[layers.cumulus]\ncells = 5\n"), None);
    let (before, after) = (images(&plain, Role::Layers), images(&heaps, Role::Layers));
    assert!(before[0] == after[0] && before[1] != after[1] && before[2] == after[2]);
}

#[test]
fn progress_counts_up_and_can_stop_the_bake_anywhere() {
    let resolved = Recipe::parse("sky.toml", SMALL)
        .unwrap()
        .resolve(None)
        .unwrap();
    let seen = Mutex::new(Vec::new());
    let pack = bake(&resolved, None, &|p| {
        seen.lock().unwrap().push(p);
        ControlFlow::Continue(())
    });
    pack.unwrap();
    let seen = seen.into_inner().unwrap();
    let total = seen[0].total;
    assert_eq!(
        seen.iter().map(|p| p.done).collect::<Vec<_>>(),
        (0..=total).collect::<Vec<_>>()
    );
    assert!(seen.iter().all(|p| p.total == total && !p.step.is_empty()));
    for last in 0..=total {
        let stop = |p: welkin_baker::Progress| {
            if p.done == last {
                ControlFlow::Break(())
            } else {
                ControlFlow::Continue(())
            }
        };
        assert!(
            matches!(bake(&resolved, None, &stop), Err(BakeError::Cancelled)),
            "at {last}"
        );
    }
}
