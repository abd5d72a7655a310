//! Against astropy's values, which `scripts/almanac.py` makes.

use glam::DVec3;

use super::date::Date;
use super::place::Place;
use super::planets::{self, Planet};
use super::refraction::lifted;
use super::{frames, moon, stars, sun};

const BODIES: &str = include_str!("../../tests/data/almanac.csv");
const STARS: &str = include_str!("../../tests/data/almanac-stars.csv");

/// What is promised, in degrees.
const SUN_DEG: f64 = 0.02;
const MOON_DEG: f64 = 0.2;
const PLANET_DEG: f64 = 0.2;
const STAR_DEG: f64 = 0.1;

fn rows(text: &'static str) -> impl Iterator<Item = Vec<&'static str>> {
    let lines = text.lines().filter(|line| !line.starts_with('#'));
    lines.skip(1).map(|line| line.split(',').collect())
}

fn number(text: &str) -> f64 {
    text.parse().unwrap_or_else(|_| panic!("{text}"))
}

fn moment(row: &[&str]) -> (Date, Place) {
    let place = Place {
        latitude_deg: number(row[1]) as f32,
        longitude_deg: number(row[2]) as f32,
    };
    (row[0].parse().unwrap(), place)
}

/// East, up, south of an azimuth from north to east and an elevation, in degrees.
fn of_horizon(azimuth: &str, elevation: &str) -> DVec3 {
    let [azimuth, elevation] = [azimuth, elevation].map(|text| number(text).to_radians());
    let flat = elevation.cos();
    DVec3::new(flat * azimuth.sin(), elevation.sin(), -flat * azimuth.cos())
}

fn apart_deg(a: DVec3, b: DVec3) -> f64 {
    a.cross(b).length().atan2(a.dot(b)).to_degrees()
}

#[test]
fn sun_moon_and_planets_stand_where_astropy_has_them() {
    let (mut worst, mut count) = ([0.0_f64; 8], 0);
    for row in rows(BODIES) {
        let (date, place) = moment(&row);
        let moon = moon::seen(date, place);
        let mut found = vec![sun::direction(date, place), moon.direction];
        found.extend(Planet::ALL.map(|planet| planets::seen(planet, date, place).direction));
        for (i, direction) in found.into_iter().enumerate() {
            assert!(direction.is_normalized());
            let apart = apart_deg(direction, of_horizon(row[3 + 2 * i], row[4 + 2 * i]));
            worst[i] = worst[i].max(apart);
        }
        worst[7] = worst[7].max((moon.lit_share() - number(row[17])).abs());
        count += 1;
    }
    println!("worst of {count}, in degrees and of the moon's lit share: {worst:.4?}");
    assert_eq!(count, 1000);
    assert!(worst[0] < SUN_DEG, "{worst:?}");
    assert!(worst[1] < MOON_DEG, "{worst:?}");
    assert!(worst[2..7].iter().all(|w| *w < PLANET_DEG), "{worst:?}");
    // 0.2 degrees where the share changes fastest, at the half moon.
    assert!(worst[7] < 0.5 * MOON_DEG.to_radians(), "{worst:?}");
}

#[test]
fn named_stars_stand_where_astropy_has_them() {
    let (mut worst, mut count) = ([0.0_f64; 2], 0);
    for row in rows(STARS) {
        let (date, place) = moment(&row);
        let [ascension, declination] = [4, 5].map(|i| number(row[i]).to_radians());
        let star = stars::turn(date, place) * frames::of_angles(ascension, declination);
        worst[0] = worst[0].max(apart_deg(star, of_horizon(row[6], row[7])));
        // Astropy's refraction is not made for the last degrees above the horizon, and what is below has none.
        if number(row[7]) > 5.0 {
            worst[1] = worst[1].max(apart_deg(lifted(star), of_horizon(row[6], row[8])));
            count += 1;
        }
    }
    println!("worst without and with air, in degrees: {worst:.4?}; with air {count}");
    assert!(worst.iter().all(|w| *w < STAR_DEG), "{worst:?}");
    assert!(count >= 10);
}

#[test]
fn the_sky_of_the_stars_is_turned_and_not_mirrored_or_stretched() {
    for row in rows(STARS) {
        let (date, place) = moment(&row);
        let turn = stars::turn(date, place);
        assert!((turn.determinant() - 1.0).abs() < 1e-12);
        assert!((turn.transpose() * turn).abs_diff_eq(glam::DMat3::IDENTITY, 1e-12));
    }
}

#[test]
fn the_book_s_moon_is_found() {
    // Meeus, example 47.a: 1992 April 12, 0h dynamical time: right ascension, declination, distance.
    let date: Date = "1992-04-12".parse().unwrap();
    let found = moon::geocentric_km(date.after(-frames::delta_t_s(date)));
    let wanted = frames::of_angles(134.688_470_f64.to_radians(), 13.768_368_f64.to_radians());
    assert!(
        apart_deg(found, wanted) < 0.02,
        "{}",
        apart_deg(found, wanted)
    );
    assert!(
        (found.length() - 368_409.7).abs() < 60.0,
        "{}",
        found.length()
    );
}

#[test]
fn the_moon_has_the_phases_of_the_calendar() {
    let place = Place {
        latitude_deg: 50.0,
        longitude_deg: 10.0,
    };
    let lit = |text: &str| moon::seen(text.parse().unwrap(), place).lit_share();
    // Full, new, first quarter of January 2024, and the total solar eclipse of 8 April 2024.
    assert!(lit("2024-01-25T17:54:00Z") > 0.995);
    assert!(lit("2024-01-11T11:57:00Z") < 0.01);
    assert!((lit("2024-01-18T03:53:00Z") - 0.5).abs() < 0.02);
    let dallas = Place {
        latitude_deg: 32.78,
        longitude_deg: -96.8,
    };
    let date: Date = "2024-04-08T18:42:00Z".parse().unwrap();
    let seen = moon::seen(date, dallas);
    let apart = apart_deg(seen.direction, sun::direction(date, dallas));
    assert!(apart < 0.1, "covered: {apart}");
    assert!(
        seen.radius_rad() > 0.004_653,
        "total: {}",
        seen.radius_rad()
    );
}

#[test]
fn moonlight_is_that_of_the_full_moon_and_falls_fast() {
    let at = |phase_deg: f64| {
        let moon = moon::Moon {
            direction: DVec3::Y,
            sunwards: DVec3::Y,
            distance_km: moon::MEAN_DISTANCE_KM,
            phase_rad: phase_deg.to_radians(),
        };
        moon.light()
    };
    assert_eq!(at(0.0), 1.0);
    // A half moon gives a tenth: J. Meeus, chapter 48's remark, and C. W. Allen, "Astrophysical Quantities", 1973, section 66: 0.08 to 0.1.
    assert!((0.07..0.12).contains(&at(90.0)), "{}", at(90.0));
    assert!(at(160.0) < 0.002);
}

#[test]
fn planets_are_as_bright_as_they_are_known_to_be() {
    let magnitude = |planet, text: &str| {
        let date = text.parse().unwrap();
        planets::seen(planet, date, Place::default()).magnitude
    };
    // Meeus, examples 41.b and c: Venus on 1992 December 20, Saturn on 1992 December 16.
    for (planet, date, wanted) in [
        (Planet::Venus, "1992-12-20", -4.2),
        (Planet::Saturn, "1992-12-16", 0.7),
        // Oppositions: Mars in August 2003, Jupiter in September 2022.
        (Planet::Mars, "2003-08-28", -2.9),
        (Planet::Jupiter, "2022-09-26", -2.9),
    ] {
        let found = magnitude(planet, date);
        assert!((found - wanted).abs() < 0.1, "{planet:?}: {found}");
    }
}

#[test]
fn poles_the_date_line_and_the_ends_of_time_have_a_sky() {
    for text in ["1900-01-01", "2099-12-31T23:59:59Z"] {
        for latitude_deg in [-90.0, 0.0, 90.0] {
            let date: Date = text.parse().unwrap();
            let [west, east] = [-180.0, 180.0].map(|longitude_deg| {
                let place = Place {
                    latitude_deg,
                    longitude_deg,
                };
                let moon = moon::seen(date, place);
                let mut all = vec![sun::direction(date, place), moon.direction, moon.sunwards];
                all.extend(Planet::ALL.map(|p| planets::seen(p, date, place).direction));
                assert!(all.iter().all(|direction| direction.is_normalized()));
                all
            });
            for (a, b) in west.into_iter().zip(east) {
                assert!(apart_deg(a, b) < 1e-6, "one meridian");
            }
        }
    }
}
