//! The sun.
//!
//! I. Reda, A. Andreas, "Solar position algorithm for solar radiation applications", Solar Energy 76, 2004 (NREL/TP-560-34302), by the crate
//! `solar-positioning`.

use glam::DVec3;
use solar_positioning::SolarPositions;
use solar_positioning::time::JulianDate;

use super::date::Date;
use super::frames::{
    ASTRONOMICAL_UNIT_KM, centuries, delta_t_s, mean_obliquity, nutation, observer_km, of_angles,
    sidereal, to_world,
};
use super::place::Place;

/// Where the sun is, in kilometres from the earth's centre, along the true equator of the date.
pub fn geocentric_km(date: Date) -> DVec3 {
    let found = JulianDate::new(date.julian_day(), delta_t_s(date))
        .and_then(|day| SolarPositions::new().for_time_from_julian(day));
    // It knows the years -2000 to 6000, so that every date has a sun.
    found.map_or(DVec3::X * ASTRONOMICAL_UNIT_KM, |sun| {
        let [ascension, declination] = [sun.right_ascension(), sun.declination()];
        let distance = sun.earth_radius_vector().unwrap_or(1.0) * ASTRONOMICAL_UNIT_KM;
        of_angles(ascension.to_radians(), declination.to_radians()) * distance
    })
}

/// The airless direction towards the sun from a place.
pub fn direction(date: Date, place: Place) -> DVec3 {
    let sidereal = apparent_sidereal(date, place);
    let seen = geocentric_km(date) - observer_km(sidereal, place);
    to_world(sidereal, place, seen.normalize())
}

/// Sidereal time at a place by the true equinox, in radians (Meeus, chapter 12).
pub(super) fn apparent_sidereal(date: Date, place: Place) -> f64 {
    let t = centuries(date);
    let [longitude, obliquity] = nutation(t);
    sidereal(date, place) + longitude * libm::cos(mean_obliquity(t) + obliquity)
}
