use glam::DVec3;
use half::f16;
use welkin_runtime::Camera;

use super::super::cube::texel_direction;
use super::super::cubemap::tests::texels;
use super::super::equirect::{self, equirect_to_direction};
use super::super::faces::tests::{analytic, smooth};
use super::*;
use crate::frame::Pixels;

/// A panorama of a function of the direction, at the centre of each texel.
fn at_centres(width: u32, azimuth_rad: f32, sky: impl Fn(Vec3) -> [f32; 3]) -> Image {
    let mut image = Image::new(width, width / 2, 3);
    for (x, y) in (0..width / 2).flat_map(|y| (0..width).map(move |x| (x, y))) {
        let uv = [x as f32 + 0.5, 2.0 * (y as f32 + 0.5)].map(|c| c / width as f32);
        let direction = Vec3::from(equirect_to_direction(uv, azimuth_rad));
        image.texel_mut(x, y).copy_from_slice(&sky(direction));
    }
    image
}

#[test]
fn every_texel_is_the_panorama_in_its_direction() {
    // Made smaller twice, once, and not at all; with an odd number of rows too.
    for width in [1024, 512, 256, 202] {
        for azimuth in [0.0, 1.0, -2.5] {
            let map = cubemap(&at_centres(width, azimuth, smooth), 16, azimuth);
            for (face, image) in map.faces.iter().enumerate() {
                for (x, y) in (0..16).flat_map(|y| (0..16).map(move |x| (x, y))) {
                    let wanted = smooth(texel_direction(face, [x, y], 16));
                    for (found, wanted) in image.texel(x, y).iter().zip(wanted) {
                        // A mean over 2/16 is off by the square of that over 24, half of it here, and one over four texels of the panorama by
                        // a tenth of that; beside a pole its rows end half of 1/101 of π before.
                        assert!((found - wanted).abs() < 1.5e-3, "{width} {face} {x} {y}");
                    }
                }
            }
        }
    }
}

#[test]
fn what_we_draw_as_a_panorama_is_the_cube_map_that_we_draw() {
    let viewer = Camera::looking(0.0, 0.0, 1.0, [1, 1]);
    let drawn = equirect::draw(&viewer, 512, 0.7, analytic(smooth)).unwrap();
    let Pixels::Linear(pixels) = drawn.frame().pixels else {
        panic!("radiance")
    };
    let rgb = pixels.iter().flat_map(|p| [p[0], p[1], p[2]]);
    let panorama = Image {
        width: 512,
        height: 256,
        channels: 3,
        texels: rgb.map(f16::to_f32).collect(),
    };
    let cube = super::super::cubemap::draw(&viewer, 32, analytic(smooth)).unwrap();
    let found = cubemap(&panorama, 32, 0.7);
    for (found, wanted) in found.faces.iter().zip(&cube.faces) {
        for (found, wanted) in found.texels.iter().zip(&wanted.texels) {
            // Means over texels of 1/16 and 1/81, of samples here and there, and two half floats.
            assert!((found - wanted).abs() < 6e-4 + 1.0 / 2048.0);
        }
    }
}

fn light(map: &Cubemap) -> DVec3 {
    texels(map)
        .map(|(_, angle, radiance)| angle * radiance)
        .sum()
}

#[test]
fn a_bright_texel_keeps_its_light_wherever_it_is() {
    // Smaller than the faces' texels, and larger: made smaller, and not.
    for (width, side) in [(512, 16), (256, 32), (128, 64)] {
        for (x, y) in [
            (width / 2, width / 4),
            (3, width / 8),
            (width - 1, width / 5),
            (width / 3, width / 3),
        ] {
            let mut panorama = Image::new(width, width / 2, 3);
            panorama.texel_mut(x, y).fill(5e5);
            let edge =
                |y: u32| (std::f64::consts::PI * (0.5 - f64::from(2 * y) / f64::from(width))).sin();
            let angle = (edge(y) - edge(y + 1)) * std::f64::consts::TAU / f64::from(width);
            let found = light(&cubemap(&panorama, side, 0.3)).x;
            // What `SAMPLES_A_TEXEL` says at the horizon. At 60 degrees columns are half as wide, and half as many directions meet one: four times that,
            // for one of two axes.
            assert!(
                (found / (5e5 * angle) - 1.0).abs() < 0.05,
                "{width} {x} {y}: {found}"
            );
        }
    }
}

#[test]
fn a_sun_keeps_its_light_at_any_height() {
    for elevation in [0.0_f32, 40.0, 75.0, 88.0, 90.0] {
        let (sine, cosine) = elevation.to_radians().sin_cos();
        let sun = Vec3::new(cosine * 0.6, sine, -cosine * 0.8);
        // A disc of the sun's size, with an edge as wide as the texels of the panorama, 0.18 degrees.
        let panorama = at_centres(2048, 0.0, |d| {
            let degrees = d.distance(sun).to_degrees();
            [4e4 * ((0.36 - degrees) / 0.18).clamp(0.0, 1.0); 3]
        });
        let pixels = panorama.texels.chunks_exact(3).zip(0_u32..);
        let sum = pixels.map(|(texel, i)| {
            let edge = |y: u32| (std::f64::consts::PI * (0.5 - f64::from(y) / 1024.0)).sin();
            let y = i / 2048;
            f64::from(texel[0]) * (edge(y) - edge(y + 1)) * std::f64::consts::TAU / 2048.0
        });
        let wanted: f64 = sum.sum();
        let found = light(&cubemap(&panorama, 64, 0.0)).x;
        // What `SAMPLES_A_TEXEL` says; and a row about a pole counts 13/12 of its area.
        let pole = if elevation == 90.0 { 1.0 / 12.0 } else { 0.0 };
        let off = (found / wanted - 1.0 - pole).abs();
        assert!(off < 0.02, "{elevation}: {found} {wanted}");
    }
}
