//! Skyboxes: where the picture comes to lie, what its values become, what is refused.

#![allow(clippy::unwrap_used, reason = "a test may stop where it fails")]

mod formats;
mod recipe;
mod refused;
mod scenes;

use std::path::Path;

use exr::prelude::{
    AnyChannel, AnyChannels, Compression, Encoding, FlatSamples, Image as ExrImage, Layer,
    LayerAttributes, WritableImage,
};
use welkin_baker::{BakeError, SkyboxPicture, SkyboxSettings, skybox_faces};
use welkin_pack::Image;
use welkin_pack::format::CUBE_FACES;
use welkin_pack::mapping::{cube_to_direction, direction_from_angles};

/// A colour and a cover that change smoothly with the direction, all between 0.2 and 2.
fn scene([east, up, south]: [f32; 3]) -> [f32; 4] {
    [
        1.0 + 0.5 * east,
        1.0 + 0.8 * up,
        1.0 + 0.6 * south,
        0.7 + 0.2 * up + 0.1 * east,
    ]
}

/// An equirectangular picture of `scene`, whose middle is north.
fn panorama(width: u32, scene: impl Fn([f32; 3]) -> [f32; 4]) -> Image {
    let height = width / 2;
    let mut image = Image::new(width, height, 4);
    for y in 0..height {
        for x in 0..width {
            let [u, v] = [
                (x as f32 + 0.5) / width as f32,
                (y as f32 + 0.5) / height as f32,
            ];
            let (azimuth, elevation) = (
                std::f32::consts::TAU * (u - 0.5),
                std::f32::consts::PI * (0.5 - v),
            );
            let colour = scene(direction_from_angles(azimuth, elevation));
            image.texel_mut(x, y).copy_from_slice(&colour);
        }
    }
    image
}

/// One channel a name, as an OpenEXR file.
fn exr(image: &Image, names: &[&str], compression: Compression, halves: bool) -> Vec<u8> {
    let size = (image.width as usize, image.height as usize);
    let channel = |(index, name): (usize, &&str)| {
        let values = image.channel(index);
        let samples = if halves {
            FlatSamples::F16(values.map(exr::prelude::f16::from_f32).collect())
        } else {
            FlatSamples::F32(values.collect())
        };
        AnyChannel::new(*name, samples)
    };
    let channels = AnyChannels::sort(names.iter().enumerate().map(channel).collect());
    let encoding = Encoding {
        compression,
        ..Encoding::UNCOMPRESSED
    };
    let layer = Layer::new(size, LayerAttributes::default(), encoding, channels);
    bytes_of(ExrImage::from_layer(layer))
}

fn bytes_of(image: ExrImage<Layer<AnyChannels<FlatSamples>>>) -> Vec<u8> {
    let mut bytes = std::io::Cursor::new(Vec::new());
    image
        .write()
        .non_parallel()
        .to_buffered(&mut bytes)
        .unwrap();
    bytes.into_inner()
}

/// Lossless: what a test compares with.
fn plain_exr(image: &Image) -> Vec<u8> {
    exr(image, &["R", "G", "B", "A"], Compression::ZIP16, false)
}

fn settings(file: &str, size: Option<u32>) -> SkyboxSettings {
    SkyboxSettings {
        picture: SkyboxPicture::Panorama {
            file: file.to_string(),
            azimuth_rad: 0.0,
        },
        size,
        gain: 1.0,
    }
}

/// Bakes the faces of one panorama that is a file `name`.
fn bake(name: &str, bytes: &[u8], size: Option<u32>) -> Result<Vec<Image>, BakeError> {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join(name), bytes).unwrap();
    skybox_faces(&settings(name, size), Some(folder.path()))
}

/// Writes a picture a face and bakes them.
fn bake_faces(
    folder: &Path,
    pictures: &[Vec<u8>; 6],
    size: Option<u32>,
) -> Result<Vec<Image>, BakeError> {
    let names = CUBE_FACES.map(|face| format!("{face}.picture"));
    for (name, bytes) in names.iter().zip(pictures) {
        std::fs::write(folder.join(name), bytes).unwrap();
    }
    let settings = SkyboxSettings {
        picture: SkyboxPicture::Faces(names),
        size,
        gain: 1.0,
    };
    skybox_faces(&settings, Some(folder))
}

/// The largest difference between baked faces and a function of the direction.
fn worst(faces: &[Image], scene: impl Fn([f32; 3]) -> [f32; 4]) -> f32 {
    assert_eq!(faces.len(), 6);
    let mut worst = 0.0_f32;
    for (face, image) in (0..).zip(faces) {
        for (i, texel) in (0..).zip(image.texels.chunks_exact(4)) {
            let place = [i % image.width, i / image.width];
            let st = place.map(|c| (c as f32 + 0.5) / image.width as f32);
            let expected = scene(cube_to_direction(face, st));
            for (value, expected) in texel.iter().zip(expected) {
                worst = worst.max((value - expected).abs());
            }
        }
    }
    worst
}
