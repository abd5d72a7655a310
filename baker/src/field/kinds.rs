//! Kinds of cloud: how each is put together from boxes.
//!
//! World Meteorological Organization, "International Cloud Atlas", WMO-No. 407, 2017: heights and shapes. Proportions are
//! judged by eye.

mod altocumulus;
mod cirrus;
mod congestus;
mod cumulonimbus;
mod cumulus;
mod heap;
mod look;
mod stratocumulus;
mod stratus;

use welkin_pack::field::CloudKind;

use crate::settings::{BoxSettings, CloudLayerSettings};
use crate::stream::Stream;

/// Base and top of a kind where the recipe says nothing, in metres above the sea.
pub(crate) const fn heights_m(kind: CloudKind) -> [f32; 2] {
    match kind {
        CloudKind::Cumulus => [1000.0, 1800.0],
        CloudKind::Congestus => [1000.0, 4200.0],
        CloudKind::Cumulonimbus => [900.0, 9500.0],
        CloudKind::Stratus => [500.0, 760.0],
        CloudKind::Stratocumulus => [1250.0, 1600.0],
        CloudKind::Altocumulus => [3400.0, 3650.0],
        CloudKind::Cirrus => [8000.0, 8300.0],
    }
}

/// Whether its clouds are pieces of a sheet, and not bodies of their own.
pub(super) const fn is_sheet(kind: CloudKind) -> bool {
    matches!(
        kind,
        CloudKind::Stratus | CloudKind::Stratocumulus | CloudKind::Altocumulus
    )
}

/// Boxes of one cloud of a layer: x and z about its origin, y above the sea.
pub(super) fn boxes(layer: &CloudLayerSettings, stream: &mut Stream) -> Vec<BoxSettings> {
    let heights = [layer.base_m, layer.top_m];
    let mut boxes = match layer.kind {
        CloudKind::Cumulus => cumulus::boxes(heights, stream),
        CloudKind::Congestus => congestus::boxes(heights, stream),
        CloudKind::Cumulonimbus => cumulonimbus::boxes(heights, stream),
        CloudKind::Stratus => stratus::boxes(heights, stream),
        CloudKind::Stratocumulus => stratocumulus::boxes(heights, stream),
        CloudKind::Altocumulus => altocumulus::boxes(heights, stream),
        CloudKind::Cirrus => cirrus::boxes(heights, stream),
    };
    for of_cloud in &mut boxes {
        let sprites = libm::roundf(of_cloud.sprites as f32 * layer.density) as u32;
        of_cloud.sprites = sprites.clamp(1, 100);
        of_cloud.cull = layer.cull;
    }
    boxes
}
