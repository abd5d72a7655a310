//! The skybox: a picture of a whole sky, on the six faces of a cube.
//!
//! # Theory
//! A panorama holds azimuth along its rows and elevation along its columns (the equirectangular projection,
//! also called plate carree). A cube is denser where the panorama is thin and has no poles: N. Greene,
//! "Environment Mapping and Other Applications of World Projections", IEEE CG&A 6(11), 1986.
//!
//! # Practice
//! A texel of a face is the mean of a square grid of bilinear samples, spaced by no more than a texel of the
//! picture, over the texel's area on the face: every texel of the picture counts, none counts much more than
//! another. Radiance is filtered times its cover, so that what is not covered leaves no dark rim, and stored
//! so: `radiance * (1 - cover) + stored` lays it over a sky. Beyond a pole a panorama goes on at the opposite
//! azimuth, and faces go on where they meet, so that there is neither a pinch nor a seam. What is brighter than a half
//! float is cut last, after the gain, and told (`skybox/clip.rs`).

mod clip;

use std::f32::consts::{PI, TAU};

use rayon::prelude::*;
use welkin_pack::Image;
use welkin_pack::format::CUBE_FACES;
use welkin_pack::mapping::{cube_texel, cube_to_direction, direction_to_cube};

use crate::error::{BakeError, unfit_size};
use crate::inputs::{Named, Picture, Reader};
use crate::load::{self, MAX_FILE_BYTES};
use crate::notice::Clipped;
use crate::settings::{SkyboxPicture, SkyboxSettings};

/// Sides that a picture of a face may have, in texels: no more than a pack's faces have.
const FACE_SIDE: [u32; 2] = [16, 2048];

/// Rows that a panorama may have.
const PANORAMA_ROWS: [u32; 2] = [32, 4096];

/// Sides of a pack's faces; the larger end only if the recipe asks for it.
const SMALLEST: u32 = 16;
const LARGEST_BY_ITSELF: u32 = 512;

/// The files that the settings name, in the order of the faces.
pub(crate) fn files(settings: &SkyboxSettings) -> Vec<Named> {
    match &settings.picture {
        SkyboxPicture::Panorama { file, .. } => vec![panorama_file(file)],
        SkyboxPicture::Faces(files) => face_files(files),
    }
}

fn panorama_file(file: &str) -> Named {
    Named::new("skybox.file", file, MAX_FILE_BYTES)
}

fn face_files(files: &[String; 6]) -> Vec<Named> {
    let named = CUBE_FACES.iter().zip(files);
    named
        .map(|(face, file)| Named::new(format!("skybox.faces.{face}"), file, MAX_FILE_BYTES))
        .collect()
}

/// The six faces in the order of the cube: radiance times cover (red, green, blue) and cover; and what was cut of their
/// light, if anything was. `proceed` is asked before each, since a large picture takes seconds.
pub(crate) fn images(
    settings: &SkyboxSettings,
    reader: &Reader,
    proceed: &dyn Fn() -> Result<(), BakeError>,
) -> Result<(Vec<Image>, Option<Clipped>), BakeError> {
    let mut scene = match &settings.picture {
        SkyboxPicture::Panorama { file, azimuth_rad } => {
            panorama(&reader.read(&panorama_file(file))?, *azimuth_rad)?
        }
        SkyboxPicture::Faces(files) => faces(&face_files(files), reader)?,
    };
    let infinite = scene.pictures().iter_mut().map(clip::tame).sum();
    let size = settings.size.unwrap_or_else(|| scene.face_size());
    // In the middle of a face, where its texels are largest.
    let ratio = scene.texels_a_radian() * 2.0 / size as f32;
    let taps = libm::ceilf(ratio) as u32;
    let face = |face| {
        proceed()?;
        Ok(resample(&scene, face, size, taps.max(1), settings.gain))
    };
    let faces = (0..CUBE_FACES.len() as u32).map(face);
    let mut faces = faces.collect::<Result<Vec<Image>, BakeError>>()?;
    let clipped = clip::cut(&mut faces, settings.gain, infinite);
    Ok((faces, clipped))
}

/// What is around the viewer.
enum Scene {
    /// Equirectangular: column 0 is half a turn left of `azimuth_rad`, row 0 is up.
    Panorama { picture: Image, azimuth_rad: f32 },
    /// As a cube texture has them.
    Faces(Vec<Image>),
}

fn panorama(picture: &Picture, azimuth_rad: f32) -> Result<Scene, BakeError> {
    let [least, most] = PANORAMA_ROWS;
    let decoded = load::decode_sky(picture, &|width, height| {
        if width == 2 * height && (least..=most).contains(&height) {
            return Ok(());
        }
        let expected = format!(
            "a panorama twice as wide as high, of {least} to {most} rows; crop or resize it, or give `faces`"
        );
        Err(unfit_size(&picture.file, [width, height], expected))
    })?;
    Ok(Scene::Panorama {
        picture: decoded,
        azimuth_rad,
    })
}

fn faces(files: &[Named], reader: &Reader) -> Result<Scene, BakeError> {
    let mut faces: Vec<Image> = Vec::new();
    for (named, face) in files.iter().zip(CUBE_FACES) {
        let picture = reader.read(named)?;
        let [least, most] = FACE_SIDE;
        let first = faces.first().map(|face| face.width);
        let mut decoded = load::decode_sky(&picture, &|width, height| {
            let fits = (least..=most).contains(&width) && first.is_none_or(|side| side == width);
            if width == height && fits {
                return Ok(());
            }
            let expected = match first {
                Some(side) => format!("{side}x{side}, as `{}`", files[0].key),
                None => format!("a square of {least} to {most} texels a side"),
            };
            let expected = format!("{expected}; crop or resize it");
            Err(unfit_size(&picture.file, [width, height], expected))
        })?;
        turn(&mut decoded, face);
        faces.push(decoded);
    }
    Ok(Scene::Faces(faces))
}

/// A face as a viewer in the middle sees it becomes its mirror image, as cube textures have it: those around
/// the horizon from side to side; up and down, whose lower and upper edge is north, from top to bottom.
fn turn(image: &mut Image, face: &str) {
    let row = image.width as usize * image.channels;
    if matches!(face, "up" | "down") {
        let rows: Vec<&[f32]> = image.texels.chunks_exact(row).rev().collect();
        image.texels = rows.concat();
    } else {
        for row in image.texels.chunks_exact_mut(row) {
            let texels: Vec<&[f32]> = row.chunks_exact(image.channels).rev().collect();
            let mirrored = texels.concat();
            row.copy_from_slice(&mirrored);
        }
    }
}

impl Scene {
    fn pictures(&mut self) -> &mut [Image] {
        match self {
            Scene::Panorama { picture, .. } => std::slice::from_mut(picture),
            Scene::Faces(faces) => faces,
        }
    }

    /// Texels of a face that show as much as the picture does.
    fn face_size(&self) -> u32 {
        let side = match self {
            Scene::Panorama { picture, .. } => picture.width / 4,
            Scene::Faces(faces) => faces[0].width,
        };
        let up = side.next_power_of_two();
        let nearest = if 4 * side < 3 * up { up / 2 } else { up };
        nearest.clamp(SMALLEST, LARGEST_BY_ITSELF)
    }

    /// Texels of the picture a radian, where it has the most.
    fn texels_a_radian(&self) -> f32 {
        match self {
            Scene::Panorama { picture, .. } => picture.height as f32 / PI,
            Scene::Faces(faces) => faces[0].width as f32 / 2.0,
        }
    }

    /// A bilinear sample along a unit direction.
    fn sample(&self, direction: [f32; 3]) -> [f32; 4] {
        match self {
            Scene::Panorama {
                picture,
                azimuth_rad,
            } => {
                let [x, y, z] = direction;
                let turn = (libm::atan2f(x, -z) - azimuth_rad) / TAU + 0.5;
                let down = 0.5 - libm::atan2f(y, libm::sqrtf(x * x + z * z)) / PI;
                let place = [
                    turn * picture.width as f32 - 0.5,
                    down * picture.height as f32 - 0.5,
                ];
                bilinear(place, |texel| panorama_texel(picture, texel))
            }
            Scene::Faces(faces) => {
                let (face, st) = direction_to_cube(direction);
                let size = faces[0].width;
                bilinear(st.map(|c| c * size as f32 - 0.5), |texel| {
                    let (face, [x, y]) = cube_texel(face, texel, size);
                    four(faces[face as usize].texel(x, y))
                })
            }
        }
    }
}

/// A texel of a panorama: rows beyond a pole come down on the other side.
fn panorama_texel(picture: &Image, [x, y]: [i32; 2]) -> [f32; 4] {
    let (width, height) = (picture.width as i32, picture.height as i32);
    let (x, y) = if y < 0 {
        (x + width / 2, -1 - y)
    } else if y >= height {
        (x + width / 2, 2 * height - 1 - y)
    } else {
        (x, y)
    };
    four(picture.texel(x.rem_euclid(width) as u32, y as u32))
}

fn four(texel: &[f32]) -> [f32; 4] {
    [texel[0], texel[1], texel[2], texel[3]]
}

/// Bilinear weights at a place in texels, whole numbers at their centres.
fn bilinear(place: [f32; 2], texel: impl Fn([i32; 2]) -> [f32; 4]) -> [f32; 4] {
    let [left, top] = place.map(|c| libm::floorf(c) as i32);
    let [right, below] = [place[0] - left as f32, place[1] - top as f32];
    let row = |y: i32| mix(texel([left, y]), texel([left + 1, y]), right);
    mix(row(top), row(top + 1), below)
}

fn mix(a: [f32; 4], b: [f32; 4], share: f32) -> [f32; 4] {
    [0, 1, 2, 3].map(|i| a[i] + (b[i] - a[i]) * share)
}

/// One face: the mean of `taps` x `taps` samples over each texel.
fn resample(scene: &Scene, face: u32, size: u32, taps: u32, gain: f32) -> Image {
    let mut image = Image::new(size, size, 4);
    let rows = image.texels.par_chunks_mut(size as usize * 4);
    rows.enumerate().for_each(|(y, row)| {
        for (x, texel) in row.chunks_exact_mut(4).enumerate() {
            let grid = (0..taps * taps).map(|i| [i % taps, i / taps]);
            for tap in grid {
                let st = [0, 1].map(|axis| {
                    let inside = (tap[axis] as f32 + 0.5) / taps as f32;
                    ([x, y][axis] as f32 + inside) / size as f32
                });
                let sample = scene.sample(cube_to_direction(face, st));
                for (sum, value) in texel.iter_mut().zip(sample) {
                    *sum += value;
                }
            }
            let share = 1.0 / (taps * taps) as f32;
            for (value, factor) in texel.iter_mut().zip([gain, gain, gain, 1.0]) {
                *value *= share * factor;
            }
        }
    });
    image
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_size_of_the_faces_follows_the_picture() {
        let size = |width: u32| {
            let picture = Image::new(width, width / 2, 1);
            Scene::Panorama {
                picture,
                azimuth_rad: 0.0,
            }
            .face_size()
        };
        let expected = [
            (64, 16),
            (512, 128),
            (760, 128),
            (770, 256),
            (1024, 256),
            (8192, 512),
        ];
        for (width, expected) in expected {
            assert_eq!(size(width), expected, "{width}");
        }
    }

    #[test]
    fn a_panorama_goes_on_beyond_its_poles_and_around() {
        let mut picture = Image::new(4, 2, 4);
        for (i, value) in (0..).zip(&mut picture.texels) {
            *value = (i / 4) as f32;
        }
        let at = |x: i32, y: i32| panorama_texel(&picture, [x, y])[0];
        assert_eq!([at(0, 0), at(4, 0), at(-1, 1)], [0.0, 0.0, 7.0]);
        assert_eq!([at(0, -1), at(3, -1), at(1, 2)], [2.0, 1.0, 7.0]);
    }
}
