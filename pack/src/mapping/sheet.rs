//! The cells of the sheet of cloud sprites.
//!
//! N. Wang, "Let There Be Clouds!", Game Developer, 2004, figure 3: 16 pictures on one sheet.

/// What a cell of the role `sprites` shows.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum SheetKind {
    /// Smooth fog, slightly blue-grey.
    Foggy,
    /// A puff with a flat bottom.
    FlatBottomed,
    /// Wisps.
    Wispy,
    /// A puff with eddies.
    Puffy,
}

impl SheetKind {
    /// Colour of its pictures, which are grey in the texture: factors in linear BT.709 that keep the luminance. The
    /// article's fog has "a subtle bluish-gray tinge".
    pub const fn tint(self) -> [f32; 3] {
        match self {
            SheetKind::Foggy => [0.94, 1.005_721_5, 1.12],
            SheetKind::FlatBottomed | SheetKind::Wispy | SheetKind::Puffy => [1.0; 3],
        }
    }
}

/// A cell of the role `sprites`: 4x4 of them, row by row from the top.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct SheetCell(pub u8);

impl SheetCell {
    /// Cells a side of the sheet.
    pub const A_SIDE: u32 = 4;

    /// Cells in all.
    pub const COUNT: u8 = 16;

    /// Least and greatest mean opacity of a cell: less shows nothing, and a disc as wide as the cell has no more.
    pub const OPACITY: [f32; 2] = [0.01, std::f32::consts::FRAC_PI_4];

    /// The cells of each kind: fog in the upper row, the flat bottom in its right corner, puffs in the two lowest rows, as in
    /// the article, and wisps in what is left.
    pub const FOGGY: [u8; 3] = [0, 1, 2];
    /// See [`SheetCell::FOGGY`].
    pub const FLAT_BOTTOMED: [u8; 1] = [3];
    /// See [`SheetCell::FOGGY`].
    pub const WISPY: [u8; 6] = [4, 5, 6, 7, 8, 9];
    /// See [`SheetCell::FOGGY`].
    pub const PUFFY: [u8; 6] = [10, 11, 12, 13, 14, 15];

    /// What it shows.
    pub const fn kind(self) -> SheetKind {
        match self.0 {
            0..=2 => SheetKind::Foggy,
            3 => SheetKind::FlatBottomed,
            4..=9 => SheetKind::Wispy,
            _ => SheetKind::Puffy,
        }
    }

    /// Its place on the sheet: column and row.
    pub const fn place(self) -> [u32; 2] {
        [self.0 as u32 % Self::A_SIDE, self.0 as u32 / Self::A_SIDE]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tints_keep_the_luminance_and_only_fog_is_bluish() {
        for cell in (0..SheetCell::COUNT).map(SheetCell) {
            let [r, g, b] = cell.kind().tint();
            // ITU-R BT.709-6, item 3.2.
            assert!((0.2126 * r + 0.7152 * g + 0.0722 * b - 1.0).abs() < 1e-6);
            assert_eq!(b > g && g > r, cell.kind() == SheetKind::Foggy);
        }
    }

    #[test]
    fn every_cell_is_of_one_kind() {
        let kinds = [
            (&SheetCell::FOGGY[..], SheetKind::Foggy),
            (&SheetCell::FLAT_BOTTOMED, SheetKind::FlatBottomed),
            (&SheetCell::WISPY, SheetKind::Wispy),
            (&SheetCell::PUFFY, SheetKind::Puffy),
        ];
        let mut cells = Vec::new();
        for (of_kind, kind) in kinds {
            for &cell in of_kind {
                assert_eq!(SheetCell(cell).kind(), kind, "{cell}");
                cells.push(cell);
            }
        }
        assert_eq!(cells, (0..SheetCell::COUNT).collect::<Vec<_>>());
        assert_eq!(SheetCell(3).place(), [3, 0]);
        assert_eq!(SheetCell(9).place(), [1, 2]);
    }
}
