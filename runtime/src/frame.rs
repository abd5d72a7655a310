//! A frame's uniforms: all that is computed once a frame, from pack, parameters, camera and seconds.

use crate::clear_sky::flares::{self, FlareUniforms};
use crate::clear_sky::galaxy::{self, GalaxyUniforms};
use crate::clear_sky::gradient::{self, SkyUniforms};
use crate::clear_sky::light::{Light, luminary};
use crate::clear_sky::perez::{self, PerezUniforms};
use crate::clear_sky::skybox::{self, SkyboxUniforms};
use crate::clear_sky::stars::{self, StarUniforms};
use crate::clear_sky::sun::{self, SunUniforms};
use crate::clouds::fbm::{self, FbmUniforms};
use crate::clouds::lit::{self, LitUniforms};
use crate::clouds::octaves::{self, OctaveUniforms};
use crate::clouds::packed::{self, PackedUniforms};
use crate::clouds::shadow::{self, ShadowUniforms};
use crate::clouds::shared::{self, CloudUniforms, CloudView};
use crate::device::pipeline::Variant;
use crate::geometry::camera::{self, Camera, CameraUniforms};
use crate::geometry::math::finite;
use crate::geometry::part::Part;
use crate::geometry::uniforms::uniforms;
use crate::pack_data::PackData;
use crate::params::{Method, SkyParams};
use crate::sprites::{self, SpriteUniforms};
use crate::tonemap::{self, TonemapUniforms};
use crate::weather::lightning::{self, LightningUniforms};
use crate::weather::rain::{self, RainUniforms};
use crate::weather::rays::{self, RayUniforms};

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
        /// Clear sky of Perez and others.
        perez: PerezUniforms,
        /// The sun's square.
        sun: SunUniforms,
        /// Stars.
        stars: StarUniforms,
        /// Galaxy.
        galaxy: GalaxyUniforms,
        /// The skybox.
        skybox: SkyboxUniforms,
        /// What the clouds of every method share.
        clouds: CloudUniforms,
        /// Clouds of the packed method.
        packed: PackedUniforms,
        /// Clouds of the octaves method.
        octaves: OctaveUniforms,
        /// Clouds of the fbm method.
        fbm: FbmUniforms,
        /// Clouds of the lit method.
        lit: LitUniforms,
        /// Clouds of the sprites method.
        sprites: SpriteUniforms,
        /// Shadows of the lit method's clouds.
        shadow: ShadowUniforms,
        /// A flash of lightning.
        lightning: LightningUniforms,
        /// Crepuscular rays.
        rays: RayUniforms,
        /// Rain.
        rain: RainUniforms,
        /// The lens flare.
        flares: FlareUniforms,
        /// The last step.
        tonemap: TonemapUniforms,
    }
}

impl PackData {
    /// The uniforms of one frame: a pure function. `step` is one step of the target's encoding.
    ///
    /// Parameters are clamped, seconds that are not finite are 0.
    pub fn uniforms(
        &self,
        params: &SkyParams,
        camera: &Camera,
        seconds: f64,
        step: f32,
    ) -> Uniforms {
        let whole = params.clamped();
        let params = whole.dome();
        let seconds = finite(seconds);
        let light = Light::new(&self.sky, self.noon_elevation_rad, params.time);
        let night = if params.stars { light.night } else { 0.0 };
        let (rays, pixel_rad) = (camera.rays(), camera.pixel_rad());
        let pixel = pixel_rad[0].max(pixel_rad[1]);
        let stands = camera.position_m().as_dvec3();
        let view = CloudView {
            texels: self.clouds_texels,
            pixel_rad: pixel,
            seconds,
            place_m: stands,
        };
        let clouds = shared::uniforms(&params, &light, self.clouds_texels);
        let packed = packed::uniforms(&params, &view);
        let octaves = octaves::uniforms(&params, &view, clouds.sun_azimuth);
        let fbm = fbm::uniforms(&params, &view, &self.fbm, light.sun_direction);
        let lit = lit::uniforms(&params, &view, &light, &clouds);
        let flash = lightning::uniforms(&params, &view, &clouds, &lit);
        let sprites = sprites::uniforms(&whole, &view, &light, &self.hours, &flash);
        let shown = match params.method {
            Method::Lit => luminary(&light, params.lit.moon),
            _ => light,
        };
        let overcast = match whole.method {
            Method::Packed => packed::overcast(&packed, &clouds, self.cloud_means),
            Method::Octaves => octaves::overcast(&octaves, &clouds),
            Method::Fbm => fbm::overcast(&fbm, &clouds),
            Method::Lit => lit::overcast(&lit),
            Method::Sprites => sprites::overcast(&sprites),
        };
        let closing = match whole.method {
            Method::Sprites => sprites::closing(&whole, stands.y as f32, self.cloud_heights_m),
            _ => shared::closing(whole.cover),
        };
        let [_, noise, detail] = self.cloud_means;
        let camera = camera::uniforms(camera);
        // Without a skybox the shader does not read one.
        let (face, levels) = self.skybox.unwrap_or((1, 1));
        Uniforms {
            camera,
            sky: gradient::uniforms(&light, &self.sky, params.time, night, overcast, closing),
            perez: perez::uniforms(&params.perez, params.sky, &light),
            sun: sun::uniforms(&shown, &rays, self.sun.0, self.sun.1, pixel, params.sun),
            stars: stars::uniforms(
                self.stars,
                &self.star_units,
                pixel_rad,
                night,
                params.even_stars,
                seconds,
            ),
            galaxy: galaxy::uniforms(night, [noise, detail], self.clouds_texels, pixel),
            skybox: skybox::uniforms(params.skybox, face, levels, pixel),
            clouds,
            packed,
            octaves,
            fbm,
            lightning: flash,
            rays: rays::uniforms(&params, &light, &clouds, &rays, pixel),
            rain: rain::uniforms(&params, &view, &rays, &clouds, &lit, &flash),
            shadow: shadow::uniforms(&params, &view, &lit),
            lit,
            sprites,
            flares: flares::uniforms(&params, &light, &camera, self.flares),
            tonemap: tonemap::uniforms(&params, step),
        }
    }
}

impl Variant {
    /// The least that draws a frame.
    pub fn of(uniforms: &Uniforms) -> Variant {
        Variant {
            night: uniforms.sky.night > 0.0,
            upper_layer: uniforms.packed.upper_layer > 0.0,
            weather: uniforms.rain.haze_opacity > 0.0 || uniforms.lightning.light.y > 0.0,
        }
    }
}
