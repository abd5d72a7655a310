//! Computes a frame's uniforms, once a frame, from pack, parameters, camera and seconds.

use glam::{Vec2, Vec3};

use crate::clear_sky::cells::Cells;
use crate::clear_sky::light::LitSky;
#[cfg(feature = "perez")]
use crate::clear_sky::perez;
use crate::clear_sky::stars::Stand;
use crate::clear_sky::{
    catalogue, flares, galaxy, ground, moon, planets, sea, skybox, stars, sun, table,
};
#[cfg(any(feature = "fbm", feature = "lit", feature = "octaves"))]
use crate::clouds::photo;
use crate::clouds::shadow;
use crate::clouds::shared::{self, CloudView};
use crate::device::pipeline::Variant;
use crate::frame::Uniforms;
#[cfg(feature = "weather")]
use crate::geometry::camera::Rays;
use crate::geometry::camera::{self, Camera};
use crate::geometry::math::finite;
use crate::methods::interface::MethodFrame;
use crate::pack_data::PackData;
use crate::params::{Method, SkyParams};
use crate::sky::mean_clouds::MeanClouds;
use crate::tonemap;
#[cfg(feature = "weather")]
use crate::weather::{lightning, rain, rainbow, rays};

/// How much brighter the densest overcast is at the horizon than above: chosen.
const SLIT: f32 = 1.3;

impl PackData {
    /// The uniforms of one frame: a pure function. `step` is one step of the target's encoding, 0 for a target of radiance.
    ///
    /// Parameters are clamped, seconds that are not finite are 0.
    pub fn uniforms(
        &self,
        params: &SkyParams,
        camera: &Camera,
        seconds: f64,
        step: f32,
    ) -> Uniforms {
        let clamped = params.clamped();
        let lit = self.lit_sky(&clamped, seconds);
        let clamped = self.exposed(&lit, clamped, seconds);
        self.uniforms_under(&lit, &clamped, camera, seconds, step)
    }

    /// The same with the light of the moment. `clamped` are in range.
    pub(crate) fn uniforms_under(
        &self,
        lit: &LitSky,
        clamped: &SkyParams,
        camera: &Camera,
        seconds: f64,
        step: f32,
    ) -> Uniforms {
        let params = clamped.dome();
        let light = lit.light;
        let night = if params.stars { light.night } else { 0.0 };
        let (rays, pixel_rad) = (camera.rays(), camera.pixel_rad());
        let pixel = pixel_rad[0].max(pixel_rad[1]);
        let view = CloudView {
            texels: self.clouds_texels,
            pixel_rad: pixel,
            seconds: finite(seconds),
            place_m: camera.position_m().as_dvec3(),
        };
        let clouds = shared::uniforms(&params, &light, self.clouds_texels);
        let mut uniforms = Uniforms {
            camera: camera::uniforms(camera),
            clouds,
            ..Uniforms::default()
        };
        let frame = MethodFrame {
            params: &params,
            clamped,
            view,
            light,
            flash: Vec3::ZERO,
            pack: self,
        };
        #[cfg(any(feature = "fbm", feature = "lit", feature = "octaves"))]
        {
            uniforms.photo = photo::uniforms(self.photo, params.photo);
        }
        for method in Method::DOMES {
            method.clouds().write(&mut uniforms, &frame);
        }
        let layers = params.method.clouds().shadow_layers(&frame, &uniforms);
        let shut = clamped.method.clouds().shut(clamped);
        uniforms.shadow = shadow::uniforms(&params, &view, &layers, shut);
        #[cfg(feature = "weather")]
        let frame = MethodFrame {
            flash: write_weather(&mut uniforms, &frame, &rays),
            ..frame
        };
        #[cfg(feature = "sprites")]
        Method::Sprites.clouds().write(&mut uniforms, &frame);

        let shown = clamped.method.clouds();
        let overcast_weight = shown.overcast_weight(clamped, view.place_m.y as f32, self);
        let overcast = shown.overcast(clamped, &uniforms, self);
        uniforms.sky = table::uniforms(
            &lit.view,
            light.sun_direction,
            shared::azimuth(light.sky_direction),
            night,
            overcast,
            overcast_weight,
            SLIT * params.density * overcast_weight,
        );
        // Clouds take their share of the sunlight, and what they give instead is the light of an overcast.
        uniforms.ground = ground::uniforms(
            params.ground.into(),
            ground::GroundLight {
                sky: light.sky_on_ground.lerp(overcast, overcast_weight),
                sun: light.ground_sunlight * (1.0 - overcast_weight),
                sun_sin: light.sun_direction.y,
                shut: overcast_weight,
            },
            ground::Noise {
                texels: self.clouds_texels,
                mean: self.cloud_means[2],
            },
            view.place_m,
            pixel,
            self.sky.aerosol_depth(params.haze),
        );
        if params.sea {
            let mean = MeanClouds::new(self, clamped, &uniforms).mean;
            let [depth, height] = shared::MIDDLING;
            let to_all_sides = shared::scattered(&uniforms.clouds, None, depth, height)[0];
            let light = sea::SeaLight {
                sky: light.sky_on_ground.lerp(overcast, overcast_weight),
                sun: light.ground_sunlight * (1.0 - overcast_weight),
                sun_sin: light.sun_direction.y,
                clouds: sea::SeaClouds {
                    opacity: mean.opacity,
                    skylit: mean.skylit,
                    sunlit: mean.sunlit / to_all_sides,
                    middling: Vec2::new(depth, height),
                },
            };
            uniforms.sea = sea::uniforms(light, params.waves, view.seconds, pixel);
        }
        #[cfg(feature = "perez")]
        {
            uniforms.perez = perez::uniforms(&params.perez, params.sky, &light);
        }
        let (texels, levels) = self.sun;
        // A lens's glare is the display's affair.
        let exposure = (step > 0.0).then(|| params.exposure_factor());
        // The moon of a date is a disc of its own.
        let is_sun = params.sun && !(light.is_moon && lit.moon.is_some());
        uniforms.sun = sun::uniforms(&light, &rays, texels, levels, pixel, is_sun, exposure);
        let disc = lit.moon.as_ref().filter(|_| params.sun);
        uniforms.moon = moon::uniforms(disc, &rays, pixel);
        let dated = params
            .date
            .map(|date| (date.after(view.seconds), params.place));
        uniforms.stars = stars::uniforms(
            self.stars,
            &self.star_units,
            pixel_rad,
            night * light.dark,
            params.even_stars,
            view.seconds,
            self.star_turn(&params, view.seconds)
                .map(|turn| Stand::of_turn(turn, self.galaxy_node)),
        );
        if self.catalogue.is_some() {
            uniforms.catalogue = catalogue::uniforms(Cells::of(camera.viewport()));
        }
        let one = stars::radiance_of_one(self.stars, pixel_rad, night * light.dark);
        uniforms.planets = planets::uniforms(dated, &uniforms.camera, one);
        let [_, noise, detail] = self.cloud_means;
        uniforms.galaxy = galaxy::uniforms(
            night * light.dark,
            [noise, detail],
            self.clouds_texels,
            pixel,
        );
        // Without a skybox the shader does not read one.
        let (face, levels) = self.skybox.unwrap_or((1, 1));
        uniforms.skybox = skybox::uniforms(params.skybox, face, levels, pixel);
        uniforms.flares = flares::uniforms(&params, &light, &uniforms.camera, self.flares);
        uniforms.tonemap = tonemap::uniforms(&params, step);
        uniforms
    }
}

/// Writes what weather needs, and gives the light of a flash.
#[cfg(feature = "weather")]
fn write_weather(uniforms: &mut Uniforms, frame: &MethodFrame<'_>, screen: &Rays) -> Vec3 {
    let (params, view, clouds) = (frame.params, &frame.view, &uniforms.clouds);
    let flash = lightning::uniforms(params, view, clouds);
    uniforms.rain = rain::uniforms(params, view, screen, clouds, &flash);
    uniforms.rainbow = rainbow::uniforms(params, frame.light.sun_direction, clouds);
    uniforms.rays = rays::uniforms(params, &frame.light, clouds, screen, view.pixel_rad);
    uniforms.lightning = flash;
    flash.light
}

impl Variant {
    /// What a frame needs beyond the clear sky.
    pub fn of(uniforms: &Uniforms, sea: bool) -> Variant {
        Variant {
            night: uniforms.sky.night > 0.0,
            upper_layer: uniforms.packed.upper_layer > 0.0,
            #[cfg(feature = "weather")]
            weather: uniforms.rain.haze_opacity > 0.0 || uniforms.lightning.light.y > 0.0,
            #[cfg(not(feature = "weather"))]
            weather: false,
            sea,
        }
    }
}
