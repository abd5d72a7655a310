//! Where the layers of the lit method are cut, so that cloud covers what it shall.

use crate::clouds::shared::{OPAQUE, inverse_smoothstep};
use crate::geometry::math::smoothstep;
use crate::params::{Shading, SkyParams};

/// Cover of a layer below which it is a trace.
pub(super) const TRACE: f32 = 0.02;
/// Cover from which the sky shuts: more than seven oktas, which are to be seven.
pub(super) const SHUTTING: f32 = 0.9;
/// How much the cut goes below 0 in an overcast.
pub(super) const OVERCAST: f32 = 1.0;
/// The opacity above which a direction counts as covered: where the cut lies.
pub(super) const COVERED: f32 = OPAQUE;
/// See [`base_share`]. The mean of rendered skies, over all that is higher than 10 degrees.
pub(super) const SIDED: f32 = 0.33;

/// The amount from which there is cloud, such that the densest `cover` of the layer counts as covered.
pub(super) fn cut(cover: f32, steepness: f32, opacity: f32) -> f32 {
    let thin = inverse_smoothstep(COVERED / opacity) / steepness;
    // A trace of cover brings its thin edge in by degrees.
    let edge = thin * (cover / TRACE).min(1.0);
    1.0 - cover - edge
}

/// What sides add to the share of the sky that bases cover, times the share that these cover and that they leave open.
pub(super) fn sided(params: &SkyParams) -> f32 {
    match params.shading {
        Shading::Scattered => SIDED,
        Shading::Paper => 0.0,
    }
}

/// The share b that bases cover where with their sides clouds cover this one, `b + sided b (1 - b)`.
pub(super) fn base_share(sided: f32, share: f32) -> f32 {
    let whole = 1.0 + sided;
    2.0 * share / (whole + (whole * whole - 4.0 * sided * share).sqrt())
}

/// How much lower every layer is cut where the sky shuts.
pub(super) fn shut(cover: f32) -> f32 {
    OVERCAST * smoothstep(SHUTTING, 1.0, cover)
}
