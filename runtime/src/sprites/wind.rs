//! How the wind moves the field of clouds, and how high it is lifted.

use glam::DVec3;

use crate::clouds::shared::{LOW_HEIGHT_M, MAX_WIND};
use crate::params::SkyParams;

/// The height of clouds ([`SkyParams::height`]) at which the field is where its recipe put it, and what 1 more lifts it by, in metres.
const HEIGHT: [f32; 2] = [0.7, 1000.0];

/// Where the field goes at speed 1, as a share of the fastest wind: to the east and to the south.
const WIND: [f64; 2] = [0.80, 0.60];

/// How far the field is lifted, in metres. `params` are in range.
pub fn lift_m(params: &SkyParams) -> f64 {
    f64::from((params.height - HEIGHT[0]) * HEIGHT[1])
}

/// Where a place of the world is in the field that the wind has blown and [`lift_m`] lifted.
pub fn in_field(params: &SkyParams, place_m: DVec3, seconds: f64) -> DVec3 {
    let way = MAX_WIND * LOW_HEIGHT_M * f64::from(params.speed) * seconds;
    place_m - DVec3::new(WIND[0] * way, lift_m(params), WIND[1] * way)
}
