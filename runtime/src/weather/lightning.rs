//! Lightning: a flash that lights the clouds of any method from inside, at a given time and place.
//!
//! # Theory
//! A flash to the ground has three to five strokes, 60 milliseconds apart in the geometric mean, the first two to three times as
//! strong as those that follow (V. A. Rakov, M. A. Uman, "Lightning: Physics and Effects", Cambridge University Press 2003, chapters 1
//! and 4). Each rises within milliseconds and falls off exponentially. How many, how far apart and how strong is a hash of the second at
//! which the flash begins.
//!
//! Its light is scattered in the clouds and comes out of their undersides: brightest below the flash, falling with the square
//! of the distance beyond the thickness of the clouds. It shows where there is cloud, and most where cloud is thick, which
//! without it is dark.
//!
//! # Practice
//! Distances are on the plane of the dome of [`crate::geometry::dome`], in heights of [`LOW_HEIGHT_M`], whatever the method. That plane ends at
//! the horizon, 5.7 heights away: flashes beyond light the clouds at the horizon, and are dimmer. One exponential and a division a
//! pixel, in pipelines that are made when a flash is first told, before it begins; without a flash, nothing. The light does not go beyond clouds and rain: an application that wants its scene
//! lit asks [`brightness`].

use glam::{DVec2, DVec3, Vec2, Vec3};

use crate::clouds::shared::{CloudUniforms, CloudView, LOW_HEIGHT_M};
use crate::geometry::dome::CLOUD_SPHERE_RADIUS;
use crate::geometry::math::luminance;
use crate::geometry::math::mix;
use crate::geometry::part::{Part, Value};
use crate::geometry::uniforms::uniforms;
use crate::params::{Lightning, SkyParams};

/// Its part of the shader.
pub const PART: Part = Part {
    constants: &[
        ("LIGHTNING_CORE", Value::F32(CORE)),
        ("LIGHTNING_THIN", Value::F32(THIN)),
        ("LIGHTNING_CORE_FALL", Value::F32(SPREAD[0])),
        ("LIGHTNING_GLOW_FALL", Value::F32(SPREAD[1])),
    ],
    structs: &[LightningUniforms::WGSL],
    wgsl: include_str!("lightning.wgsl"),
};

uniforms! {
    /// A flash of lightning, all 0 without one.
    LightningUniforms {
        /// Its light.
        light: Vec3,
        /// 1 / luminance of the brightest cloud without it.
        per_white: f32,
        /// Where it is on the plane of the dome.
        position: Vec2,
        /// Nothing.
        _pad: Vec2,
    }
}

/// How fast the bright core and the wide glow fall, by the square of the distance in heights: half of the core is within 0.5
/// heights, and half of the glow within 0.9.
pub const SPREAD: [f32; 2] = [4.0, 0.5];
/// How much brighter than the wide glow the core is.
pub const CORE: f32 = 1.6;
/// How much less than a dark cloud one glows that is as bright as they come.
pub const THIN: f32 = 0.75;

/// Radiance of the wide glow at its middle. Air at 30000 kelvin (Rakov and Uman, chapter 4) is blue-white.
const LIGHT: Vec3 = Vec3::new(0.62, 0.70, 1.0);

/// The most strokes of a flash, and the least.
const STROKES: [u64; 2] = [3, 5];
/// The shortest and the longest time from stroke to stroke in seconds: 60 ms are their geometric mean.
const INTERVAL_S: [f64; 2] = [0.03, 0.12];
/// Strength of a subsequent stroke beside the first.
const SUBSEQUENT: [f64; 2] = [0.33, 0.6];
/// Time constants in seconds: of the rise, and of the fall, which is slower than a stroke's since continuing currents follow it.
const RISE_S: f64 = 0.002;
const FALL_S: f64 = 0.045;
/// Brightness below this is none: so a flash ends.
const LEAST: f64 = 1e-3;

/// Heights away from which a flash is moved in towards the horizon.
const FAR: f64 = 4.5;

/// How bright a flash is at a moment, from 0 to a little over its strength: 0 before it starts, and a second later.
pub fn brightness(flash: &Lightning, seconds: f64) -> f32 {
    let age_s = seconds - flash.start_s;
    if !(0.0..1.0).contains(&age_s) {
        return 0.0;
    }
    let light = |(start_s, peak): (f64, f64)| {
        let since = age_s - start_s;
        if since < 0.0 {
            return 0.0;
        }
        peak * (1.0 - (-since / RISE_S).exp()) * (-since / FALL_S).exp()
    };
    let sum: f64 = strokes(flash.start_s).into_iter().map(light).sum();
    flash.strength * (sum - LEAST).max(0.0) as f32
}

/// The strokes of the flash that begins at this second: seconds since then, and their strength.
fn strokes(start_s: f64) -> Vec<(f64, f64)> {
    let hash = |index: u64| mix(start_s.to_bits() ^ mix(index));
    let share = |index: u64| (hash(index) >> 11) as f64 / (1_u64 << 53) as f64;
    let [least, most] = STROKES;
    let count = least + hash(0) % (most - least + 1);
    let mut strokes = vec![(0.0, 1.0)];
    let mut after_s = 0.0;
    for stroke in 1..count {
        after_s += INTERVAL_S[0] * (INTERVAL_S[1] / INTERVAL_S[0]).powf(share(2 * stroke));
        let weaker = SUBSEQUENT[0] + (SUBSEQUENT[1] - SUBSEQUENT[0]) * share(2 * stroke + 1);
        strokes.push((after_s, weaker));
    }
    strokes
}

/// The flash's share of the uniforms, all 0 without one. `params` are in range.
pub fn uniforms(params: &SkyParams, view: &CloudView, clouds: &CloudUniforms) -> LightningUniforms {
    let flash = &params.weather.lightning;
    let brightness = brightness(flash, view.seconds);
    if brightness == 0.0 {
        return LightningUniforms::default();
    }
    let [east, south] = flash.place_m.map(f64::from);
    let (place, nearness) = on_the_plane(DVec2::new(east, south), view);
    let white = luminance(clouds.sunlight + clouds.ambient).max(1e-3);
    LightningUniforms {
        light: LIGHT * (brightness * nearness as f32),
        per_white: 1.0 / white,
        position: place.as_vec2(),
        ..Default::default()
    }
}

/// Where a place is on the plane of the dome, and how bright a flash there is: those beyond the horizon are moved in to it.
fn on_the_plane(place_m: DVec2, view: &CloudView) -> (DVec2, f64) {
    let DVec3 { x, z, .. } = view.place_m;
    let away = (place_m - DVec2::new(x, z)) / (LOW_HEIGHT_M * view.distance(LOW_HEIGHT_M));
    let distance = away.length();
    if distance <= FAR {
        return (away, 1.0);
    }
    let rim = f64::from(2.0 * CLOUD_SPHERE_RADIUS + 1.0).sqrt();
    let room = rim - FAR;
    let seen = FAR + room * (1.0 - (-(distance - FAR) / room).exp());
    (away * (seen / distance), FAR / distance)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn flash(start_s: f64) -> Lightning {
        Lightning {
            strength: 1.0,
            start_s,
            place_m: [0.0; 2],
        }
    }

    #[test]
    fn flashes_have_the_strokes_of_the_book() {
        let (mut counts, mut logarithms, mut intervals) = ([0; 6], 0.0, 0.0);
        for start in 0..1000 {
            let strokes = strokes(f64::from(start) * 0.37);
            counts[strokes.len()] += 1;
            assert_eq!(strokes[0], (0.0, 1.0));
            for pair in strokes.windows(2) {
                let interval: f64 = pair[1].0 - pair[0].0;
                assert!((0.03..=0.12).contains(&interval));
                assert!((0.33..=0.6).contains(&pair[1].1));
                logarithms += interval.ln();
                intervals += 1.0;
            }
            assert!(strokes[strokes.len() - 1].0 < 0.5, "within half a second");
        }
        assert!(counts[3..].iter().all(|&count| count > 250), "{counts:?}");
        // 3000 intervals over a factor of 4: the mean of their logarithms is off by 0.4 / sqrt(3000), five times at most.
        let mean_s = f64::exp(logarithms / intervals);
        assert!(
            (mean_s / 0.06).ln().abs() < 5.0 * 0.4 / 3000_f64.sqrt(),
            "{mean_s}"
        );
    }

    #[test]
    fn a_flash_starts_rises_sharply_and_is_over_after_a_second() {
        for start_s in [-7.5, 0.0, 12.34, 1e6, 1e9] {
            let at = |since: f64| brightness(&flash(start_s), start_s + since);
            assert_eq!([at(-1.0), at(-1e-3), at(0.0), at(1.0), at(100.0)], [0.0; 5]);
            // 64 bits tell 0.1 microseconds at 1e9 s.
            assert!(at(0.01) > 0.7, "{start_s}: {}", at(0.01));
            assert!(at(0.95) == 0.0 && at(0.02) < at(0.01), "{start_s}");
            let most = (0..1000)
                .map(|i| at(f64::from(i) * 1e-3))
                .fold(0.0, f32::max);
            assert!((0.7..1.6).contains(&most), "{start_s}: {most}");
        }
        let twice = |seconds: f64| {
            brightness(
                &Lightning {
                    strength: 0.5,
                    ..flash(3.0)
                },
                seconds,
            )
        };
        assert_eq!(2.0 * twice(3.02), brightness(&flash(3.0), 3.02));
    }

    #[test]
    fn far_flashes_come_in_to_the_horizon_without_a_step() {
        let view = CloudView {
            texels: 512,
            pixel_rad: 1e-3,
            seconds: 0.0,
            place_m: DVec3::new(500.0, 0.0, 0.0),
        };
        let at = |metres: f64| on_the_plane(DVec2::new(500.0 + metres, 0.0), &view);
        assert_eq!(at(1000.0), (DVec2::new(1.0, 0.0), 1.0));
        let mut last = at(0.0);
        for step in 1..10_000 {
            let now = at(f64::from(step) * 10.0);
            // Heights of 64 bits, and steps of a hundredth.
            assert!(
                (-1e-12..0.01 + 1e-12).contains(&(now.0.x - last.0.x)),
                "{step}"
            );
            assert!(now.0.x < 5.75, "{step}");
            assert!(now.1 <= last.1 && last.1 - now.1 < 0.005, "{step}");
            last = now;
        }
    }
}
