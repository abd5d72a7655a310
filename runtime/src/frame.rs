//! A frame's uniforms: all that is computed once a frame, from pack, parameters, camera and seconds.

use welkin_pack::field::Hour;
use welkin_pack::{Image, Pack, Role, StarTexel, Texture};

use crate::clouds::CloudView;
use crate::fbm_map::Octaves;
use crate::light::Light;
use crate::uniforms::{CameraUniforms, Uniforms, vec4};
use crate::{
    Camera, Method, SkyError, SkyParams, clouds, fbm, flares, galaxy, lightning, lit, octaves,
    octaves_map, packed, perez, rain, rays, shadow, sky, skybox, sprites, stars, sun, tonemap,
};

/// What the CPU keeps of a pack between frames.
#[derive(Clone, Debug, PartialEq)]
pub struct Facts {
    /// Elevation of the sun at noon, in radians.
    pub noon_elevation_rad: f32,
    /// The day gradient.
    pub sky: Image,
    /// Texels a side of the clouds.
    pub clouds_texels: u32,
    /// Means of photo, noise and detail.
    pub cloud_means: [f32; 3],
    /// Texels a side of the stars.
    pub stars: u32,
    /// What a step of each of their levels stands for: [`StarTexel::level_units`].
    pub star_units: Vec<f32>,
    /// Texels a side and levels of the sun.
    pub sun: (u32, usize),
    /// Texels a side of the atlas of flares.
    pub flares: u32,
    /// Texels a side of a face and levels of the skybox, if there is one.
    pub skybox: Option<(u32, usize)>,
    /// Seed of the pack.
    pub seed: u64,
    /// Texels of the white noise, 32x32 of four bytes.
    pub noise: Vec<u8>,
    /// The octaves of smooth noise.
    pub fbm: Octaves,
    /// Light on the sprites' clouds over the day; empty without a field.
    pub hours: Vec<Hour>,
    /// The lowest base and the highest top of the sprites' clouds, in metres; 0 without a field.
    pub cloud_heights_m: [f32; 2],
}

impl Facts {
    /// Reads them from a pack.
    ///
    /// # Errors
    /// [`SkyError::MissingTexture`] if the pack lacks a texture.
    pub fn new(pack: &Pack) -> Result<Facts, SkyError> {
        let side = |t: &Texture| (t.width, t.levels.len());
        Ok(Facts {
            noon_elevation_rad: pack.manifest().noon_elevation_rad,
            sky: texture(pack, Role::Sky)?.image(0, 0),
            clouds_texels: texture(pack, Role::Clouds)?.width,
            cloud_means: cloud_means(pack)?,
            stars: texture(pack, Role::Stars)?.width,
            star_units: StarTexel::level_units(texture(pack, Role::Stars)?),
            sun: side(texture(pack, Role::Sun)?),
            flares: texture(pack, Role::Flares)?.width,
            skybox: pack.texture(Role::Skybox).map(side),
            seed: pack.manifest().seed,
            noise: texture(pack, Role::Octaves)?.levels.concat(),
            fbm: Octaves::new(texture(pack, Role::Fbm)?),
            hours: pack.field().map_or(Vec::new(), |field| field.hours.clone()),
            cloud_heights_m: pack.field().map_or([0.0; 2], sprites::heights_m),
        })
    }

    /// The states of the octaves method's noise at a moment: see [`octaves_map::states`].
    pub fn octave_states(&self, params: &SkyParams, seconds: f64) -> Vec<f32> {
        let seconds = finite(seconds);
        octaves_map::states(&self.noise, self.seed, &params.clamped(), seconds)
    }

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
        let clouds = clouds::uniforms(&params, &light, self.clouds_texels);
        let [east, south, ..] = clouds.gradient;
        let packed = packed::uniforms(&params, &view);
        let octaves = octaves::uniforms(&params, &view, [east, south]);
        let fbm = fbm::uniforms(&params, &view, &self.fbm, light.sun_direction);
        let lit = lit::uniforms(&params, &view, &light, &clouds);
        let flash = lightning::uniforms(&params, &view, &clouds, &lit);
        let sprites = sprites::uniforms(&whole, &view, &light, &self.hours, &flash);
        let shown = match params.method {
            Method::Lit => lit::luminary(&light, params.lit.moon),
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
            _ => clouds::closing(whole.cover),
        };
        let overcast = vec4(overcast, closing);
        let [_, noise, detail] = self.cloud_means;
        let camera = camera_uniforms(camera);
        // Without a skybox the shader does not read one.
        let (face, levels) = self.skybox.unwrap_or((1, 1));
        Uniforms {
            camera,
            sky: sky::uniforms(&light, &self.sky, params.time, night, overcast),
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

/// Seconds that are not finite are 0.
pub(crate) fn finite(seconds: f64) -> f64 {
    if seconds.is_finite() { seconds } else { 0.0 }
}

/// The texture of a role.
pub(crate) fn texture(pack: &Pack, role: Role) -> Result<&Texture, SkyError> {
    pack.texture(role).ok_or(SkyError::MissingTexture { role })
}

/// Means of the first three channels of the clouds, as the manifest gives them.
fn cloud_means(pack: &Pack) -> Result<[f32; 3], SkyError> {
    let role = Role::Clouds;
    let entry = pack
        .manifest()
        .texture(role)
        .ok_or(SkyError::MissingTexture { role })?;
    let mean = |channel: usize| entry.channels.get(channel).map_or(0.0, |c| c.mean);
    Ok([mean(0), mean(1), mean(2)])
}

fn camera_uniforms(camera: &Camera) -> CameraUniforms {
    let (rays, viewport) = (camera.rays(), camera.viewport());
    // Rows of the inverse of [right up forward]: a direction's coordinates in that basis are its clip
    // x, y and w.
    let inverse = glam::Mat3::from_cols(rays.right, rays.up, rays.forward)
        .inverse()
        .transpose();
    CameraUniforms {
        right: vec4(rays.right, viewport.x),
        up: vec4(rays.up, viewport.y),
        forward: vec4(rays.forward, 0.0),
        clip_x: vec4(inverse.x_axis, 0.0),
        clip_y: vec4(inverse.y_axis, 0.0),
        clip_w: vec4(inverse.z_axis, 0.0),
    }
}
