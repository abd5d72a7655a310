//! What a frame of sprites is computed from: where the viewer is, and the views of screen and ring.

use glam::{DVec3, Vec3};

use super::SpriteUniforms;
use super::ring::{SpriteView, Station};
use super::wind::in_field;
use crate::device::config::DepthConfig;
use crate::geometry::camera::{Camera, CameraUniforms};
use crate::params::SkyParams;

/// What a frame is drawn from.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Frame<'a> {
    /// In their ranges.
    pub params: &'a SkyParams,
    /// Of the screen.
    pub camera: &'a Camera,
    /// Finite.
    pub seconds: f64,
    /// The screen's share of the uniforms.
    pub screen: &'a CameraUniforms,
    /// What the sprites look like.
    pub look: &'a SpriteUniforms,
}

impl Frame<'_> {
    /// The viewer's place in the field.
    pub fn viewer_m(&self) -> DVec3 {
        let place = self.camera.position_m().as_dvec3();
        in_field(self.params, place, self.seconds)
    }
}

/// Texels a side of a cell of the sheet.
pub fn cell_texels(sheet: &wgpu::Texture) -> f32 {
    (sheet.width() / welkin_pack::SheetCell::A_SIDE) as f32
}

/// What a ring for this frame would be made for.
pub fn station(frame: &Frame<'_>, viewer_m: DVec3, sight_m: f32, heights_m: [f64; 2]) -> Station {
    let own = frame.look;
    let params = frame.params;
    Station {
        place_m: viewer_m,
        radius_m: f64::from(params.sprites.ring_radius_m),
        distance_m: f64::from(sight_m),
        heights_m,
        sun: Vec3::from_slice(&own.sun),
        look: [
            own.colour[0],
            own.colour[2],
            own.ambient[0],
            own.air[2],
            own.air[3],
            own.flash[2],
            params.cover,
            params.sprites.formation,
        ],
    }
}

/// The screen's view. Depth is that of the camera's projection, or, without one, of an infinite one that begins at a tenth of a metre.
pub fn screen_view(
    depth: Option<DepthConfig>,
    frame: &Frame<'_>,
    sheet: &wgpu::Texture,
) -> SpriteView {
    let screen = frame.screen;
    let [slope, start] = match (depth, frame.camera.clip_z) {
        // Nothing is tested: half way between near and far is never cut off.
        (None, _) => [0.5, 0.0],
        (Some(_), Some(own)) => own,
        (Some(depth), None) if depth.reversed => [0.0, NEAR_M],
        (Some(_), None) => [1.0, -NEAR_M],
    };
    let [x, y, z, _] = screen.clip_w;
    let height = frame.camera.position_m().y;
    let [pixel_width, pixel_height] = frame.camera.pixel_rad();
    let pixel = pixel_width.max(pixel_height);
    SpriteView {
        clip_x: screen.clip_x,
        clip_y: screen.clip_y,
        clip_z: [slope * x, slope * y, slope * z, start],
        clip_w: screen.clip_w,
        viewer: [height, pixel, cell_texels(sheet), 0.0],
    }
}

/// The near plane of a camera that does not say, in metres.
const NEAR_M: f32 = 0.1;
