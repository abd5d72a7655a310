//! The frames that are timed: what each row of the table draws.
//!
//! The camera looks up far enough that sky fills the whole frame, and towards the sun, so that the sun and its
//! flare are paid for.

use welkin_runtime::params::MAX_OCTAVES;
use welkin_runtime::{Camera, Method, OctaveParams, SkyModel, SkyParams};

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
    let sunset = SkyParams {
        time: 0.74,
        sunset: 1.0,
        ..usual
    };
    let night = SkyParams { time: 0.0, ..usual };
    let perez = SkyParams {
        sky: SkyModel::Perez,
        ..usual
    };
    let scene = |label: &str, params: SkyParams, azimuth_deg: f32| Scene {
        label: label.to_string(),
        params,
        azimuth_deg,
        sun_moves: false,
    };
    let mut scenes = vec![
        scene("noon", usual, SOUTH_DEG),
        scene("sunset", sunset, WEST_DEG),
        scene("night", night, SOUTH_DEG),
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
    }
    scenes
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
