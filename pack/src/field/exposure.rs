//! How much light gets to each sprite through the clouds around it.
//!
//! # Theory
//! N. Wang, "Let There Be Clouds!", Game Developer, 2004, lights a sprite by where it is in its group alone, and names light through the
//! cloud as what could come next. M. J. Harris, A. Lastra, "Real-Time Cloud Rendering", Eurographics 2001, add up the extinction between each particle
//! and the sun; here it is added up once, towards five directions, so that the sun may go where it likes.
//!
//! Sprites become a grid of extinction: each an ellipsoid, somewhat larger than what its picture shows. Rays from the middle of each sprite add up what
//! they meet. A sprite sees its own cloud, and those of lower rank, which are there whenever it is.
//!
//! # Practice
//! Depths are halvings of light most of which is scattered on forwards, far fewer than Beer's law has: a puff counts two through its middle.
//! Time goes with the sprites: nine rays of at most four kilometres each, 25 microseconds a sprite.

use super::{Cloud, Exposure, Field, MOST_DEPTH, MOST_HALVINGS_M, Sprite};
use crate::mapping::{SheetCell, SheetKind};

/// Depth through the middle of fog, of a wisp and of a puff, in halvings.
const THICKNESS: [f32; 3] = [0.3, 0.4, 2.0];

/// Half axes of the ellipsoid as a share of the sprite's width and height: more than a picture shows, since light is scattered to and fro between
/// neighbours, which have about as much of it.
const LARGE: f32 = 0.8;

/// Side of a cell of the grid, in metres, in fields of up to three sections; larger fields have larger cells.
const CELL_M: f32 = 80.0;
const FINE_SECTIONS: u32 = 3;

/// Cells that a sprite reaches at most from its middle, and that the grid has upwards: what is larger is not a cloud.
const MOST_REACH: f32 = 16.0;
const MOST_LEVELS: usize = 192;

/// Cells from the origin beyond which no place is told apart.
const FAR: f32 = 1e6;

/// How far a ray goes, in metres.
const REACH_M: f32 = 4000.0;

/// Sines of the elevation of the low rays and of those half way up.
const LOW: f32 = 0.2;
const HALF_WAY: f32 = 0.7;

/// Shares of the sky that the high ray, the four half way up and the four low ones stand for: bands of equal height between the sines.
const SKY: [f32; 3] = [0.15, 0.125, 0.0875];

/// Share of a depth that skylight feels: it comes round what is in the way.
const SKY_FEELS: f32 = 0.5;

impl Exposure {
    /// East, south, west, north, above, sky, halvings.
    pub(crate) fn bytes(self) -> [u8; 7] {
        let [east, south, west, north] = self.sides;
        [
            east,
            south,
            west,
            north,
            self.above,
            self.sky,
            self.halvings,
        ]
    }
}

impl Field {
    /// Finds the exposure of every sprite.
    pub fn expose(&mut self) {
        let mut grid = Grid::new(self);
        for cloud in &mut self.clouds {
            for sprite in &cloud.sprites {
                grid.add(cloud, sprite);
            }
            for sprite in &mut cloud.sprites {
                sprite.exposure = grid.exposure(sprite.centre_m);
            }
        }
    }
}

/// In 255ths.
fn byte(share: f32) -> u8 {
    libm::roundf(255.0 * share).clamp(0.0, 255.0) as u8
}

/// Halvings a metre, on a grid that repeats along the ground.
struct Grid {
    cell_m: f32,
    /// Cells along the ground, and upwards.
    side: usize,
    levels: usize,
    base_m: f32,
    halvings_m: Vec<f32>,
}

impl Grid {
    fn new(field: &Field) -> Grid {
        let coarser = field.sections.div_ceil(FINE_SECTIONS).max(1);
        let cell_m = CELL_M * coarser as f32;
        let side = libm::roundf(field.side_m() / cell_m).max(1.0) as usize;
        let edges = field.clouds.iter().flat_map(|cloud| &cloud.sprites);
        let [base, top] = edges.fold([f32::MAX, f32::MIN], |[low, high], sprite| {
            let [y, half] = [
                sprite.centre_m[1],
                0.5 * sprite.size_m[1].max(sprite.size_m[0]),
            ];
            [low.min(y - half), high.max(y + half)]
        });
        // Cells are where they are, whatever clouds there are.
        let base_m = if base < top {
            (libm::floorf(base / cell_m) - 1.0) * cell_m
        } else {
            0.0
        };
        let levels = libm::ceilf((top - base_m).max(0.0) / cell_m) as usize + 2;
        let levels = levels.min(MOST_LEVELS);
        Grid {
            cell_m,
            side,
            levels,
            base_m,
            halvings_m: vec![0.0; side * side * levels],
        }
    }

    /// Adds an ellipsoid, in all as much as its depth over its disc.
    fn add(&mut self, cloud: &Cloud, sprite: &Sprite) {
        let thickness = match SheetCell(sprite.cell).kind() {
            SheetKind::Foggy => THICKNESS[0],
            SheetKind::Wispy => THICKNESS[1],
            SheetKind::FlatBottomed | SheetKind::Puffy => THICKNESS[2],
        };
        let [width, height] = sprite.size_m;
        // A grid cannot hold what is smaller than its cells.
        let wide = (LARGE * width).max(0.75 * self.cell_m);
        let high = match cloud.kind.is_flat() {
            true => 0.75 * self.cell_m,
            false => (LARGE * height).max(0.75 * self.cell_m),
        };
        let radii = [wide, high, wide].map(|r| r.min(MOST_REACH * self.cell_m));
        let middle = self.place(sprite.centre_m);
        let reach = radii.map(|r| libm::ceilf(r / self.cell_m) as i64 + 1);
        let corner = middle.map(|c| libm::floorf(c) as i64);
        let mut cells = Vec::new();
        let mut sum = 0.0;
        for y in corner[1] - reach[1]..=corner[1] + reach[1] {
            for z in corner[2] - reach[2]..=corner[2] + reach[2] {
                for x in corner[0] - reach[0]..=corner[0] + reach[0] {
                    let away: f32 = (0..3)
                        .map(|a| ([x, y, z][a] as f32 + 0.5 - middle[a]) * self.cell_m / radii[a])
                        .map(|d| d * d)
                        .sum();
                    let weight = 1.0 - away;
                    if weight > 0.0
                        && let Some(index) = self.index([x, y, z])
                    {
                        cells.push((index, weight));
                        sum += weight;
                    }
                }
            }
        }
        // Density falls off with the square of the radius: over its disc a ball has 2/5 of the depth through its middle.
        let area = std::f32::consts::PI * (LARGE * width) * (LARGE * width);
        let volume = self.cell_m * self.cell_m * self.cell_m;
        let opacity = 0.5 * (cloud.levels[0].rgba[3] + cloud.levels[4].rgba[3]);
        let amount = 0.4 * thickness * opacity * area / volume;
        for (index, weight) in cells {
            self.halvings_m[index] += amount * weight / sum;
        }
    }

    /// A place in cells.
    fn place(&self, [x, y, z]: [f32; 3]) -> [f32; 3] {
        [
            x / self.cell_m,
            (y - self.base_m) / self.cell_m,
            z / self.cell_m,
        ]
        .map(|c| c.clamp(-FAR, FAR))
    }

    fn index(&self, [x, y, z]: [i64; 3]) -> Option<usize> {
        let level = usize::try_from(y).ok().filter(|y| *y < self.levels)?;
        let [x, z] = [x, z].map(|i| i.rem_euclid(self.side as i64) as usize);
        Some((level * self.side + z) * self.side + x)
    }

    /// Halvings a metre between the middles of eight cells.
    fn at(&self, place: [f32; 3]) -> f32 {
        let from = place.map(|c| libm::floorf(c - 0.5));
        let part: [f32; 3] = std::array::from_fn(|a| place[a] - 0.5 - from[a]);
        let corner = from.map(|c| c as i64);
        let mut sum = 0.0;
        for number in 0..8 {
            let bits = [number & 1, number >> 1 & 1, number >> 2 & 1];
            let weight: f32 = (0..3)
                .map(|a| if bits[a] == 1 { part[a] } else { 1.0 - part[a] })
                .product();
            let cell = std::array::from_fn(|a| corner[a] + i64::from(bits[a]));
            sum += weight * self.index(cell).map_or(0.0, |index| self.halvings_m[index]);
        }
        sum
    }

    /// Halvings along a ray from a place, up to the top of the grid.
    fn depth(&self, from_m: [f32; 3], direction: [f32; 3]) -> f32 {
        let from = self.place(from_m);
        let most = (REACH_M / self.cell_m) as usize;
        let mut depth = 0.0;
        for step in 0..most {
            let far = step as f32 + 0.5;
            let place: [f32; 3] = std::array::from_fn(|a| from[a] + far * direction[a]);
            if place[1] > self.levels as f32 {
                break;
            }
            depth += self.cell_m * self.at(place);
        }
        depth
    }

    fn exposure(&self, from_m: [f32; 3]) -> Exposure {
        let sides = [[1.0, 0.0], [0.0, 1.0], [-1.0, 0.0], [0.0, -1.0]];
        let ray = |[x, z]: [f32; 2], sine: f32| {
            let along = libm::sqrtf(1.0 - sine * sine);
            self.depth(from_m, [x * along, sine, z * along])
        };
        let top = ray([0.0, 0.0], 1.0);
        let low = sides.map(|side| ray(side, LOW));
        let diagonal = std::f32::consts::FRAC_1_SQRT_2;
        let between = [[1.0, 1.0], [-1.0, 1.0], [-1.0, -1.0], [1.0, -1.0]];
        let half_way = between.map(|side| ray(side.map(|c: f32| c * diagonal), HALF_WAY));
        let open = |depth: f32| libm::exp2f(-SKY_FEELS * depth);
        let sky = SKY[0] * open(top)
            + SKY[1] * half_way.map(open).iter().sum::<f32>()
            + SKY[2] * low.map(open).iter().sum::<f32>();
        let depth = |depth: f32| byte(depth / MOST_DEPTH);
        Exposure {
            sides: low.map(depth),
            above: depth(top),
            sky: byte(sky),
            halvings: byte(self.at(self.place(from_m)) / MOST_HALVINGS_M),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::field::{CloudKind, ColourLevel};

    fn sprite(centre_m: [f32; 3], side_m: f32) -> Sprite {
        Sprite {
            centre_m,
            size_m: [side_m; 2],
            rotation_rad: 0.0,
            cell: SheetCell::PUFFY[0],
            cloud_box: 0,
            exposure: Exposure::default(),
        }
    }

    fn exposed(clouds: &[&[Sprite]]) -> Vec<Vec<Exposure>> {
        let cloud = |sprites: &&[Sprite]| Cloud {
            kind: CloudKind::Cumulus,
            rank: 0.0,
            centre_m: [0.0; 3],
            size_m: [0.0; 3],
            levels: [ColourLevel {
                height: 0.0,
                rgba: [1.0; 4],
            }; 5],
            groups_m: Vec::new(),
            boxes: Vec::new(),
            sprites: sprites.to_vec(),
        };
        let mut field = Field {
            sections: 1,
            hours: Vec::new(),
            clouds: clouds.iter().map(cloud).collect(),
        };
        field.expose();
        let exposures = |cloud: &Cloud| cloud.sprites.iter().map(|s| s.exposure).collect();
        field.clouds.iter().map(exposures).collect()
    }

    #[test]
    fn half_of_a_lone_puff_is_before_its_own_middle() {
        let [own] = exposed(&[&[sprite([2000.0, 1000.0, 2000.0], 1000.0)]])[0][..] else {
            panic!("one sprite");
        };
        let expected = 0.5 * THICKNESS[2];
        let depth = |byte: u8| f32::from(byte) / 255.0 * MOST_DEPTH;
        for found in [
            own.above,
            own.sides[0],
            own.sides[1],
            own.sides[2],
            own.sides[3],
        ] {
            assert!(
                (depth(found) / expected - 1.0).abs() < 0.15,
                "{} {expected}",
                depth(found)
            );
        }
    }

    #[test]
    fn what_stands_towards_the_light_takes_it() {
        let [west, east] = [1700.0, 2300.0].map(|x| sprite([x, 1000.0, 2000.0], 400.0));
        let found = exposed(&[&[west, east]])[0].clone();
        // The western one sees the eastern one before the eastern sky.
        assert!(found[0].sides[0] > found[1].sides[0] + 10, "{found:?}");
        assert!(found[1].sides[2] > found[0].sides[2] + 10, "{found:?}");
        for (a, b) in [(0, 2), (1, 1), (3, 3)] {
            assert!(
                found[0].sides[a].abs_diff(found[1].sides[b]) <= 1,
                "{found:?}"
            );
        }
        assert!(found[0].above.abs_diff(found[1].above) <= 1);
    }

    #[test]
    fn bases_are_darker_than_tops() {
        let tower: Vec<Sprite> = (0..3)
            .map(|i| sprite([2000.0, 1000.0 + 300.0 * i as f32, 2000.0], 300.0))
            .collect();
        let found = &exposed(&[&tower])[0];
        for pair in found.windows(2) {
            assert!(
                pair[0].above > pair[1].above && pair[0].sky < pair[1].sky,
                "{found:?}"
            );
        }
    }

    #[test]
    fn a_cloud_sees_those_before_it_and_not_those_after_it_and_over_the_edge_of_the_field() {
        // Across the edge, 200 m apart.
        let [low, high] = [[3950.0, 1000.0, 10.0], [150.0, 1050.0, 3990.0]]
            .map(|place| vec![sprite(place, 400.0)]);
        let alone = exposed(&[&low])[0][0];
        let both = exposed(&[&low, &high]);
        assert_eq!(both[0][0], alone);
        assert!(both[1][0].sides[2] > alone.sides[2] + 10, "{both:?}");
    }
}
