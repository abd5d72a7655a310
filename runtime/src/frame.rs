//! A frame's uniforms, a struct a pass. `evaluate.rs` computes them.

use bytemuck::{Pod, Zeroable};

use crate::clear_sky::flares::FlareUniforms;
use crate::clear_sky::galaxy::GalaxyUniforms;
use crate::clear_sky::gradient::SkyUniforms;
use crate::clear_sky::perez::PerezUniforms;
use crate::clear_sky::skybox::SkyboxUniforms;
use crate::clear_sky::stars::StarUniforms;
use crate::clear_sky::sun::SunUniforms;
use crate::clouds::fbm::FbmUniforms;
use crate::clouds::lit::LitUniforms;
use crate::clouds::lit::shadow::ShadowUniforms;
use crate::clouds::octaves::OctaveUniforms;
use crate::clouds::packed::PackedUniforms;
use crate::clouds::shared::CloudUniforms;
use crate::geometry::camera::CameraUniforms;
use crate::geometry::part::Part;
use crate::sprites::SpriteUniforms;
use crate::tonemap::TonemapUniforms;
use crate::weather::lightning::LightningUniforms;
use crate::weather::rain::RainUniforms;
use crate::weather::rays::RayUniforms;

/// The uniforms and what else the passes share.
pub const PART: Part = Part {
    constants: &[],
    wgsl: include_str!("frame.wgsl"),
};

/// The whole buffer, a struct a pass.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Pod, Zeroable)]
pub struct Uniforms {
    /// Where pixels look.
    pub camera: CameraUniforms,
    /// Clear sky.
    pub sky: SkyUniforms,
    /// Clear sky of Perez and others.
    pub perez: PerezUniforms,
    /// The sun's square.
    pub sun: SunUniforms,
    /// Stars.
    pub stars: StarUniforms,
    /// Galaxy.
    pub galaxy: GalaxyUniforms,
    /// The skybox.
    pub skybox: SkyboxUniforms,
    /// What the clouds of every method share.
    pub clouds: CloudUniforms,
    /// Clouds of the packed method.
    pub packed: PackedUniforms,
    /// Clouds of the octaves method.
    pub octaves: OctaveUniforms,
    /// Clouds of the fbm method.
    pub fbm: FbmUniforms,
    /// Clouds of the lit method.
    pub lit: LitUniforms,
    /// Clouds of the sprites method.
    pub sprites: SpriteUniforms,
    /// Shadows of the lit method's clouds.
    pub shadow: ShadowUniforms,
    /// A flash of lightning.
    pub lightning: LightningUniforms,
    /// Crepuscular rays.
    pub rays: RayUniforms,
    /// Rain.
    pub rain: RainUniforms,
    /// The lens flare.
    pub flares: FlareUniforms,
    /// The last step.
    pub tonemap: TonemapUniforms,
}
