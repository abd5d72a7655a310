//! From the picture of a camera to the plan of a flat layer of clouds.
//!
//! The layer lies one unit above the viewer. A place of it is seen in the direction (right, 1, ahead), and so a pinhole camera maps
//! the plan by a projective transformation (P. S. Heckbert, "Fundamentals of Texture Mapping and Image Warping", Berkeley
//! 1989, 2.2.3). A texel of the plan is the mean of what it covers in the picture (3.5.1), in a grid of samples a texel of
//! the picture apart.

#[cfg(test)]
mod tests;

use std::f64::consts::{FRAC_PI_2, TAU};

use welkin_pack::Image;

use crate::filter;

/// The lowest elevation that is used, in radians: 15 degrees. Lower down one sees the sides of clouds, which are about as high as
/// wide, and a row of the picture stands for more than ten times as much of the layer as overhead.
const LOWEST_RAD: f64 = 0.261_799;

/// Samples along a side of a texel at most: four times what 60 million texels of a picture give.
const MOST_SAMPLES: u32 = 32;

/// Places of the picture along a side that the middle of the plan is looked for at.
const CENTRES: u32 = 24;

/// Places along a side of a square that have to be in the picture.
const PROBES: u32 = 8;

/// Halvings of the side of the square: it is found to a thousandth.
const HALVINGS: u32 = 12;

/// How a picture was taken. Texels have their centres at halves; x goes to the right and y down.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Camera {
    /// A pinhole that looks up by an angle, without roll.
    Pinhole {
        /// Distance of the picture from the pinhole, in texels.
        focal: f64,
        /// The middle of the picture.
        centre: [f64; 2],
        /// Sine and cosine of the angle.
        up: [f64; 2],
    },
    /// All azimuths across the picture.
    Equirect {
        /// Texels a radian.
        scale: f64,
        /// Row of the horizon.
        horizon: f64,
    },
}

/// A square of the plan: its corner nearest to 0 in the picture's upper left, and its side.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Square {
    pub corner: [f64; 2],
    pub side: f64,
}

impl Camera {
    /// `fov` is the angle across the longer side, `horizon` the row of the horizon as a share of the height.
    pub fn pinhole([width, height]: [u32; 2], fov: f64, horizon: f64) -> Camera {
        let [width, height] = [width, height].map(f64::from);
        let focal = 0.5 * width.max(height) / libm::tan(0.5 * fov);
        let angle = libm::atan((horizon - 0.5) * height / focal);
        Camera::Pinhole {
            focal,
            centre: [0.5 * width, 0.5 * height],
            up: [libm::sin(angle), libm::cos(angle)],
        }
    }

    pub fn equirect([width, height]: [u32; 2], horizon: f64) -> Camera {
        Camera::Equirect {
            scale: f64::from(width) / TAU,
            horizon: horizon * f64::from(height),
        }
    }

    /// Where a place of the plan is in the picture, or beyond its sides; nowhere if it is behind the camera.
    pub fn seen(&self, [right, ahead]: [f64; 2]) -> Option<[f64; 2]> {
        match *self {
            Camera::Pinhole {
                focal,
                centre: [x, y],
                up: [sin, cos],
            } => {
                let depth = ahead * cos + sin;
                let height = cos - ahead * sin;
                (depth > 0.0).then(|| [x + focal * right / depth, y - focal * height / depth])
            }
            Camera::Equirect { scale, horizon } => {
                let elevation = libm::atan2(1.0, libm::hypot(right, ahead));
                let azimuth = libm::atan2(right, ahead);
                Some([scale * (azimuth + 0.5 * TAU), horizon - scale * elevation])
            }
        }
    }

    /// The place of the plan that a place of the picture shows; none at the horizon and below.
    pub fn shown(&self, [x, y]: [f64; 2]) -> Option<[f64; 2]> {
        match *self {
            Camera::Pinhole {
                focal,
                centre,
                up: [sin, cos],
            } => {
                let [right, up] = [(x - centre[0]) / focal, (centre[1] - y) / focal];
                let height = up * cos + sin;
                let ahead = cos - up * sin;
                (height > 0.0).then(|| [right / height, ahead / height])
            }
            Camera::Equirect { scale, horizon } => {
                let (azimuth, elevation) = (x / scale - 0.5 * TAU, (horizon - y) / scale);
                let is_above = elevation > 0.0 && elevation <= FRAC_PI_2;
                is_above.then(|| {
                    let distance = 1.0 / libm::tan(elevation);
                    [distance * libm::sin(azimuth), distance * libm::cos(azimuth)]
                })
            }
        }
    }

    /// Steps between two places of the picture, the shorter way around a panorama.
    fn step(&self, a: [f64; 2], b: [f64; 2]) -> [f64; 2] {
        let [x, y] = [b[0] - a[0], b[1] - a[1]];
        match *self {
            Camera::Pinhole { .. } => [x, y],
            Camera::Equirect { scale, .. } => {
                let around = scale * TAU;
                [x - around * libm::floor(x / around + 0.5), y]
            }
        }
    }

    fn goes_around(&self) -> bool {
        matches!(self, Camera::Equirect { .. })
    }
}

/// The largest square of the plan that a part of the picture shows, high enough above the horizon.
pub(super) fn largest_square(camera: &Camera, region: [u32; 4]) -> Option<Square> {
    let [left, top, width, height] = region.map(f64::from);
    let farthest = 1.0 / libm::tan(LOWEST_RAD);
    let is_shown = |place: [f64; 2]| {
        libm::hypot(place[0], place[1]) <= farthest
            && camera.seen(place).is_some_and(|[x, y]| {
                (left..=left + width).contains(&x) && (top..=top + height).contains(&y)
            })
    };
    let around = |[right, ahead]: [f64; 2], side: f64| Square {
        corner: [right - 0.5 * side, ahead - 0.5 * side],
        side,
    };
    let fits = |square: &Square| {
        let probes = (0..=PROBES).flat_map(|i| (0..=PROBES).map(move |j| [i, j]));
        { probes }.all(|probe| is_shown(square.at(probe.map(|p| f64::from(p) / f64::from(PROBES)))))
    };
    let share = |i: u32| (f64::from(i) + 0.5) / f64::from(CENTRES);
    let mut best: Option<Square> = None;
    for (i, j) in (0..CENTRES).flat_map(|j| (0..CENTRES).map(move |i| (i, j))) {
        let Some(centre) = camera.shown([left + width * share(i), top + height * share(j)]) else {
            continue;
        };
        let (mut least, mut most) = (best.map_or(0.0, |best| best.side), 2.0 * farthest);
        if !fits(&around(centre, least)) {
            continue;
        }
        for _ in 0..HALVINGS {
            let middle = 0.5 * (least + most);
            if fits(&around(centre, middle)) {
                least = middle;
            } else {
                most = middle;
            }
        }
        if best.is_none_or(|best| least > best.side) {
            best = Some(around(centre, least));
        }
    }
    best.filter(|best| best.side > 0.0)
}

impl Square {
    /// A place of the plan by its shares of the sides.
    pub fn at(&self, [u, v]: [f64; 2]) -> [f64; 2] {
        [
            self.corner[0] + self.side * u,
            self.corner[1] + self.side * v,
        ]
    }

    /// The part of the picture that the square is in: left, top, width, height.
    pub fn bounds(&self, camera: &Camera, region: [u32; 4]) -> [u32; 4] {
        let edge = (0..=PROBES).map(|i| f64::from(i) / f64::from(PROBES));
        let outline = edge.flat_map(|t| [[t, 0.0], [t, 1.0], [0.0, t], [1.0, t]]);
        let seen: Vec<[f64; 2]> = outline.filter_map(|uv| camera.seen(self.at(uv))).collect();
        let extent = |axis: usize| {
            let (from, to) = (
                f64::from(region[axis]),
                f64::from(region[axis] + region[axis + 2]),
            );
            let values = seen.iter().map(|place| place[axis]);
            let least = values.clone().fold(to, f64::min).max(from);
            [least, values.fold(from, f64::max).min(to)].map(|v| libm::round(v) as u32)
        };
        let ([left, right], [top, bottom]) = (extent(0), extent(1));
        // What is around the zenith is in every column up to the first row.
        if camera.goes_around() && self.corner.iter().all(|&c| c < 0.0 && c + self.side > 0.0) {
            return [region[0], region[1], region[2], bottom - region[1]];
        }
        [left, top, right - left, bottom - top]
    }
}

/// One channel of a picture as a square of the plan, `size` texels a side.
pub(super) fn unprojected(
    image: &Image,
    channel: usize,
    camera: &Camera,
    square: &Square,
    size: u32,
) -> Image {
    let place = |x: f64, y: f64| square.at([x / f64::from(size), y / f64::from(size)]);
    let read = Reading {
        image,
        channel,
        goes_around: camera.goes_around(),
    };
    filter::plane(size, size, |x, y| {
        let [x, y] = [f64::from(x), f64::from(y)];
        let seen = |dx: f64, dy: f64| camera.seen(place(x + dx, y + dy)).unwrap_or_default();
        let middle = seen(0.5, 0.5);
        let [across, down] = [(1.5, 0.5), (0.5, 1.5)].map(|(dx, dy)| {
            let [x, y] = camera.step(middle, seen(dx, dy));
            (libm::ceil(libm::hypot(x, y)) as u32).clamp(1, MOST_SAMPLES)
        });
        let centre = |i: u32, count: u32| (f64::from(i) + 0.5) / f64::from(count);
        let mut sum = 0.0;
        for j in 0..down {
            for i in 0..across {
                sum += read.at(seen(centre(i, across), centre(j, down)));
            }
        }
        (sum / f64::from(across * down)) as f32
    })
}

/// A channel that is read between its texels.
struct Reading<'a> {
    image: &'a Image,
    channel: usize,
    goes_around: bool,
}

impl Reading<'_> {
    /// Straight between the four nearest texels.
    fn at(&self, [x, y]: [f64; 2]) -> f64 {
        let [x, y] = [x - 0.5, y - 0.5];
        let [left, top] = [x, y].map(libm::floor);
        let [u, v] = [x - left, y - top];
        let texel = |dx: i64, dy: i64| {
            let [width, height] = [self.image.width, self.image.height].map(i64::from);
            let column = left as i64 + dx;
            let column = if self.goes_around {
                column.rem_euclid(width)
            } else {
                column.clamp(0, width - 1)
            };
            let row = (top as i64 + dy).clamp(0, height - 1);
            f64::from(self.image.texel(column as u32, row as u32)[self.channel])
        };
        let upper = texel(0, 0) + u * (texel(1, 0) - texel(0, 0));
        let lower = texel(0, 1) + u * (texel(1, 1) - texel(0, 1));
        upper + v * (lower - upper)
    }
}
