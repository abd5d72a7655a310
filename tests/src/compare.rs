//! Comparing two pictures, and showing where they differ.

use std::path::PathBuf;

use glam::Vec3;

/// How far two pictures are apart.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Difference {
    /// Largest difference of a channel, over its own allowance (1 is just allowed).
    pub worst: f32,
    /// Index of the pixel with the largest difference.
    pub pixel: usize,
    /// Mean difference of a channel.
    pub mean: f32,
}

/// Compares pixel by pixel; `allowed` gives the allowance for an expected value.
///
/// What is not finite in `actual` differs infinitely.
pub fn difference(expected: &[Vec3], actual: &[Vec3], allowed: impl Fn(f32) -> f32) -> Difference {
    assert_eq!(expected.len(), actual.len(), "pictures of one size");
    let (mut worst, mut pixel, mut sum) = (0.0_f32, 0, 0.0_f64);
    for (index, (e, a)) in expected.iter().zip(actual).enumerate() {
        for (e, a) in e.to_array().into_iter().zip(a.to_array()) {
            let apart = if a.is_finite() {
                (e - a).abs()
            } else {
                f32::INFINITY
            };
            sum += f64::from(apart);
            if apart / allowed(e) > worst {
                (worst, pixel) = (apart / allowed(e), index);
            }
        }
    }
    Difference {
        worst,
        pixel,
        mean: (sum / (3.0 * expected.len() as f64)) as f32,
    }
}

/// Compares pictures in units of what each pixel may differ by: 1 is just allowed.
pub fn in_bounds([expected, actual]: [&[Vec3]; 2], bounds: &[Vec3]) -> Difference {
    let scaled = |picture: &[Vec3]| -> Vec<Vec3> {
        picture.iter().zip(bounds).map(|(p, b)| *p / *b).collect()
    };
    difference(&scaled(expected), &scaled(actual), |_| 1.0)
}

/// Writes expected | difference times 16 | actual as a PNG into target/, and gives its path.
///
/// # Panics
/// If it cannot be written.
pub fn save(name: &str, expected: &[Vec3], actual: &[Vec3], size: [u32; 2]) -> PathBuf {
    let [width, height] = size;
    let byte = |x: f32| (x.clamp(0.0, 1.0) * 255.0 + 0.5) as u8;
    let picture = image::RgbImage::from_fn(width * 3, height, |x, y| {
        let index = (y * width + x % width) as usize;
        let (e, a) = (expected[index], actual[index]);
        let shown = [e, (e - a).abs() * 16.0, a][(x / width) as usize];
        image::Rgb(shown.to_array().map(byte))
    });
    let path = PathBuf::from(concat!(env!("CARGO_MANIFEST_DIR"), "/../target"))
        .join(format!("{name}.png"));
    picture.save(&path).expect("the comparison is written");
    path
}
