//! The cube map: six faces, and the KTX2 file that holds them.
//!
//! Faces are in the order of [`FACES`], each a square of texels whose centres are at `(i + 0.5) / side`, from the upper left corner, as
//! KTX2 has cube maps: orientation `rd`, rows down and columns to the right.
//!
//! # Practice
//! A texel is the mean of 2x2 that are drawn. Levels down to one texel are means of 2x2 texels of a face each; they are for
//! minification. Those for reflections of rough surfaces are in [`prefilter`](super::prefilter).

use half::f16;
use welkin_pack::texture::encode;
use welkin_pack::{Format, Image, PackError, Shape, Texture, ktx};
use welkin_runtime::Camera;

use super::cube::FACES;
use super::faces::Face;
use crate::frame::{Frame, Pixels};

/// Texels a side that a face may have; a power of two, as some programs want it and levels need it.
pub const SIDES: [u32; 2] = [16, 2048];

/// Texels that are drawn for one, along each axis.
const SAMPLES: u32 = 2;

/// A sky on the six faces of a cube: linear radiance, BT.709.
#[derive(Clone, Debug, PartialEq)]
pub struct Cubemap {
    /// Texels a side of a face.
    pub side: u32,
    /// The faces, in the order of [`FACES`], rows from the top, three channels.
    pub faces: Vec<Image>,
}

/// Draws a cube map from where `viewer` stands. `draw` gives what a camera sees.
///
/// # Errors
/// Those of `draw`.
pub fn draw<E>(
    viewer: &Camera,
    side: u32,
    mut draw: impl FnMut(&Camera) -> Result<Vec<[f16; 4]>, E>,
) -> Result<Cubemap, E> {
    let mut face = |number| -> Result<Image, E> {
        let drawn = Face::draw(number, [side * SAMPLES, 0], viewer, &mut draw)?;
        let image = Image {
            width: side * SAMPLES,
            height: side * SAMPLES,
            channels: 3,
            texels: drawn.texels.into_flattened(),
        };
        Ok(halved(&image))
    };
    let faces = (0..FACES.len()).map(&mut face);
    Ok(Cubemap {
        side,
        faces: faces.collect::<Result<_, E>>()?,
    })
}

impl Cubemap {
    /// A face as a picture.
    ///
    /// # Panics
    /// If there is no such face.
    pub fn frame(&self, face: usize) -> Frame {
        let texels = self.faces[face].texels.chunks_exact(3);
        let pixels = texels.map(|t| [t[0], t[1], t[2], 1.0].map(f16::from_f32));
        Frame {
            width: self.side,
            height: self.side,
            pixels: Pixels::Linear(pixels.collect()),
        }
    }

    /// The cube map as a texture of RGBA half floats with all its levels; alpha is 1.
    pub fn texture(&self) -> Texture {
        let mut levels = vec![halves(&self.faces, 1.0)];
        let mut faces: Vec<Image> = self.faces.iter().map(halved).collect();
        for _ in 1..Texture::full_level_count(self.side, self.side) {
            levels.push(halves(&faces, 1.0));
            faces = faces.iter().map(halved).collect();
        }
        Texture {
            format: Format::Rgba16Float,
            shape: Shape::Cube,
            width: self.side,
            height: self.side,
            layers: FACES.len() as u32,
            levels,
        }
    }

    /// The bytes of a KTX2 file, compressed with Zstandard. `file` names it in errors.
    ///
    /// # Errors
    /// [`PackError::Value`] if a level cannot be compressed.
    pub fn ktx2(&self, file: &str) -> Result<Vec<u8>, PackError> {
        let writer = concat!("welkin-view ", env!("CARGO_PKG_VERSION"));
        ktx::encode(file, &self.texture(), writer)
    }
}

/// The faces of a level as half floats, one after another, divided by `scale`.
pub(super) fn halves(faces: &[Image], scale: f32) -> Vec<u8> {
    let of = |face: &Image| {
        let texels = face.texels.chunks_exact(3);
        let texels = texels.flat_map(|t| [t[0] / scale, t[1] / scale, t[2] / scale, 1.0]);
        let opaque: Vec<f32> = texels.collect();
        encode(Format::Rgba16Float, &opaque)
    };
    faces.iter().flat_map(of).collect()
}

/// The means of 2x2 texels. The side is even, or 1: then nothing is left.
fn halved(image: &Image) -> Image {
    let side = image.width / 2;
    let mut half = Image::new(side, side, image.channels);
    for (x, y) in (0..side).flat_map(|y| (0..side).map(move |x| (x, y))) {
        let four = [[0, 0], [1, 0], [0, 1], [1, 1]].map(|[i, j]| image.texel(2 * x + i, 2 * y + j));
        for (channel, value) in half.texel_mut(x, y).iter_mut().enumerate() {
            *value = 0.25 * four.iter().map(|texel| texel[channel]).sum::<f32>();
        }
    }
    half
}

#[cfg(test)]
pub(crate) mod tests {
    use glam::{DVec3, Vec3};

    use super::super::cube;
    use super::super::faces::tests::{analytic, smooth};
    use super::*;

    const SIDE: u32 = 32;

    fn cubemap(sky: impl Fn(Vec3) -> [f32; 3]) -> Cubemap {
        let viewer = Camera::looking(0.0, 0.0, 1.0, [1, 1]);
        draw(&viewer, SIDE, analytic(sky)).unwrap()
    }

    /// A sky that is a function of the direction alone, at the centre of each texel.
    pub fn at_centres(side: u32, sky: impl Fn(Vec3) -> [f32; 3]) -> Cubemap {
        let face = |face: usize| {
            let mut image = Image::new(side, side, 3);
            for (x, y) in (0..side).flat_map(|y| (0..side).map(move |x| (x, y))) {
                let radiance = sky(cube::texel_direction(face, [x, y], side));
                image.texel_mut(x, y).copy_from_slice(&radiance);
            }
            image
        };
        Cubemap {
            side,
            faces: (0..6).map(face).collect(),
        }
    }

    /// Direction, solid angle and radiance of every texel.
    pub fn texels(map: &Cubemap) -> impl Iterator<Item = (DVec3, f64, DVec3)> {
        let places = (0..6).flat_map(|face| (0..map.side * map.side).map(move |i| (face, i)));
        places.map(|(face, i)| {
            let at = [i % map.side, i / map.side];
            let radiance = Vec3::from_slice(map.faces[face].texel(at[0], at[1]));
            (
                cube::texel_direction(face, at, map.side)
                    .as_dvec3()
                    .normalize(),
                cube::texel_solid_angle(at, map.side),
                radiance.as_dvec3(),
            )
        })
    }

    /// A sky with a gradient, grain of a texel, and a sun of one texel or none.
    pub fn rough_sky(side: u32, sun: f32) -> Cubemap {
        let mut map = at_centres(side, |d| {
            let grain = (d.x * 9123.7 + d.y * 4177.3 + d.z * 7919.1).sin().abs();
            let up = 0.5 + 0.5 * d.y;
            [0.2 + grain * up, 0.3 + 0.5 * grain, 1.0 - 0.5 * up]
        });
        if sun > 0.0 {
            let [x, y] = [side / 3, side / 4];
            map.faces[4].texel_mut(x, y).fill(sun);
        }
        map
    }

    /// Directions on all sides, none of them an axis: a spiral of R. Swinbank, R. J. Purser, "Fibonacci grids", QJRMS 132, 2006.
    pub fn directions(count: u32) -> impl Iterator<Item = DVec3> {
        (0..count).map(move |i| {
            let y: f64 = 1.0 - (2.0 * f64::from(i) + 1.0) / f64::from(count);
            let azimuth = f64::from(i) * 2.399_963_229_728_653;
            let flat = (1.0 - y * y).sqrt();
            DVec3::new(flat * azimuth.cos(), y, flat * azimuth.sin())
        })
    }

    fn centre(face: usize, x: u32, y: u32) -> Vec3 {
        let st = [x, y].map(|i| (i as f32 + 0.5) / SIDE as f32);
        Vec3::from(cube::face_to_direction(face, st))
    }

    #[test]
    fn every_texel_is_the_sky_of_its_direction() {
        let map = cubemap(smooth);
        for (face, image) in map.faces.iter().enumerate() {
            for (x, y) in (0..SIDE).flat_map(|y| (0..SIDE).map(move |x| (x, y))) {
                let wanted = smooth(centre(face, x, y));
                for (found, wanted) in image.texel(x, y).iter().zip(wanted) {
                    // Samples a quarter of a texel of 1/16 from its centre, on a unit direction, half of it: its mean is off by the
                    // square of that; half floats round.
                    assert!((found - wanted).abs() < 3e-4 + 0.5 / 2048.0);
                }
            }
        }
    }

    #[test]
    fn the_texture_holds_the_faces_one_after_another_at_every_level() {
        // A colour for each face, so that means of it stay what they are.
        let colour = |face: usize| [face as f32, 10.0 + face as f32, 0.25];
        let map = cubemap(|d| colour(cube::direction_to_face(d.to_array()).0));
        let texture = map.texture();
        assert_eq!(
            (texture.shape, texture.layers, texture.format),
            (Shape::Cube, 6, Format::Rgba16Float)
        );
        assert_eq!(texture.levels.len(), 6);
        for level in 0..texture.levels.len() {
            assert_eq!(texture.levels[level].len(), texture.level_bytes(level));
            for face in 0..6 {
                let [r, g, b] = colour(face);
                let image = texture.image(level, face as u32);
                assert!(image.texels.chunks_exact(4).all(|t| t == [r, g, b, 1.0]));
            }
        }
    }

    #[test]
    fn ktx2_gives_back_the_texture() {
        let map = cubemap(smooth);
        let bytes = map.ktx2("sky.ktx2").unwrap();
        assert_eq!(ktx::decode("sky.ktx2", &bytes).unwrap(), map.texture());
    }
}
