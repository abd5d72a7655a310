//! A place on the earth.

/// A place at sea level.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(default))]
pub struct Place {
    /// Geodetic latitude in degrees, north positive, -90..=90.
    pub latitude_deg: f32,
    /// Longitude in degrees, east positive, -180..=180.
    pub longitude_deg: f32,
}
