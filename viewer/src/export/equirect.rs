//! The panorama: azimuth along the rows, elevation along the columns (the equirectangular projection).
//!
//! Column centres are at `u = (x + 0.5) / width`, row centres at `v = (y + 0.5) / height`. v 0 is the zenith and 1 the nadir; u grows to the
//! right by azimuth, from north towards east, and 0.5 is the azimuth that was asked for: north in the middle, east to the right, unless told
//! otherwise. The first and the last column are neighbours.
//!
//! # Practice
//! A texel is the mean radiance over its solid angle, so that sums of radiance times solid angle over the map are those over the sky. It is taken
//! over 4x4 directions, each between the four nearest texels of a face. A face has half as many texels a side as the panorama has columns:
//! 1.6 of them to one of the panorama in its middle, 3 or 5 in its corners, where the samples still overlap. With a margin of a
//! texel a face never has to ask its neighbour.

use std::f32::consts::{PI, TAU};

use glam::{Vec2, Vec3};
use half::f16;
use rayon::prelude::*;
use welkin_pack::mapping::{angles_from_direction, direction_from_angles};
use welkin_runtime::Camera;

use super::cube::{FACES, direction_to_face, face_to_direction};
use super::faces::Face;
use crate::frame::{Frame, Pixels};

/// Columns that a panorama may have; an even number.
pub const WIDTHS: [u32; 2] = [32, 8192];

/// Directions a texel, along each axis.
const SAMPLES: u32 = 4;

/// Texels of a face beyond its sides: as far as a bilinear sample on the edge reaches.
const MARGIN: u32 = 1;

/// A direction, of length 1, to u and v, 0..1 each; `azimuth_rad` is what is in the middle.
pub fn direction_to_equirect(direction: [f32; 3], azimuth_rad: f32) -> [f32; 2] {
    let (azimuth, elevation) = angles_from_direction(direction);
    let u = 0.5 + (azimuth - azimuth_rad) / TAU;
    [u - u.floor(), 0.5 - elevation / PI]
}

/// The inverse of [`direction_to_equirect`]: a unit direction.
pub fn equirect_to_direction([u, v]: [f32; 2], azimuth_rad: f32) -> [f32; 3] {
    direction_from_angles(azimuth_rad + (u - 0.5) * TAU, (0.5 - v) * PI)
}

/// A panorama in the making: sums of radiance over the samples of each texel, times the cosine of their elevation.
#[derive(Clone, Debug)]
pub struct Map {
    width: u32,
    /// Of each column of samples, its direction on the horizon: x east, y south.
    columns: Vec<Vec2>,
    /// Of each row of samples: x cosine, y sine of its elevation.
    rows: Vec<Vec2>,
    sums: Vec<[f32; 3]>,
}

/// Draws a panorama of `width` by `width / 2` texels from where `viewer` stands. `draw` gives what a camera sees.
///
/// # Errors
/// Those of `draw`.
pub fn draw<E>(
    viewer: &Camera,
    width: u32,
    azimuth_rad: f32,
    mut draw: impl FnMut(&Camera) -> Result<Vec<[f16; 4]>, E>,
) -> Result<Map, E> {
    let mut map = Map::new(width, azimuth_rad);
    let side = (width / 2).max(1);
    for number in 0..FACES.len() {
        let face = Face::draw(number, [side, MARGIN], viewer, &mut draw)?;
        map.add(number, &face);
    }
    Ok(map)
}

impl Map {
    fn new(width: u32, azimuth_rad: f32) -> Map {
        let places = |count: u32| {
            let samples = count * SAMPLES;
            (0..samples).map(move |i| (i as f32 + 0.5) / samples as f32)
        };
        let on_horizon = |u| {
            let [east, _, south] = equirect_to_direction([u, 0.5], azimuth_rad);
            Vec2::new(east, south)
        };
        let towards_north = |v| {
            let [_, up, south] = equirect_to_direction([0.5, v], 0.0);
            Vec2::new(-south, up)
        };
        Map {
            width,
            columns: places(width).map(on_horizon).collect(),
            rows: places(width / 2).map(towards_north).collect(),
            sums: vec![[0.0; 3]; width as usize * (width / 2) as usize],
        }
    }

    /// Adds the samples that lie on a face.
    fn add(&mut self, number: usize, face: &Face) {
        let forward = Vec3::from(face_to_direction(number, [0.5, 0.5]));
        // No direction of a face is further from its middle than a corner; the samples of a texel are less than its diagonal apart.
        let diagonal = TAU / self.width as f32 * std::f32::consts::SQRT_2;
        let nearest = 1.0 / 3.0_f32.sqrt() - diagonal;
        let (columns, rows) = (&self.columns, &self.rows);
        let sums = self.sums.par_chunks_exact_mut(self.width as usize);
        let samples = SAMPLES as usize;
        sums.zip(rows.par_chunks_exact(samples))
            .for_each(|(sums, rows)| {
                for (sum, columns) in sums.iter_mut().zip(columns.chunks_exact(samples)) {
                    if direction(columns[0], rows[0]).dot(forward) < nearest {
                        continue;
                    }
                    for &row in rows {
                        for &column in columns {
                            let (found, st) = direction_to_face(direction(column, row).to_array());
                            if found == number {
                                for (sum, value) in sum.iter_mut().zip(face.bilinear(st)) {
                                    // By the cosine of the elevation, which a solid angle goes by.
                                    *sum += row.x * value;
                                }
                            }
                        }
                    }
                }
            });
    }

    /// The panorama: every texel its mean.
    pub fn frame(&self) -> Frame {
        let (width, height) = (self.width, self.width / 2);
        let weights = self.rows.chunks_exact(SAMPLES as usize);
        let weights =
            weights.map(|rows| SAMPLES as f32 * rows.iter().map(|row| row.x).sum::<f32>());
        let rows = self.sums.chunks_exact(width as usize).zip(weights);
        let pixels = rows.flat_map(|(row, weight)| {
            row.iter().map(move |sum| {
                let [r, g, b] = sum.map(|c| f16::from_f32(c / weight));
                [r, g, b, f16::ONE]
            })
        });
        Frame {
            width,
            height,
            pixels: Pixels::Linear(pixels.collect()),
        }
    }
}

/// A direction from that of its column on the horizon (x east, y south) and that of its row (x along the horizon, y up).
fn direction(column: Vec2, row: Vec2) -> Vec3 {
    Vec3::new(row.x * column.x, row.y, row.x * column.y)
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::super::faces::tests::{analytic, smooth};
    use super::*;

    const WIDTH: u32 = 128;

    fn map_of(azimuth_rad: f32, sky: impl Fn(Vec3) -> [f32; 3]) -> Vec<[f32; 3]> {
        let viewer = Camera::looking(0.0, 0.0, 1.0, [1, 1]);
        let map = draw(&viewer, WIDTH, azimuth_rad, analytic(sky)).unwrap();
        match map.frame().pixels {
            Pixels::Linear(pixels) => pixels
                .iter()
                .map(|&[r, g, b, _]| [r, g, b].map(f16::to_f32))
                .collect(),
            other => panic!("{other:?}"),
        }
    }

    proptest! {
        #[test]
        fn panorama_and_back(u in 0.001_f32..0.999, v in 0.01_f32..0.99, azimuth in -7.0_f32..7.0) {
            let [back_u, back_v] = direction_to_equirect(equirect_to_direction([u, v], azimuth), azimuth);
            // Angles of up to 10 radians have steps of 1e-6; arc sines lose digits next to the poles.
            prop_assert!((back_u - u).abs() < 1e-5 && (back_v - v).abs() < 1e-4);
        }

        #[test]
        fn directions_and_back(azimuth in 0.0_f32..TAU, elevation in -1.5_f32..1.5, middle in -7.0_f32..7.0) {
            let direction = Vec3::from(direction_from_angles(azimuth, elevation));
            let uv = direction_to_equirect(direction.to_array(), middle);
            prop_assert!(uv.iter().all(|c| (0.0..=1.0).contains(c)));
            let back = Vec3::from(equirect_to_direction(uv, middle));
            prop_assert!(back.abs_diff_eq(direction, 5e-4));
        }
    }

    #[test]
    fn north_is_in_the_middle_east_to_the_right_and_the_zenith_above() {
        let (east, up, north) = (Vec3::X, Vec3::Y, Vec3::NEG_Z);
        for (direction, wanted) in [
            (north, [0.5, 0.5]),
            (east, [0.75, 0.5]),
            (-east, [0.25, 0.5]),
        ] {
            assert_eq!(direction_to_equirect(direction.to_array(), 0.0), wanted);
        }
        assert_eq!(direction_to_equirect(up.to_array(), 0.0)[1], 0.0);
        assert_eq!(direction_to_equirect((-up).to_array(), 0.0)[1], 1.0);
        // Rounding may put the south, where the sides meet, on either.
        let u = direction_to_equirect((-north).to_array(), 0.0)[0];
        assert!(!(0.001..0.999).contains(&u));
        let turned = direction_to_equirect(east.to_array(), 0.5 * PI);
        assert!((turned[0] - 0.5).abs() < 1e-6);
    }

    /// The mean of unit directions over the solid angle of a texel, by the integrals of their three coordinates.
    fn mean_direction(index: usize, azimuth_rad: f32) -> Vec3 {
        let (x, y) = (index as u32 % WIDTH, index as u32 / WIDTH);
        let azimuth = |x: u32| azimuth_rad + (x as f32 / WIDTH as f32 - 0.5) * TAU;
        let elevation = |y: u32| (0.5 - y as f32 / (WIDTH / 2) as f32) * PI;
        let (left, right, high, low) = (azimuth(x), azimuth(x + 1), elevation(y), elevation(y + 1));
        let square = |e: f32| 0.5 * (e + e.sin() * e.cos());
        let flat = (square(high) - square(low)) / (high.sin() - low.sin());
        let east = (left.cos() - right.cos()) / (right - left);
        let north = (right.sin() - left.sin()) / (right - left);
        Vec3::new(flat * east, 0.5 * (high.sin() + low.sin()), -flat * north)
    }

    #[test]
    fn every_texel_is_the_mean_of_its_part_of_the_sky_across_all_faces() {
        for azimuth in [0.0, 1.0, -2.5] {
            for (index, found) in map_of(azimuth, smooth).iter().enumerate() {
                let wanted = smooth(mean_direction(index, azimuth));
                for (found, wanted) in found.iter().zip(wanted) {
                    // Next to a pole four samples put the mean 0.0104 of a texel, pi / 64 wide, too near: half of that is 3e-4 here. A chord of a
                    // face's texel, 2 / 64, is up to 1e-4 below half its arc. Two half floats round by 2^-12 each.
                    assert!((found - wanted).abs() < 4e-4 + 1.0 / 2048.0, "{index}");
                }
            }
        }
    }

    #[test]
    fn light_over_the_map_is_light_over_the_sky() {
        // The mean of max(0, cos) to the zenith, about the sphere, is 1/4; of a constant, the constant.
        let map = map_of(0.0, |d| [d.y.max(0.0), 1.0, d.x.max(0.0)]);
        let height = (WIDTH / 2) as usize;
        let mut means = [0.0_f64; 3];
        for (index, texel) in map.iter().enumerate() {
            let edge =
                |row: usize| (f64::from(row as u32) / height as f64 * std::f64::consts::PI).cos();
            let row = index / WIDTH as usize;
            let share = 0.5 * (edge(row) - edge(row + 1)) / f64::from(WIDTH);
            for (mean, value) in means.iter_mut().zip(texel) {
                *mean += share * f64::from(*value);
            }
        }
        for (mean, wanted) in means.iter().zip([0.25, 1.0, 0.25]) {
            // Roundings of half floats are 2^-12 of a value at most; the kink of the second one is met by samples a quarter of a texel apart.
            assert!((mean / wanted - 1.0).abs() < 1e-3, "{means:?}");
        }
    }
}
