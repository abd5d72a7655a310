//! Cumulus: separate heaps of different sizes with crisp, sprouting edges.
//!
//! Each heap is a round hill about a point of its cell, with a radius of its own; lumps on it, from half its cell to
//! a few texels, give it the outline of a cauliflower.

use welkin_pack::Image;

use super::cells::{Cells, Lumps, Neighbour};
use crate::filter;
use crate::fractal::{Fractal, Octaves};
use crate::settings::LayerSettings;
use crate::stream::Stream;

/// Radii of the smallest and the largest heap, in cells: where a hill has half of its height. With six cells across the
/// tile they are a twentieth and a seventh of it, so heaps are a tenth to a quarter wide.
const RADII: [f64; 2] = [0.3, 0.9];

/// Distance at which every hill has ended, in cells.
const END: i64 = 2;

/// Strength of the displacement that makes heaps uneven, in cells.
const DISPLACEMENT: f64 = 0.3;

/// Lumps side by side in a cell.
const LUMPS_A_CELL: u32 = 2;

/// Their strength beside the hills'.
const LUMP_STRENGTH: f64 = 0.33;

/// Density before it is brought to its range.
pub(super) fn field(settings: &LayerSettings, size: u32, stream: &mut Stream) -> Image {
    let cells = f64::from(settings.cells);
    let heaps = Cells::new(settings.cells, 1.0, stream);
    let displacement = [(); 2].map(|()| {
        let octaves = Octaves {
            count: 2,
            gain: 0.5,
        };
        Fractal::new([0.8 * cells; 2], octaves, size, stream)
    });
    let lumps = Lumps::new(
        LUMPS_A_CELL * settings.cells,
        Octaves::new(settings.octaves, settings.gain),
        size,
        stream,
    );
    filter::tile(size, |point| {
        let displaced = [0, 1].map(|i| point[i] + DISPLACEMENT / cells * displacement[i].at(point));
        let highest = heaps.around(displaced, END).map(hill).fold(0.0, f64::max);
        highest + LUMP_STRENGTH * lumps.at(point)
    })
}

/// Height of the hill about a point: `1 / (1 + (d / r)^2)`, brought to 0 with a level slope. Most heaps are small.
fn hill(point: Neighbour) -> f64 {
    let [least, most] = RADII;
    let radius = least + (most - least) * point.number * point.number;
    let window = (1.0 - point.square / (END * END) as f64).max(0.0);
    window * window / (1.0 + point.square / (radius * radius))
}
