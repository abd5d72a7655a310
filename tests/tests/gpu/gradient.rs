//! No bands: the clear sky runs through every level of an 8-bit target, and dither carries what lies between.

use welkin_runtime::{Camera, SkyParams};
use welkin_tests::renderer::Twin;
use welkin_tests::{gpu, pack, tonemap};

/// Wide enough that the mean of a row tells dithered tenths of a level.
const SIZE: [u32; 2] = [64, 480];

fn clear(dither: bool) -> SkyParams {
    SkyParams {
        cover: 0.0,
        time: 0.5,
        dither,
        flare: 0.0,
        ..SkyParams::default()
    }
}

/// Looking north, away from the sun, from below the horizon to 66 degrees. So narrow a picture is level in a row.
fn camera() -> Camera {
    Camera::looking(0.0, 0.6, 1.1, SIZE)
}

/// Bytes of one channel, row by row.
fn rows(format: wgpu::TextureFormat, dither: bool, channel: usize) -> Vec<Vec<u8>> {
    let texels = gpu::render(
        &mut gpu::sky(pack::default_pack(), format),
        format,
        &clear(dither),
        &camera(),
        0.0,
    );
    let byte = |t: &[f32; 4]| (t[channel] * 255.0 + 0.5) as u8;
    texels
        .chunks_exact(SIZE[0] as usize)
        .map(|row| row.iter().map(byte).collect())
        .collect()
}

/// What the same rows should hold, in steps of the target, not rounded: the mean of each row.
fn expected(channel: usize) -> Vec<f32> {
    let radiance = Twin::for_display(pack::default_pack()).render(&clear(false), &camera(), 0.0);
    let values: Vec<f32> = radiance
        .iter()
        .map(|&r| tonemap::to_bytes(r, &clear(false))[channel])
        .collect();
    values.chunks_exact(SIZE[0] as usize).map(mean).collect()
}

fn mean(row: &[f32]) -> f32 {
    row.iter().sum::<f32>() / row.len() as f32
}

/// The largest distance between the mean of a row and what it should be.
fn worst_row(rows: &[Vec<u8>], expected: &[f32]) -> f32 {
    let means = rows
        .iter()
        .map(|row| mean(&row.iter().map(|&b| f32::from(b)).collect::<Vec<_>>()));
    means
        .zip(expected)
        .map(|(m, e)| (m - e).abs())
        .fold(0.0, f32::max)
}

#[test]
fn every_level_between_the_darkest_and_the_brightest_is_there() {
    for format in [
        wgpu::TextureFormat::Rgba8Unorm,
        wgpu::TextureFormat::Rgba8UnormSrgb,
    ] {
        for channel in 0..3 {
            let rows = rows(format, true, channel);
            let mut seen: Vec<u8> = rows.concat();
            seen.sort_unstable();
            seen.dedup();
            let (low, high) = (seen[0], seen[seen.len() - 1]);
            println!(
                "{format:?} channel {channel}: {} levels from {low} to {high}",
                seen.len()
            );
            // The gradient is continuous, so between its ends no level may be missing; and a clear noon sky
            // spans more than the few levels of a banded one: its dark upper part, some thirty of them.
            assert_eq!(
                seen.len(),
                usize::from(high - low) + 1,
                "{format:?} channel {channel}: {seen:?}"
            );
            assert!(
                seen.len() > 30,
                "{format:?} channel {channel}: only {} levels",
                seen.len()
            );
        }
    }
}

#[test]
fn dither_carries_what_lies_between_two_levels() {
    for format in [
        wgpu::TextureFormat::Rgba8Unorm,
        wgpu::TextureFormat::Rgba8UnormSrgb,
    ] {
        for channel in 0..3 {
            let expected = expected(channel);
            let dithered = worst_row(&rows(format, true, channel), &expected);
            let plain = worst_row(&rows(format, false, channel), &expected);
            println!(
                "{format:?} channel {channel}: worst row {dithered:.3} steps dithered, {plain:.3} plain"
            );
            // A row of 64 noise values misses its mean by a few hundredths; the approximate slope of the
            // hardware-encoded target is off by 16 % of half a step. Without dither a row is off by up to 0.5.
            assert!(dithered < 0.25, "{format:?} channel {channel}: {dithered}");
            assert!(plain > 0.4, "the test would not see bands: {plain}");
        }
    }
}
