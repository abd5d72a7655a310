//! The stars of a catalogue over a place and at a moment.

use glam::DMat3;

use crate::almanac;
use crate::clear_sky::catalogue::{Air, NightSky, turn_of_time};
use crate::clear_sky::cells::Cells;
use crate::clear_sky::eclipse::DUSK_SINE;
use crate::clear_sky::eye::{self, Overhead};
use crate::clear_sky::light::LitSky;
use crate::clear_sky::spread::Screen;
use crate::clear_sky::stars;
use crate::geometry::camera::{Camera, CameraUniforms};
use crate::pack_data::PackData;
use crate::params::SkyParams;

/// Texels a side of a texture of stars whose brightness those of a catalogue have: that of the default recipe.
const AS_BRIGHT_AS: u32 = 256;

impl PackData {
    /// From the equator of J2000 to the world: by the date, or with a catalogue by the plain time. Otherwise stars stand over the viewer.
    pub(crate) fn star_turn(&self, params: &SkyParams, seconds: f64) -> Option<DMat3> {
        match params.date {
            Some(date) => Some(almanac::stars::turn(date.after(seconds), params.place)),
            None => self
                .catalogue
                .is_some()
                .then(|| turn_of_time(params.time, self.noon_elevation_rad)),
        }
    }

    /// What stars of a catalogue are drawn by, if the pack has one and it is night. `params` are in range.
    pub fn night_sky(
        &self,
        lit: &LitSky,
        params: &SkyParams,
        camera: &Camera,
        seconds: f64,
    ) -> Option<NightSky> {
        let light = &lit.light;
        self.catalogue.as_ref()?;
        if !params.stars || light.night <= 0.0 {
            return None;
        }
        let air = Air::new(self.sky.aerosol_depth(params.haze));
        let sky = eye::sky_magnitude(Overhead {
            // Where stars are seen with a higher sun, it is eclipsed.
            sun_sine: light.sun.y.min(DUSK_SINE),
            moon_sine: light.moon.y,
            moonlight: light.moonlight,
            extinction: air.magnitudes(1.0),
        });
        let pixel_rad = camera.pixel_rad();
        Some(NightSky {
            turn: self.star_turn(params, seconds)?.as_mat3(),
            one: stars::radiance_of_one(AS_BRIGHT_AS, pixel_rad, light.night * light.dark),
            faintest: eye::faintest(sky),
            air,
            screen: Screen::of(pixel_rad, params.exposure_factor()),
            seconds,
        })
    }

    /// The stars of the screen, as the shader reads them; `view` is the camera's share of the uniforms.
    pub(crate) fn star_texels(
        &self,
        lit: &LitSky,
        params: &SkyParams,
        (camera, view): (&Camera, &CameraUniforms),
        seconds: f64,
    ) -> Option<Vec<[f32; 4]>> {
        let night = self.night_sky(lit, params, camera, seconds)?;
        let catalogue = self.catalogue.as_ref()?;
        let spots = catalogue.spots(&night, view);
        Some(Cells::of(camera.viewport()).texels(spots))
    }
}
