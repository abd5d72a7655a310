//! The table `[layers]`.

use welkin_pack::LayerKind;

use crate::error::RecipeError;
use crate::recipe::Recipe;
use crate::recipe::tables::Layer;
use crate::settings::{LayerSettings, LayersSettings};

/// Root mean square slopes: less than the least would be lost in bytes, more than the most would be all walls.
const RELIEF: [f32; 2] = [0.1, 2.0];

impl Recipe {
    pub(super) fn layers(&self) -> Result<LayersSettings, RecipeError> {
        let l = &self.tables.layers;
        let size = self.size("layers.size", &l.size, 256, 64, 1024)?;
        let [stratocumulus, cumulus, cirrus] = LayerKind::ALL.map(|kind| self.layer(kind, size));
        Ok(LayersSettings {
            size,
            kinds: [stratocumulus?, cumulus?, cirrus?],
        })
    }

    fn layer(&self, kind: LayerKind, size: u32) -> Result<LayerSettings, RecipeError> {
        let (entry, default) = self.layer_and_default(kind);
        let key = |name: &str| format!("layers.{}.{name}", kind.name());
        let most = size / least_cell_texels(kind);
        let cells = default.cells.min(most);
        let [least_relief, most_relief] = RELIEF;
        Ok(LayerSettings {
            cells: self.integer(&key("cells"), &entry.cells, cells, 2, most)?,
            octaves: self.integer(&key("octaves"), &entry.octaves, default.octaves, 1, 8)?,
            gain: self.real(&key("gain"), &entry.gain, default.gain, 0.0, 1.0)?,
            relief: self.real(
                &key("relief"),
                &entry.relief,
                default.relief,
                least_relief,
                most_relief,
            )?,
        })
    }

    /// What the recipe says of a kind, and what holds where it says nothing.
    fn layer_and_default(&self, kind: LayerKind) -> (&Layer, LayerSettings) {
        let l = &self.tables.layers;
        let (entry, cells, gain, relief) = match kind {
            LayerKind::Stratocumulus => (&l.stratocumulus, 12, 0.4, 0.6),
            LayerKind::Cumulus => (&l.cumulus, 6, 0.5, 0.8),
            LayerKind::Cirrus => (&l.cirrus, 3, 0.7, 0.3),
        };
        let default = LayerSettings {
            cells,
            octaves: 5,
            gain,
            relief,
        };
        (entry, default)
    }
}

/// The first octave of what shapes the clouds has at least eight texels a cell, or it would not be smooth at the texel.
/// Of cumulus and cirrus it is finer than the clouds: two lumps and three fibres a cell.
const fn least_cell_texels(kind: LayerKind) -> u32 {
    match kind {
        LayerKind::Stratocumulus => 8,
        LayerKind::Cumulus => 2 * 8,
        LayerKind::Cirrus => 3 * 8,
    }
}
