//! Spectra over altitude and the sun's elevation, read between entries linearly.

use rayon::prelude::*;

use welkin_pack::air::Spectrum;

use super::geometry::{GROUND_KM, TOP_KM};

pub(super) struct Table {
    rows: usize,
    columns: usize,
    entries: Vec<Spectrum>,
}

impl Table {
    pub(super) fn empty() -> Table {
        Table {
            rows: 0,
            columns: 0,
            entries: Vec::new(),
        }
    }

    /// Entries from a function of altitude (km) and the sine of the sun's elevation.
    pub(super) fn new(
        rows: usize,
        columns: usize,
        value: impl Fn(f32, f32) -> Spectrum + Sync,
    ) -> Table {
        let entries = (0..rows * columns).into_par_iter().map(|i| {
            let row = (i / columns) as f32 / (rows - 1) as f32;
            let column = (i % columns) as f32 / (columns - 1) as f32;
            value(row * row * (TOP_KM - GROUND_KM), sine_of_column(column))
        });
        Table {
            rows,
            columns,
            entries: entries.collect(),
        }
    }

    pub(super) fn read(&self, altitude: f32, sun_sin: f32) -> Spectrum {
        let row =
            libm::sqrtf((altitude / (TOP_KM - GROUND_KM)).clamp(0.0, 1.0)) * (self.rows - 1) as f32;
        let column = column_of_sine(sun_sin) * (self.columns - 1) as f32;
        let (y, x) = (
            (row as usize).min(self.rows - 2),
            (column as usize).min(self.columns - 2),
        );
        let (v, u) = (row - y as f32, column - x as f32);
        let weights = [(1.0 - u) * (1.0 - v), u * (1.0 - v), (1.0 - u) * v, u * v];
        let at = y * self.columns + x;
        let near = [at, at + 1, at + self.columns, at + self.columns + 1].map(|i| &self.entries[i]);
        std::array::from_fn(|c| (0..4).map(|i| weights[i] * near[i][c]).sum())
    }
}

/// Columns lie closest at the horizon, where sunlight changes fastest: the sine is s |s|, s in -0.6..1.
fn sine_of_column(column: f32) -> f32 {
    let s = -0.6 + 1.6 * column;
    s * s.abs()
}

fn column_of_sine(sine: f32) -> f32 {
    let root = libm::sqrtf(sine.abs());
    let s = if sine < 0.0 { -root } else { root };
    ((s + 0.6) / 1.6).clamp(0.0, 1.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn entries_are_read_back_where_they_were_made() {
        let table = Table::new(5, 9, |altitude, sun| [altitude + 100.0 * sun; 8]);
        for i in 0..9 {
            let sun = sine_of_column(i as f32 / 8.0);
            // 100 km, the top row, plus the column's own value; rounding of f32 alone.
            assert!((table.read(100.0, sun)[3] - (100.0 + 100.0 * sun)).abs() < 1e-3);
        }
    }
}
