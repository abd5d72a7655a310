//! Twin of catalogue.wgsl: every star asked at every pixel, in 64 bits, without cells.

use std::f64::consts::{PI, TAU};

use glam::{DVec2, DVec3, Vec2, Vec3};
use welkin_pack::{CatalogueStar, Pack};
use welkin_runtime::almanac::{frames, refraction::lifted};
use welkin_runtime::internals::clear_sky::catalogue::{NightSky, colour};
use welkin_runtime::internals::clear_sky::eye;
use welkin_runtime::internals::clear_sky::spread::WING_END;
use welkin_runtime::internals::frame::Uniforms;

use crate::camera;
use crate::pack::catalogue_records;

/// A star on the screen.
struct Shown {
    pixel: DVec2,
    light: Vec3,
    /// The shares of tent and wing, the wing's radius and where it ends, in pixels.
    tent: f64,
    wing: f64,
    radius: f64,
    reach: f64,
}

/// The stars of a catalogue on the screen.
pub struct Stars {
    shown: Vec<Shown>,
}

/// Where a star is seen, in the world.
pub fn seen(star: &CatalogueStar, night: &NightSky) -> DVec3 {
    let [ra, dec] = [star.right_ascension_deg, star.declination_deg].map(f64::to_radians);
    lifted(night.turn.as_dmat3() * frames::of_angles(ra, dec)).normalize()
}

impl Stars {
    /// Those of a night.
    pub fn new(pack: &Pack, night: &NightSky, uniforms: &Uniforms) -> Stars {
        let mut shown = Vec::new();
        for star in catalogue_records(pack) {
            let direction = seen(&star, night);
            let ahead = direction.as_vec3().dot(uniforms.camera.clip_w.truncate());
            if direction.y <= 0.0 || ahead < 1e-3 {
                continue;
            }
            let sine = direction.y as f32;
            let magnitude = star.magnitude as f32 + night.air.magnitudes(sine);
            let share = eye::share(night.faintest, magnitude);
            let whole = colour(star.colour_index) * night.air.transmittance(sine);
            let light = whole * (10.0_f64.powf(-0.4 * star.magnitude) as f32 * night.one * share);
            let mass = 1.0 / (direction.y + 0.025 * (-11.0 * direction.y).exp());
            let amplitude = (f64::from(star.variance) / 255.0 * mass.powf(11.0 / 12.0)).min(0.8);
            let turns = f64::from(star.rate) / 64.0 * night.seconds + f64::from(star.phase) / 256.0;
            let flicker = 1.0 + amplitude * (TAU * turns.fract()).sin();
            let luminance = f64::from(light.dot(Vec3::new(0.2126, 0.7152, 0.0722)));
            let [tent, radius, reach] = spread(night, luminance);
            shown.push(Shown {
                pixel: camera::pixel_of(&uniforms.camera, direction.as_vec3()).as_dvec2(),
                light: light * flicker as f32,
                tent,
                wing: 1.0 - tent,
                radius,
                reach,
            });
        }
        Stars { shown }
    }

    /// Radiance at the pixel with centre `pixel`.
    pub fn radiance(&self, uniforms: &Uniforms, direction: Vec3, pixel: Vec2) -> Vec3 {
        let of = |star: &Shown| {
            let away = pixel.as_dvec2() - star.pixel;
            let tent = (1.0 - away.abs()).max(DVec2::ZERO);
            let mut share = star.tent * tent.x * tent.y;
            if star.wing > 0.0 && away.length() < star.reach {
                // The profile less its end, over its own integral.
                let profile = |r: f64| (r * r + star.radius * star.radius).powf(-1.5);
                let end = profile(star.reach);
                let (near, far) = (star.radius, star.reach.hypot(star.radius));
                let whole = TAU * (1.0 / near - 1.0 / far) - PI * end * star.reach * star.reach;
                share += star.wing * (profile(away.length()) - end) / whole;
            }
            star.light * share as f32
        };
        let light: Vec3 = self.shown.iter().map(of).sum();
        let narrowing = direction.dot(uniforms.camera.clip_w.truncate());
        light * (1.0 + uniforms.stars.evenness * (narrowing.powi(-3) - 1.0))
    }
}

/// The share of the light in the tent, the wing's radius and where it ends, in pixels.
fn spread(night: &NightSky, luminance: f64) -> [f64; 3] {
    let [a, white] = [night.screen.wing_px, night.screen.white].map(f64::from);
    let least = a.max(1.5);
    // Spencer's share, and no more than half of white in a pixel.
    let tent = (luminance * (1.0 - 0.478 * a / least)).min(0.5 * white);
    let rest = luminance - tent;
    let radius = (rest / (TAU * white)).sqrt().max(least);
    let reach = (rest * radius / TAU / f64::from(WING_END))
        .cbrt()
        .min(128.0);
    match reach < 1.0 + least {
        true => [1.0, least, 0.0],
        false => [tent / luminance, radius, reach],
    }
}
