//! How the air lifts what is seen through it.

use glam::DVec3;
use libm::tan;

/// Degrees of elevation between which it fades below the horizon: there nothing is seen, and what sinks must not leap.
const FADE_DEG: [f64; 2] = [-3.0, -0.6];

/// By how many degrees the air of sea level at 10 degrees Celsius lifts what stands at an elevation.
///
/// T. Saemundsson, "Atmospheric Refraction", Sky and Telescope 72, 1986, as J. Meeus has it, "Astronomical Algorithms", 1998, (16.4), 0 at the zenith:
/// within 0.1 minutes of arc above the horizon.
pub fn refraction_deg(elevation_deg: f64) -> f64 {
    let minutes = |h: f64| 1.02 / tan((h + 10.3 / (h + 5.11)).to_radians());
    let [low, high] = FADE_DEG;
    let t = ((elevation_deg - low) / (high - low)).clamp(0.0, 1.0);
    let share = t * t * (3.0 - 2.0 * t);
    share * (minutes(elevation_deg.max(low)) - minutes(90.0)).max(0.0) / 60.0
}

/// The same as a shader has it, for the sines of elevations above the horizon: what is added to a unit vector's height before it is made one again,
/// `LIFT[0] / (y + LIFT[1] / (1 + LIFT[2] y))`. Fitted to [`refraction_deg`] by least fourth powers, within 0.0001 degrees above the horizon.
pub const LIFT: [f32; 3] = [2.966_491e-4, 0.035_183_51, 11.196_601];

/// The least sine at which [`lift`] is told: below, there is nothing to be seen.
pub const LEAST_SINE: f32 = -0.012;

/// See [`LIFT`].
pub fn lift(sine: f32) -> f32 {
    let [light, low, bend] = LIFT;
    let sine = sine.max(LEAST_SINE);
    light / (sine + low / (1.0 + bend * sine.max(0.0)))
}

/// A direction of the world as it is seen through the air.
pub fn lifted(direction: DVec3) -> DVec3 {
    let flat = direction.x.hypot(direction.z);
    if flat < 1e-9 {
        return direction;
    }
    let elevation = libm::atan2(direction.y, flat);
    let seen = elevation + refraction_deg(elevation.to_degrees()).to_radians();
    let wide = libm::cos(seen) / flat;
    DVec3::new(wide * direction.x, libm::sin(seen), wide * direction.z)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_is_the_almanacs() {
        // Minutes of arc at a true elevation: Meeus's own example, and the horizon of the Nautical Almanac, 34' at an apparent 0.
        for (elevation_deg, minutes) in [(33.0 / 60.0, 24.6), (-34.0 / 60.0, 34.0)] {
            let found = 60.0 * refraction_deg(elevation_deg);
            assert!((found - minutes).abs() < 0.6, "{elevation_deg}: {found}");
        }
        assert_eq!(refraction_deg(90.0), 0.0);
        assert_eq!(refraction_deg(-3.0), 0.0);
        assert_eq!(refraction_deg(-90.0), 0.0);
    }

    #[test]
    fn what_rises_rises_and_never_leaps() {
        let seen = |step: i32| {
            let elevation = f64::from(step) * 0.01;
            elevation + refraction_deg(elevation)
        };
        for step in -9000..9000 {
            let rise = seen(step + 1) - seen(step);
            assert!((0.005..0.015).contains(&rise), "{step}: {rise}");
        }
    }

    #[test]
    fn the_shader_s_lift_is_the_same() {
        for step in 0..=900 {
            let elevation = (f64::from(step) * 0.1).to_radians();
            let (sine, cosine) = elevation.sin_cos();
            let seen = (sine + f64::from(lift(sine as f32))).atan2(cosine);
            let found_deg = (seen - elevation).to_degrees();
            let off = (found_deg - refraction_deg(elevation.to_degrees())).abs();
            assert!(off < 2e-4, "{step}: {off}");
        }
    }

    #[test]
    fn a_lifted_direction_keeps_its_azimuth() {
        for direction in [DVec3::new(0.6, 0.1, -0.7), DVec3::new(-0.3, -0.001, 0.2)] {
            let (from, to) = (direction.normalize(), lifted(direction.normalize()));
            assert!(to.is_normalized() && to.y > from.y);
            assert!((to.x * from.z - to.z * from.x).abs() < 1e-12);
        }
        for pole in [DVec3::Y, DVec3::NEG_Y] {
            assert_eq!(lifted(pole), pole);
        }
    }
}
