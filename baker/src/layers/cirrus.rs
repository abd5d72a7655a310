//! Cirrus: long fibres along u, soft, some hooked, some fanned out.
//!
//! Fibres are the ridges of noise that is stretched along u. Where they lie is large noise, which also displaces
//! them: so they bend where they begin and end.

use welkin_pack::Image;

use crate::filter;
use crate::fractal::{Fractal, Octaves};
use crate::settings::LayerSettings;
use crate::stream::Stream;

/// Cells of the first octave of fibres: along u across the tile, and along v for each cell of the settings.
const FIBRES: [f64; 2] = [1.0, 3.0];

/// Cells of the patches along u and v, for each cell of the settings.
const PATCHES: [f64; 2] = [0.6, 1.3];

/// Their strength beside the fibres'.
const PATCH_STRENGTH: f64 = 0.6;

/// Cells of the bends, for each cell of the settings.
const BENDS: f64 = 0.7;

/// How far fibres are displaced, in cells of the settings: by bends along u and v, by patches along v.
const DISPLACEMENT: [f64; 3] = [0.2, 0.15, 0.1];

/// Density before it is brought to its range.
pub(super) fn field(settings: &LayerSettings, size: u32, stream: &mut Stream) -> Image {
    let cells = f64::from(settings.cells);
    let mut fractal = |cells: [f64; 2], octaves| Fractal::new(cells, octaves, size, stream);
    let two = |gain| Octaves { count: 2, gain };
    let bends = fractal([BENDS * cells; 2], two(0.3));
    let patches = fractal(PATCHES.map(|n| n * cells), two(0.5));
    let fibres = fractal(
        [FIBRES[0], FIBRES[1] * cells],
        Octaves::new(settings.octaves, settings.gain),
    );
    let [along, across, by_patches] = DISPLACEMENT.map(|d| d / cells);
    filter::tile(size, |point| {
        let (bend, patch) = (bends.at(point), patches.at(point));
        let displaced = [
            point[0] + along * bend,
            point[1] + across * bend + by_patches * patch,
        ];
        PATCH_STRENGTH * patch - fibres.sum(displaced, f64::abs)
    })
}
