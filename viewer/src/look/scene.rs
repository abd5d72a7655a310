//! What is looked at.

use welkin_runtime::params::FbmParams;
use welkin_runtime::{Camera, Method, SkyParams};
use welkin_viewer::headless::View;
use welkin_viewer::structure::SIZE;

/// Covers at which structure is measured, in eighths of the sky.
pub const OKTAS: [f32; 3] = [3.0, 5.0, 8.0];

/// A view of a sky, whatever its method.
#[derive(Clone, Copy, Debug)]
pub struct Scene {
    pub name: &'static str,
    /// Of [`SkyParams`].
    time: f32,
    cover: f32,
    density: f32,
    /// Where the camera looks, in degrees.
    azimuth_deg: f32,
    elevation_deg: f32,
}

const fn scene(
    name: &'static str,
    time: f32,
    cover: f32,
    density: f32,
    [azimuth_deg, elevation_deg]: [f32; 2],
) -> Scene {
    Scene {
        name,
        time,
        cover,
        density,
        azimuth_deg,
        elevation_deg,
    }
}

const NOON: Scene = scene("noon", 0.45, 0.6, 0.2, [100.0, 17.0]);
/// The sun is three degrees high, and its light comes from the side.
const SUNSET: Scene = scene("sunset", 0.742, 0.55, 0.2, [270.0, 14.0]);
const STORM: Scene = scene("storm", 0.42, 0.95, 0.8, [40.0, 15.0]);

/// The skies whose structure is measured.
pub const MEASURED: [Scene; 3] = [NOON, SUNSET, STORM];

/// The skies of the page.
pub const SHOWN: [Scene; 8] = [
    NOON,
    scene("sunset", 0.752, 0.55, 0.2, [270.0, 14.0]),
    scene("away", 0.752, 0.55, 0.2, [90.0, 14.0]),
    STORM,
    scene("dawn", 0.262, 0.5, 0.2, [92.0, 14.0]),
    scene("night", 0.03, 0.5, 0.2, [200.0, 34.0]),
    scene("zenith", 0.45, 0.6, 0.2, [200.0, 75.0]),
    scene("horizon", 0.4, 0.6, 0.2, [30.0, 4.0]),
];

impl Scene {
    /// The sky of a method.
    pub fn view(&self, method: Method) -> View {
        let stormy = self.name == STORM.name;
        let params = SkyParams {
            method,
            time: self.time,
            cover: self.cover,
            density: self.density,
            fbm: if stormy {
                FbmParams::STORMY
            } else {
                FbmParams::default()
            },
            ..SkyParams::default()
        };
        let [azimuth, elevation] = [self.azimuth_deg, self.elevation_deg].map(f32::to_radians);
        View {
            params,
            camera: Camera::looking(azimuth, elevation, 60.0_f32.to_radians(), SIZE),
            seconds: 0.0,
        }
    }
}

/// A small view of noon at the usual cover, for many frames.
pub fn moving(method: Method) -> View {
    let mut view = NOON.view(method);
    view.params.cover = SkyParams::default().cover;
    view.camera = Camera {
        viewport_px: [160, 90],
        ..view.camera
    };
    view
}

/// A wide view straight up at noon, without the sun.
pub fn zenith(method: Method) -> View {
    let mut view = NOON.view(method);
    view.params.sun = false;
    let up = std::f32::consts::FRAC_PI_2;
    view.camera = Camera::looking(0.0, up, 130.0_f32.to_radians(), [384, 384]);
    view
}
