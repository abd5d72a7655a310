//! The sunset gradient: how red a cloud turns, over the dome from away from the sun to below it.
//!
//! T. Roden, I. Parberry, "Clouds and Stars", ACE 2005, lines 26-27 and figure 3 (lower left).

use welkin_pack::Image;

use crate::filter;
use crate::settings::GradientSettings;

/// Rows from exactly 0 (top: the horizon opposite the sun) to exactly 1 (bottom: the horizon below the sun).
///
/// The curve is `t^power`. With a power of at most 2 and 512 rows, neighbouring rows differ by less than
/// one step of a byte, so the stored gradient has no visible edge.
pub(crate) fn channel(settings: &GradientSettings, size: u32) -> Image {
    let last = (size - 1) as f32;
    filter::plane(size, size, |_, y| {
        libm::powf(y as f32 / last, settings.power)
    })
}
