//! The same bytes twice, with any number of threads, in debug and in release.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

use std::ops::ControlFlow;
use std::process::Command;

use welkin_baker::{DEFAULT_RECIPE, Recipe, bake};
use welkin_pack::Pack;

fn baked(threads: usize, seed: Option<u64>) -> Pack {
    let resolved = Recipe::parse("default.toml", DEFAULT_RECIPE)
        .unwrap()
        .resolve(seed)
        .unwrap();
    let pool = rayon::ThreadPoolBuilder::new()
        .num_threads(threads)
        .build()
        .unwrap();
    pool.install(|| bake(&resolved, None, &|_| ControlFlow::Continue(())))
        .unwrap()
}

#[test]
fn threads_and_repetition_change_no_byte() {
    let one = baked(1, None);
    for (threads, what) in [
        (1, "baked again"),
        (8, "with 8 threads"),
        (3, "with 3 threads"),
    ] {
        for ((name, a), (_, b)) in one.files().iter().zip(baked(threads, None).files()) {
            assert!(a == b, "{name} differs {what}");
        }
    }
}

#[test]
fn another_seed_changes_what_is_random_and_nothing_else() {
    let (one, two) = (baked(2, None), baked(2, Some(2)));
    for (a, b) in one.manifest().textures.iter().zip(&two.manifest().textures) {
        let random = !matches!(a.role.name(), "sky" | "sun");
        assert_eq!(
            a.texels_blake3 != b.texels_blake3,
            random,
            "{}",
            a.role.name()
        );
    }
}

/// Bakes with the release build of `welkin`, whose path `make test` gives in WELKIN_RELEASE, and
/// compares its files with those of this (debug) build's library.
#[test]
#[ignore = "needs the release build: `make test` runs it"]
fn debug_and_release_bake_the_same_bytes() {
    let welkin =
        std::env::var("WELKIN_RELEASE").expect("WELKIN_RELEASE names the release build of welkin");
    let place = tempfile::tempdir().unwrap();
    let here = baked(2, None);
    for threads in ["1", "8"] {
        let folder = place.path().join(threads);
        let status = Command::new(&welkin)
            .args(["bake", "--threads", threads, "-o"])
            .arg(&folder)
            .status()
            .unwrap();
        assert!(status.success());
        for (name, bytes) in here.files() {
            assert!(
                *bytes == std::fs::read(folder.join(name)).unwrap(),
                "{name} differs with --threads {threads}"
            );
        }
    }
}
