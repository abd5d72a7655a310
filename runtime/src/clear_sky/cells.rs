//! Which stars a pixel is near: lists for the cells of the screen, as texels that a shader reads.
//!
//! The first [`HEADER`] texels are a cell each, row by row: where its list begins, and how many stars it has. Then the lists, two texels a star: where it is on
//! the screen, the square of its wing's radius and what that ends at; then the light of the wing and, over it, that of the tent. A star is in the list of every cell that it reaches.

use glam::{Vec2, Vec3};

use super::spread::Spread;

/// Texels a row of the texture.
pub const WIDTH: usize = 256;
/// Its rows.
pub const HEIGHT: usize = 256;
/// Cells each way, at most.
pub const MOST_CELLS: u32 = 64;
/// Texels before the lists.
pub const HEADER: usize = (MOST_CELLS * MOST_CELLS) as usize;
/// Stars of all lists together, at most; beyond, the faintest are left out.
pub const MOST_ENTRIES: usize = (WIDTH * HEIGHT - HEADER) / 2;

/// The narrowest cell, in pixels: with narrower ones a star is in more lists than it is worth.
const LEAST_PX: f32 = 12.0;

/// A star on the screen.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Spot {
    /// Pixel coordinates.
    pub pixel: Vec2,
    /// Radiance of a pixel that gets all of its light.
    pub light: Vec3,
    /// How it is spread.
    pub spread: Spread,
}

/// The cells of a screen.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cells {
    /// How many there are each way.
    pub counts: [u32; 2],
    /// Cells a pixel, each way.
    pub a_pixel: Vec2,
}

impl Cells {
    /// Those of a screen of a size in pixels.
    pub fn of(size_px: Vec2) -> Cells {
        let count = |px: f32| ((px / LEAST_PX).floor() as u32).clamp(1, MOST_CELLS);
        let counts = [count(size_px.x), count(size_px.y)];
        let [columns, rows] = counts.map(|count| count as f32);
        Cells {
            counts,
            a_pixel: Vec2::new(columns, rows) / size_px,
        }
    }

    /// Columns and rows that a spot reaches, first and last; none if it is off the screen.
    fn reached(&self, spot: &Spot) -> Option<[[u32; 2]; 2]> {
        let [columns, rows] = self.counts;
        let range = |at: f32, a_pixel: f32, count: u32| {
            let [low, high] =
                [at - spot.spread.reach, at + spot.spread.reach].map(|px| px * a_pixel);
            let is_on = high >= 0.0 && low < count as f32;
            let last = count - 1;
            is_on.then(|| [low, high].map(|cell| (cell.max(0.0) as u32).min(last)))
        };
        let x = range(spot.pixel.x, self.a_pixel.x, columns)?;
        let y = range(spot.pixel.y, self.a_pixel.y, rows)?;
        Some([x, y])
    }

    /// The texture's texels, whole rows of them. `spots` come in the order in which they are left out last.
    pub fn texels(&self, spots: impl Iterator<Item = Spot>) -> Vec<[f32; 4]> {
        let columns = self.counts[0];
        let mut kept = Vec::new();
        let mut entries: Vec<(u32, u32)> = Vec::new();
        for spot in spots {
            let Some([x, y]) = self.reached(&spot) else {
                continue;
            };
            let many = (x[1] - x[0] + 1) as usize * (y[1] - y[0] + 1) as usize;
            if entries.len() + many > MOST_ENTRIES {
                break;
            }
            let index = kept.len() as u32;
            for row in y[0]..=y[1] {
                entries.extend((x[0]..=x[1]).map(|column| (row * columns + column, index)));
            }
            kept.push(spot);
        }
        // A stable sort: the brightest first in every list.
        entries.sort_by_key(|&(cell, _)| cell);
        let texels = HEADER + 2 * entries.len();
        let mut out = vec![[0.0; 4]; texels.next_multiple_of(WIDTH)];
        for (i, &(cell, index)) in entries.iter().enumerate() {
            let at = HEADER + 2 * i;
            let head = &mut out[cell as usize];
            if head[1] == 0.0 {
                head[0] = at as f32;
            }
            head[1] += 1.0;
            let spot = kept[index as usize];
            let Spread {
                core,
                wing,
                square,
                end,
                ..
            } = spot.spread;
            out[at] = [spot.pixel.x, spot.pixel.y, square, end];
            out[at + 1] = (wing * spot.light).extend(core / wing).to_array();
        }
        out
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn spot(x: f32, y: f32, reach: f32) -> Spot {
        Spot {
            pixel: Vec2::new(x, y),
            light: Vec3::new(x, y, reach),
            spread: Spread {
                reach,
                core: 1.0,
                wing: 1.0,
                square: 1.0,
                end: 0.0,
            },
        }
    }

    /// The lights of the stars in the list of a pixel's cell.
    fn listed(cells: Cells, texels: &[[f32; 4]], pixel: Vec2) -> Vec<Vec3> {
        let at = pixel * cells.a_pixel;
        let [first, count, ..] = texels[at.y as usize * cells.counts[0] as usize + at.x as usize];
        let lights = (0..count as usize).map(|i| texels[first as usize + 2 * i + 1]);
        lights.map(|l| Vec3::new(l[0], l[1], l[2])).collect()
    }

    #[test]
    fn a_pixel_finds_every_star_that_reaches_it() {
        let mut spots = Vec::new();
        for i in 0..400 {
            let at = |step: f32| (i as f32 * step).fract();
            let reach = if i % 37 == 0 { 40.0 } else { 1.0 };
            spots.push(spot(
                660.0 * at(0.618) - 10.0,
                380.0 * at(0.414) - 10.0,
                reach,
            ));
        }
        for size in [[640.0, 360.0], [641.0, 47.0], [5.0, 3000.0]] {
            let size = Vec2::from(size);
            let cells = Cells::of(size);
            let texels = cells.texels(spots.iter().copied());
            assert!(texels.len().is_multiple_of(WIDTH) && texels.len() <= WIDTH * HEIGHT);
            for i in 0..2000 {
                let at = |step: f32| (i as f32 * step).fract();
                let pixel = (size * Vec2::new(at(0.7548), at(0.5698))).floor() + 0.5;
                let found = listed(cells, &texels, pixel);
                for spot in &spots {
                    let away = (spot.pixel - pixel).abs().max_element();
                    if away < spot.spread.reach {
                        assert!(found.contains(&spot.light), "{size}: {pixel} {spot:?}");
                    }
                }
            }
        }
    }

    #[test]
    fn what_does_not_fit_is_the_faintest() {
        let cells = Cells::of(Vec2::new(1920.0, 1080.0));
        let everywhere = |i: u32| spot(960.0, 540.0, 4000.0 + i as f32);
        let texels = cells.texels((0..20).map(everywhere));
        let fit = MOST_ENTRIES / HEADER;
        let found = listed(cells, &texels, Vec2::new(7.5, 7.5));
        let wanted: Vec<Vec3> = (0..fit as u32).map(|i| everywhere(i).light).collect();
        assert_eq!(found, wanted);
    }

    #[test]
    fn a_screen_without_stars_has_empty_lists() {
        let texels = Cells::of(Vec2::new(64.0, 64.0)).texels(std::iter::empty());
        assert_eq!(texels, vec![[0.0; 4]; HEADER]);
    }
}
