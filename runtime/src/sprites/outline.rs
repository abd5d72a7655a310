//! Outlines of the pictures on the sheet: octagons that leave out what is clear.
//!
//! # Theory
//! Sprites overlap by the dozen, and a texel costs the same whether it shows or not: E. Persson, "Graphics Gems for Games: Findings
//! from Avalanche Studios", SIGGRAPH 2012 ("Particle Trimming").
//!
//! # Practice
//! Found once from the alpha of the sheet's largest level, whatever is on it, with a thirty-second of the half side to spare. The shader
//! widens it by what coarser levels spread.

use welkin_pack::{SheetCell, Texture};

/// Vertices of an outline.
pub const VERTICES: usize = 8;
/// Vertices of a far sprite: the box around its outline. It has so few texels that more vertices would cost more than they save.
pub const BOX: usize = 4;
/// Distance of a block's middle, in metres, beyond which its sprites are boxes.
pub const BOXES_BEYOND_M: f32 = 8_000.0;
/// Room for what coarser levels spread, in half sides of the cell.
const MARGIN: f32 = 1.0 / 32.0;

/// The vertices of a cell, anticlockwise from the right, in half sides from its middle; y is up.
pub type Outline = [[f32; 2]; VERTICES];

/// The outline of every cell of a sheet; channel 1 of its texels is alpha.
pub fn outlines(sheet: &Texture) -> Vec<Outline> {
    let image = sheet.image(0, 0);
    let side = image.width / SheetCell::A_SIDE;
    let outline = |cell: u8| {
        let [column, row] = SheetCell(cell).place();
        let mut reach = Reach::default();
        for y in 0..side {
            for x in 0..side {
                if image.texel(column * side + x, row * side + y)[1] > 0.0 {
                    reach.add(x, y, side);
                }
            }
        }
        reach.outline()
    };
    (0..SheetCell::COUNT).map(outline).collect()
}

/// How far a shape reaches: to the right, up, left, down, and along the diagonals (x + y, y - x, -x - y, x - y).
#[derive(Clone, Copy, Debug, Default)]
struct Reach {
    sides: [f32; 4],
    diagonals: [f32; 4],
}

impl Reach {
    /// Adds a texel, and its neighbours, into which filtering spreads it.
    fn add(&mut self, x: u32, y: u32, side: u32) {
        let place = |i: f32| 2.0 * i / side as f32 - 1.0;
        let (x, y) = (x as f32, y as f32);
        let (left, right) = (place(x - 0.5), place(x + 1.5));
        let (up, down) = (-place(y - 0.5), -place(y + 1.5));
        let sides = [right, up, -left, -down];
        let diagonals = [right + up, up - left, -left - down, right - down];
        self.sides = std::array::from_fn(|i| self.sides[i].max(sides[i]));
        self.diagonals = std::array::from_fn(|i| self.diagonals[i].max(diagonals[i]));
    }

    /// Where neighbouring sides meet, with the margin.
    fn outline(self) -> Outline {
        let [right, up, left, down] = self.sides.map(|side| (side + MARGIN).min(1.0));
        let corners = [right + up, up + left, left + down, down + right];
        let cut =
            |i: usize| (self.diagonals[i] + MARGIN * std::f32::consts::SQRT_2).min(corners[i]);
        let [north_east, north_west, south_west, south_east] = [0, 1, 2, 3].map(cut);
        [
            [right, north_east - right],
            [north_east - up, up],
            [up - north_west, up],
            [-left, north_west - left],
            [-left, left - south_west],
            [down - south_west, -down],
            [south_east - down, -down],
            [right, right - south_east],
        ]
    }
}

/// The order of an outline's vertices as a strip that goes to and fro between its sides.
pub const STRIP: [u32; VERTICES] = [0, 1, 7, 2, 6, 3, 5, 4];

/// The same of the vertices of a box, from its lower left corner anticlockwise.
pub const BOX_STRIP: [u32; BOX] = [0, 1, 3, 2];

/// Indices of so many outlines or boxes as triangles.
pub fn indices<const N: usize>(count: u32, strip: [u32; N]) -> Vec<u32> {
    let triangles = |number: u32| {
        let strip = strip.map(|vertex| number * N as u32 + vertex);
        (0..N - 2).flat_map(move |i| [strip[i], strip[i + 1], strip[i + 2]])
    };
    (0..count).flat_map(triangles).collect()
}

/// Indices of one outline or box.
pub const fn index_count(vertices: usize) -> u32 {
    3 * (vertices as u32 - 2)
}

#[cfg(test)]
mod tests {
    use welkin_pack::{Format, Shape};

    use super::*;

    /// A sheet whose texels are clear but where `inside` says, of x and y in half sides of a cell.
    fn sheet(inside: impl Fn(f32, f32) -> bool) -> Texture {
        let side = 256_u32;
        let cell = side / SheetCell::A_SIDE;
        let place = |i: u32| ((i % cell) as f32 + 0.5) / cell as f32 * 2.0 - 1.0;
        let texels = (0..side * side).flat_map(|i| {
            let (x, y) = (place(i % side), -place(i / side));
            [128, if inside(x, y) { 255 } else { 0 }, 128, 128]
        });
        Texture {
            format: Format::Rgba8Unorm,
            shape: Shape::D2,
            width: side,
            height: side,
            layers: 1,
            levels: vec![texels.collect()],
        }
    }

    fn area(outline: &Outline) -> f32 {
        let pairs = (0..VERTICES).map(|i| (outline[i], outline[(i + 1) % VERTICES]));
        0.5 * pairs.map(|([a, b], [c, d])| a * d - b * c).sum::<f32>()
    }

    /// Whether a place is on the left of every side.
    fn holds(outline: &Outline, x: f32, y: f32) -> bool {
        (0..VERTICES).all(|i| {
            let ([a, b], [c, d]) = (outline[i], outline[(i + 1) % VERTICES]);
            (c - a) * (y - b) - (d - b) * (x - a) >= -1e-4
        })
    }

    #[test]
    fn every_opaque_texel_is_inside_and_much_of_what_is_clear_is_not() {
        let disc = |x: f32, y: f32| x.hypot(y) < 0.8;
        let bar = |x: f32, y: f32| (x - y).abs() < 0.3 && x.abs() < 0.7;
        let shapes: [&dyn Fn(f32, f32) -> bool; 2] = [&disc, &bar];
        for shape in shapes {
            let found = outlines(&sheet(shape));
            assert_eq!(found.len(), 16);
            for outline in &found {
                for i in 0..100 {
                    for j in 0..100 {
                        let (x, y) = (i as f32 / 50.0 - 0.99, j as f32 / 50.0 - 0.99);
                        assert!(!shape(x, y) || holds(outline, x, y), "{x} {y}");
                    }
                }
                // A square has 4.
                assert!(area(outline) < 3.0, "{}", area(outline));
            }
        }
    }

    /// Every triangle has an area and the areas of all are the polygon's.
    fn assert_covered<const N: usize>(strip: [u32; N]) {
        let place = |i: u32| {
            let angle = i as f32 / N as f32 * std::f32::consts::TAU;
            [angle.cos(), angle.sin()]
        };
        let indices = indices(3, strip);
        let each = index_count(N) as usize;
        assert_eq!(indices.len(), 3 * each);
        let areas = indices[each..2 * each].chunks_exact(3).map(|triangle| {
            let [[a, b], [c, d], [e, f]] = [0, 1, 2].map(|i| place(triangle[i] - N as u32));
            0.5 * ((c - a) * (f - b) - (d - b) * (e - a)).abs()
        });
        let areas: Vec<f32> = areas.collect();
        assert!(areas.iter().all(|area| *area > 1e-3));
        let whole = 0.5 * N as f32 * (std::f32::consts::TAU / N as f32).sin();
        assert!((areas.iter().sum::<f32>() - whole).abs() < 1e-5);
    }

    #[test]
    fn the_triangles_of_an_outline_and_of_a_box_cover_it_once() {
        assert_covered(STRIP);
        assert_covered(BOX_STRIP);
    }

    #[test]
    fn a_picture_that_fills_its_cell_keeps_all_of_it_and_an_empty_one_next_to_nothing() {
        let full = outlines(&sheet(|_, _| true));
        assert!((area(&full[0]) - 4.0).abs() < 1e-5);
        let empty = outlines(&sheet(|_, _| false));
        assert!(area(&empty[5]) < 0.005 && area(&empty[5]) > 0.0);
    }
}
