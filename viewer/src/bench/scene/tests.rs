//! What is timed is what its row says.

use super::*;

fn all_scenes(method: Method) -> Vec<Scene> {
    scenes(method, 10_000.0)
}

#[test]
fn sky_fills_the_frame_of_the_benchmark_however_wide_it_is() {
    for scene in Method::DOMES.into_iter().flat_map(all_scenes) {
        for width in [100, 133, 178, 400] {
            let rays = scene.camera([width, 100], 0).rays();
            for x in [-1.0, 1.0] {
                let corner = rays.forward - rays.up + rays.right * x;
                assert!(corner.y > 0.0, "{} {width}", scene.name());
            }
        }
    }
}

#[test]
fn every_row_is_of_its_method_by_a_name_of_its_own_and_in_range() {
    for method in Method::ALL {
        let scenes = all_scenes(method);
        assert!(scenes.iter().all(|s| s.method() == method));
        let mut names: Vec<String> = scenes.iter().map(Scene::name).collect();
        names.sort();
        names.dedup();
        assert_eq!(names.len(), scenes.len());
        for frame in [0, 1] {
            assert!(scenes.iter().all(|s| s.params(frame).check().is_ok()));
        }
    }
}

#[test]
fn alone_leaves_the_clouds_as_they_are_and_nothing_else_on() {
    for method in Method::DOMES {
        let all = all_scenes(method);
        for scene in all.iter().filter(|s| s.label.starts_with("alone")) {
            let p = scene.params(0);
            assert!(!p.sun && !p.stars, "{}", scene.name());
            assert_eq!([p.flare, p.skybox, p.upper_layer], [0.0; 3]);
            assert_eq!(p.cover, SkyParams::default().cover);
        }
    }
}

#[test]
fn octaves_are_timed_for_each_count() {
    let all = all_scenes(Method::Octaves);
    let counts: Vec<u32> = all[4..].iter().map(|s| s.params(0).octaves.count).collect();
    assert_eq!(counts, [1, 2, 3, 4, 5, 6, 7, 8]);
}

#[test]
fn the_protocol_is_lit_with_three_layers_shade_and_shadow_by_day_evening_and_night() {
    let scenes = scenes_of_mukhina();
    let labels: Vec<&str> = scenes.iter().map(|s| s.label.as_str()).collect();
    assert_eq!(labels, ["noon", "low sun", "night"]);
    let noon_elevation_rad = 1.0;
    let heights: Vec<f32> = scenes
        .iter()
        .map(|s| welkin_pack::mapping::sun_direction(s.params(0).time, noon_elevation_rad)[1])
        .collect();
    // Up by the noon's height, less than ten degrees up, and down.
    assert!(
        (heights[0] - noon_elevation_rad.sin()).abs() < 1e-3,
        "{heights:?}"
    );
    assert!(
        heights[1] > 0.0 && heights[1] < 0.17 && heights[2] < -0.5,
        "{heights:?}"
    );
    for scene in &scenes {
        let p = scene.params(0);
        assert_eq!(
            (p.method, p.sky, p.check()),
            (Method::Lit, SkyModel::Perez, Ok(()))
        );
        assert_eq!(p.lit.layers.iter().filter(|l| l.share > 0.0).count(), 3);
        assert_eq!(p.shadow_extent_m, 8000.0);
        // Light that comes through is scattered.
        assert!(p.lit.k1 > 0.0 && p.lit.k2 > 0.0);
    }
}

#[test]
fn layers_are_timed_one_three_and_six() {
    let all = all_scenes(Method::Lit);
    let counts = |label: &str| {
        let scene = all.iter().find(|s| s.label == label).unwrap();
        let layers = scene.params(0).lit.layers;
        layers.iter().filter(|l| l.share > 0.0).count()
    };
    let labels = ["alone, 1 layer", "alone", "alone, 6 layers"];
    assert_eq!(labels.map(counts), [1, 3, 6]);
}

#[test]
fn fields_are_timed_with_and_without_the_ring_and_while_it_is_made_anew() {
    for of in SpriteScene::ALL {
        let [_, alone, ring, anew] = scenes_of_sprites(of, 10_000.0);
        let radius = |scene: &Scene| scene.params(0).sprites.ring_radius_m;
        assert_eq!(radius(&alone), 0.0);
        assert!(radius(&ring) > 0.0 && radius(&ring) == radius(&anew));
        let north = |frame: u32| -anew.camera([160, 90], frame).position_m.z;
        // Each ring that is ready is stale.
        assert_eq!(north(RING_FRAMES - 1), north(0));
        assert!(north(RING_FRAMES) - north(0) > 0.15 * radius(&anew));
        assert_eq!(north(2 * RING_FRAMES), north(0));
        assert_eq!(alone.camera([160, 90], 24), alone.camera([160, 90], 0));
    }
    let covers = SpriteScene::ALL.map(SpriteScene::cover);
    assert_eq!(covers.map(|cover| cover * 8.0), [2.0, 5.0, 8.0]);
}

#[test]
fn only_the_row_of_a_moving_sun_moves_it_and_far_enough_for_octaves_to_be_packed_anew() {
    for scene in Method::ALL.into_iter().flat_map(all_scenes) {
        let times = [0, 1].map(|frame| scene.params(frame).time);
        if scene.label != "alone, sun moves" {
            assert_eq!(times[0], times[1]);
            continue;
        }
        // Of an hour-long way the sun takes the same share, wherever it stands at noon.
        let [a, b] = times.map(|time| welkin_pack::mapping::sun_direction(time, 1.0));
        let cosine: f32 = (0..3).map(|i| a[i] * b[i]).sum();
        assert!(cosine.acos() > 2.0 * welkin_runtime::internals::clouds::march::CELL_RAD as f32);
    }
}
