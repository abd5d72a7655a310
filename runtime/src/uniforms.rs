//! The uniform buffer: everything that is constant over a frame.
//!
//! All members are four floats wide, so that Rust's layout is WGSL's without padding. The WGSL structs
//! of the same names are in the file of each pass; a test of [`crate::shader`] compares both.

use bytemuck::{Pod, Zeroable};

/// Camera: see shaders/camera.wgsl for what each component holds.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Pod, Zeroable)]
pub struct CameraUniforms {
    /// xyz: from the middle of the screen to its right side; w: width in pixels.
    pub right: [f32; 4],
    /// xyz: from the middle of the screen to its upper side; w: height in pixels.
    pub up: [f32; 4],
    /// xyz: to the middle of the screen.
    pub forward: [f32; 4],
    /// xyz: dot with a direction gives its clip x.
    pub clip_x: [f32; 4],
    /// xyz: the same for y.
    pub clip_y: [f32; 4],
    /// xyz: the same for w.
    pub clip_w: [f32; 4],
}

/// Clear sky.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Pod, Zeroable)]
pub struct SkyUniforms {
    /// x: u of the time; y, z: `v = y + z * sqrt(sin elevation)`; w: share of the night sky.
    pub gradient: [f32; 4],
    /// xyz: unit direction towards the sun.
    pub sun: [f32; 4],
    /// rgb: radiance of the wide lobe towards the sun; w: its sharpness.
    pub wide: [f32; 4],
    /// rgb: radiance of the narrow lobe; w: its sharpness.
    pub narrow: [f32; 4],
    /// rgb: radiance of the twilight band on the horizon; w: how fast it fades upwards.
    pub band: [f32; 4],
    /// rgb: radiance of a shut sky; w: how far the sky is shut.
    pub overcast: [f32; 4],
}

/// The sun's square.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Pod, Zeroable)]
pub struct SunUniforms {
    /// xyz: the screen's right about the sun, over the glow's half side; w: glow's half side over the disc's.
    pub right: [f32; 4],
    /// xyz: the same upwards; w: 1 if there is a sun to draw.
    pub up: [f32; 4],
    /// rgb: radiance of the disc; w: level of the texture for it.
    pub disc: [f32; 4],
    /// rgb: radiance of the glow; w: level of the texture for it.
    pub glow: [f32; 4],
}

/// Stars.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Pod, Zeroable)]
pub struct StarUniforms {
    /// x: level; y: texels a side of that level; z: place in the flicker's period, 0..1; w: brightness.
    pub field: [f32; 4],
}

/// Galaxy.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Pod, Zeroable)]
pub struct GalaxyUniforms {
    /// rgb: radiance of the brightest place, times the share of the night sky; w: level of detail of the grain.
    pub light: [f32; 4],
}

/// Clouds.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Pod, Zeroable)]
pub struct CloudUniforms {
    /// x: scale; yz: offset; w: level of detail at distance 1.
    pub photo: [f32; 4],
    /// xy: scale times cosine and sine of its turn; zw: offset.
    pub noise: [f32; 4],
    /// x: scale; yz: offset; w: level of detail at distance 1.
    pub detail: [f32; 4],
    /// xy: scale to the east and to the south; zw: offset.
    pub upper: [f32; 4],
    /// x, y: level of detail of noise and upper layer at distance 1; z: smoothness (line 19); w: sine of the
    /// elevation at which clouds are out of the haze.
    pub levels: [f32; 4],
    /// xy: unit vector to the sun's azimuth (east, south); zw: `v = z + w * place`.
    pub gradient: [f32; 4],
    /// x: the cut of line 15; y: 1 / cover, as clamped in line 16; z: density; w: amount of the upper layer.
    pub shape: [f32; 4],
    /// rgb: light of the sun on clouds.
    pub sunlight: [f32; 4],
    /// rgb: light of the sky on clouds.
    pub ambient: [f32; 4],
    /// rgb: the sunset colour, display-referred; w: sunset.
    pub tint: [f32; 4],
}

/// The last step.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Pod, Zeroable)]
pub struct TonemapUniforms {
    /// x: exposure; y: size of the dither, 0 for none.
    pub display: [f32; 4],
}

/// The whole buffer, a struct a pass.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Pod, Zeroable)]
pub struct Uniforms {
    /// Where pixels look.
    pub camera: CameraUniforms,
    /// Clear sky.
    pub sky: SkyUniforms,
    /// The sun's square.
    pub sun: SunUniforms,
    /// Stars.
    pub stars: StarUniforms,
    /// Galaxy.
    pub galaxy: GalaxyUniforms,
    /// Clouds.
    pub clouds: CloudUniforms,
    /// The last step.
    pub tonemap: TonemapUniforms,
}

/// Three numbers and a fourth.
pub(crate) fn vec4(xyz: glam::Vec3, w: f32) -> [f32; 4] {
    xyz.extend(w).to_array()
}
