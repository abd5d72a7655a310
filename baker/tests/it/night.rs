//! Stars and galaxy: the invariants that the runtime relies on, and the statistics of a real sky.

#![allow(
    clippy::disallowed_methods,
    reason = "what a test computes reaches no pack"
)]

use welkin_baker::Resolved;
use welkin_pack::{Image, Role, mapping};

use crate::common;

fn bake(text: &str, seed: u64, role: Role) -> (Resolved, Image) {
    let (resolved, all) = common::bake_for(&[role], text, Some(seed));
    let image = common::image(&all, role).clone();
    (resolved, image)
}

/// Place and the four bytes of every star.
fn stars(image: &Image) -> Vec<([i64; 2], [u8; 4])> {
    let places = (0..image.height).flat_map(|y| (0..image.width).map(move |x| (x, y)));
    let all = places.map(|(x, y)| {
        let bytes: Vec<u8> = image
            .texel(x, y)
            .iter()
            .map(|v| (v * 255.0 + 0.5) as u8)
            .collect();
        (
            [i64::from(x), i64::from(y)],
            [bytes[0], bytes[1], bytes[2], bytes[3]],
        )
    });
    all.filter(|(_, bytes)| *bytes != [0; 4]).collect()
}

fn chi_squared(counts: &[u32]) -> f64 {
    let expected = f64::from(counts.iter().sum::<u32>()) / counts.len() as f64;
    counts
        .iter()
        .map(|&c| (f64::from(c) - expected).powi(2) / expected)
        .sum()
}

#[test]
fn stars_keep_the_invariants_of_their_role() {
    for (text, count) in [
        ("", 1500),
        ("[stars]\nsize = 64\ncount = 128\nbrightest = 1\n", 128),
    ] {
        for seed in 0..4 {
            let (_, image) = bake(text, seed, Role::Stars);
            let stars = stars(&image);
            assert_eq!(
                stars.len(),
                count,
                "every star of the recipe is there and lit"
            );
            for (place, [intensity, rate, variance, _]) in &stars {
                assert!(*intensity >= 2, "{place:?}: intensity {intensity}");
                assert!(
                    variance <= intensity && u16::from(*variance) + u16::from(*intensity) <= 255,
                    "{place:?} clips"
                );
                // A fifth of a hertz is 12.8 64ths.
                assert!(*rate >= 12, "{place:?}: rate {rate}");
            }
        }
    }
}

#[test]
fn no_two_stars_touch_even_across_the_edge() {
    let (_, image) = bake("", 3, Role::Stars);
    let size = i64::from(image.width);
    let places: Vec<[i64; 2]> = stars(&image).into_iter().map(|(place, _)| place).collect();
    for (i, a) in places.iter().enumerate() {
        for b in &places[i + 1..] {
            let [dx, dy] = [0, 1].map(|k| {
                let d = (a[k] - b[k]).abs();
                d.min(size - d)
            });
            assert!(dx * dx + dy * dy >= 4, "{a:?} {b:?}");
        }
    }
}

#[test]
fn counts_grow_by_the_law_of_magnitudes() {
    let (resolved, image) = bake("", 1, Role::Stars);
    let settings = &resolved.stars;
    let all = stars(&image);
    // N(<m) = N (10^(0.5 m) - 1) / (10^(0.5 M) - 1), cut at the brightest and the faintest star.
    let whole = 10_f64.powf(0.5 * f64::from(settings.magnitudes)) - 1.0;
    for byte in [3_u8, 4, 6, 10, 20, 40, 80, 120] {
        let found = all.iter().filter(|(_, b)| b[0] >= byte).count() as f64;
        let least = (f64::from(byte) - 0.5) / 255.0;
        let magnitude = -2.5 * (least / f64::from(settings.brightest)).log10();
        let expected = f64::from(settings.count) * (10_f64.powf(0.5 * magnitude) - 1.0) / whole;
        // One star is drawn from each equal share of the law, so a count is off by one at most.
        assert!(
            (found - expected).abs() <= 1.0 + 1e-3,
            "byte {byte}: {found} against {expected}"
        );
    }
}

#[test]
fn stars_show_no_pattern() {
    for seed in 0..5 {
        let (_, image) = bake("", seed, Role::Stars);
        let mut cells = [0_u32; 64];
        let mut residues = [[0_u32; 4]; 2];
        let mut phases = [0_u32; 16];
        for ([x, y], bytes) in stars(&image) {
            cells[(y / 32 * 8 + x / 32) as usize] += 1;
            residues[0][(x % 4) as usize] += 1;
            residues[1][(y % 4) as usize] += 1;
            phases[usize::from(bytes[3] / 16)] += 1;
        }
        // Quantiles of chi squared at one false alarm in 1000. 63 degrees: 103.4, and at the other end 34.0,
        // below which stars would lie too evenly (their least distance makes them a little even).
        let spread = chi_squared(&cells);
        assert!(
            (30.0..103.4).contains(&spread),
            "seed {seed}: cells {spread}"
        );
        for counts in &residues {
            assert!(
                chi_squared(counts) < 16.3,
                "seed {seed}: residues {counts:?}"
            );
        }
        assert!(
            chi_squared(&phases) < 37.7,
            "seed {seed}: phases {phases:?}"
        );
    }
}

#[test]
fn the_galaxy_is_a_band_along_its_plane() {
    for seed in [1, 9] {
        let (resolved, image) = bake("", seed, Role::Galaxy);
        let (tilt, azimuth) = (resolved.galaxy.tilt_rad, resolved.galaxy.azimuth_rad);
        // The pole stands as far from the zenith as the plane is tilted, a quarter turn from its node.
        let side = mapping::direction_from_angles(azimuth + std::f32::consts::FRAC_PI_2, 0.0);
        let pole = [-side[0] * tilt.sin(), tilt.cos(), -side[2] * tilt.sin()];
        let (mut near, mut far) = (Vec::new(), Vec::new());
        for y in 0..image.height {
            for x in 0..image.width {
                let uv = [x, y].map(|i| (i as f32 + 0.5) / image.width as f32);
                let direction = mapping::galaxy_uv_to_direction(uv);
                let value = image.texel(x, y)[0];
                assert!((0.0..=1.0).contains(&value));
                let sine: f32 = (0..3).map(|i| direction[i] * pole[i]).sum();
                if direction[1] > 0.0 && sine.abs() < 0.1 {
                    near.push(value);
                } else if direction[1] > 0.0 && sine.abs() > 0.7 {
                    far.push(value);
                }
            }
        }
        let mean = |values: &[f32]| values.iter().sum::<f32>() / values.len() as f32;
        assert!(mean(&near) > 0.2, "{}", mean(&near));
        // Two bytes: so far from the plane the sky is black.
        assert!(mean(&far) < 2.0 / 255.0, "{}", mean(&far));
        // Structure: along the band brightness varies by a good part of itself.
        let spread = (near.iter().map(|v| (v - mean(&near)).powi(2)).sum::<f32>()
            / near.len() as f32)
            .sqrt();
        assert!(spread > 0.25 * mean(&near), "{spread}");
    }
}
