//! What the other methods draw from: white noise, octaves of smooth noise, and the lens flare.

use std::f32::consts::TAU;

use crate::common::{bake_for, image, images};
use welkin_pack::mapping::FBM_STEPS_A_TILE;
use welkin_pack::{FbmTexel, FlareCell, Image, Role, Source};

/// What the other methods draw from.
fn small(text: &str, seed: u64) -> Vec<Source> {
    bake_for(&[Role::Octaves, Role::Fbm, Role::Flares], text, Some(seed)).1
}

/// Pearson's correlation of two lists.
fn correlation(a: &[f32], b: &[f32]) -> f64 {
    let mean = |v: &[f32]| v.iter().map(|&x| f64::from(x)).sum::<f64>() / v.len() as f64;
    let (mean_a, mean_b) = (mean(a), mean(b));
    let moment = |a: &[f32], b: &[f32], mean_a: f64, mean_b: f64| {
        let pairs = a.iter().zip(b);
        pairs
            .map(|(&x, &y)| (f64::from(x) - mean_a) * (f64::from(y) - mean_b))
            .sum::<f64>()
    };
    moment(a, b, mean_a, mean_b)
        / (moment(a, a, mean_a, mean_a) * moment(b, b, mean_b, mean_b)).sqrt()
}

#[test]
fn white_noise_has_the_moments_of_its_bytes_exactly() {
    for seed in [1, 2, u64::MAX] {
        let sources = small("", seed);
        let noise = image(&sources, Role::Octaves);
        assert_eq!((noise.width, noise.height, noise.channels), (32, 32, 4));
        for channel in 0..4 {
            let mut counts = [0; 256];
            noise
                .channel(channel)
                .for_each(|v| counts[(v * 255.0 + 0.5) as usize] += 1);
            assert!(counts.iter().all(|&count| count == 4));
            let (mean, spread) = noise.mean_and_spread(channel);
            // The variance of 0, 1, ... n - 1 is (n^2 - 1) / 12.
            let expected = ((256.0_f64 * 256.0 - 1.0) / 12.0).sqrt() / 255.0;
            assert!((mean - 0.5).abs() < 1e-6);
            assert!((f64::from(spread) - expected).abs() < 1e-6);
        }
    }
}

#[test]
fn white_noise_knows_nothing_of_its_neighbours_or_other_octaves() {
    // The correlation of shuffled lists spreads by 1 / sqrt(n - 1); five of that, one false alarm in 1.7 million.
    let most = 5.0 / 1023.0_f64.sqrt();
    for seed in 1..4 {
        let sources = small("", seed);
        let noise = image(&sources, Role::Octaves);
        let channels = [0, 1, 2, 3].map(|c| noise.channel(c).collect::<Vec<f32>>());
        for (i, channel) in channels.iter().enumerate() {
            for other in &channels[..i] {
                assert!(correlation(channel, other).abs() < most, "seed {seed}");
            }
            for away in [1, 2, 32, 33] {
                let mut moved = channel.clone();
                moved.rotate_left(away);
                let found = correlation(channel, &moved);
                assert!(
                    found.abs() < most,
                    "seed {seed}, octave {i}, {away}: {found}"
                );
            }
        }
    }
}

fn noise_of(image: &Image, x: u32, y: u32) -> f32 {
    image.texel(x % image.width, y % image.height)[3]
}

#[test]
fn smooth_noise_is_its_lattice_interpolated_across_the_edges_too() {
    for (text, size, cells) in [
        ("", 256, 8),
        ("[fbm]\nsize = 64\ncells = 4\noctaves = 4\n", 64, 4),
        ("[fbm]\nsize = 128\ncells = 64\noctaves = 1\n", 128, 64),
    ] {
        let sources = small(text, 3);
        for (octave, image) in images(&sources, Role::Fbm).iter().enumerate() {
            assert_eq!((image.width, image.height, image.channels), (size, size, 4));
            let step = size / (cells << octave);
            for (x, y) in (0..size * size).map(|i| (i % size, i / size)) {
                let (left, top) = (x - x % step, y - y % step);
                let share = |i: u32| {
                    let t = (i % step) as f32 / step as f32;
                    t * t * (3.0 - 2.0 * t)
                };
                let (xf, yf) = (share(x), share(y));
                let [a, b, c, d] = [(0, 0), (step, 0), (0, step), (step, step)]
                    .map(|(dx, dy)| noise_of(image, left + dx, top + dy));
                // As the article writes it.
                let expected = a + xf * (b - a) + yf * (c - a) + xf * yf * (a - b - c + d);
                assert!(
                    (noise_of(image, x, y) - expected).abs() < 1e-6,
                    "{octave}: {x} {y}"
                );
                assert!((0.0..=1.0).contains(&noise_of(image, x, y)));
            }
            // Lattice values are bytes, so they survive being stored.
            let corner = noise_of(image, 0, 0) * 255.0;
            assert!((corner - corner.round()).abs() < 1e-4);
        }
    }
}

#[test]
fn smooth_noise_has_the_variance_of_its_interpolation() {
    let sources = small("[fbm]\nsize = 512\ncells = 32\noctaves = 3\n", 5);
    for (octave, image) in images(&sources, Role::Fbm).iter().enumerate() {
        let cells = 32 << octave;
        let step = 512 / cells;
        // Weights s and 1 - s of two independent numbers leave s^2 + (1 - s)^2 of their variance, 1/12.
        let left = (0..step).map(|i| {
            let t = f64::from(i) / f64::from(step);
            let s = t * t * (3.0 - 2.0 * t);
            s * s + (1.0 - s) * (1.0 - s)
        });
        let left = left.sum::<f64>() / f64::from(step);
        let expected = (1.0 / 12.0_f64).sqrt() * left;
        let (mean, spread) = image.mean_and_spread(3);
        // The mean of c^2 numbers spreads by sqrt(1/12) / c, their variance by less than sqrt(2) / c of itself,
        // its root by half of that; five of each.
        let slack = 5.0 / f64::from(cells);
        assert!(
            (f64::from(mean) - 0.5).abs() < slack * 0.289,
            "octave {octave}: {mean}"
        );
        assert!(
            (f64::from(spread) / expected - 1.0).abs() < slack * 0.71,
            "octave {octave}: {spread} {expected}"
        );
    }
}

#[test]
fn three_channels_are_the_noise_one_two_and_three_steps_to_the_east() {
    for size in [64, 256, 512] {
        let sources = small(&format!("[fbm]\nsize = {size}\n"), 1);
        let step = size / FBM_STEPS_A_TILE;
        for image in images(&sources, Role::Fbm) {
            for (x, y) in (0..size * size).map(|i| (i % size, i / size)) {
                let t = image.texel(x, y);
                let texel = FbmTexel {
                    steps3: t[0],
                    steps2: t[1],
                    steps1: t[2],
                    noise: t[3],
                };
                assert_eq!(texel.steps1, noise_of(image, x + step, y));
                assert_eq!(texel.steps2, noise_of(image, x + 2 * step, y));
                assert_eq!(texel.steps3, noise_of(image, x + 3 * step, y));
            }
        }
    }
}

#[test]
fn no_octave_repeats_in_another() {
    let sources = small("", 2);
    let layers: Vec<Vec<f32>> = images(&sources, Role::Fbm)
        .iter()
        .map(|image| image.channel(3).collect())
        .collect();
    assert_eq!(layers.len(), 4);
    for (i, layer) in layers.iter().enumerate() {
        for (j, other) in layers[..i].iter().enumerate() {
            // The coarser has 64 cells at least: independent values correlate by 1/8, hardly by five of that.
            let cells = f64::from(8 << j);
            let found = correlation(layer, other).abs();
            assert!(found < 5.0 / cells, "{i} {j}: {found}");
        }
    }
}

/// The light of a cell at a distance and an angle from its middle, read at the nearest texel.
fn light_at(image: &Image, cell: FlareCell, r: f32, angle: f32) -> f32 {
    let half = image.width as f32 / 4.0;
    let [column, row] = cell.place().map(|i| (2 * i + 1) as f32 * half);
    let at = |middle: f32, unit: f32| (middle + r * half * unit) as u32;
    let (x, y) = (at(column, libm::cosf(angle)), at(row, libm::sinf(angle)));
    image.texel(x, y)[0]
}

#[test]
fn flares_end_before_the_side_of_their_cell_at_every_size() {
    for size in [64, 128, 256, 1024] {
        let sources = small(&format!("[flares]\nsize = {size}\n"), 1);
        let atlas = image(&sources, Role::Flares);
        assert_eq!((atlas.width, atlas.height, atlas.channels), (size, size, 1));
        let cell = size / 2;
        let inside = FlareCell::BORDER_TEXELS..cell - FlareCell::BORDER_TEXELS;
        for (x, y) in (0..size * size).map(|i| (i % size, i / size)) {
            let light = atlas.texel(x, y)[0];
            assert!((0.0..=1.0).contains(&light));
            if !inside.contains(&(x % cell)) || !inside.contains(&(y % cell)) {
                assert_eq!(light, 0.0, "{size}: {x} {y}");
            }
        }
    }
}

#[test]
fn round_flares_are_round_and_have_the_profiles_of_their_names() {
    let sources = small("[flares]\nsize = 512\n", 1);
    let atlas = image(&sources, Role::Flares);
    for (y, x) in (0..256).flat_map(|y| (0..256).map(move |x| (y, x))) {
        for [dx, dy] in [[0, 0], [256, 0], [0, 256]] {
            let at = |x: u32, y: u32| atlas.texel(x + dx, y + dy)[0];
            assert!((at(x, y) - at(255 - x, y)).abs() < 1e-5 && (at(x, y) - at(y, x)).abs() < 1e-5);
        }
    }
    let profile = |cell| -> Vec<f32> {
        let radii = (0..100).map(|i| i as f32 / 100.0);
        radii.map(|r| light_at(atlas, cell, r, 0.0)).collect()
    };
    let [disc, ring, glow] = [FlareCell::Disc, FlareCell::Ring, FlareCell::Glow].map(profile);
    // Flat over its inner half, brighter at the rim by less than half.
    assert!(disc[..45].iter().all(|v| (v - disc[0]).abs() < 0.01));
    let rim = disc.iter().copied().fold(0.0, f32::max);
    assert!(
        rim > 1.1 * disc[0] && rim < 1.5 * disc[0],
        "{rim} over {}",
        disc[0]
    );
    // Bright over less than a sixth of the radius, with hardly any light inside.
    let bright = ring.iter().filter(|&&v| v > 0.5).count();
    assert!((3..16).contains(&bright), "{bright}");
    assert!(ring[..50].iter().all(|&v| v < 0.15));
    // Falls all the way.
    assert!(glow[0] > 0.95 && glow.windows(2).all(|w| w[1] <= w[0]));
}

#[test]
fn the_starburst_has_eight_rays_of_uneven_length() {
    for seed in 1..5 {
        let sources = small("[flares]\nsize = 512\n", seed);
        let atlas = image(&sources, Role::Flares);
        let around = |r: f32| -> Vec<f32> {
            (0..720)
                .map(|i| light_at(atlas, FlareCell::Starburst, r, i as f32 / 720.0 * TAU))
                .collect()
        };
        // Rays are the arcs that shine more than what is between them.
        let rays = |r: f32| {
            let ring = around(r);
            let lit = |i: usize| ring[i % 720] > 0.045;
            (0..720).filter(|&i| !lit(i) && lit(i + 1)).count()
        };
        assert_eq!(rays(0.5), 8, "seed {seed}");
        assert!(rays(0.82) < 8, "seed {seed}");
        let middle = around(0.0);
        assert!(middle[0] > 0.95);
        // Dark between the rays.
        assert!(
            around(0.5).iter().filter(|&&v| v < 0.03).count() > 360,
            "seed {seed}"
        );
    }
}
