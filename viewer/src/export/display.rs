//! Radiance as a picture that a display shows: the runtime's last step on the CPU, for maps that are put together from several frames.
//!
//! The same exposure, tone curve, encoding and dither as [`welkin_runtime::internals::tonemap`], after the means were taken in linear light.

use glam::Vec3;
use half::f16;
use rayon::prelude::*;
use welkin_runtime::SkyParams;
use welkin_runtime::internals::geometry::math::luminance;
use welkin_runtime::internals::tonemap;
use welkin_runtime::params::Tonemap;

use crate::frame::{Frame, Pixels};

/// A frame of radiance, tonemapped and encoded as sRGB as these parameters say. Other frames stay what they are.
pub fn displayed(frame: Frame, params: &SkyParams) -> Frame {
    let Pixels::Linear(pixels) = &frame.pixels else {
        return frame;
    };
    let factor = params.clamped().exposure_factor();
    let places = pixels.iter().enumerate();
    let bytes = places.map(|(index, pixel)| {
        let noise = dither(index as u32 % frame.width, index as u32 / frame.width);
        let light = on_display(*pixel, factor, params.tonemap);
        let steps = tonemap::srgb_encoded(light) * 255.0 + 0.5 + noise;
        let [r, g, b] = steps.to_array().map(|c| c as u8);
        [r, g, b, 255]
    });
    Frame {
        pixels: Pixels::Srgb8(bytes.collect()),
        ..frame
    }
}

/// Luminance of the picture that a frame of radiance becomes, encoded as sRGB, 0..=1, without dither. Of other frames nothing.
pub fn encoded_luminance(frame: &Frame, params: &SkyParams) -> Vec<f32> {
    let Pixels::Linear(pixels) = &frame.pixels else {
        return Vec::new();
    };
    let factor = params.clamped().exposure_factor();
    let of = |pixel: &[f16; 4]| {
        let light = luminance(on_display(*pixel, factor, params.tonemap));
        tonemap::srgb_encoded(Vec3::splat(light)).x
    };
    pixels.par_iter().map(of).collect()
}

/// Linear light of the picture, each channel 0..1.
fn on_display([r, g, b, _]: [f16; 4], factor: f32, curve: Tonemap) -> Vec3 {
    tonemap::displayed(Vec3::from([r, g, b].map(f16::to_f32)) * factor, curve)
}

/// Interleaved gradient noise, -0.5..0.5: J. Jimenez, "Next Generation Post Processing in Call of Duty: Advanced Warfare", SIGGRAPH 2014.
fn dither(x: u32, y: u32) -> f32 {
    let along = f64::from(x) * 0.067_110_56 + f64::from(y) * 0.005_837_15;
    ((52.982_918_9 * along.fract()).fract() - 0.5) as f32
}

#[cfg(test)]
mod tests {
    use super::*;

    fn shown(radiance: f32, params: &SkyParams) -> Vec<u8> {
        let pixels = Pixels::Linear(vec![[f16::from_f32(radiance); 4]; 64 * 64]);
        let frame = Frame {
            width: 64,
            height: 64,
            pixels,
        };
        match displayed(frame, params).pixels {
            Pixels::Srgb8(pixels) => {
                assert!(
                    pixels
                        .iter()
                        .all(|p| p[0] == p[1] && p[1] == p[2] && p[3] == 255)
                );
                pixels.iter().map(|p| p[0]).collect()
            }
            other => panic!("{other:?}"),
        }
    }

    fn every_curve() -> [SkyParams; Tonemap::ALL.len()] {
        Tonemap::ALL.map(|tonemap| SkyParams {
            tonemap,
            ..SkyParams::default()
        })
    }

    #[test]
    fn black_is_black_and_bright_is_white_with_every_curve() {
        for params in every_curve() {
            let dark = [0.0, -1.0]
                .map(|radiance| shown(radiance, &params))
                .concat();
            assert!(dark.iter().all(|&b| b <= 1));
            assert!(shown(60_000.0, &params).iter().all(|&b| b >= 254));
        }
    }

    #[test]
    fn the_sunlit_cloud_is_a_little_below_white() {
        let filmic = SkyParams {
            tonemap: Tonemap::Filmic,
            exposure: 1.0,
            ..SkyParams::default()
        };
        // (1 + A) / (1 + B + A) is 0.86, which sRGB encodes as 0.935.
        assert!(shown(1.0, &filmic).iter().all(|&b| b.abs_diff(238) <= 1));
    }

    #[test]
    fn encoded_luminance_is_the_picture_s_grey() {
        for params in every_curve() {
            for radiance in [0.0, 0.01, 0.3, 2.0] {
                let frame = Frame {
                    width: 1,
                    height: 1,
                    pixels: Pixels::Linear(vec![[f16::from_f32(radiance); 4]]),
                };
                let found = encoded_luminance(&frame, &params)[0] * 255.0;
                let bytes = shown(radiance, &params);
                let mean = bytes.iter().map(|&b| f32::from(b)).sum::<f32>() / bytes.len() as f32;
                // Bytes end at 255, where dither has no mean any more.
                assert!((found - mean).abs() < 0.5, "{found} {mean}");
            }
        }
    }

    #[test]
    fn a_stop_is_twice_the_radiance() {
        for params in every_curve() {
            let brighter = SkyParams {
                exposure_ev: 1.0,
                ..params
            };
            assert_eq!(shown(0.125, &brighter), shown(0.25, &params));
            assert_ne!(shown(0.125, &params), shown(0.25, &params));
        }
    }

    #[test]
    fn dither_keeps_the_mean() {
        for params in every_curve() {
            for radiance in [0.03, 0.21, 0.5] {
                let bytes = shown(radiance, &params);
                let mean = bytes.iter().map(|&b| f32::from(b)).sum::<f32>() / bytes.len() as f32;
                let light = on_display(
                    [f16::from_f32(radiance); 4],
                    params.exposure_factor(),
                    params.tonemap,
                );
                let wanted = tonemap::srgb_encoded(light).x * 255.0;
                // Noise of 64x64 different values over one step: an even distribution is off by less than a 64th.
                assert!((mean - wanted).abs() < 1.0 / 64.0, "{mean} {wanted}");
            }
        }
    }
}
