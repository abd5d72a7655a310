//! The frames that are timed: what each row of the table draws.
//!
//! The camera looks up far enough that sky fills the whole frame, and towards the sun, so that the sun and its
//! flare are paid for.

use welkin_pack::LayerKind;
use welkin_runtime::params::{MAX_LAYERS, MAX_OCTAVES};
use welkin_runtime::{
    Camera, LitLayer, LitParams, Method, OctaveParams, SkyModel, SkyParams, WeatherParams,
};

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
    /// Whether the sun goes to and fro by [`SUN_STEP`].
    sun_moves: bool,
}

/// The rows of a method.
pub fn scenes(method: Method) -> Vec<Scene> {
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
    match method {
        // What is behind the clouds is the same for every method.
        Method::Packed => scenes.push(scene("alone, Perez sky", alone(perez), SOUTH_DEG)),
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
    }
    scenes
}

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

    /// The camera of all of its frames.
    pub fn camera(&self, size: [u32; 2]) -> Camera {
        Camera::looking(
            self.azimuth_deg.to_radians(),
            CAMERA_ELEVATION_DEG.to_radians(),
            CAMERA_FOV_DEG.to_radians(),
            size,
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sky_fills_the_frame_of_the_benchmark_however_wide_it_is() {
        for scene in Method::ALL.into_iter().flat_map(scenes) {
            for width in [100, 133, 178, 400] {
                let rays = scene.camera([width, 100]).rays();
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
            let scenes = scenes(method);
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
        for method in Method::ALL {
            let all = scenes(method);
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
        let all = scenes(Method::Octaves);
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
        let all = scenes(Method::Lit);
        let counts = |label: &str| {
            let scene = all.iter().find(|s| s.label == label).unwrap();
            let layers = scene.params(0).lit.layers;
            layers.iter().filter(|l| l.share > 0.0).count()
        };
        let labels = ["alone, 1 layer", "alone", "alone, 6 layers"];
        assert_eq!(labels.map(counts), [1, 3, 6]);
    }

    #[test]
    fn only_the_row_of_a_moving_sun_moves_it_and_far_enough_for_octaves_to_be_packed_anew() {
        for scene in Method::ALL.into_iter().flat_map(scenes) {
            let times = [0, 1].map(|frame| scene.params(frame).time);
            if scene.label != "alone, sun moves" {
                assert_eq!(times[0], times[1]);
                continue;
            }
            // Of an hour-long way the sun takes the same share, wherever it stands at noon.
            let [a, b] = times.map(|time| welkin_pack::mapping::sun_direction(time, 1.0));
            let cosine: f32 = (0..3).map(|i| a[i] * b[i]).sum();
            assert!(cosine.acos() > 2.0 * welkin_runtime::fbm_pack::CELL_RAD as f32);
        }
    }
}
