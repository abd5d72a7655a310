//! An eclipse of the sun: how much of its light the moon leaves.
//!
//! # Theory
//! The moon's disc before the sun's hides a part of it. Daylight is dimmed by the light of that part, which is darker at the limb. What is left in
//! totality comes from beyond the shadow, as at dusk it comes from beyond the horizon: S. M. Silverman, E. G. Mullen, "Sky brightness during eclipses: a review",
//! Applied Optics 14, 1975, find a thousandth to a hundred thousandth of the sky's light in totality, as at the end of civil twilight, and that all around. So totality is that dusk, evened around the
//! horizon.
//!
//! # Practice
//! A sum over rings of the disc once a frame, and none where the discs are apart.

use glam::DVec3;

/// Half the sun's angular diameter, in radians: 0.2666 degrees at its mean distance.
pub const SUN_RADIUS_RAD: f32 = 0.004_653;

/// Sine of the sun's elevation at whose dusk it is as light as in totality: 6 degrees below the horizon, the end of civil twilight.
pub const DUSK_SINE: f32 = -0.104_528;

/// Rings of the sun's disc. They are the narrower the nearer the limb, to a fifteenth of a second of arc: the last light goes in steps that nobody sees.
const RINGS: u32 = 64;

/// The share of the sun's light that the moon's disc covers, 0 to 1, from two directions and radii in radians.
///
/// The disc is as bright as `2/5 + 3/5 mu` (A. S. Eddington, "The Internal Constitution of the Stars", 1926, section 226).
pub fn covered(sun: DVec3, moon: DVec3, [sun_rad, moon_rad]: [f64; 2]) -> f64 {
    let apart = sun.cross(moon).length().atan2(sun.dot(moon)) / sun_rad;
    let moon_radius = moon_rad / sun_rad;
    if apart >= 1.0 + moon_radius {
        return 0.0;
    }
    let (mut hidden, mut whole) = (0.0, 0.0);
    for ring in 0..RINGS {
        let angle = std::f64::consts::FRAC_PI_2 * (f64::from(ring) + 0.5) / f64::from(RINGS);
        let (radius, mu) = (libm::sin(angle), libm::cos(angle));
        let light = radius * mu * (0.4 + 0.6 * mu);
        whole += light;
        hidden += light * ring_share(radius, apart, moon_radius);
    }
    hidden / whole
}

/// The share of a circle about the sun's middle that is behind the moon, whose middle is so far from it.
fn ring_share(radius: f64, apart: f64, moon_radius: f64) -> f64 {
    if radius + apart <= moon_radius {
        return 1.0;
    }
    if apart < 1e-12 {
        return 0.0;
    }
    let cosine =
        (radius * radius + apart * apart - moon_radius * moon_radius) / (2.0 * radius * apart);
    libm::acos(cosine.clamp(-1.0, 1.0)) / std::f64::consts::PI
}

#[cfg(test)]
mod tests {
    use super::*;

    const SUN_RAD: f64 = 0.004_65;

    fn at(apart: f64, moon_radius: f64) -> f64 {
        let moon = DVec3::new(libm::sin(apart * SUN_RAD), 0.0, -libm::cos(apart * SUN_RAD));
        covered(DVec3::NEG_Z, moon, [SUN_RAD, moon_radius * SUN_RAD])
    }

    #[test]
    fn discs_apart_hide_nothing_and_a_larger_moon_everything() {
        assert_eq!(at(2.1, 1.05), 0.0);
        assert_eq!(at(0.0, 1.05), 1.0);
        assert_eq!(at(0.03, 1.05), 1.0);
    }

    #[test]
    fn a_smaller_moon_leaves_the_ring_that_it_leaves() {
        // The light beyond a radius of m, in closed form: of the disc's integral 2/5 + 2/5, what is left where mu < sqrt(1 - m^2).
        let m = 0.94_f64;
        let mu = (1.0 - m * m).sqrt();
        let left = (0.4 * mu * mu + 0.4 * mu.powi(3)) / 0.8;
        assert!((1.0 - at(0.0, m) - left).abs() < 0.01, "{}", at(0.0, m));
    }

    #[test]
    fn half_of_a_sun_of_even_light_is_hidden_where_geometry_has_it() {
        // Equal discs whose rims go through each other's middles hide (2/3 - sqrt(3) / (2 pi)) = 0.391 of the area, and of a disc darker at the limb, whose
        // middle is not all covered, no more than some hundredths from that.
        let found = at(1.0, 1.0);
        assert!((0.36..0.42).contains(&found), "{found}");
    }

    #[test]
    fn the_light_goes_and_never_leaps() {
        let mut last = at(2.1, 1.04);
        for step in 1..=4200 {
            let now = at(2.1 - 5e-4 * f64::from(step), 1.04);
            assert!(now >= last - 1e-12, "{step}");
            // What eyes keep of light is its cube root; a step is about a second of time.
            let [before, after] = [last, now].map(|hidden| (1.0 - hidden + 4e-5).cbrt());
            assert!(before - after < 0.01, "{step}: {before} {after}");
            last = now;
        }
        assert_eq!(last, 1.0);
    }
}
