//! How the sky of the stars stands over a place.
//!
//! Precession and mean sidereal time; nutation and aberration, 0.01 degrees together, are left out, and so are the stars' own motions.

use glam::DMat3;

use super::date::Date;
use super::frames::{centuries, precessed, sidereal, to_world};
use super::place::Place;

/// The turn from an equator to the world at a latitude, where the sidereal time is so much, in radians; without precession.
pub fn turn_at(sidereal: f64, latitude_deg: f32) -> DMat3 {
    let place = Place {
        latitude_deg,
        longitude_deg: 0.0,
    };
    let turned = |axis| to_world(sidereal, place, axis);
    DMat3::from_cols(
        turned(DMat3::IDENTITY.x_axis),
        turned(DMat3::IDENTITY.y_axis),
        turned(DMat3::IDENTITY.z_axis),
    )
}

/// The turn from the equator of J2000 (x to right ascension 0, z to the north pole) to the world, east, up, south; without air.
pub fn turn(date: Date, place: Place) -> DMat3 {
    let (t, sidereal) = (centuries(date), sidereal(date, place));
    let turned = |axis| to_world(sidereal, place, precessed(t, axis));
    DMat3::from_cols(
        turned(DMat3::IDENTITY.x_axis),
        turned(DMat3::IDENTITY.y_axis),
        turned(DMat3::IDENTITY.z_axis),
    )
}
