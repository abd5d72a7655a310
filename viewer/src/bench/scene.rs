//! The frames that are timed: what each row of the table draws.
//!
//! The camera looks up far enough that sky fills the whole frame, and towards the sun, so that the sun and its
//! flare are paid for.

use clap::ValueEnum;
use welkin_pack::LayerKind;
use welkin_runtime::internals::sprites::ring;
use welkin_runtime::params::{
    LitLayer, LitParams, OctaveParams, SkyModel, SpriteParams, WeatherParams,
};
use welkin_runtime::params::{MAX_LAYERS, MAX_OCTAVES, MOST_DISTANCE_M};
use welkin_runtime::{Camera, Method, SkyParams};

/// With this the lower edge of the frame is 20 degrees above the horizon at its middle, and above it
/// everywhere, however wide the frame is.
pub const CAMERA_ELEVATION_DEG: f32 = 50.0;
const CAMERA_FOV_DEG: f32 = 60.0;

/// Azimuths of the sun at noon and at sunset.
const SOUTH_DEG: f32 = 180.0;
const WEST_DEG: f32 = 270.0;

/// What the time of day changes by from frame to frame where the sun moves: seven degrees of the sun's way, many
/// times what it takes for octaves to be packed anew.
const SUN_STEP: f32 = 0.02;

/// Side of the ground whose shadows are drawn, in metres: about as far as the lowest layer's texture reaches.
pub const SHADOW_EXTENT_M: f32 = 8_000.0;

/// A frame, drawn again and again.
#[derive(Clone, Debug, PartialEq)]
pub struct Scene {
    /// What it shows, within its method.
    pub label: String,
    params: SkyParams,
    azimuth_deg: f32,
    elevation_deg: f32,
    /// Metres up.
    height_m: f32,
    /// Metres to the north that the viewer jumps to and fro, each time a ring of impostors is ready.
    jump_m: f32,
    /// Whether the sun goes to and fro by [`SUN_STEP`].
    sun_moves: bool,
}

/// The rows of a method; the ring is of sprites alone.
pub fn scenes(method: Method, ring_radius_m: f32) -> Vec<Scene> {
    let usual = SkyParams {
        method,
        ..SkyParams::default()
    };
    let perez = SkyParams {
        sky: SkyModel::Perez,
        ..usual
    };
    let mut scenes = vec![
        scene("noon", usual, SOUTH_DEG),
        scene("sunset", sunset(usual), WEST_DEG),
        scene("night", night(usual), SOUTH_DEG),
        scene("alone", alone(usual), SOUTH_DEG),
    ];
    // What is behind the clouds is the same for every method.
    if method == Method::Packed {
        scenes.push(scene("alone, Perez sky", alone(perez), SOUTH_DEG));
    }
    match method {
        Method::Octaves => scenes.extend((1..=MAX_OCTAVES).map(|count| {
            let label = format!("alone, {count} octave{}", if count == 1 { "" } else { "s" });
            let octaves = OctaveParams {
                count,
                ..usual.octaves
            };
            scene(&label, alone(SkyParams { octaves, ..usual }), SOUTH_DEG)
        })),
        Method::Fbm => scenes.push(Scene {
            sun_moves: true,
            ..scene("alone, sun moves", alone(usual), SOUTH_DEG)
        }),
        Method::Lit => scenes.extend(scenes_of_lit(usual)),
        Method::Sprites => {
            let scenes = |of| scenes_of_sprites(of, ring_radius_m);
            return SpriteScene::ALL.into_iter().flat_map(scenes).collect();
        }
        _ => {}
    }
    scenes
}

/// A field of clouds by how much of it there is, as in figure 5 of Wang's article.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum SpriteScene {
    /// Two oktas
    Sparse,
    /// Five oktas
    Broken,
    /// Eight oktas: every sprite of the field
    Overcast,
}

impl SpriteScene {
    /// All of them.
    pub const ALL: [SpriteScene; 3] = [
        SpriteScene::Sparse,
        SpriteScene::Broken,
        SpriteScene::Overcast,
    ];

    /// Its name in the table.
    fn name(self) -> String {
        format!("{self:?}").to_lowercase()
    }

    fn cover(self) -> f32 {
        match self {
            SpriteScene::Sparse => 0.25,
            SpriteScene::Broken => 0.625,
            SpriteScene::Overcast => 1.0,
        }
    }
}

/// The dome without clouds; sprites alone; with the ring; and with a ring that is always being made anew.
pub fn scenes_of_sprites(of: SpriteScene, ring: f32) -> [Scene; 4] {
    let usual = SkyParams {
        method: Method::Sprites,
        cover: of.cover(),
        flare: 0.0,
        ..SkyParams::default()
    };
    let sprites = |ring_radius_m: f32| SkyParams {
        sprites: SpriteParams {
            distance_m: SPRITE_SIGHT_M,
            ring_radius_m,
            // Every sprite, however far: what is timed is how many there are.
            billboards_beyond_m: MOST_DISTANCE_M,
            ..usual.sprites
        },
        ..usual
    };
    let among = |label: &str, ring_radius_m: f32, jump_m: f32| Scene {
        elevation_deg: SPRITE_ELEVATION_DEG,
        height_m: SPRITE_HEIGHT_M,
        jump_m,
        ..scene(
            &format!("{}, {label}", of.name()),
            sprites(ring_radius_m),
            SOUTH_DEG,
        )
    };
    let jump = JUMP * ring;
    let clear = SkyParams {
        cover: 0.0,
        ..sprites(0.0)
    };
    [
        Scene {
            params: clear,
            ..among("no clouds", 0.0, 0.0)
        },
        among("sprites alone", 0.0, 0.0),
        among("ring", ring, 0.0),
        among("ring made anew", ring, jump),
    ]
}

/// So far that an overcast of the default field has more than 100,000 sprites on a screen of 16 to 9.
const SPRITE_SIGHT_M: f32 = 55_000.0;
/// Frames that a ring takes at that sight: two for each picture, the fade, and one each to begin and to end.
const RING_FRAMES: u32 = 2 * ring::PICTURES as u32 + ring::FADE_FRAMES + 2;
/// How far a jump goes, over the radius of the ring: just beyond the 0.15 that a ring is good for.
const JUMP: f32 = 0.151;
/// Level flight below the clouds: the horizon, where most of them are, is in the middle.
const SPRITE_ELEVATION_DEG: f32 = 0.0;
const SPRITE_HEIGHT_M: f32 = 300.0;

/// What an iteration of layers costs, and what else only this method or the weather draws.
fn scenes_of_lit(usual: SkyParams) -> Vec<Scene> {
    let with_layers = |count: usize| SkyParams {
        lit: LitParams::with_layers(&vec![LitLayer::of(LayerKind::Stratocumulus, 1.0); count]),
        ..usual
    };
    let shadow = SkyParams {
        shadow_extent_m: SHADOW_EXTENT_M,
        ..usual
    };
    let weather = |rays, rain| SkyParams {
        weather: WeatherParams {
            rays,
            rain,
            ..usual.weather
        },
        ..usual
    };
    vec![
        scene("alone, 1 layer", alone(with_layers(1)), SOUTH_DEG),
        scene("alone, 6 layers", alone(with_layers(MAX_LAYERS)), SOUTH_DEG),
        scene("alone, ground shadow", alone(shadow), SOUTH_DEG),
        scene("noon, rays", weather(1.0, 0.0), SOUTH_DEG),
        scene("noon, rain", weather(0.0, 1.0), SOUTH_DEG),
    ]
}

/// What the protocol of Mukhina and Bezgodov draws: three layers before the sky of Perez, as in their paper, and the clouds'
/// shadow on the ground. Their time of day is not told; noon is the plainest, and where the light differs follows.
pub fn scenes_of_mukhina() -> Vec<Scene> {
    let usual = SkyParams {
        method: Method::Lit,
        sky: SkyModel::Perez,
        shadow_extent_m: SHADOW_EXTENT_M,
        ..SkyParams::default()
    };
    vec![
        scene("noon", usual, SOUTH_DEG),
        scene("low sun", sunset(usual), WEST_DEG),
        scene("night", night(usual), SOUTH_DEG),
    ]
}

fn scene(label: &str, params: SkyParams, azimuth_deg: f32) -> Scene {
    Scene {
        label: label.to_string(),
        params,
        azimuth_deg,
        elevation_deg: CAMERA_ELEVATION_DEG,
        height_m: 0.0,
        jump_m: 0.0,
        sun_moves: false,
    }
}

/// The sun is three degrees above the western horizon.
fn sunset(params: SkyParams) -> SkyParams {
    SkyParams {
        time: 0.74,
        sunset: 1.0,
        ..params
    }
}

fn night(params: SkyParams) -> SkyParams {
    SkyParams {
        time: 0.0,
        ..params
    }
}

/// The clouds and the sky behind them, everything else off.
fn alone(params: SkyParams) -> SkyParams {
    SkyParams {
        sun: false,
        stars: false,
        flare: 0.0,
        skybox: 0.0,
        upper_layer: 0.0,
        ..params
    }
}

impl Scene {
    /// Its name in the table.
    pub fn name(&self) -> String {
        format!("{}, {}", self.method().name(), self.label)
    }

    /// The method that it shows.
    pub fn method(&self) -> Method {
        self.params.method
    }

    /// Parameters of one of its frames.
    pub fn params(&self, frame: u32) -> SkyParams {
        let steps = if self.sun_moves { frame % 2 } else { 0 };
        SkyParams {
            time: self.params.time + SUN_STEP * steps as f32,
            ..self.params
        }
    }

    /// The camera of one of its frames.
    pub fn camera(&self, size: [u32; 2], frame: u32) -> Camera {
        let angles = [self.azimuth_deg, self.elevation_deg, CAMERA_FOV_DEG];
        let [azimuth_rad, elevation_rad, fov_rad] = angles.map(f32::to_radians);
        let north_m = self.jump_m * (frame / RING_FRAMES % 2) as f32;
        Camera {
            position_m: [0.0, self.height_m, -north_m].into(),
            ..Camera::looking(azimuth_rad, elevation_rad, fov_rad, size)
        }
    }
}

#[cfg(test)]
mod tests {
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
            assert!(
                cosine.acos() > 2.0 * welkin_runtime::internals::clouds::fbm::pack::CELL_RAD as f32
            );
        }
    }
}
