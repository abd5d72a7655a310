//! What pictures of two drivers may differ by.

use glam::Vec3;
use welkin_runtime::SkyParams;

use crate::renderer::{FILTER_STEP, Frame};
use crate::tonemap;

/// How far apart a map's texels by two drivers may be, over what they are off by on average.
const APART: f32 = 4.0;

/// What sprites add to what two drivers may differ by, since the twin's frame has none. Each one over a pixel is filtered and
/// blended within two steps by each driver, and what lies behind it counts less: of sprites that are half opaque without end,
/// 4 (1 + 1/2 + 1/4 + ...) steps.
pub const SPRITES: f32 = 8.0 / 255.0;

/// What 8-bit pictures of a frame by unlike drivers may differ by at each pixel; the frame is a twin's, with its map.
///
/// Drivers may filter more or less exactly: both read clouds and maps within a step of 8-bit filtering, so together within two,
/// and a map's texels may be off by four times what they are off by on average; sky, sun and half floats within 1 %; and each
/// rounds and encodes within a step of the target.
pub fn unlike(frame: &mut Frame, params: &SkyParams) -> Vec<Vec3> {
    bounds(frame, params, 2.0, 0.01, 2.0)
}

/// The same by one driver behind two backends.
///
/// Rasteriser and filter are the same, but shaders reach them by two compilers, which may order additions differently: a value
/// just between two steps of 8 bits is rounded to the other one, in the octaves and the maps that a method draws first and in
/// the target. Half a step is spare for bytes as floats.
pub fn alike(frame: &mut Frame, params: &SkyParams) -> Vec<Vec3> {
    bounds(frame, params, 0.0, 0.0, 1.5)
}

/// Bounds where reads are off by `filter` steps, radiance by a share, and the target by so many of its steps.
fn bounds(frame: &mut Frame, params: &SkyParams, filter: f32, share: f32, steps: f32) -> Vec<Vec3> {
    let allowance = frame.map_allowance();
    let mean: Vec<_> = allowance.iter().map(|(_, mean)| *mean).collect();
    let map = frame.in_order_of_reads(&mean).into_iter();
    let off: Vec<f32> = map
        .map(|mean| (filter + APART * mean) * FILTER_STEP)
        .collect();
    let worth = frame.worth_of_reads(&off, Frame::render);
    let bound = |(&here, &worth): (&Vec3, &Vec3)| {
        let may = worth + share * here;
        (tonemap::spread(here, may, params) + steps) / 255.0
    };
    frame.render().iter().zip(&worth).map(bound).collect()
}
