//! Stratocumulus: a sheet of rounded lumps, gathered in rolls, with gaps between them.
//!
//! The lumps are cellular noise. Stretched noise raises them along u, which makes rolls, and large noise makes parts
//! of the sheet thicker than others.

use welkin_pack::Image;

use super::cells::Lumps;
use crate::filter;
use crate::fractal::{Fractal, Octaves};
use crate::settings::LayerSettings;
use crate::stream::Stream;

/// Strength of the displacement that makes lumps uneven, in cells.
const DISPLACEMENT: f64 = 0.3;

/// Cells across the tile of the noise that makes parts of the sheet thicker.
const LARGE_CELLS: f64 = 3.0;

/// Its strength beside the lumps'.
const LARGE_STRENGTH: f64 = 0.3;

/// Cells of the noise that makes rolls, along u and v, for each lump across the tile.
const ROLLS: [f64; 2] = [0.15, 0.6];

/// Its strength beside the lumps'.
const ROLL_STRENGTH: f64 = 0.35;

/// Density before it is brought to its range.
pub(super) fn field(settings: &LayerSettings, size: u32, stream: &mut Stream) -> Image {
    let cells = f64::from(settings.cells);
    let lumps = Lumps::new(
        settings.cells,
        Octaves::new(settings.octaves, settings.gain),
        size,
        stream,
    );
    let mut fractal = |cells: [f64; 2], count| {
        let octaves = Octaves { count, gain: 0.5 };
        Fractal::new(cells, octaves, size, stream)
    };
    let displacement = [(); 2].map(|()| fractal([0.5 * cells; 2], 1));
    let large = fractal([LARGE_CELLS; 2], 2);
    let rolls = fractal(ROLLS.map(|n| n * cells), 1);
    filter::tile(size, |point| {
        let displaced = [0, 1].map(|i| point[i] + DISPLACEMENT / cells * displacement[i].at(point));
        lumps.at(displaced) + LARGE_STRENGTH * large.at(point) + ROLL_STRENGTH * rolls.at(displaced)
    })
}
