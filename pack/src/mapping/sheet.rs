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

/// A cell of the role `sprites`: 4x4 of them, row by row from the top.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct SheetCell(pub u8);

impl SheetCell {
    /// Cells a side of the sheet.
    pub const A_SIDE: u32 = 4;

    /// Cells in all.
    pub const COUNT: u8 = 16;

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
