//! The whole sky as an environment map, for programs that have no runtime of ours: linear radiance in every direction at one moment.
//!
//! # Theory
//! N. Greene, "Environment Mapping and Other Applications of World Projections", IEEE CG&A 6(11), 1986. The six faces of a cube
//! are drawn, each by a camera that sees 90 degrees ([`cube`], [`faces`]); a cube map ([`cubemap`]) is their means over its texels, a
//! panorama ([`equirect`]) the mean of the directions that a texel covers. As light on things ([`light`]) a cube map has levels for rough surfaces
//! ([`prefilter`]) and its irradiance beside it ([`harmonics`]); so has the cube map of anyone's panorama ([`panorama`]).
//!
//! # Practice
//! Nothing of a sky may depend on the screen then, or faces would not meet. What the runtime takes of the screen is the angle of a pixel, which
//! is the same for two faces along their common edge, and the place of a star between pixels, whose light the two faces share as two
//! pixels of one face do. A lens flare belongs to one camera, and streaks of rain to one screen: [`Environment`] draws neither. Crepuscular
//! rays come of a map about the sun, and hold. Below the horizon lies the haze of the sky's own ground.

pub mod cube;
pub mod cubemap;
pub mod display;
pub mod equirect;
pub mod faces;
pub mod harmonics;
pub mod light;
pub mod looped;
pub mod panorama;
pub mod prefilter;
pub mod sequence;

use half::f16;
use welkin_pack::Pack;
use welkin_runtime::{Camera, SkyParams};

use crate::export::cubemap::Cubemap;
use crate::frame::{Frame, Target};
use crate::gpu::{Gpu, GpuError};
use crate::headless::{Stage, View};

/// Draws environment maps of a pack's sky.
#[derive(Debug)]
pub struct Environment<'a> {
    stage: Stage<'a>,
}

impl<'a> Environment<'a> {
    /// A pack's sky, of which nothing is drawn yet.
    ///
    /// # Errors
    /// [`GpuError::Sky`].
    pub fn new(gpu: &'a Gpu, pack: &Pack) -> Result<Environment<'a>, GpuError> {
        Ok(Environment {
            stage: Stage::new(gpu, pack, Target::Linear)?,
        })
    }

    /// The opacity of a pack's clouds instead of its sky.
    ///
    /// # Errors
    /// [`GpuError::Sky`].
    pub fn of_opacity(gpu: &'a Gpu, pack: &Pack) -> Result<Environment<'a>, GpuError> {
        Ok(Environment {
            stage: Stage::of_opacity(gpu, pack)?,
        })
    }

    /// The sky as a panorama of `width` by `width / 2` texels: see [`equirect`]. Of the view's camera its place alone counts.
    ///
    /// # Errors
    /// [`GpuError::FrameSize`], [`GpuError::Device`].
    pub fn equirect(
        &mut self,
        view: &View,
        width: u32,
        azimuth_rad: f32,
    ) -> Result<Frame, GpuError> {
        self.stage.reset_history();
        let map = equirect::draw(&view.camera, width, azimuth_rad, |camera| {
            self.radiance(view, camera)
        })?;
        Ok(map.frame())
    }

    /// The sky as a cube map of `side` texels a side of a face: see [`cubemap`]. Of the view's camera its place alone counts.
    ///
    /// # Errors
    /// [`GpuError::FrameSize`], [`GpuError::Device`].
    pub fn cubemap(&mut self, view: &View, side: u32) -> Result<Cubemap, GpuError> {
        self.stage.reset_history();
        cubemap::draw(&view.camera, side, |camera| self.radiance(view, camera))
    }

    /// The view's parameters with the exposure that a picture of the map is shown by.
    pub fn exposed(&self, view: &View) -> SkyParams {
        self.stage.exposed(view)
    }

    /// What a camera sees, row by row.
    fn radiance(&mut self, view: &View, camera: &Camera) -> Result<Vec<[f16; 4]>, GpuError> {
        let bytes = self.stage.draw_bytes(&View {
            params: without_screen(view.params),
            camera: *camera,
            seconds: view.seconds,
        })?;
        Ok(bytemuck::pod_collect_to_vec(&bytes))
    }
}

/// The parameters without what belongs to one screen, and stars that are as bright on every part of a map.
fn without_screen(mut params: SkyParams) -> SkyParams {
    params.flare = 0.0;
    params.weather.rain = 0.0;
    params.shadow_extent_m = 0.0;
    params.even_stars = true;
    params
}
