//! A frame's uniforms, a struct a pass. `sky/evaluate.rs` computes them.

use crate::clear_sky::catalogue::CatalogueUniforms;
use crate::clear_sky::flares::FlareUniforms;
use crate::clear_sky::galaxy::GalaxyUniforms;
use crate::clear_sky::ground::GroundUniforms;
use crate::clear_sky::moon::MoonUniforms;
#[cfg(feature = "perez")]
use crate::clear_sky::perez::PerezUniforms;
use crate::clear_sky::planets::PlanetUniforms;
use crate::clear_sky::sea::SeaUniforms;
use crate::clear_sky::skybox::SkyboxUniforms;
use crate::clear_sky::stars::StarUniforms;
use crate::clear_sky::sun::SunUniforms;
use crate::clear_sky::table::SkyUniforms;
#[cfg(feature = "fbm")]
use crate::clouds::fbm::FbmUniforms;
#[cfg(feature = "lit")]
use crate::clouds::lit::LitUniforms;
#[cfg(feature = "octaves")]
use crate::clouds::octaves::OctaveUniforms;
use crate::clouds::packed::PackedUniforms;
#[cfg(any(feature = "fbm", feature = "lit", feature = "octaves"))]
use crate::clouds::photo::PhotoUniforms;
use crate::clouds::shadow::ShadowUniforms;
use crate::clouds::shared::CloudUniforms;
use crate::geometry::camera::CameraUniforms;
use crate::geometry::part::Part;
use crate::geometry::uniforms::uniforms;
#[cfg(feature = "sprites")]
use crate::sprites::SpriteUniforms;
use crate::tonemap::TonemapUniforms;
#[cfg(feature = "weather")]
use crate::weather::lightning::LightningUniforms;
#[cfg(feature = "weather")]
use crate::weather::rain::RainUniforms;
#[cfg(feature = "weather")]
use crate::weather::rainbow::RainbowUniforms;
#[cfg(feature = "weather")]
use crate::weather::rays::RayUniforms;

/// The uniforms and what else the passes share.
pub const PART: Part = Part {
    constants: &[],
    structs: &[Uniforms::WGSL],
    wgsl: include_str!("frame.wgsl"),
};

uniforms! {
    /// Everything that is constant over a frame, a struct a pass.
    Uniforms {
        /// Where pixels look.
        camera: CameraUniforms,
        /// Clear sky.
        sky: SkyUniforms,
        /// The ground below the horizon.
        ground: GroundUniforms,
        /// The sea in its place.
        sea: SeaUniforms,
        /// Clear sky of Perez and others.
        #[cfg(feature = "perez")]
        perez: PerezUniforms,
        /// The sun's square.
        sun: SunUniforms,
        /// The moon's disc.
        moon: MoonUniforms,
        /// Stars.
        stars: StarUniforms,
        /// Stars of a catalogue.
        catalogue: CatalogueUniforms,
        /// The planets.
        planets: PlanetUniforms,
        /// Galaxy.
        galaxy: GalaxyUniforms,
        /// The skybox.
        skybox: SkyboxUniforms,
        /// What the clouds of every method share.
        clouds: CloudUniforms,
        /// Shadows on the ground.
        shadow: ShadowUniforms,
        /// Clouds of the packed method.
        packed: PackedUniforms,
        /// The photograph's share of their large shapes.
        #[cfg(any(feature = "fbm", feature = "lit", feature = "octaves"))]
        photo: PhotoUniforms,
        /// Clouds of the octaves method.
        #[cfg(feature = "octaves")]
        octaves: OctaveUniforms,
        /// Clouds of the fbm method.
        #[cfg(feature = "fbm")]
        fbm: FbmUniforms,
        /// Clouds of the lit method.
        #[cfg(feature = "lit")]
        lit: LitUniforms,
        /// Clouds of the sprites method.
        #[cfg(feature = "sprites")]
        sprites: SpriteUniforms,
        /// A flash of lightning.
        #[cfg(feature = "weather")]
        lightning: LightningUniforms,
        /// Crepuscular rays.
        #[cfg(feature = "weather")]
        rays: RayUniforms,
        /// Rain.
        #[cfg(feature = "weather")]
        rain: RainUniforms,
        /// The rainbow.
        #[cfg(feature = "weather")]
        rainbow: RainbowUniforms,
        /// The lens flare.
        flares: FlareUniforms,
        /// The last step.
        tonemap: TonemapUniforms,
    }
}
