//! How much light gets to every place of a field, between the sprites that know it.
//!
//! # Theory
//! A field tells of each sprite how much light gets to its middle. Sprites overlap, and one that is lit as a whole by what gets to its own middle
//! stands out from its neighbours as a paper cut-out does; so vertices are lit by where they are. Scattered data become a grid by pull and push:
//! S. J. Gortler, R. Grzeszczuk, R. Szeliski, M. F. Cohen, "The Lumigraph", SIGGRAPH 1996, section 3.4. Each sprite gives what its
//! middle has, and what its rims have by the cloud about it: more light towards the light, less away from it.
//!
//! # Practice
//! Two textures in space that repeat along the ground, at most 128 x 64 x 128 texels of four bytes each, made once with the
//! field. Texels are centred: the first one's middle is half a cell from the grid's corner.

use glam::{Vec2, Vec3};
use welkin_pack::Field;
use welkin_pack::field::{Exposure, MOST_DEPTH, MOST_HALVINGS_M};

/// Cells along a section of the field, and at most along the ground and upwards.
const CELLS_A_SECTION: u32 = 32;
const MOST_CELLS: u32 = 128;
const MOST_LEVELS: u32 = 64;

/// Share of the halvings between middle and rim of a sprite that its rim is nearer to the light.
const RIM: f32 = 0.8;

/// Weights of a middle and of a rim, which are spread over eight cells: a cell of a weight of 1 asks no larger one.
const MIDDLE_WEIGHT: f32 = 8.0;
const RIM_WEIGHT: f32 = 2.0;

/// What a place has, in 255ths: halvings from east, south, west, north and above; sky.
type Values = [f32; 6];

/// What of a grid lies where.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Span {
    /// 1 / its size along the ground and upwards, 1 / m.
    pub per_m: Vec2,
    /// Height of its lower side, m.
    pub base_m: f32,
}

/// A grid over a field, cell by cell to the east, upwards and to the south.
#[derive(Clone, Debug, PartialEq)]
pub struct Exposures {
    /// Cells to the east, upwards and to the south.
    pub cells: [u32; 3],
    /// Where it lies.
    pub span: Span,
    /// Halvings of sunlight from the east, south, west and north over [`MOST_DEPTH`], in 255ths.
    pub sides: Vec<[u8; 4]>,
    /// The same from above; the sky's share in 255ths; nothing.
    pub above: Vec<[u8; 4]>,
}

impl Exposures {
    /// Of a field.
    pub fn new(field: &Field) -> Exposures {
        let across = (field.sections * CELLS_A_SECTION).next_power_of_two();
        let across = across.clamp(CELLS_A_SECTION, MOST_CELLS);
        let side_m = field.side_m().max(1.0);
        let cell_m = side_m / across as f32;
        let heights = field.clouds.iter().flat_map(|cloud| &cloud.sprites);
        let [low, high] = heights.fold([f32::MAX, f32::MIN], |[low, high], sprite| {
            let (y, half) = (sprite.centre_m[1], 0.5 * sprite.size_m[1]);
            [low.min(y - half), high.max(y + half)]
        });
        let (base_m, height_m) = if low < high {
            (low, high - low)
        } else {
            (0.0, cell_m)
        };
        let up = (height_m / cell_m).ceil().clamp(1.0, MOST_LEVELS as f32) as u32;
        let cells = [across, up, across];
        let per_m = Vec2::new(side_m, height_m).recip();
        let mut grid = Grid::new(cells);
        let scale = Vec3::new(per_m.x, per_m.y, per_m.x) * Vec3::from(cells.map(|c| c as f32));
        for sprite in field.clouds.iter().flat_map(|cloud| &cloud.sprites) {
            let middle = Vec3::from(sprite.centre_m) - base_m * Vec3::Y;
            let [width, height] = sprite.size_m;
            let mut add = |offset: Vec3, weight: f32| {
                let there = rim(&sprite.exposure, offset);
                grid.add((middle + offset) * scale, &there, weight);
            };
            add(Vec3::ZERO, MIDDLE_WEIGHT);
            for (axis, half) in [(Vec3::X, width), (Vec3::Y, height), (Vec3::Z, width)] {
                add(0.5 * half * axis, RIM_WEIGHT);
                add(-0.5 * half * axis, RIM_WEIGHT);
            }
        }
        let values = grid.filled();
        let bytes = |values: [f32; 4]| values.map(|v| v.round().clamp(0.0, 255.0) as u8);
        Exposures {
            cells,
            span: Span { per_m, base_m },
            sides: values
                .iter()
                .map(|&[e, s, w, n, ..]| bytes([e, s, w, n]))
                .collect(),
            above: values
                .iter()
                .map(|&[.., above, sky]| bytes([above, sky, 0.0, 0.0]))
                .collect(),
        }
    }
}

/// What a place has so far from the middle of a sprite.
fn rim(own: &Exposure, offset_m: Vec3) -> Values {
    let halvings_m = f32::from(own.halvings) / 255.0 * MOST_HALVINGS_M;
    let nearer = RIM * halvings_m * offset_m / MOST_DEPTH * 255.0;
    let [east, south, west, north] = own.sides.map(f32::from);
    let towards = [
        east - nearer.x,
        south - nearer.z,
        west + nearer.x,
        north + nearer.z,
    ];
    let [east, south, west, north] = towards.map(|depth| depth.max(0.0));
    let above = (f32::from(own.above) - nearer.y).max(0.0);
    let sky = f32::from(own.sky) * (RIM * halvings_m * offset_m.y).exp2();
    [east, south, west, north, above, sky.min(255.0)]
}

/// Sums of weighted values, and weights.
struct Grid {
    cells: [usize; 3],
    sums: Vec<(Values, f32)>,
}

impl Grid {
    fn new(cells: [u32; 3]) -> Grid {
        let cells = cells.map(|c| c as usize);
        Grid {
            cells,
            sums: vec![Default::default(); cells.iter().product()],
        }
    }

    /// A cell's index: it repeats along the ground, and goes on as it ends upwards and downwards.
    fn index(&self, [x, y, z]: [i64; 3]) -> usize {
        let [across, up, along] = self.cells;
        let wrap = |i: i64, n: usize| i.rem_euclid(n as i64) as usize;
        let y = y.clamp(0, up as i64 - 1) as usize;
        (wrap(z, along) * up + y) * across + wrap(x, across)
    }

    /// The eight cells about a place, by their shares.
    fn about(place: Vec3) -> impl Iterator<Item = ([i64; 3], f32)> {
        let from = (place - 0.5).floor();
        let part = place - 0.5 - from;
        (0..8).map(move |corner: u8| {
            let bits = [corner & 1, corner >> 1 & 1, corner >> 2];
            let far = Vec3::from(bits.map(f32::from));
            let share = (far * part + (1.0 - far) * (1.0 - part)).to_array();
            let cell = (from + far).to_array().map(|c| c as i64);
            (cell, share.iter().product())
        })
    }

    fn add(&mut self, place: Vec3, values: &Values, weight: f32) {
        for (cell, share) in Grid::about(place) {
            let index = self.index(cell);
            let (sums, sum) = &mut self.sums[index];
            for (sum, value) in sums.iter_mut().zip(values) {
                *sum += weight * share * value;
            }
            *sum += weight * share;
        }
    }

    /// Values of all cells. Where there is little weight, they are those of cells twice as large.
    fn filled(&self) -> Vec<Values> {
        let coarse = (self.cells.iter().any(|&c| c > 1)).then(|| {
            let coarse = self.halved();
            let values = coarse.filled();
            (coarse, values)
        });
        let cell = |index: usize, [x, y, z]: [usize; 3]| {
            let (sums, weight) = &self.sums[index];
            let share = weight.min(1.0);
            let own = sums.map(|sum| if *weight > 0.0 { sum / weight } else { 0.0 });
            let Some((coarse, values)) = coarse.as_ref().filter(|_| share < 1.0) else {
                return own;
            };
            let place = 0.5 * (Vec3::new(x as f32, y as f32, z as f32) + 0.5);
            let mut there = own.map(|value| share * value);
            for (cell, part) in Grid::about(place) {
                let from = &values[coarse.index(cell)];
                for (sum, value) in there.iter_mut().zip(from) {
                    *sum += (1.0 - share) * part * value;
                }
            }
            there
        };
        let [across, up, _] = self.cells;
        let indices = 0..self.sums.len();
        let values = indices.map(|i| cell(i, [i % across, i / across % up, i / across / up]));
        values.collect()
    }

    /// The sums of cells twice as large. No cell counts more than once, however many sprites are in it.
    fn halved(&self) -> Grid {
        let [across, up, along] = self.cells;
        let mut half = Grid::new(self.cells.map(|c| c.div_ceil(2) as u32));
        for (z, y, x) in
            (0..along).flat_map(|z| (0..up).flat_map(move |y| (0..across).map(move |x| (z, y, x))))
        {
            let (sums, weight) = &self.sums[(z * up + y) * across + x];
            if *weight == 0.0 {
                continue;
            }
            let factor = weight.min(1.0) / weight;
            let index = half.index([x / 2, y / 2, z / 2].map(|i| i as i64));
            let (into, sum) = &mut half.sums[index];
            for (into, from) in into.iter_mut().zip(sums) {
                *into += factor * from;
            }
            *sum += factor * weight;
        }
        half
    }
}

#[cfg(test)]
mod tests {
    use welkin_pack::SheetCell;
    use welkin_pack::field::{Cloud, CloudKind, ColourLevel, Sprite};

    use super::*;

    fn field(sprites: Vec<Sprite>) -> Field {
        let level = ColourLevel {
            height: 0.0,
            rgba: [1.0; 4],
        };
        let cloud = Cloud {
            kind: CloudKind::Cumulus,
            rank: 0.0,
            centre_m: [0.0; 3],
            size_m: [0.0; 3],
            levels: [level; 5],
            groups_m: Vec::new(),
            boxes: Vec::new(),
            sprites,
        };
        Field {
            sections: 1,
            hours: Vec::new(),
            clouds: vec![cloud],
        }
    }

    fn sprite(centre_m: [f32; 3], exposure: Exposure) -> Sprite {
        Sprite {
            centre_m,
            size_m: [500.0; 2],
            rotation_rad: 0.0,
            cell: SheetCell::PUFFY[0],
            cloud_box: 0,
            exposure,
        }
    }

    /// The cell of a place.
    fn cell(grid: &Exposures, place_m: Vec3) -> usize {
        let [across, up, along] = grid.cells.map(|c| c as f32);
        let x = (place_m.x * grid.span.per_m.x * across).rem_euclid(across) as usize;
        let y =
            ((place_m.y - grid.span.base_m) * grid.span.per_m.y * up).clamp(0.0, up - 1.0) as usize;
        let z = (place_m.z * grid.span.per_m.x * along).rem_euclid(along) as usize;
        (z * grid.cells[1] as usize + y) * grid.cells[0] as usize + x
    }

    #[test]
    fn every_place_has_what_all_sprites_have() {
        let exposure = Exposure {
            sides: [10, 20, 30, 40],
            above: 50,
            sky: 60,
            halvings: 0,
        };
        let places = [[100.0, 1000.0, 100.0], [3900.0, 1500.0, 2000.0]];
        let grid = Exposures::new(&field(places.map(|p| sprite(p, exposure)).to_vec()));
        assert_eq!(grid.cells, [32, 8, 32]);
        assert!(grid.sides.iter().all(|&sides| sides == [10, 20, 30, 40]));
        assert!(grid.above.iter().all(|&above| above == [50, 60, 0, 0]));
    }

    #[test]
    fn a_rim_is_nearer_to_the_light_than_the_middle() {
        let exposure = Exposure {
            sides: [100; 4],
            above: 100,
            sky: 100,
            halvings: 64,
        };
        let grid = Exposures::new(&field(vec![sprite([2000.0, 1000.0, 2000.0], exposure)]));
        let at = |offset: Vec3| cell(&grid, Vec3::new(2000.0, 1000.0, 2000.0) + offset);
        let [east, west] = [230.0, -230.0].map(|x| grid.sides[at(x * Vec3::X)]);
        assert!(east[0] < 100 && east[2] > 100 && west[0] > 100 && west[2] < 100);
        let [south, north] = [230.0, -230.0].map(|z| grid.sides[at(z * Vec3::Z)]);
        assert!(south[1] < north[1] && south[3] > north[3]);
        let [top, base] = [200.0, -200.0].map(|y| grid.above[at(y * Vec3::Y)]);
        assert!(top[0] < 100 && base[0] > 100 && top[1] > 100 && base[1] < 100);
    }

    #[test]
    fn what_is_between_two_sprites_is_between_theirs_also_across_the_side() {
        let of = |depth: u8| Exposure {
            sides: [depth; 4],
            ..Exposure::default()
        };
        let sprites = vec![
            sprite([200.0, 1000.0, 2000.0], of(40)),
            sprite([3800.0, 1000.0, 2000.0], of(200)),
        ];
        let grid = Exposures::new(&field(sprites));
        let at = |x: f32| grid.sides[cell(&grid, Vec3::new(x, 1000.0, 2000.0))][0];
        assert!(at(200.0) < 60 && at(3800.0) > 180);
        assert!((100..=140).contains(&at(0.0)), "{}", at(0.0));
    }

    #[test]
    fn a_field_without_clouds_is_dark_nowhere() {
        let empty = Field {
            sections: 0,
            hours: Vec::new(),
            clouds: Vec::new(),
        };
        let grid = Exposures::new(&empty);
        assert_eq!(grid.cells, [32, 1, 32]);
        assert!(grid.sides.iter().all(|&sides| sides == [0; 4]));
    }
}
