//! A face of the cube as it is drawn: in tiles that any GPU can hold, with a margin that goes on in the plane of the face.

use half::f16;
use welkin_runtime::Camera;

use super::cube::{Tile, camera};

/// Largest side of a tile, in texels: what WebGL2 promises a texture.
const TILE: u32 = 2048;

/// A face of the cube: linear radiance, BT.709.
#[derive(Clone, Debug, PartialEq)]
pub struct Face {
    /// Texels a side, without the margin.
    pub side: u32,
    /// Texels of the plane of the face that go on beyond each side.
    pub margin: u32,
    /// `(side + 2 margin)^2` texels, row by row from the upper left corner.
    pub texels: Vec<[f32; 3]>,
}

impl Face {
    /// Draws a face from where `viewer` stands. `draw` gives what a camera sees: rows from the top, pixels from the left.
    ///
    /// # Errors
    /// Those of `draw`.
    ///
    /// # Panics
    /// If there is no such face.
    pub fn draw<E>(
        face: usize,
        [side, margin]: [u32; 2],
        viewer: &Camera,
        draw: &mut impl FnMut(&Camera) -> Result<Vec<[f16; 4]>, E>,
    ) -> Result<Face, E> {
        let row = (side + 2 * margin) as usize;
        let mut texels = vec![[0.0; 3]; row * row];
        for [x, y, width, height] in tiles(row as u32) {
            let tile = Tile {
                start: [x, y].map(|c| c as i32 - margin as i32),
                size: [width, height],
            };
            let drawn = draw(&camera(face, side, tile, viewer))?;
            for (line, y) in drawn.chunks_exact(width as usize).zip(y as usize..) {
                let start = y * row + x as usize;
                for (texel, [r, g, b, _]) in texels[start..].iter_mut().zip(line) {
                    *texel = [r, g, b].map(|c| c.to_f32());
                }
            }
        }
        Ok(Face {
            side,
            margin,
            texels,
        })
    }

    /// The radiance at texture coordinates, 0..1 each, between the four nearest texels. The margin must reach there.
    pub fn bilinear(&self, st: [f32; 2]) -> [f32; 3] {
        let row = (self.side + 2 * self.margin) as usize;
        let last = (row as f32 - 2.0).max(0.0);
        let place = st.map(|c| c * self.side as f32 + self.margin as f32 - 0.5);
        let corner = place.map(|c| c.floor().clamp(0.0, last));
        let [across, down] = [0, 1].map(|i| place[i] - corner[i]);
        let start = corner[1] as usize * row + corner[0] as usize;
        let [a, b, c, d] = [0, 1, row, row + 1].map(|step| self.texels[start + step]);
        [0, 1, 2].map(|i| {
            let upper = a[i] + (b[i] - a[i]) * across;
            let lower = c[i] + (d[i] - c[i]) * across;
            upper + (lower - upper) * down
        })
    }
}

/// Column, row, width and height of the tiles of a square.
fn tiles(side: u32) -> impl Iterator<Item = [u32; 4]> {
    let parts = move || {
        (0..side)
            .step_by(TILE as usize)
            .map(move |start| (start, TILE.min(side - start)))
    };
    parts().flat_map(move |(y, height)| parts().map(move |(x, width)| [x, y, width, height]))
}

#[cfg(test)]
pub(crate) mod tests {
    use std::convert::Infallible;

    use glam::Vec3;

    use super::super::cube::face_to_direction;
    use super::*;

    /// A sky that is a function of the direction alone, as a camera sees it at the middle of each pixel.
    pub fn analytic(
        sky: impl Fn(Vec3) -> [f32; 3],
    ) -> impl FnMut(&Camera) -> Result<Vec<[f16; 4]>, Infallible> {
        move |camera| {
            let [width, height] = camera.viewport_px;
            let rays = camera.rays();
            let pixel = |i: u32| {
                let x = 2.0 * ((i % width) as f32 + 0.5) / width as f32 - 1.0;
                let y = 1.0 - 2.0 * ((i / width) as f32 + 0.5) / height as f32;
                let [r, g, b] = sky((rays.forward + rays.right * x + rays.up * y).normalize());
                [r, g, b, 1.0].map(f16::from_f32)
            };
            Ok((0..width * height).map(pixel).collect())
        }
    }

    /// Smooth, and nowhere the same in two directions.
    pub fn smooth(direction: Vec3) -> [f32; 3] {
        (0.5 + 0.5 * direction).to_array()
    }

    #[test]
    fn tiles_cover_a_square_once() {
        for side in [1, TILE - 1, TILE, TILE + 1, 2 * TILE + 7] {
            let area: u64 = tiles(side).map(|[.., w, h]| u64::from(w * h)).sum();
            assert_eq!(area, u64::from(side).pow(2));
            for [x, y, width, height] in tiles(side) {
                assert!(x % TILE == 0 && y % TILE == 0);
                assert!(x + width <= side && y + height <= side && width.max(height) <= TILE);
            }
        }
    }

    #[test]
    fn a_face_of_several_tiles_is_that_of_one() {
        // Wider than a tile, so that four are put together.
        let viewer = Camera::looking(0.0, 0.0, 1.0, [1, 1]);
        let face = Face::draw(2, [TILE, 3], &viewer, &mut analytic(smooth)).unwrap();
        let row = (TILE + 6) as usize;
        for [x, y] in [[0, 0], [2047, 2047], [2048, 2047], [2049, 2050], [2053, 5]] {
            let st = [x, y].map(|c| (c as f32 - 3.0 + 0.5) / TILE as f32);
            let wanted = smooth(Vec3::from(face_to_direction(2, st)));
            for (found, wanted) in face.texels[y * row + x].iter().zip(wanted) {
                // Half floats below 1 have steps of 2^-11.
                assert!((found - wanted).abs() < 1.0 / 2048.0);
            }
        }
    }

    #[test]
    fn between_texels_radiance_is_interpolated_up_to_the_edge_of_the_face() {
        let viewer = Camera::looking(0.0, 0.0, 1.0, [1, 1]);
        let face = Face::draw(5, [64, 1], &viewer, &mut analytic(smooth)).unwrap();
        for st in [
            [0.0, 0.0],
            [1.0, 1.0],
            [0.0, 0.37],
            [0.5, 0.51],
            [0.93, 0.08],
        ] {
            let wanted = smooth(Vec3::from(face_to_direction(5, st)));
            for (found, wanted) in face.bilinear(st).iter().zip(wanted) {
                // Half a step of a half float, and what a chord is below its arc: (2/64)^2 / 8 of the radius, half of that here.
                assert!((found - wanted).abs() < 0.5 / 2048.0 + 1e-4);
            }
        }
    }
}
