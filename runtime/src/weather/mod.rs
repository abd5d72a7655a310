//! Rain and its bow, rays and lightning.

pub mod lightning;
pub(crate) mod overlays;
pub mod rain;
pub mod rainbow;
pub mod rays;

use crate::geometry::part::Part;

/// What rain and lightning add to a pixel of the sky.
pub const PART: Part = Part {
    constants: &[],
    structs: &[],
    wgsl: include_str!("weather.wgsl"),
};
