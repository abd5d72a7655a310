//! Clouds as they are on average, for what counts them all: the light of a scene, and the sea that mirrors them.

use glam::Vec3;

use crate::frame::Uniforms;
use crate::geometry::math::smoothstep;
use crate::pack_data::PackData;
use crate::params::SkyParams;

/// What clouds are on average.
pub(super) struct MeanClouds<'a> {
    params: &'a SkyParams,
    pub opacity: f32,
    /// Radiance by sunlight that they show where they are lit from all sides.
    pub sunlit: Vec3,
    /// Radiance by all else.
    pub skylit: Vec3,
}

impl<'a> MeanClouds<'a> {
    pub fn new(data: &PackData, params: &'a SkyParams, uniforms: &Uniforms) -> MeanClouds<'a> {
        let method = params.method.clouds();
        let mut sunless = *uniforms;
        sunless.clouds.sunlight = Vec3::ZERO;
        #[cfg(feature = "lit")]
        {
            sunless.lit.light = Vec3::ZERO;
        }
        let (opacity, whole) = method.mean(params, uniforms, data);
        let (_, skylit) = method.mean(params, &sunless, data);
        MeanClouds {
            params,
            opacity: opacity.clamp(0.0, 1.0),
            sunlit: whole - skylit,
            skylit,
        }
    }

    /// Their mean opacity at a sine of elevation.
    pub fn opacity(&self, uniforms: &Uniforms, sine: f32) -> f32 {
        self.opacity * smoothstep(0.0, 1.0, sine * uniforms.clouds.haze_scale)
    }

    pub fn over(&self, behind: Vec3, uniforms: &Uniforms, direction: Vec3) -> Vec3 {
        let method = self.params.method.clouds();
        let facing = method.facing(self.params, uniforms, direction, self.opacity);
        let cloud = self.sunlit * facing + self.skylit;
        behind.lerp(cloud, self.opacity(uniforms, direction.y))
    }
}
