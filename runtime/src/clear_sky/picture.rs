//! The picture of a moment's clear sky that the shader reads.
//!
//! # Theory
//! A sky is the same on both sides of the sun, so it is a smooth function of two numbers that cost a pixel next to nothing: how far its direction
//! goes to the sun's azimuth, and up. Seen so, from the side, the hemisphere is half a disc, without a pole. Rows lie as close at
//! the horizon as the table's (`pack/src/mapping/sky.rs`), every second on one of them: with the root of the height, bent by an eighth of it.
//!
//! # Practice
//! One root a pixel, where the table's own places take three, a reciprocal one and a division. Against those a displayed colour
//! moves by 0.3 of a byte at most while the sun is up, by 1 with it 9 degrees down. The last column is not sky but the colour of the aureole below the
//! sun, row by row. A picture is some 60 microseconds of one core.

use glam::{Vec3, Vec4};
use half::f16;
use welkin_pack::Image;
use welkin_pack::mapping::sky_to_texel;

use crate::geometry::math::luminance;

/// Columns of sky for each of the table.
const FINER: u32 = 4;
/// Rows for each of the table, at the horizon.
const FINER_ROWS: f32 = 2.0;
/// How far the rows are bent.
pub const BEND: f32 = 0.125;

/// The most that there is of the aureole's light over that below the sun: beyond, in the shade of the earth, there is next to nothing below the
/// sun either.
const MOST_SHARE: f32 = 4.0;

/// Where directions lie in a picture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Places {
    /// Columns of sky.
    columns: u32,
    rows: u32,
    /// From row to row, of the bent root of the height.
    step: f32,
}

impl Places {
    /// Of the picture of a table of that size.
    pub fn new([width, height]: [u32; 2]) -> Places {
        let step = std::f32::consts::SQRT_2 / (FINER_ROWS * (height - 1) as f32);
        Places {
            columns: FINER * width,
            // Up to the zenith and no more than a step beyond it.
            rows: ((1.0 + BEND) / step).ceil() as u32 + 1,
            step,
        }
    }

    /// Width and height of the picture.
    pub fn size(self) -> [u32; 2] {
        [self.columns + 1, self.rows]
    }

    /// Texture coordinates of sideways 0 and height 0, and how far they go with each.
    pub fn start_and_span(self) -> [[f32; 2]; 2] {
        let [width, height] = self.size().map(|side| side as f32);
        let half = 0.5 * (self.columns - 1) as f32;
        let start = [(0.5 + half) / width, 0.5 / height];
        [start, [half / width, 1.0 / (self.step * height)]]
    }

    /// Texture coordinate of the aureole's column.
    pub fn aureole_u(self) -> f32 {
        1.0 - 0.5 / self.size()[0] as f32
    }

    /// How far a column's directions go to the sun's azimuth.
    fn sideways(self, column: u32) -> f32 {
        2.0 * column as f32 / (self.columns - 1) as f32 - 1.0
    }

    /// The height of a row's directions, as a sine.
    fn height(self, row: u32) -> f32 {
        let bent = row as f32 * self.step;
        // The root of s (1 + b s^2) = bent, by Newton's steps.
        let mut root = bent;
        for _ in 0..4 {
            let off = root * (1.0 + BEND * root * root) - bent;
            root -= off / (1.0 + 3.0 * BEND * root * root);
        }
        root * root
    }
}

/// The picture of a table of that size, of radiance and of the light of the aureole: radiance, and in alpha how much there is of the aureole's
/// light, over that below the sun; in the last column that light.
pub(crate) fn image(size: [u32; 2], radiance: &[Vec3], aureole: &[Vec3]) -> Image {
    let places = Places::new(size);
    let [width, height] = places.size();
    let sky = Table::of_shares(size, radiance, aureole);
    let light = Table {
        size,
        texels: aureole.iter().map(|light| light.extend(0.0)).collect(),
    };
    let mut image = Image::new(width, height, 4);
    for y in 0..height {
        let sine = places.height(y);
        let row = (0..places.columns).map(|x| sky.at_place(places.sideways(x), sine));
        // Below the sun.
        for (x, texel) in row.chain([light.at(1.0, sine)]).enumerate() {
            // As half floats have it, so that twins read what the device reads.
            let halves = texel.to_array().map(|c| f16::from_f32(c).to_f32());
            image.texel_mut(x as u32, y).copy_from_slice(&halves);
        }
    }
    image
}

/// A table of a moment's sky, by azimuth and elevation.
struct Table {
    size: [u32; 2],
    texels: Vec<Vec4>,
}

impl Table {
    /// Radiance and the share of the aureole.
    fn of_shares(size: [u32; 2], radiance: &[Vec3], aureole: &[Vec3]) -> Table {
        let width = size[0] as usize;
        let pairs = radiance.iter().zip(aureole).enumerate();
        let texels = pairs.map(|(i, (radiance, light))| {
            let below = luminance(aureole[i / width * width]);
            let share = luminance(*light) / below.max(1e-9);
            radiance.extend(share.min(MOST_SHARE))
        });
        Table {
            size,
            texels: texels.collect(),
        }
    }

    /// Where a direction goes so far to the sun's azimuth and up. Beyond the edge of the half disc it goes on as it comes from inside.
    fn at_place(&self, sideways: f32, sine: f32) -> Vec4 {
        let radius = sideways.hypot(sine);
        let along = |share: f32| {
            let flat = (1.0 - sine * sine * share * share).max(1e-12).sqrt();
            self.at((sideways * share / flat).clamp(-1.0, 1.0), sine * share)
        };
        if radius <= 1.0 {
            return along(1.0);
        }
        let inside = (2.0 - radius).max(0.0);
        let seen = 2.0 * along(1.0 / radius) - along(inside / radius);
        seen.clamp(Vec4::ZERO, Vec3::MAX.extend(MOST_SHARE))
    }

    /// At the cosine of an azimuth from the sun and the sine of an elevation, between the four texels about it.
    fn at(&self, azimuth_cos: f32, sine: f32) -> Vec4 {
        let [width, height] = self.size;
        let [x, y] = sky_to_texel(sine, azimuth_cos, self.size);
        let (left, low) = ((x as u32).min(width - 2), (y as u32).min(height - 2));
        let row = |y: u32| {
            let i = (y * width + left) as usize;
            self.texels[i].lerp(self.texels[i + 1], x - left as f32)
        };
        row(low).lerp(row(low + 1), y - low as f32)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_are_bent_roots_from_the_horizon_to_beyond_the_zenith() {
        for size in [[16, 32], [8, 16], [64, 128]] {
            let places = Places::new(size);
            assert_eq!(places.height(0), 0.0);
            let [.., rows] = places.size();
            assert!(places.height(rows - 1) >= 1.0 && places.height(rows - 2) < 1.0);
            for row in 0..rows {
                let sine = places.height(row);
                let place = sine.sqrt() * (1.0 + BEND * sine) / places.step;
                assert!((place - row as f32).abs() < 1e-3, "{row}: {place}");
            }
        }
    }

    #[test]
    fn a_sky_that_is_linear_seen_at_place_stays_so_beyond_its_edge() {
        let size = [65, 129];
        let texel = |i: usize| {
            let (x, y) = (i % size[0] as usize, i / size[0] as usize);
            let (sine, cosine) = welkin_pack::mapping::texel_to_sky([x as f32, y as f32], size);
            Vec3::splat(2.0 + cosine * (1.0 - sine * sine).max(0.0).sqrt() + 0.5 * sine)
        };
        let count = (size[0] * size[1]) as usize;
        let radiance: Vec<Vec3> = (0..count).map(texel).collect();
        let table = Table::of_shares(size, &radiance, &radiance);
        for (sideways, sine) in [
            (0.0, 1.0),
            (0.6, 0.7),
            (0.6, 0.81),
            (-0.9, 0.45),
            (1.0, 0.02),
        ] {
            let seen = table.at_place(sideways, sine).x;
            let wanted = 2.0 + sideways + 0.5 * sine;
            assert!(
                (seen - wanted).abs() < 5e-3,
                "{sideways} {sine}: {seen} {wanted}"
            );
        }
    }
}
