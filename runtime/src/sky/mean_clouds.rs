//! Clouds as they are on average, for what counts them all: the light of a scene, and the sea that mirrors them.

use glam::Vec3;

use crate::clouds::shared::MeanCloud;
use crate::frame::Uniforms;
use crate::geometry::math::smoothstep;
use crate::pack_data::PackData;
use crate::params::SkyParams;

/// What clouds are on average.
pub(super) struct MeanClouds<'a> {
    params: &'a SkyParams,
    pub mean: MeanCloud,
}

impl<'a> MeanClouds<'a> {
    pub fn new(data: &PackData, params: &'a SkyParams, uniforms: &Uniforms) -> MeanClouds<'a> {
        let mean = params.method.clouds().mean(params, uniforms, data);
        MeanClouds {
            params,
            mean: MeanCloud {
                opacity: mean.opacity.clamp(0.0, 1.0),
                ..mean
            },
        }
    }

    /// Their mean opacity at a sine of elevation.
    pub fn opacity(&self, uniforms: &Uniforms, sine: f32) -> f32 {
        self.mean.opacity * smoothstep(0.0, 1.0, sine * uniforms.clouds.haze_scale)
    }

    pub fn over(&self, behind: Vec3, uniforms: &Uniforms, direction: Vec3) -> Vec3 {
        let method = self.params.method.clouds();
        let facing = method.facing(self.params, uniforms, direction, self.mean.opacity);
        let cloud = self.mean.sunlit * facing + self.mean.skylit;
        behind.lerp(cloud, self.opacity(uniforms, direction.y))
    }
}
