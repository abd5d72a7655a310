//! The way towards the sun on a flat layer of clouds.
//!
//! # Practice
//! What is drawn along it is kept until the sun has moved into another cell of [`CELL_RAD`], and is drawn for the middle of that cell: it
//! follows from the sun's direction alone, never from where it was before.

use glam::{DVec2, Vec3};

/// How far the sun goes, in azimuth or elevation, before a march is drawn anew: 1/16 degree, in radians.
pub const CELL_RAD: f64 = std::f64::consts::PI / 180.0 / 16.0;

/// The middle of the cell in which the sun stands.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct SunCell {
    /// Unit vector to its azimuth (east, south).
    pub towards: DVec2,
    /// Its elevation in radians.
    pub elevation_rad: f64,
}

impl SunCell {
    /// That of a sun in this unit direction.
    pub fn of(sun: Vec3) -> SunCell {
        let azimuth = f64::from(sun.x).atan2(-f64::from(sun.z));
        let elevation = f64::from(sun.y).clamp(-1.0, 1.0).asin();
        let [azimuth_rad, elevation_rad] =
            [azimuth, elevation].map(|angle| ((angle / CELL_RAD).floor() + 0.5) * CELL_RAD);
        SunCell {
            // East and south of an azimuth that goes from north towards east.
            towards: DVec2::new(azimuth_rad.sin(), -azimuth_rad.cos()),
            elevation_rad,
        }
    }
}

/// The direction of a sun that stands at these angles.
#[cfg(test)]
pub(crate) fn sun(azimuth_deg: f32, elevation_deg: f32) -> Vec3 {
    Vec3::from(welkin_pack::mapping::direction_from_angles(
        azimuth_deg.to_radians(),
        elevation_deg.to_radians(),
    ))
}
