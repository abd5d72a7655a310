//! The CPU's part of a frame: what it draws, and that it allocates nothing.

use glam::DVec3;
use welkin_runtime::internals::sprites::grid::{BlockId, around};
use welkin_runtime::internals::sprites::instances::Instance;
use welkin_runtime::internals::sprites::scene::Scene;
use welkin_tests::pack;

use super::params;

const SIGHT_M: f32 = 30_000.0;
const BILLBOARDS_M: [f32; 2] = [51_000.0, 60_000.0];

fn scene() -> Scene {
    let mut scene = Scene::new(pack::default_pack().field().unwrap());
    scene.fit(SIGHT_M);
    scene.form(&params(), 0.0);
    scene
}

/// How many of the instances of whole rows are sprites: the rest are empty.
fn shown(rows: &[Instance]) -> usize {
    rows.iter().filter(|i| i.size[0] > 0).count()
}

/// Draws every block in sight; gives how many sprites there are and how many were uploaded.
fn draw(scene: &mut Scene, viewer: DVec3) -> [usize; 2] {
    let (mut count, mut uploaded) = (0, 0);
    for block in around(viewer, f64::from(SIGHT_M)) {
        let upload = |_: u32, instances: &[Instance]| uploaded += shown(instances);
        let draw = scene.draw(block, viewer, viewer, 1.0, BILLBOARDS_M, upload);
        count += draw.map_or(0, |draw| draw.count as usize);
    }
    [count, uploaded]
}

#[test]
fn a_still_viewer_sorts_nothing_and_one_who_moves_only_what_is_near() {
    let mut scene = scene();
    let viewer = DVec3::new(100.0, 900.0, 4500.0);
    let [count, first] = draw(&mut scene, viewer);
    assert!(count > 50_000, "{count}");
    assert_eq!(first, count);
    assert_eq!(draw(&mut scene, viewer), [count, 0]);
    let [_, moved] = draw(&mut scene, viewer + DVec3::new(5.0, 0.0, 0.0));
    assert!(moved > 0 && moved < count / 10, "{moved} of {count}");
}

#[test]
fn a_frame_allocates_nothing() {
    let mut scene = scene();
    draw(&mut scene, DVec3::ZERO);
    let allocated = allocation_counter::measure(|| {
        for step in 1..20 {
            let viewer = DVec3::new(f64::from(step) * 700.0, 1200.0, 0.0);
            scene.form(&params(), f64::from(step) * 60.0);
            scene.lock(viewer);
            draw(&mut scene, viewer);
        }
    });
    assert_eq!(allocated.count_total, 0, "{allocated:?}");
}

#[test]
fn sprites_are_drawn_the_farthest_first() {
    let mut scene = scene();
    let viewer = DVec3::new(2100.0, 1100.0, 1900.0);
    let mut places = Vec::new();
    let block = BlockId { east: 0, south: 0 };
    scene.draw(block, viewer, viewer, 1.0, BILLBOARDS_M, |_, instances| {
        let shown = instances.iter().take(shown(instances));
        places.extend(shown.map(|i| i.centre_m().as_dvec3()));
    });
    let distances: Vec<f64> = places.iter().map(|p| p.distance(viewer)).collect();
    // The place that they are sorted from is within four metres of the viewer on each axis.
    let sorted = |pair: &[f64]| pair[0] >= pair[1] - 2.0 * 4.0 * 3.0_f64.sqrt();
    assert!(distances.len() > 100 && distances.windows(2).all(sorted));
}

#[test]
fn memory_is_bounded_whatever_the_sight() {
    let scene = scene();
    for distance in [8000.0, 30_000.0, 60_000.0] {
        assert_eq!(scene.sight_m(distance, u32::MAX), distance);
        // A device with small textures sees less far, and is not asked for more.
        let less = scene.sight_m(distance, 512);
        assert!(less <= distance && scene.rows(less) <= 512, "{less}");
    }
    // Sixteen kilobytes a row: with the largest texture that WebGL2 promises, 32 megabytes.
    assert!(scene.rows(scene.sight_m(60_000.0, 2048)) <= 2048);
}
