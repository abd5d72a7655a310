//! The tables that light the clouds: what holds where a recipe says nothing.

use welkin_pack::field::{COLOUR_LEVELS, CloudKind, ColourLevel, Hour};

use super::kinds;
use crate::settings::CloudLayerSettings;

/// Light over the day: time, factor on the colour levels, red, green and blue of the direct light, its least share.
///
/// Judged by eye, as the article's artists did: white at noon; orange while the sun is low, since blue is scattered out of
/// its long way through the air, and a little cooler at dawn, when the air holds less haze; purple in twilight; blue and
/// some thirtieth of the day's by the moon. Exposures are adapted, as those of the role `sky` are.
const HOURS: [[f32; 6]; 14] = [
    [0.000, 0.04, 0.030, 0.036, 0.055, 0.10],
    [0.200, 0.05, 0.034, 0.041, 0.062, 0.10],
    [0.232, 0.18, 0.190, 0.140, 0.200, 0.16],
    [0.257, 0.36, 0.540, 0.310, 0.215, 0.06],
    [0.285, 0.60, 0.670, 0.480, 0.350, 0.06],
    [0.335, 0.86, 0.610, 0.540, 0.470, 0.10],
    [0.420, 0.97, 0.560, 0.530, 0.495, 0.14],
    [0.500, 1.00, 0.550, 0.530, 0.500, 0.16],
    [0.580, 0.97, 0.560, 0.530, 0.490, 0.14],
    [0.665, 0.86, 0.620, 0.530, 0.440, 0.10],
    [0.715, 0.60, 0.690, 0.460, 0.300, 0.06],
    [0.743, 0.36, 0.600, 0.320, 0.180, 0.06],
    [0.768, 0.18, 0.220, 0.130, 0.180, 0.16],
    [0.800, 0.05, 0.034, 0.041, 0.062, 0.10],
];

pub(crate) fn default_hours() -> Vec<Hour> {
    let hour = |[time, ambient, red, green, blue, least]: [f32; 6]| Hour {
        time,
        ambient,
        colour: [red, green, blue],
        least,
        most: 1.0,
    };
    HOURS.into_iter().map(hour).collect()
}

/// The layers of the default recipe: heaps at little cover, then a sheet that shuts the sky.
pub(crate) fn default_layers() -> Vec<CloudLayerSettings> {
    let layer = |kind: CloudKind, cover: f32| {
        let [base_m, top_m] = kinds::heights_m(kind);
        CloudLayerSettings {
            kind,
            cover,
            base_m,
            top_m,
            density: 1.0,
            cull: 1.0 / 3.0,
            levels: levels(kind),
        }
    };
    vec![
        layer(CloudKind::Cumulus, 0.35),
        layer(CloudKind::Stratocumulus, 1.0),
    ]
}

/// Ambient colour of a kind over its height: dark below, where less light of the sky comes through, and the darker the
/// more cloud is above. Judged by eye.
pub(crate) fn levels(kind: CloudKind) -> [ColourLevel; COLOUR_LEVELS] {
    let rows: [[f32; 4]; COLOUR_LEVELS] = match kind {
        CloudKind::Cumulus => [
            [0.00, 0.42, 0.46, 0.55],
            [0.15, 0.46, 0.50, 0.59],
            [0.40, 0.53, 0.57, 0.65],
            [0.70, 0.58, 0.62, 0.70],
            [1.00, 0.62, 0.66, 0.74],
        ],
        CloudKind::Congestus => [
            [0.00, 0.34, 0.38, 0.47],
            [0.10, 0.40, 0.44, 0.53],
            [0.35, 0.50, 0.54, 0.62],
            [0.70, 0.58, 0.62, 0.70],
            [1.00, 0.63, 0.67, 0.75],
        ],
        CloudKind::Cumulonimbus => [
            [0.00, 0.20, 0.23, 0.30],
            [0.08, 0.27, 0.31, 0.39],
            [0.30, 0.42, 0.46, 0.54],
            [0.70, 0.56, 0.60, 0.68],
            [1.00, 0.64, 0.68, 0.75],
        ],
        CloudKind::Stratus => [
            [0.00, 0.33, 0.36, 0.42],
            [0.25, 0.36, 0.39, 0.45],
            [0.50, 0.41, 0.44, 0.50],
            [0.75, 0.47, 0.50, 0.56],
            [1.00, 0.52, 0.55, 0.61],
        ],
        CloudKind::Stratocumulus => [
            [0.00, 0.36, 0.40, 0.48],
            [0.25, 0.41, 0.45, 0.53],
            [0.50, 0.48, 0.52, 0.60],
            [0.75, 0.54, 0.58, 0.66],
            [1.00, 0.59, 0.63, 0.71],
        ],
        CloudKind::Altocumulus => [
            [0.00, 0.50, 0.54, 0.62],
            [0.25, 0.53, 0.57, 0.65],
            [0.50, 0.57, 0.61, 0.68],
            [0.75, 0.60, 0.64, 0.71],
            [1.00, 0.63, 0.67, 0.74],
        ],
        CloudKind::Cirrus => [
            [0.00, 0.62, 0.66, 0.73],
            [0.25, 0.62, 0.66, 0.73],
            [0.50, 0.63, 0.67, 0.74],
            [0.75, 0.64, 0.68, 0.75],
            [1.00, 0.64, 0.68, 0.75],
        ],
    };
    // Cirrus is ice, thin enough to let the sky through.
    let alpha = if kind.is_flat() { 0.6 } else { 1.0 };
    rows.map(|[height, red, green, blue]| ColourLevel {
        height,
        rgba: [red, green, blue, alpha],
    })
}
