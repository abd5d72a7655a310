//! The ground below a field, and how much of it is below clouds.

use welkin_pack::field::{Cloud, SECTION_SIDE_M, Sprite};

use crate::stream::Stream;

/// Cells along a side of a section: 62.5 m each, well below the smallest sprites.
const CELLS_A_SECTION: usize = 64;

/// Radius of what can be seen of a sprite, as a share of its size: it fades out towards its border.
pub(super) const SEEN: f32 = 0.4;

/// Cells that are looked at before all free ones are listed.
const TRIES: usize = 64;

/// A square of cells that repeats in both directions.
pub(super) struct Ground {
    side: usize,
    covered: Vec<bool>,
    count: usize,
}

impl Ground {
    pub fn new(sections: u32) -> Ground {
        let side = sections as usize * CELLS_A_SECTION;
        Ground {
            side,
            covered: vec![false; side * side],
            count: 0,
        }
    }

    /// Share of the ground that is below clouds.
    pub fn share(&self) -> f32 {
        self.count as f32 / self.covered.len() as f32
    }

    /// Side of the square, in metres.
    pub fn side_m(&self) -> f32 {
        self.side as f32 * cell_m()
    }

    /// The middle of a random cell that no cloud covers, in metres; of any cell if there is none.
    pub fn free_place(&self, stream: &mut Stream) -> [f32; 2] {
        let mut one_of = |count: usize| ((stream.unit() * count as f64) as usize).min(count - 1);
        let all = self.covered.len();
        for _ in 0..TRIES {
            let cell = one_of(all);
            if !self.covered[cell] {
                return self.middle(cell);
            }
        }
        let free: Vec<usize> = (0..all).filter(|cell| !self.covered[*cell]).collect();
        match free.len() {
            0 => self.middle(one_of(all)),
            count => self.middle(free[one_of(count)]),
        }
    }

    fn middle(&self, cell: usize) -> [f32; 2] {
        [cell % self.side, cell / self.side].map(|c| (c as f32 + 0.5) * cell_m())
    }

    /// How many of some points around a place are free: 29 in a disc of this radius.
    pub fn free_around(&self, [x, z]: [f32; 2], radius_m: f32) -> usize {
        let steps = -3..=3_i32;
        let points = steps
            .clone()
            .flat_map(|i| steps.clone().map(move |j| [i, j]));
        let points = points.filter(|[i, j]| i * i + j * j <= 9);
        let cell =
            |c: f32, step: i32| libm::floorf((c + radius_m * step as f32 / 3.0) / cell_m()) as i64;
        points
            .filter(|[i, j]| !self.covered[self.index(cell(x, *i), cell(z, *j))])
            .count()
    }

    /// Share of a rectangle that is free.
    pub fn free_share(&self, [x, z]: [f32; 2], [width, depth]: [f32; 2]) -> f32 {
        let cells = |c: f32, side: f32| {
            let cell = |m: f32| libm::floorf(m / cell_m()) as i64;
            cell(c - 0.5 * side)..=cell(c + 0.5 * side)
        };
        let (columns, rows) = (cells(x, width), cells(z, depth));
        let (mut free, mut all) = (0, 0);
        for row in rows {
            for column in columns.clone() {
                all += 1;
                free += u32::from(!self.covered[self.index(column, row)]);
            }
        }
        free as f32 / all as f32
    }

    /// Covers what is below a cloud.
    pub fn cover(&mut self, cloud: &Cloud) {
        for sprite in &cloud.sprites {
            self.cover_by(sprite, cloud.kind.is_flat());
        }
    }

    /// A facing sprite, from below turned in any way, is a disc as large as its ellipse; a flat one is the ellipse.
    pub fn cover_by(&mut self, sprite: &Sprite, is_flat: bool) {
        let [mut a, mut b] = sprite.size_m.map(|side| SEEN * side);
        let (mut sin, mut cos) = (0.0, 1.0);
        if is_flat {
            (sin, cos) = (
                libm::sinf(sprite.rotation_rad),
                libm::cosf(sprite.rotation_rad),
            );
        } else {
            a = libm::sqrtf(a * b);
            b = a;
        }
        let reach = a.max(b);
        let [x, _, z] = sprite.centre_m;
        let cells = |c: f32| {
            let cell = |m: f32| libm::floorf(m / cell_m()) as i64;
            cell(c - reach)..=cell(c + reach)
        };
        for row in cells(z) {
            for column in cells(x) {
                let [dx, dz] =
                    [(column, x), (row, z)].map(|(i, c)| (i as f32 + 0.5) * cell_m() - c);
                // A turn about +Y brings +x towards -z.
                let (along, across) = (dx * cos - dz * sin, dx * sin + dz * cos);
                let (u, v) = (along / a, across / b);
                if u * u + v * v <= 1.0 {
                    self.cover_cell(column, row);
                }
            }
        }
    }

    fn index(&self, column: i64, row: i64) -> usize {
        let wrap = |i: i64| i.rem_euclid(self.side as i64) as usize;
        wrap(row) * self.side + wrap(column)
    }

    fn cover_cell(&mut self, column: i64, row: i64) {
        let cell = self.index(column, row);
        if !self.covered[cell] {
            self.covered[cell] = true;
            self.count += 1;
        }
    }
}

fn cell_m() -> f32 {
    SECTION_SIDE_M / CELLS_A_SECTION as f32
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sprite(centre_m: [f32; 3], size_m: [f32; 2], rotation_rad: f32) -> Sprite {
        Sprite {
            centre_m,
            size_m,
            rotation_rad,
            cell: 0,
            cloud_box: 0,
            exposure: welkin_pack::field::Exposure::default(),
        }
    }

    #[test]
    fn a_sprite_covers_its_ellipse_wherever_it_lies() {
        let area = std::f32::consts::PI * (SEEN * 2000.0) * (SEEN * 1000.0);
        for centre in [
            [2000.0, 0.0, 2000.0],
            [3999.0, 0.0, 10.0],
            [-9000.0, 0.0, 0.0],
        ] {
            for (is_flat, rotation) in [(false, 0.0), (true, 0.0), (true, 0.7)] {
                let mut ground = Ground::new(1);
                ground.cover_by(&sprite(centre, [2000.0, 1000.0], rotation), is_flat);
                let found = ground.share() * ground.side_m() * ground.side_m();
                // Cells cut the border, some 70 of them; half of one each is more than chance does.
                assert!((found / area - 1.0).abs() < 0.04, "{found} {area}");
            }
        }
    }

    #[test]
    fn a_flat_sprite_is_turned_from_east_towards_north() {
        let mut ground = Ground::new(1);
        ground.cover_by(&sprite([2000.0, 0.0, 2000.0], [3000.0, 300.0], 0.785), true);
        let is_free = |x: f32, z: f32| ground.free_share([x, z], [0.0; 2]) == 1.0;
        assert!(!is_free(2500.0, 1500.0) && !is_free(1500.0, 2500.0));
        assert!(is_free(2500.0, 2500.0) && is_free(1500.0, 1500.0));
    }

    #[test]
    fn free_places_are_free_however_few_there_are() {
        let mut ground = Ground::new(1);
        let mut stream = Stream::new(1, "test");
        ground.covered.fill(true);
        ground.covered[1234] = false;
        assert_eq!(ground.free_place(&mut stream), ground.middle(1234));
        ground.covered[1234] = true;
        let [x, z] = ground.free_place(&mut stream);
        assert!((0.0..4000.0).contains(&x) && (0.0..4000.0).contains(&z));
    }
}
