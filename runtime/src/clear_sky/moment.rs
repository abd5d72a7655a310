//! Where sun and moon stand at a moment: by the plain time of day, or by date and place.

use glam::Vec3;
use welkin_pack::mapping;

use crate::almanac::refraction::lifted;
use crate::almanac::{Date, Place, moon, sun};
use crate::clear_sky::eclipse::{SUN_RADIUS_RAD, covered};
use crate::geometry::math::smoothstep;

/// Where sun and moon stand, as they are seen through the air.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Moment {
    /// Unit direction towards the sun.
    pub sun: Vec3,
    /// Unit direction towards the moon.
    pub moon: Vec3,
    /// The moon's light over that of the full moon, 0 to 1.2: it comes nearer.
    pub moonlight: f32,
    /// Times of day, 0 to 1, for what knows no other sun than the pack's, and the weight of each.
    pub hours: [Hour; 2],
    /// The share of the sun's light that the moon covers, 0 to 1.
    pub eclipsed: f32,
    /// What else a date tells of the moon.
    pub disc: Option<MoonDisc>,
}

/// All that the light of a moment depends on: where sun and moon stand; haze and the moon's strength.
pub type Lighting = (Moment, [f32; 2]);

/// How the moon of a date looks.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MoonDisc {
    /// Unit direction towards the sun from the moon.
    pub sunwards: Vec3,
    /// Half of its angular size, in radians.
    pub radius_rad: f32,
    /// The angle between sun and viewer as it sees them, in radians.
    pub phase_rad: f32,
}

/// A time of day, 0 to 1, and its weight.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Hour {
    /// 0 midnight, 0.5 noon.
    pub time: f32,
    /// The weights of a moment add up to 1.
    pub weight: f32,
}

/// How far the sun goes to east and west, as a sine, while morning becomes evening.
const NOON: f32 = 0.2;

impl Moment {
    /// The equinox of [`mapping::sun_direction`], with a full moon opposite the sun.
    pub fn of_time(time: f32, noon_elevation_rad: f32) -> Moment {
        let sun = Vec3::from(mapping::sun_direction(time, noon_elevation_rad));
        Moment {
            sun,
            moon: -sun,
            moonlight: 1.0,
            hours: [Hour { time, weight: 1.0 }, Hour::default()],
            eclipsed: 0.0,
            disc: None,
        }
    }

    /// The sky of a date and place. Its hours are those at which the pack's sun stands as high, or highest where it never does; morning goes
    /// over to evening as the sun goes from east to west.
    pub fn of_date(date: Date, place: Place, noon_elevation_rad: f32) -> Moment {
        let airless_sun = sun::direction(date, place);
        let sun = lifted(airless_sun).as_vec3();
        let moon = moon::seen(date, place);
        let radii_rad = [f64::from(SUN_RADIUS_RAD), moon.radius_rad()];
        let highest = libm::sinf(noon_elevation_rad).max(1e-3);
        let turn = libm::acosf((sun.y / highest).clamp(-1.0, 1.0)) / std::f32::consts::TAU;
        let morning = smoothstep(-NOON, NOON, sun.x);
        Moment {
            sun,
            moon: lifted(moon.direction).as_vec3(),
            moonlight: moon.light() as f32,
            eclipsed: covered(airless_sun, moon.direction, radii_rad) as f32,
            disc: Some(MoonDisc {
                sunwards: moon.sunwards.as_vec3(),
                radius_rad: moon.radius_rad() as f32,
                phase_rad: moon.phase_rad as f32,
            }),
            hours: [
                Hour {
                    time: 0.5 - turn,
                    weight: morning,
                },
                Hour {
                    // Midnight is 0.
                    time: (0.5 + turn).fract(),
                    weight: 1.0 - morning,
                },
            ],
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const NOON_RAD: f32 = 1.1;

    fn of(text: &str, latitude_deg: f32, longitude_deg: f32) -> Moment {
        let place = Place {
            latitude_deg,
            longitude_deg,
        };
        Moment::of_date(text.parse().unwrap(), place, NOON_RAD)
    }

    #[test]
    fn the_sun_keeps_the_compass() {
        // Saint Petersburg at midsummer: sunset in the north-west at 19:26 UTC, noon in the south, and a light night.
        let noon = of("2026-06-21T10:01:00Z", 59.9, 30.3);
        assert!(noon.sun.z > 0.5 && noon.sun.x.abs() < 0.01, "{}", noon.sun);
        assert!((noon.sun.y.asin().to_degrees() - 53.5).abs() < 0.2);
        let evening = of("2026-06-21T19:20:00Z", 59.9, 30.3).sun;
        assert!(evening.x < -0.5 && evening.z < -0.5 && evening.y.abs() < 0.02);
        let night = of("2026-06-21T22:01:00Z", 59.9, 30.3).sun.y;
        assert!((-0.15..-0.08).contains(&night), "{night}");
    }

    #[test]
    fn hours_are_those_of_a_sun_as_high() {
        for (text, is_morning) in [
            ("2026-03-20T08:00:00Z", true),
            ("2026-03-20T15:00:00Z", false),
        ] {
            let moment = of(text, 40.0, 0.0);
            let [morning, evening] = moment.hours;
            assert_eq!(
                [morning.weight, evening.weight],
                match is_morning {
                    true => [1.0, 0.0],
                    false => [0.0, 1.0],
                }
            );
            for hour in moment.hours {
                let height = mapping::sun_direction(hour.time, NOON_RAD)[1];
                assert!((height - moment.sun.y).abs() < 1e-5, "{hour:?}");
            }
        }
        // Of a sun that stands higher than the pack's ever does, both are noon.
        let high = of("2026-03-20T12:07:00Z", 0.0, 0.0).hours;
        assert!(high.iter().all(|hour| hour.time == 0.5), "{high:?}");
    }

    #[test]
    fn hours_and_directions_never_leap() {
        let start: Date = "2026-02-10".parse().unwrap();
        for latitude_deg in [-90.0, -35.0, 0.0, 60.0, 90.0] {
            let place = Place {
                latitude_deg,
                longitude_deg: 12.0,
            };
            let mix = |m: &Moment| -> f32 {
                let light = |hour: &Hour| hour.weight * (hour.time * std::f32::consts::TAU).sin();
                m.hours.iter().map(light).sum()
            };
            let mut last = Moment::of_date(start, place, NOON_RAD);
            for minute in 1..3 * 1440 {
                let now = Moment::of_date(start.after(60.0 * f64::from(minute)), place, NOON_RAD);
                // A turn a day, a little more while the air lifts.
                assert!(now.sun.distance(last.sun) < 0.007, "{minute}");
                assert!(now.moon.distance(last.moon) < 0.007, "{minute}");
                assert!((now.moonlight - last.moonlight).abs() < 1e-3);
                assert!(
                    (mix(&now) - mix(&last)).abs() < 0.12,
                    "{minute} at {latitude_deg}"
                );
                last = now;
            }
        }
    }

    #[test]
    fn the_plain_time_is_as_it_was() {
        let moment = Moment::of_time(0.3, 1.0);
        assert_eq!(moment.sun, Vec3::from(mapping::sun_direction(0.3, 1.0)));
        assert_eq!((moment.moon, moment.moonlight), (-moment.sun, 1.0));
        assert_eq!(
            moment.hours[0],
            Hour {
                time: 0.3,
                weight: 1.0
            }
        );
        assert_eq!(moment.hours[1].weight, 0.0);
    }
}
