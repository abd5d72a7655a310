//! Twin of clouds/shared.wgsl.

use glam::Vec3;
use welkin_pack::mapping;
use welkin_runtime::internals::clouds::shared::CloudUniforms;
use welkin_runtime::internals::clouds::shared::{
    ABEAM, BACKWARD, BRIGHTEST, CORE, FORWARD, HIDDEN, MULTIPLE, POWDER, RIM, SIDED, SINGLE, THIN,
};
use welkin_runtime::internals::frame::Uniforms;
use welkin_runtime::params::Shading;

use crate::dome::DomeHit;
use crate::texture::{Texture, smoothstep};

/// What a layer of clouds is computed from.
#[derive(Clone, Copy, Debug)]
pub struct Inputs<'a> {
    /// How clouds are shaded.
    pub shading: Shading,
    /// The frame's constants.
    pub uniforms: &'a Uniforms,
    /// The pack's clouds.
    pub clouds: &'a Texture,
    /// The layers of the map of the method, if it draws one.
    pub map: &'a [Texture],
    /// The pack's layers of the lit method, at the place of their kind.
    pub layers: &'a [Texture],
    /// What is added to each of [`crate::methods::reads`], in their order: 0, but where a test asks what a texture unit's error is worth
    /// in the picture.
    pub nudges: &'a [f32],
}

impl Inputs<'_> {
    /// A read of the map of a method that has one layer.
    ///
    /// # Panics
    /// If the method has none.
    pub fn map_at(&self, uv: [f32; 2], level: f32) -> [f32; 4] {
        self.map[0].sample(uv, level)
    }
}

/// Share of sunlight that a cloud of an opacity sends back along a direction.
pub fn facing(uniforms: &Uniforms, direction: Vec3, opacity: f32) -> f32 {
    let cosine = direction.dot(uniforms.sky.sun_direction);
    let thin = 1.0 - opacity;
    let rim = RIM * thin * thin * cosine.max(0.0).powi(8);
    let sided = ABEAM - SIDED * cosine + rim;
    1.0 + (sided - 1.0) * uniforms.clouds.low_sun
}

/// Shares of sunlight and of skylight that a cloud of this height sends along a direction, where sunlight was halved `depth` times.
pub fn scattered(uniforms: &Uniforms, direction: Vec3, depth: f32, height: f32) -> [f32; 2] {
    let cosine = direction.dot(uniforms.sky.sun_direction);
    let halved = |times: f32| libm::exp2f(-times);
    let sided = 1.0 + (ABEAM - SIDED * cosine - 1.0) * uniforms.clouds.low_sun;
    let rim = SINGLE[1] * phase(cosine) * halved(THIN * height + depth);
    let body = SINGLE[0] * halved(depth) + MULTIPLE[0] * halved(MULTIPLE[1] * depth);
    let powder = 1.0 - POWDER[0] * (0.5 - 0.5 * cosine) * (1.0 - POWDER[1] * height).max(0.0);
    [
        (body * sided + rim) * powder,
        1.0 - HIDDEN * height.min(1.0),
    ]
}

/// The phase function against all sides alike, by the cosine to the sun; limited about it.
pub fn phase(cosine: f32) -> f32 {
    // Henyey and Greenstein, in 64 bits.
    let lobe = |weight: f32, g: f32| {
        let (weight, g, cosine) = (f64::from(weight), f64::from(g), f64::from(cosine));
        let base = 1.0 + g * g - 2.0 * g * cosine;
        weight * (1.0 - g * g) / (base * libm::sqrt(base))
    };
    let forward = lobe(FORWARD[0], FORWARD[1]) as f32;
    (forward + BACKWARD[0] - BACKWARD[1] * cosine).min(BRIGHTEST)
}

/// Radiance of what these shares are of, under the sunset tint.
pub fn lit(clouds: &CloudUniforms, [sunlit, skylit]: [f32; 2], tint: f32) -> Vec3 {
    (sunlit * clouds.sunlight + skylit * clouds.ambient) * Vec3::ONE.lerp(clouds.tint, tint)
}

/// Radiance of display-referred grey.
pub fn light(clouds: &CloudUniforms, grey: Vec3, facing: f32) -> Vec3 {
    let bright = CORE + (1.0 - CORE) * grey;
    bright * (bright * facing * clouds.sunlight + clouds.ambient)
}

/// Display-referred colour of a grey under the sunset tint.
pub fn tinted(clouds: &CloudUniforms, grey: f32, tint: f32) -> Vec3 {
    grey * Vec3::ONE.lerp(clouds.tint, tint)
}

/// Opacity with its foot softened.
pub fn soften(alpha: f32, edge: f32) -> f32 {
    alpha * alpha * (1.0 + edge) / (alpha + edge)
}

/// How far the sunset tints clouds in a direction.
pub fn tint(clouds: &CloudUniforms, texture: &Texture, direction: Vec3) -> f32 {
    let azimuth = clouds.sun_azimuth.to_array();
    let place = mapping::direction_to_gradient(direction.to_array(), azimuth);
    let v = clouds.gradient_start + clouds.gradient_span * place;
    clouds.sunset * texture.sample([0.5, v], 0.0)[3]
}

/// What the haze of the horizon leaves of a cloud.
pub fn clearness(clouds: &CloudUniforms, direction: Vec3) -> f32 {
    smoothstep(0.0, 1.0, clouds.haze_scale * direction.y)
}

/// Level of detail of a texture with one texel a height of the layer.
pub fn level(hit: &DomeHit, narrowing: f32) -> f32 {
    let side = hit.distance * narrowing;
    0.5 * libm::log2f((side * side / hit.cos_incidence).max(1e-12))
}

/// A wave of period 1 between -1 and 1, of two parabolas.
pub fn wave(x: f32) -> f32 {
    let turn = 2.0 * (x - x.floor()) - 1.0;
    4.0 * turn * (turn.abs() - 1.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn opacity_starts_without_a_kink_and_keeps_its_ends() {
        for edge in [
            welkin_runtime::internals::clouds::packed::EDGE,
            welkin_runtime::internals::clouds::octaves::EDGE,
        ] {
            assert_eq!(soften(0.0, edge), 0.0);
            assert!((soften(1.0, edge) - 1.0).abs() < 1e-6);
            assert!(soften(1e-3, edge) / 1e-3 < 0.01, "slope 0 at the foot");
            let rises =
                |i: i32| soften(i as f32 * 0.01, edge) > soften((i - 1) as f32 * 0.01, edge);
            assert!((1..=100).all(rises));
        }
    }
}
