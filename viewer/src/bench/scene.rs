//! The frames that are timed: what each row of the table draws.
//!
//! The camera looks up far enough that sky fills the whole frame, and towards the sun, so that the sun and its
//! flare are paid for.

use clap::ValueEnum;
use welkin_pack::LayerKind;
use welkin_runtime::internals::sprites::station;
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
    let defaults = SkyParams {
        method,
        ..SkyParams::default()
    };
    let perez = SkyParams {
        sky: SkyModel::Perez,
        ..defaults
    };
    let mut scenes = vec![
        scene("noon", defaults, SOUTH_DEG),
        scene("sunset", sunset(defaults), WEST_DEG),
        scene("night", night(defaults), SOUTH_DEG),
        scene("alone", alone(defaults), SOUTH_DEG),
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
                ..defaults.octaves
            };
            scene(
                &label,
                alone(SkyParams {
                    octaves,
                    ..defaults
                }),
                SOUTH_DEG,
            )
        })),
        Method::Fbm => scenes.push(Scene {
            sun_moves: true,
            ..scene("alone, sun moves", alone(defaults), SOUTH_DEG)
        }),
        Method::Lit => scenes.extend(scenes_of_lit(defaults)),
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
    let defaults = SkyParams {
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
            ..defaults.sprites
        },
        ..defaults
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
const RING_FRAMES: u32 = 2 * station::PICTURES as u32 + station::FADE_FRAMES + 2;
/// How far a jump goes, over the radius of the ring: just beyond the 0.15 that a ring is good for.
const JUMP: f32 = 0.151;
/// Level flight below the clouds: the horizon, where most of them are, is in the middle.
const SPRITE_ELEVATION_DEG: f32 = 0.0;
const SPRITE_HEIGHT_M: f32 = 300.0;

/// What an iteration of layers costs, and what else only this method or the weather draws.
fn scenes_of_lit(defaults: SkyParams) -> Vec<Scene> {
    let with_layers = |count: usize| SkyParams {
        lit: LitParams::with_layers(&vec![LitLayer::of(LayerKind::Stratocumulus, 1.0); count]),
        ..defaults
    };
    let shadow = SkyParams {
        shadow_extent_m: SHADOW_EXTENT_M,
        ..defaults
    };
    let weather = |rays, rain| SkyParams {
        weather: WeatherParams {
            rays,
            rain,
            ..defaults.weather
        },
        ..defaults
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
    let defaults = SkyParams {
        method: Method::Lit,
        sky: SkyModel::Perez,
        shadow_extent_m: SHADOW_EXTENT_M,
        ..SkyParams::default()
    };
    vec![
        scene("noon", defaults, SOUTH_DEG),
        scene("low sun", sunset(defaults), WEST_DEG),
        scene("night", night(defaults), SOUTH_DEG),
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
mod tests;
