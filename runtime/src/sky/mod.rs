//! The sky on a device: what is made once, what is written each frame, what is drawn.
//!
//! # Practice
//! [`Sky`] owns the pack's textures, some three megabytes, and the pipelines; a [`View`] what one camera needs: a buffer of uniforms and the maps
//! of methods. What only one method needs is made when that method is first prepared or [`Sky::load`]ed, and kept. Draw after the opaque scene:
//! pixels that the scene covers then cost nothing.

pub mod air;
mod common;
mod evaluate;
pub mod light;
mod mean_clouds;
mod method_pipelines;
mod night;
mod pack_light;
mod view;

use welkin_pack::Pack;

use self::common::{Common, Drawn};
pub use self::light::{Luminary, SkyLight};
pub use self::pack_light::PackLight;
pub use self::view::View;
use crate::clouds::shadow::Shadow;
use crate::device::config::SkyConfig;
use crate::error::SkyError;
use crate::geometry::camera::Camera;
use crate::params::{Method, SkyModel, SkyParams};

/// A sky on a device.
#[derive(Debug)]
pub struct Sky {
    common: Common,
    view: View,
}

impl Sky {
    /// Uploads the textures of a pack and builds the pipelines. The sky is drawn as one triangle over the screen.
    ///
    /// # Errors
    /// See [`SkyError`]; the device is not touched before the configuration has been looked at.
    pub fn new(
        device: &wgpu::Device,
        queue: &wgpu::Queue,
        config: SkyConfig,
        pack: &Pack,
    ) -> Result<Sky, SkyError> {
        Sky::build(device, queue, config, pack, None, Drawn::Sky)
    }

    /// A sky that draws the opacity of its clouds, 0 to 1, in red, green and blue, and nothing else: what a picture of the same parameters
    /// shows of them, pixel by pixel. Weather, stars, sun and flare are left out.
    ///
    /// # Errors
    /// As [`Sky::new`], and [`SkyError::TargetFormat`] for a target that the hardware encodes (`*Srgb`).
    pub fn of_opacity(
        device: &wgpu::Device,
        queue: &wgpu::Queue,
        config: SkyConfig,
        pack: &Pack,
    ) -> Result<Sky, SkyError> {
        Sky::build(device, queue, config, pack, None, Drawn::Opacity)
    }

    /// As [`Sky::new`], but only clouds, stars, Milky Way, planets and moon, to be drawn over a clear sky that the application has drawn into the same target
    /// with a sun and a ground of its own. Clouds hide it, stars and moon are added to it. Haze of rain, the rainbow, flashes of lightning and a pack's
    /// skybox are left out.
    ///
    /// # Errors
    /// As [`Sky::new`], and [`SkyError::OverFormat`] for a target that is no float one or cannot be blended with.
    pub fn over(
        device: &wgpu::Device,
        queue: &wgpu::Queue,
        config: SkyConfig,
        pack: &Pack,
    ) -> Result<Sky, SkyError> {
        Sky::build(device, queue, config, pack, None, Drawn::OverClear)
    }

    /// As [`Sky::new`], drawn on the papers' dome mesh with a vertex every `step_deg` degrees: the same
    /// picture above the horizon, and nothing below it. See [`dome::mesh`].
    ///
    /// # Errors
    /// As [`Sky::new`].
    #[doc(hidden)]
    pub fn with_dome_mesh(
        device: &wgpu::Device,
        queue: &wgpu::Queue,
        config: SkyConfig,
        pack: &Pack,
        step_deg: f32,
    ) -> Result<Sky, SkyError> {
        Sky::build(device, queue, config, pack, Some(step_deg), Drawn::Sky)
    }

    fn build(
        device: &wgpu::Device,
        queue: &wgpu::Queue,
        config: SkyConfig,
        pack: &Pack,
        dome_step_deg: Option<f32>,
        drawn: Drawn,
    ) -> Result<Sky, SkyError> {
        let common = Common::new(device, queue, config, pack, dome_step_deg, drawn)?;
        Ok(Sky {
            view: View::new(&common),
            common,
        })
    }

    /// Another view of this sky, for another camera. Nothing is compiled anew for it.
    pub fn view(&self) -> View {
        View::new(&self.common)
    }

    /// How many pipelines were made.
    #[doc(hidden)]
    pub fn pipelines_made(&self) -> usize {
        let made = &self.common.context.made;
        made.lock().map_or(0, |made| made.len())
    }

    /// Compiles the shader of a method with a sky model and makes the method's map, so that their first frame need not.
    /// For [`Method::Sprites`] that is what draws the sprites over a clear dome.
    pub fn load(&mut self, method: Method, sky: SkyModel) {
        self.view.load(&self.common, method, sky);
    }

    /// Whether the pack has what a method draws from.
    ///
    /// # Errors
    /// [`SkyError::MissingField`] for [`Method::Sprites`] with a pack that has no clouds in space: it then draws the dome alone.
    pub fn supports(&self, method: Method) -> Result<(), SkyError> {
        match method {
            #[cfg(feature = "sprites")]
            Method::Sprites if !self.common.stock.has_field() => Err(SkyError::MissingField),
            _ => Ok(()),
        }
    }

    /// Forgets what [`Method::Sprites`] keeps of earlier frames, its ring of impostors and the facing of sprites near the viewer: the next
    /// frame is drawn as a new sky would draw it. No other method keeps anything.
    pub fn reset_history(&mut self) {
        self.view.reset_history();
    }

    /// Sets the factor on the radiance that a float target gets: see [`View::set_scale`].
    pub fn set_scale(&mut self, scale: f32) {
        self.view.set_scale(scale);
    }

    /// Sprites that the prepared frame draws: on the screen, and into the ring of impostors.
    #[cfg(feature = "sprites")]
    pub fn sprites_drawn(&self) -> [u64; 2] {
        self.view.sprites_drawn()
    }

    /// Bytes of the ring of impostors: 2 MiB, and 4 MiB while it changes.
    #[cfg(feature = "sprites")]
    pub fn ring_bytes(&self) -> u64 {
        self.view.ring_bytes()
    }

    /// Computes a frame: writes its uniforms and records the off-screen passes of its method into `encoder`, before the
    /// pass in which the sky is drawn. `seconds` moves clouds and stars; any value will do.
    ///
    /// Nothing of a picture is remembered from frame to frame: the same arguments give the same picture, but with
    /// [`Method::Sprites`], see [`Sky::reset_history`]. Submit the encoder before the next frame is prepared; for a second
    /// camera in the same submission, see [`Sky::view`].
    pub fn prepare(
        &mut self,
        queue: &wgpu::Queue,
        encoder: &mut wgpu::CommandEncoder,
        params: &SkyParams,
        camera: &Camera,
        seconds: f64,
    ) {
        let common = &self.common;
        self.view
            .record(common, queue, encoder, params, camera, seconds);
    }

    /// The light that this sky gives to a scene: sun, moon and ambient light, horizon and exposure. The device is not asked, and no frame need be
    /// prepared.
    ///
    /// Clouds count by their mean at these parameters; rain, lightning, rays, a skybox and stars do not.
    pub fn light(&self, params: &SkyParams, seconds: f64) -> SkyLight {
        self.view.light(&self.common, params, seconds)
    }

    /// Parameters with the exposure that is drawn with: what [`SkyParams::auto_exposure`] finds, if it is on.
    pub fn exposed(&self, params: &SkyParams, seconds: f64) -> SkyParams {
        let clamped = params.clamped();
        let lit = self.common.pack_data.lit_sky(&clamped, seconds);
        self.common.pack_data.exposed(&lit, clamped, seconds)
    }

    /// Draws the prepared frame into a pass whose attachments are as the configuration said.
    ///
    /// Before the first [`Sky::prepare`] there is nothing to draw.
    pub fn draw(&self, pass: &mut wgpu::RenderPass<'_>) {
        self.view.draw(pass);
    }

    /// The cloud map of the prepared frame, if its method draws one: it tiles, and level 0 is as fine as it gets.
    ///
    /// Its red channel is the amount of cloud ([`Method::Octaves`], before cover) or the shade ([`Method::Fbm`], with
    /// the cover in alpha). That of [`Method::Lit`] is an array, a layer each (see [`crate::clouds::lit::map`]); its last one is empty.
    pub fn cloud_map(&self) -> Option<&wgpu::Texture> {
        self.view.cloud_map()
    }

    /// The shadows that the clouds of the prepared frame throw on the ground: see [`crate::shadow`].
    ///
    /// None where [`SkyParams::shadow_extent_m`] is 0.
    pub fn shadow(&self) -> Option<Shadow<'_>> {
        self.view.shadow()
    }

    /// Bytes of the textures that only this method reads: its own of the pack and, once they are made, those that it draws.
    pub fn memory_bytes(&self, method: Method) -> u64 {
        self.common.pack_bytes[method as usize] + self.view.memory_bytes(method)
    }
}

impl View {
    /// Computes a frame of the sky that made it: see [`Sky::prepare`]. Another sky's view is none of its own: its pipelines may not fit.
    pub fn prepare(
        &mut self,
        sky: &Sky,
        queue: &wgpu::Queue,
        encoder: &mut wgpu::CommandEncoder,
        params: &SkyParams,
        camera: &Camera,
        seconds: f64,
    ) {
        self.record(&sky.common, queue, encoder, params, camera, seconds);
    }
}
