//! Where a picture of sky and ground has its horizon.
//!
//! The row that parts the picture into two kinds of colours, each as like itself as can be: S. M. Ettinger, M. C. Nechyba, P. G. Ifju,
//! M. Waszak, "Vision-Guided Flight Stability and Control for Micro Air Vehicles", IROS 2002, eq. 11, of horizons without roll.

use welkin_pack::Image;

use crate::filter;

/// Rows and columns that the horizon is looked for in.
const ROWS: u32 = 200;
const COLUMNS: u32 = 64;

/// A horizon parts at least this share of the rows from the others.
const LEAST_PART: f64 = 0.05;

/// Share of the variance of all colours that the two means have to explain (N. Otsu, "A Threshold Selection Method from Gray-Level
/// Histograms", IEEE Trans. SMC 9, 1979, eq. 12): half of it or more, so that the two kinds differ more than each within itself.
const LEAST_APART: f64 = 0.5;

/// Share of the difference of the two means that lies within six rows in a hundred about the horizon. A step has all of it, an even
/// slope less than an eighth.
const LEAST_STEP: f64 = 0.5;
const STEP_ROWS: usize = 12;

/// Sums of a number of colours and of their products.
#[derive(Clone, Copy, Default)]
struct Sums {
    count: f64,
    colours: [f64; 3],
    products: [[f64; 3]; 3],
}

impl Sums {
    fn less(&self, other: &Sums) -> Sums {
        let mut rest = *self;
        rest.count -= other.count;
        for i in 0..3 {
            rest.colours[i] -= other.colours[i];
            for j in 0..3 {
                rest.products[i][j] -= other.products[i][j];
            }
        }
        rest
    }

    fn mean(&self) -> [f64; 3] {
        self.colours.map(|sum| sum / self.count)
    }

    fn covariance(&self) -> [[f64; 3]; 3] {
        let mean = self.mean();
        [0, 1, 2].map(|i| [0, 1, 2].map(|j| self.products[i][j] / self.count - mean[i] * mean[j]))
    }

    fn trace(&self) -> f64 {
        let c = self.covariance();
        c[0][0] + c[1][1] + c[2][2]
    }

    /// What Ettinger and others add up of the sky and of the ground: determinant and squared sum of the eigenvalues.
    fn disorder(&self) -> f64 {
        let [a, b, c] = self.covariance();
        let determinant = a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0])
            + a[2] * (b[0] * c[1] - b[1] * c[0]);
        determinant + self.trace() * self.trace()
    }
}

/// The row of the horizon as a share of the height, if there is one.
pub(super) fn find(colours: &Image) -> Option<f64> {
    let (width, height) = (colours.width.min(COLUMNS), colours.height.min(ROWS));
    let small = [0, 1, 2].map(|channel| {
        let plane = filter::plane(colours.width, colours.height, |x, y| {
            colours.texel(x, y)[channel]
        });
        filter::resample(&plane, width, height)
    });
    // Sums of all rows above each row.
    let mut above = vec![Sums::default()];
    for y in 0..height {
        let mut sums = *above.last()?;
        for x in 0..width {
            let colour = small
                .each_ref()
                .map(|image| f64::from(image.texel(x, y)[0]));
            sums.count += 1.0;
            for i in 0..3 {
                sums.colours[i] += colour[i];
                for j in 0..3 {
                    sums.products[i][j] += colour[i] * colour[j];
                }
            }
        }
        above.push(sums);
    }
    let all = *above.last()?;
    let rows = above.len() - 1;
    let margin = (LEAST_PART * rows as f64) as usize + 1;
    let disorder = |row: usize| above[row].disorder() + all.less(&above[row]).disorder();
    let row = (margin..rows - margin).min_by(|&a, &b| disorder(a).total_cmp(&disorder(b)))?;
    let (sky, ground) = (above[row], all.less(&above[row]));
    let within = (sky.trace() * sky.count + ground.trace() * ground.count) / all.count;
    let is_apart = all.trace() > 0.0 && 1.0 - within / all.trace() >= LEAST_APART;
    let distance = |a: &Sums, b: &Sums| {
        let [a, b] = [a.mean(), b.mean()];
        libm::sqrt((0..3).map(|i| (a[i] - b[i]) * (a[i] - b[i])).sum())
    };
    let (from, to) = (row.saturating_sub(STEP_ROWS), (row + STEP_ROWS).min(rows));
    let (over, under) = (above[row].less(&above[from]), above[to].less(&above[row]));
    let is_step = distance(&over, &under) >= LEAST_STEP * distance(&sky, &ground);
    (is_apart && is_step).then(|| row as f64 / rows as f64)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn picture(colour: impl Fn(f32, f32) -> [f32; 3]) -> Image {
        let mut image = Image::new(300, 240, 3);
        for y in 0..240 {
            for x in 0..300 {
                let place = [x as f32 / 300.0, y as f32 / 240.0];
                image
                    .texel_mut(x, y)
                    .copy_from_slice(&colour(place[0], place[1]));
            }
        }
        image
    }

    fn sky(x: f32, y: f32) -> [f32; 3] {
        let cloud = 0.5 + 0.5 * libm::sinf(17.0 * x + 5.0 * libm::sinf(9.0 * y));
        [
            0.3 + 0.4 * cloud + 0.2 * y,
            0.45 + 0.3 * cloud + 0.15 * y,
            0.8 + 0.1 * cloud,
        ]
    }

    #[test]
    fn a_horizon_over_ground_and_over_hills_is_found() {
        for at in [0.3_f32, 0.55, 0.8] {
            let found = find(&picture(|x, y| {
                let hill = at + 0.02 * libm::sinf(8.0 * x);
                let rough = 0.05 * libm::sinf(90.0 * x + 70.0 * y);
                if y < hill {
                    sky(x, y)
                } else {
                    [0.2 + rough, 0.22 + rough, 0.1]
                }
            }));
            let found = found.expect("a horizon");
            assert!((found - f64::from(at)).abs() < 0.03, "{at}: {found}");
        }
    }

    #[test]
    fn a_sky_alone_a_slope_and_one_colour_have_none() {
        assert_eq!(find(&picture(sky)), None);
        assert_eq!(
            find(&picture(|_, y| [0.3 + 0.5 * y, 0.5 + 0.4 * y, 0.9])),
            None
        );
        assert_eq!(find(&picture(|_, _| [0.4; 3])), None);
    }
}
