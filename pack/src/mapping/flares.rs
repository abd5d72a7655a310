//! The cells of the atlas of lens flares.

/// A cell of the role `flares`: 2x2 of them, row by row from the top.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum FlareCell {
    /// A nearly flat disc with a soft edge and a slightly brighter rim.
    Disc,
    /// A thin, soft ring.
    Ring,
    /// A blob that falls smoothly to nothing.
    Glow,
    /// A bright core with fine tapering rays.
    Starburst,
}

impl FlareCell {
    /// Every cell, in the order of their indices.
    pub const ALL: [FlareCell; 4] = [
        FlareCell::Disc,
        FlareCell::Ring,
        FlareCell::Glow,
        FlareCell::Starburst,
    ];

    /// Cells a side of the atlas.
    pub const A_SIDE: u32 = 2;

    /// Texels along the border of a cell, at level 0, that are 0, so that cells do not bleed into each other.
    pub const BORDER_TEXELS: u32 = 2;

    /// Its place in the atlas: column and row.
    pub const fn place(self) -> [u32; 2] {
        [self as u32 % Self::A_SIDE, self as u32 / Self::A_SIDE]
    }

    /// The name in reports.
    pub const fn name(self) -> &'static str {
        match self {
            FlareCell::Disc => "disc",
            FlareCell::Ring => "ring",
            FlareCell::Glow => "glow",
            FlareCell::Starburst => "starburst",
        }
    }

    /// Texture coordinates of its upper left and of its lower right corner.
    pub fn uv_rect(self) -> [[f32; 2]; 2] {
        let corner = |add: u32| self.place().map(|i| (i + add) as f32 / Self::A_SIDE as f32);
        [corner(0), corner(1)]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cells_lie_row_by_row_and_fill_the_atlas() {
        let corners = FlareCell::ALL.map(|cell| cell.uv_rect()[0]);
        assert_eq!(corners, [[0.0, 0.0], [0.5, 0.0], [0.0, 0.5], [0.5, 0.5]]);
        for (index, cell) in FlareCell::ALL.into_iter().enumerate() {
            let [[left, top], [right, bottom]] = cell.uv_rect();
            assert_eq!((right - left, bottom - top), (0.5, 0.5));
            assert_eq!(cell as usize, index);
        }
    }
}
