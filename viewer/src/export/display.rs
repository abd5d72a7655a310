//! Radiance as a picture that a display shows: the runtime's last step on the CPU, for maps that are put together from several frames.
//!
//! The same tone curve, encoding and dither as [`welkin_runtime::internals::tonemap`], after the means were taken in linear light.

use welkin_runtime::internals::tonemap::{KNEE, SHOULDER};

use crate::frame::{Frame, Pixels};

/// A frame of radiance, tonemapped and encoded as sRGB. Other frames stay what they are.
pub fn displayed(frame: Frame) -> Frame {
    let Pixels::Linear(pixels) = &frame.pixels else {
        return frame;
    };
    let places = pixels.iter().enumerate();
    let bytes = places.map(|(index, pixel)| {
        let noise = dither(index as u32 % frame.width, index as u32 / frame.width);
        let [r, g, b, _] = pixel.map(|c| (encoded(toned(c.to_f32())) * 255.0 + 0.5 + noise) as u8);
        [r, g, b, 255]
    });
    Frame {
        pixels: Pixels::Srgb8(bytes.collect()),
        ..frame
    }
}

fn toned(radiance: f32) -> f32 {
    let x = radiance.max(0.0);
    let shoulder = SHOULDER * x * x;
    ((x + shoulder) / (1.0 + KNEE * x + shoulder)).min(1.0)
}

/// IEC 61966-2-1.
fn encoded(linear: f32) -> f32 {
    if linear <= 0.003_130_8 {
        12.92 * linear
    } else {
        1.055 * linear.powf(1.0 / 2.4) - 0.055
    }
}

/// Interleaved gradient noise, -0.5..0.5: J. Jimenez, "Next Generation Post Processing in Call of Duty: Advanced Warfare", SIGGRAPH 2014.
fn dither(x: u32, y: u32) -> f32 {
    let along = f64::from(x) * 0.067_110_56 + f64::from(y) * 0.005_837_15;
    ((52.982_918_9 * along.fract()).fract() - 0.5) as f32
}

#[cfg(test)]
mod tests {
    use half::f16;

    use super::*;

    fn shown(radiance: f32) -> Vec<u8> {
        let pixels = Pixels::Linear(vec![[f16::from_f32(radiance); 4]; 64 * 64]);
        let frame = displayed(Frame {
            width: 64,
            height: 64,
            pixels,
        });
        match frame.pixels {
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

    #[test]
    fn black_is_black_bright_is_white_and_the_sunlit_cloud_a_little_below() {
        assert!(shown(0.0).iter().all(|&b| b <= 1) && shown(-1.0).iter().all(|&b| b <= 1));
        assert!(shown(60_000.0).iter().all(|&b| b >= 254));
        // (1 + a) / (1 + b + a) is 0.86, which sRGB encodes as 0.935.
        assert!(shown(1.0).iter().all(|&b| b.abs_diff(238) <= 1));
    }

    #[test]
    fn dither_keeps_the_mean() {
        for radiance in [0.03, 0.21, 0.5] {
            let bytes = shown(radiance);
            let mean = bytes.iter().map(|&b| f32::from(b)).sum::<f32>() / bytes.len() as f32;
            let wanted = encoded(toned(f16::from_f32(radiance).to_f32())) * 255.0;
            // Noise of 64x64 different values over one step: an even distribution is off by less than a 64th.
            assert!((mean - wanted).abs() < 1.0 / 64.0, "{mean} {wanted}");
        }
    }
}
