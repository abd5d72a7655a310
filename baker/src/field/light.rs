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
    [0.000, 0.06, 0.045, 0.055, 0.080, 0.10],
    [0.200, 0.07, 0.045, 0.054, 0.078, 0.10],
    [0.232, 0.24, 0.200, 0.140, 0.190, 0.12],
    [0.257, 0.44, 0.620, 0.330, 0.200, 0.05],
    [0.285, 0.68, 0.800, 0.540, 0.360, 0.04],
    [0.335, 0.88, 0.720, 0.620, 0.510, 0.04],
    [0.420, 0.97, 0.660, 0.620, 0.570, 0.05],
    [0.500, 1.00, 0.640, 0.610, 0.570, 0.05],
    [0.580, 0.97, 0.660, 0.615, 0.560, 0.05],
    [0.665, 0.88, 0.730, 0.610, 0.480, 0.04],
    [0.715, 0.68, 0.820, 0.520, 0.310, 0.04],
    [0.743, 0.44, 0.680, 0.330, 0.170, 0.05],
    [0.768, 0.24, 0.240, 0.130, 0.160, 0.12],
    [0.800, 0.07, 0.045, 0.054, 0.078, 0.10],
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
            [0.00, 0.200, 0.235, 0.300],
            [0.15, 0.260, 0.300, 0.370],
            [0.40, 0.360, 0.400, 0.470],
            [0.70, 0.440, 0.480, 0.550],
            [1.00, 0.500, 0.540, 0.600],
        ],
        CloudKind::Congestus => [
            [0.00, 0.160, 0.190, 0.250],
            [0.10, 0.220, 0.255, 0.320],
            [0.35, 0.330, 0.370, 0.440],
            [0.70, 0.430, 0.470, 0.540],
            [1.00, 0.500, 0.540, 0.600],
        ],
        CloudKind::Cumulonimbus => [
            [0.00, 0.085, 0.105, 0.140],
            [0.08, 0.130, 0.155, 0.200],
            [0.30, 0.270, 0.310, 0.370],
            [0.70, 0.410, 0.450, 0.520],
            [1.00, 0.500, 0.540, 0.600],
        ],
        CloudKind::Stratus => [
            [0.00, 0.240, 0.265, 0.310],
            [0.25, 0.270, 0.295, 0.340],
            [0.50, 0.310, 0.335, 0.380],
            [0.75, 0.370, 0.395, 0.440],
            [1.00, 0.430, 0.455, 0.500],
        ],
        CloudKind::Stratocumulus => [
            [0.00, 0.200, 0.230, 0.280],
            [0.25, 0.260, 0.290, 0.345],
            [0.50, 0.340, 0.375, 0.430],
            [0.75, 0.420, 0.455, 0.510],
            [1.00, 0.480, 0.515, 0.570],
        ],
        CloudKind::Altocumulus => [
            [0.00, 0.360, 0.395, 0.450],
            [0.25, 0.390, 0.425, 0.480],
            [0.50, 0.430, 0.465, 0.520],
            [0.75, 0.470, 0.505, 0.560],
            [1.00, 0.500, 0.535, 0.590],
        ],
        CloudKind::Cirrus => [
            [0.00, 0.500, 0.540, 0.600],
            [0.25, 0.500, 0.540, 0.600],
            [0.50, 0.510, 0.550, 0.610],
            [0.75, 0.520, 0.560, 0.620],
            [1.00, 0.520, 0.560, 0.620],
        ],
    };
    // Cirrus is ice, thin enough to let the sky through.
    let alpha = if kind.is_flat() { 0.6 } else { 1.0 };
    rows.map(|[height, red, green, blue]| ColourLevel {
        height,
        rgba: [red, green, blue, alpha],
    })
}
