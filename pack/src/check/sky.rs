//! The table of the clear sky.

use std::f32::consts::PI;

use super::report::Report;
use super::rule::{
    SKY_COLOUR, SKY_DUSK, SKY_HAZE, SKY_LIGHT, SKY_RANGE, SKY_SMOOTH, SKY_SUN, SKY_ZENITH,
};
use crate::air::{aureole_phase, skylight_lx, unit_luminance_cd_m2};
use crate::mapping::{SKY_HAZES, SKY_PARTS, SkyLayer, layer_to_sun, sky_to_texel, texel_to_sky};
use crate::role::Role;
use crate::texture::Texture;
use crate::view::View;

const NAME: &str = Role::Sky.name();

/// The least and the most that the sky's light may be of what a clear sky gives at the hour ([`skylight_lx`]).
///
/// Aerosol moves it: with none of it, by half; with an optical depth of 0.4, a dusty day, up by three (R. Bird, R. Hulstrom, "A
/// Simplified Clear Sky Model for Direct and Diffuse Insolation on Horizontal Surfaces", SERI/TR-642-761, 1981). In twilight the
/// table of the hours is of one atmosphere, and light scattered many times decides.
const SHARES: [f32; 2] = [0.4, 3.0];

/// How much green is above red and blue above green at the least, of luminance: what is closer is grey to the eye (five hundredths are some four ellipses of MacAdam).
const LEAST_BLUE: f64 = 0.05;

/// Luminance below which a bend is not seen: 1 is white.
const SEEN: f32 = 0.01;

/// Elevation from which the sun's side is looked at, in radians: 5 degrees. Lower down, rows about it are of other elevations by as much as the sky changes there.
const WHOLE_SUN_RAD: f32 = 0.087;

/// Down to here the table of the hours is compared with, in degrees: farther down the light of the night, which is not in the table of the sky, decides.
const LAST_LIT_DEG: f32 = -10.0;

pub(super) fn check(report: &mut Report, texture: &Texture) {
    let texels = texture.view_of_level(0);
    let wrong = texels
        .texels()
        .filter(|t| !t.iter().all(|v| v.is_finite() && *v >= 0.0) || t[3] != 0.0)
        .count();
    report.at_most(SKY_RANGE, NAME, wrong as f64, 0.0);
    if wrong > 0 {
        for rule in [
            SKY_ZENITH, SKY_SMOOTH, SKY_SUN, SKY_LIGHT, SKY_COLOUR, SKY_DUSK, SKY_HAZE,
        ] {
            report.skip(rule, NAME, "the light is not sound");
        }
        return;
    }
    let table = Table::new(texture);
    table.check_zenith(report);
    table.check_smooth(report);
    table.check_sun(report);
    table.check_light(report);
    table.check_colour(report);
    table.check_dusk(report);
    table.check_haze(report);
}

/// The layers, with what they stand for.
struct Table<'a> {
    texture: &'a Texture,
    suns: u32,
    size: [u32; 2],
}

impl Table<'_> {
    fn new(texture: &Texture) -> Table<'_> {
        Table {
            texture,
            suns: texture.layers / (SKY_HAZES * SKY_PARTS),
            size: [texture.width, texture.height],
        }
    }

    fn view(&self, haze: u32, sun: u32, part: u32) -> View<'_> {
        self.texture
            .view(0, SkyLayer { haze, sun, part }.index(self.suns))
    }

    fn sun_rad(&self, sun: u32) -> f32 {
        layer_to_sun(sun as f32, self.suns)
    }

    /// Every sky: haze and sun.
    fn skies(&self) -> impl Iterator<Item = (u32, u32)> {
        let suns = self.suns;
        (0..SKY_HAZES).flat_map(move |haze| (0..suns).map(move |sun| (haze, sun)))
    }

    fn places(&self) -> impl Iterator<Item = (u32, u32)> {
        let [width, height] = self.size;
        (0..height).flat_map(move |y| (0..width).map(move |x| (x, y)))
    }

    /// Luminance at a texel, aureole and all.
    fn whole(&self, haze: u32, sun: u32, x: u32, y: u32) -> f32 {
        let (sine, azimuth_cos) = texel_to_sky([x as f32, y as f32], self.size);
        let sun_sine = libm::sinf(self.sun_rad(sun));
        let flat = |sine: f32| libm::sqrtf((1.0 - sine * sine).max(0.0));
        let cosine = sine * sun_sine + flat(sine) * flat(sun_sine) * azimuth_cos;
        let part = |part| luminance(self.view(haze, sun, part).texel(x, y));
        part(0) + part(1) * aureole_phase(cosine.clamp(-1.0, 1.0))
    }

    /// The zenith is one direction, whatever azimuth it is seen at.
    fn check_zenith(&self, report: &mut Report) {
        let last = self.size[1] - 1;
        let mut worst = 0.0_f32;
        for layer in 0..self.texture.layers {
            let view = self.texture.view(0, layer);
            let first = view.texel(0, last);
            for texel in (1..self.size[0]).map(|x| view.texel(x, last)) {
                let apart = first.iter().zip(texel).map(|(a, b)| (a - b).abs());
                worst = worst.max(apart.fold(0.0, f32::max) / luminance(first).max(1e-6));
            }
        }
        // A step of a half float in each of the two.
        report.at_most(SKY_ZENITH, NAME, worst, 2.0 / 1024.0);
    }

    /// The largest bend of luminance from texel to texel along a row, a column and the suns, over the brightest of both neighbours.
    fn check_smooth(&self, report: &mut Report) {
        let [width, height] = self.size;
        let mut worst = 0.0_f32;
        for (haze, sun) in self.skies() {
            for part in 0..SKY_PARTS {
                let here = self.view(haze, sun, part);
                let brightest = here.texels().map(luminance).fold(0.0, f32::max);
                for (x, y) in self.places() {
                    let at = |x: u32, y: u32| luminance(here.texel(x, y));
                    let mut bend = |a: f32, b: f32, c: f32| {
                        let scale = a.max(b).max(c).max(0.4 * brightest).max(SEEN);
                        worst = worst.max((a - 2.0 * b + c).abs() / scale);
                    };
                    if (1..width - 1).contains(&x) {
                        bend(at(x - 1, y), at(x, y), at(x + 1, y));
                    }
                    if (1..height - 1).contains(&y) {
                        bend(at(x, y - 1), at(x, y), at(x, y + 1));
                    }
                }
            }
        }
        // A texel half as bright again as its neighbours bends by 0.67; the steepest that is seen, the foot of a hazy sky, by 0.52.
        report.at_most(SKY_SMOOTH, NAME, worst, 0.7);
    }

    /// How much brighter than towards the sun either part is anywhere else at the sun's elevation. There the way through the air is the same all around,
    /// and molecules scatter most forwards and backwards.
    fn check_sun(&self, report: &mut Report) {
        let mut worst = 0.0_f32;
        for (haze, sun) in self.skies() {
            let sun_rad = self.sun_rad(sun);
            if sun_rad < WHOLE_SUN_RAD {
                continue;
            }
            let [_, row] = sky_to_texel(libm::sinf(sun_rad), 1.0, self.size);
            for part in 0..SKY_PARTS {
                let view = self.view(haze, sun, part);
                let at = |x| luminance(view.texel(x, (row + 0.5) as u32));
                let most = (1..self.size[0]).map(at).fold(0.0, f32::max);
                worst = worst.max(most / at(0).max(1e-6));
            }
        }
        // A step of a half float in each of the two.
        report.at_most(SKY_SUN, NAME, worst, 1.0 + 2.0 / 1024.0);
    }

    /// Illuminance of a horizontal plane by the sky, in lux.
    fn diffuse_lx(&self, haze: u32, sun: u32) -> f32 {
        let [width, height] = self.size;
        let azimuth = |x: f32| libm::acosf(texel_to_sky([x, 0.0], self.size).1.clamp(-1.0, 1.0));
        let sine = |y: f32| texel_to_sky([0.0, y], self.size).0;
        let mut sum = 0.0_f64;
        for (x, y) in self.places() {
            // The half texels about it, and no farther than the table goes.
            let around =
                |i: u32, last: u32| [(i as f32 - 0.5).max(0.0), (i as f32 + 0.5).min(last as f32)];
            let [left, right] = around(x, width - 1).map(azimuth);
            let [low, high] = around(y, height - 1).map(sine);
            // Twice, for both sides of the sun; the integral of the sine over the solid angle is half of its square.
            let weight = 2.0 * (right - left) * 0.5 * (high * high - low * low);
            sum += f64::from(self.whole(haze, sun, x, y) * weight);
        }
        sum as f32 * unit_luminance_cd_m2(self.sun_rad(sun))
    }

    /// How far the light of the clear air is outside of what the hour lets it be, as a factor.
    fn check_light(&self, report: &mut Report) {
        let mut worst = 0.0_f32;
        for sun in 0..self.suns {
            let sun_rad = self.sun_rad(sun);
            let degrees = sun_rad * (180.0 / PI);
            if degrees < LAST_LIT_DEG {
                continue;
            }
            let [least, most] = SHARES;
            let share = self.diffuse_lx(0, sun) / skylight_lx(sun_rad);
            worst = worst.max(share / most).max(least / share.max(1e-9));
        }
        report.at_most(SKY_LIGHT, NAME, worst, 1.0);
    }

    /// Air scatters blue more than green and green more than red, and least of all that comes from above is reddened.
    fn check_colour(&self, report: &mut Report) {
        let [r, g, b, _] = self
            .view(0, self.suns * 3 / 4, 0)
            .texel(0, self.size[1] - 1);
        let apart = (g - r).min(b - g) / luminance([r, g, b, 0.0]).max(1e-6);
        report.at_least(SKY_COLOUR, NAME, apart, LEAST_BLUE);
    }

    /// With the sun just below the horizon the sky is brighter on its side; with the sun high, brighter at the horizon than overhead.
    fn check_dusk(&self, report: &mut Report) {
        let [width, height] = self.size;
        let dusk = (0..self.suns).filter(|&sun| (-0.1..-0.02).contains(&self.sun_rad(sun)));
        let side = |sun, x| {
            (0..height / 2)
                .map(|y| self.whole(0, sun, x, y))
                .sum::<f32>()
        };
        let ratio = dusk
            .map(|sun| side(sun, 0) / side(sun, width - 1).max(1e-6))
            .fold(f32::MAX, f32::min);
        report.at_least(SKY_DUSK, "sunward / opposite", ratio, 1.2);
        let high = (0..self.suns).filter(|&sun| self.sun_rad(sun) > 0.35);
        let at = |sun, y| luminance(self.view(0, sun, 0).texel(0, y));
        let ratio = high
            .map(|sun| at(sun, 0) / at(sun, height - 1).max(1e-6))
            .fold(f32::MAX, f32::min);
        report.at_least(SKY_DUSK, "horizon / zenith", ratio, 1.0);
    }

    /// More aerosol makes a brighter aureole about a sun overhead. Scattered once, that is `t exp(-t)` at an optical depth of t: it grows up to 1, and falls back
    /// to what it is at 0.4, ten times that of clear air, only at 2, the most that there may be.
    fn check_haze(&self, report: &mut Report) {
        let [clear, hazy] = [0, 1].map(|haze| {
            let view = self.view(haze, self.suns - 1, 1);
            luminance(view.texel(0, self.size[1] - 1))
        });
        // Two steps of a half float: they are not the same.
        let least = 1.0 + 2.0 / 1024.0;
        report.at_least(SKY_HAZE, NAME, hazy / clear.max(1e-6), least);
    }
}

/// Luminance of linear BT.709 colour (ITU-R BT.709-6, item 3.2).
fn luminance(t: [f32; 4]) -> f32 {
    0.2126 * t[0] + 0.7152 * t[1] + 0.0722 * t[2]
}
