//! The light of a pack's sky where no device is: for a simulation, a server, or the half of an application that does not draw.

use welkin_pack::Pack;

use super::light::SkyLight;
use crate::error::SkyError;
use crate::pack_data::PackData;
use crate::params::SkyParams;

/// What the light of a sky follows from: some hundred kilobytes of a pack in memory.
#[derive(Clone, Debug)]
pub struct PackLight(PackData);

impl PackLight {
    /// Takes it out of a pack.
    ///
    /// # Errors
    /// [`SkyError::MissingTexture`] if the pack lacks a texture that every sky needs.
    pub fn new(pack: &Pack) -> Result<PackLight, SkyError> {
        PackData::new(pack).map(PackLight)
    }

    /// The light that the sky of these parameters gives to a scene: the same as [`Sky::light`](super::Sky::light).
    pub fn light(&self, params: &SkyParams, seconds: f64) -> SkyLight {
        self.0.light(params, seconds)
    }
}
