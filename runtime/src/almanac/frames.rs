//! From the sky of the stars to that of a place: time, sidereal time, precession, nutation, the horizon.
//!
//! J. Meeus, "Astronomical Algorithms", second edition, 1998; chapters and equations are his.

use glam::DVec3;
use libm::{cos, sin};
use solar_positioning::delta_t;

use super::date::Date;
use super::place::Place;

/// Kilometres of the earth's equatorial radius: WGS 84.
pub const EARTH_RADIUS_KM: f64 = 6378.137;
/// Square of the eccentricity of its meridians: WGS 84.
const ECCENTRICITY_SQUARED: f64 = 0.006_694_379_990_14;
/// Kilometres of the astronomical unit. IAU 2012, resolution B2.
pub const ASTRONOMICAL_UNIT_KM: f64 = 149_597_870.7;

/// Julian centuries of terrestrial time since J2000.
///
/// The earth's rotation falls behind by F. Espenak's and J. Meeus's fit, with newer years by `solar-positioning`.
pub fn centuries(date: Date) -> f64 {
    (date.julian_day() + delta_t_s(date) / 86_400.0 - 2_451_545.0) / 36_525.0
}

/// Terrestrial time less universal time, in seconds.
pub fn delta_t_s(date: Date) -> f64 {
    // Every year of a date has one.
    delta_t::estimate(date.decimal_year()).unwrap_or(69.0)
}

/// Nutation in longitude and in obliquity, in radians, to half a second of arc (chapter 22).
pub fn nutation(t: f64) -> [f64; 2] {
    let node = (125.044_52 - 1_934.136_261 * t).to_radians();
    let sun = (280.4665 + 36_000.769_8 * t).to_radians();
    let moon = (218.3165 + 481_267.881_3 * t).to_radians();
    let longitude = -17.20 * sin(node) - 1.32 * sin(2.0 * sun) - 0.23 * sin(2.0 * moon)
        + 0.21 * sin(2.0 * node);
    let obliquity =
        9.20 * cos(node) + 0.57 * cos(2.0 * sun) + 0.10 * cos(2.0 * moon) - 0.09 * cos(2.0 * node);
    [longitude, obliquity].map(|seconds| (seconds / 3600.0).to_radians())
}

/// Mean obliquity of the ecliptic, in radians (22.2).
pub fn mean_obliquity(t: f64) -> f64 {
    let seconds = t * (-46.8150 + t * (-0.000_59 + t * 0.001_813));
    (23.439_291_11 + seconds / 3600.0).to_radians()
}

/// Mean sidereal time at a place, in radians, not reduced (12.4).
pub fn sidereal(date: Date, place: Place) -> f64 {
    let days = date.julian_day() - 2_451_545.0;
    let t = days / 36_525.0;
    let whole_turns = 360.0 * (days - days.floor());
    let rest =
        280.460_618_37 + 0.985_647_366_29 * days + t * t * (0.000_387_933 - t / 38_710_000.0);
    (whole_turns + rest + f64::from(place.longitude_deg)).to_radians()
}

/// A direction of the equator of J2000 in that of a date: precession (21.3).
pub fn precessed(t: f64, direction: DVec3) -> DVec3 {
    let angle = |a: f64, b: f64, c: f64| (t * (a + t * (b + t * c)) / 3600.0).to_radians();
    let zeta = angle(2306.2181, 0.301_88, 0.017_998);
    let z = angle(2306.2181, 1.094_68, 0.018_203);
    let theta = angle(2004.3109, -0.426_65, -0.041_833);
    let turned = about_z(direction, zeta);
    let (sine, cosine) = (sin(theta), cos(theta));
    let tilted = DVec3::new(
        cosine * turned.x - sine * turned.z,
        turned.y,
        sine * turned.x + cosine * turned.z,
    );
    about_z(tilted, z)
}

/// A direction of the ecliptic in the equator.
pub fn of_ecliptic(obliquity: f64, ecliptic: DVec3) -> DVec3 {
    let (sine, cosine) = (sin(obliquity), cos(obliquity));
    DVec3::new(
        ecliptic.x,
        cosine * ecliptic.y - sine * ecliptic.z,
        sine * ecliptic.y + cosine * ecliptic.z,
    )
}

/// A vector of right ascension and declination, in radians.
pub fn of_angles(right_ascension: f64, declination: f64) -> DVec3 {
    let flat = cos(declination);
    DVec3::new(
        flat * cos(right_ascension),
        flat * sin(right_ascension),
        sin(declination),
    )
}

/// A vector of the equator of the date in the world, east, up, south; `sidereal` is the place's.
pub fn to_world(sidereal: f64, place: Place, equatorial: DVec3) -> DVec3 {
    // To the meridian, to the east, to the pole.
    let local = about_z(equatorial, -sidereal);
    let latitude = f64::from(place.latitude_deg).to_radians();
    let (sine, cosine) = (sin(latitude), cos(latitude));
    DVec3::new(
        local.y,
        cosine * local.x + sine * local.z,
        sine * local.x - cosine * local.z,
    )
}

/// Where a place is, in kilometres from the earth's centre, along the equator of the date.
pub fn observer_km(sidereal: f64, place: Place) -> DVec3 {
    let latitude = f64::from(place.latitude_deg).to_radians();
    let (sine, cosine) = (sin(latitude), cos(latitude));
    let normal_km = EARTH_RADIUS_KM / (1.0 - ECCENTRICITY_SQUARED * sine * sine).sqrt();
    let flat_km = normal_km * cosine;
    DVec3::new(
        flat_km * cos(sidereal),
        flat_km * sin(sidereal),
        normal_km * (1.0 - ECCENTRICITY_SQUARED) * sine,
    )
}

/// A vector turned about the pole, from x towards y.
pub fn about_z(v: DVec3, angle: f64) -> DVec3 {
    let (sine, cosine) = (sin(angle), cos(angle));
    DVec3::new(cosine * v.x - sine * v.y, sine * v.x + cosine * v.y, v.z)
}
