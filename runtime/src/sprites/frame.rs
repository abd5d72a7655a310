//! What a frame of sprites is computed from: where the viewer is, and the views of screen and ring.

use glam::DVec3;

use super::SpriteUniforms;
use super::station::{SpriteView, Station};
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
        sun: own.light_direction,
        look: [
            own.light.x,
            own.light.z,
            own.ambient.x,
            own.opacity,
            own.dark_base,
            own.flash.z,
            params.cover,
            params.sprites.formation,
            // Pictures hold colours as the target does: shares of the exposure, and another curve is another look.
            params.exposure_factor().max(f32::MIN_POSITIVE).ln(),
            f32::from(params.tonemap as u8),
            f32::from(u8::from(params.sea)),
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
    let [pixel_width, pixel_height] = frame.camera.pixel_rad();
    SpriteView {
        clip_x: screen.clip_x,
        clip_y: screen.clip_y,
        clip_z: (slope * screen.clip_w.truncate()).extend(start),
        clip_w: screen.clip_w,
        height_m: frame.camera.position_m().y,
        pixel_rad: super::SOFT * pixel_width.max(pixel_height),
        cell_texels: cell_texels(sheet),
        ..Default::default()
    }
}

/// The near plane of a camera that does not say, in metres.
const NEAR_M: f32 = 0.1;
