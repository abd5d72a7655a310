//! A tile that is closed by a cut, and blended by its gradients: fine structure is kept, since no two pictures are mixed.
//!
//! The cut goes where the two sides differ least: A. A. Efros, W. T. Freeman, "Image Quilting for Texture Synthesis and Transfer",
//! SIGGRAPH 2001, 2.1. What is left of the step is spread over the whole tile: the tile has the gradients of its pieces as nearly as it
//! can, P. Perez, M. Gangnet, A. Blake, "Poisson Image Editing", SIGGRAPH 2003, eq. 3, here on a torus, where a Fourier
//! transform solves it.

use welkin_pack::Image;

use super::fourier::{self, Plane};

/// Which texels of a field make up its tile of `size` texels.
struct Pieces<'a> {
    field: &'a Image,
    size: usize,
    /// For every row of the field: the first column that comes from the near side.
    columns: Vec<usize>,
    /// For every column of the tile: the first row that comes from the near side.
    rows: Vec<usize>,
}

/// Closes a field whose last `margin` columns and rows lie beyond the tile of `size` texels, a power of two.
pub(super) fn close(field: &Image, size: u32, margin: u32) -> Image {
    let (n, margin) = (size as usize, margin as usize);
    let value = |x: usize, y: usize| f64::from(field.texels[field.index(x as u32, y as u32)]);
    let step = |a: f64, b: f64| (a - b) * (a - b);
    let height = field.height as usize;
    let columns = cheapest(height, margin, |y, x| step(value(x, y), value(x + n, y)));
    let mut pieces = Pieces {
        field,
        size: n,
        columns,
        rows: Vec::new(),
    };
    pieces.rows = cheapest(n, margin, |x, y| {
        step(pieces.in_row(x, y), pieces.in_row(x, y + n))
    });
    solve(&pieces, size)
}

/// A way along `length` places that is at one of `breadth` at each and moves by one at most: the one whose costs add up to least.
/// It keeps off the ends, where nothing would be left of one side.
fn cheapest(length: usize, breadth: usize, cost: impl Fn(usize, usize) -> f64) -> Vec<usize> {
    let ways = 1..breadth - 1;
    let near = |at: usize| at.saturating_sub(1).max(1)..=(at + 1).min(breadth - 2);
    let mut sums = vec![vec![f64::MAX; breadth]; length];
    for place in 0..length {
        for at in ways.clone() {
            let before = match place {
                0 => 0.0,
                _ => near(at)
                    .map(|from| sums[place - 1][from])
                    .fold(f64::MAX, f64::min),
            };
            sums[place][at] = before + cost(place, at);
        }
    }
    let mut way = vec![1; length];
    for place in (0..length).rev() {
        let reach = match way.get(place + 1) {
            Some(&next) => near(next),
            None => 1..=breadth - 2,
        };
        let best = reach.min_by(|&a, &b| sums[place][a].total_cmp(&sums[place][b]));
        way[place] = best.unwrap_or(1);
    }
    way
}

impl Pieces<'_> {
    /// Column of the field that column `x` of the tile has in a row of the field.
    fn column(&self, x: usize, row: usize) -> usize {
        if x < self.columns[row] {
            x + self.size
        } else {
            x
        }
    }

    fn in_row(&self, x: usize, row: usize) -> f64 {
        self.value([self.column(x, row), row]).unwrap_or_default()
    }

    /// Where the field has a texel of the tile.
    fn place(&self, x: usize, y: usize) -> [usize; 2] {
        let row = if y < self.rows[x] { y + self.size } else { y };
        [self.column(x, row), row]
    }

    fn value(&self, [x, y]: [usize; 2]) -> Option<f64> {
        let is_in = x < self.field.width as usize && y < self.field.height as usize;
        is_in.then(|| f64::from(self.field.texels[self.field.index(x as u32, y as u32)]))
    }

    /// From a texel to the next one, to the right or down: as either of the two has it, or the mean where both do.
    fn gradient(&self, x: usize, y: usize, [dx, dy]: [usize; 2]) -> f64 {
        let (here, next) = (
            self.place(x, y),
            self.place((x + dx) % self.size, (y + dy) % self.size),
        );
        let of = |from: [usize; 2], to: [usize; 2]| Some(self.value(to)? - self.value(from)?);
        let ahead = of(here, [here[0] + dx, here[1] + dy]);
        let before = next[0].checked_sub(dx).zip(next[1].checked_sub(dy));
        let behind = before.and_then(|(x, y)| of([x, y], next));
        match (ahead, behind) {
            (Some(a), Some(b)) => 0.5 * (a + b),
            (Some(only), None) | (None, Some(only)) => only,
            (None, None) => 0.0,
        }
    }
}

/// The tile whose gradients are nearest to those of the pieces, and whose mean is theirs.
fn solve(pieces: &Pieces, size: u32) -> Image {
    let n = pieces.size;
    let mut plane = Plane::new(n);
    let mut mean = 0.0;
    for y in 0..n {
        for x in 0..n {
            mean += pieces.value(pieces.place(x, y)).unwrap_or_default() / (n * n) as f64;
            let [right, down] = [[1, 0], [0, 1]].map(|step| pieces.gradient(x, y, step));
            // The divergence is what comes in less what goes out.
            plane.add([x, y], right + down);
            plane.add([(x + 1) % n, y], -right);
            plane.add([x, (y + 1) % n], -down);
        }
    }
    fourier::transform(&mut plane, false);
    plane.scale(|[x, y]| {
        let wave = |i: usize| libm::cos(std::f64::consts::TAU * i as f64 / n as f64);
        // The Laplacian of a wave is this multiple of it.
        let laplacian = 2.0 * (wave(x) + wave(y)) - 4.0;
        if laplacian == 0.0 {
            0.0
        } else {
            1.0 / laplacian
        }
    });
    fourier::transform(&mut plane, true);
    let mut tile = Image::new(size, size, 1);
    let texels = tile.texels.iter_mut().zip(plane.real());
    texels.for_each(|(texel, value)| *texel = (value + mean) as f32);
    tile
}

#[cfg(test)]
mod tests;
