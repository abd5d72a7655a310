//! The cloud texture: it tiles, is calibrated, and is smooth enough to be thresholded and magnified.

use welkin_pack::{Image, Role};

use crate::common;

fn clouds(text: &str, seed: u64) -> Image {
    let (_, all) = common::bake_for(&[Role::Clouds], text, Some(seed));
    common::image(&all, Role::Clouds).clone()
}

/// Mean square of the second difference across every column, the last ones across the seam.
fn bends(image: &Image, channel: usize, transposed: bool) -> Vec<f64> {
    let n = image.width;
    let at = |i: u32, j: u32| {
        let (x, y) = if transposed { (j, i % n) } else { (i % n, j) };
        f64::from(image.texel(x, y)[channel])
    };
    let bend = |i: u32, j: u32| at(i, j) - 2.0 * at(i + 1, j) + at(i + 2, j);
    (0..n)
        .map(|i| (0..n).map(|j| bend(i, j) * bend(i, j)).sum::<f64>() / f64::from(n))
        .collect()
}

#[test]
fn no_channel_has_a_seam() {
    for seed in [1, 2] {
        let image = clouds("", seed);
        for channel in 0..3 {
            for transposed in [false, true] {
                let bends = bends(&image, channel, transposed);
                let (inside, seam) = bends.split_at(bends.len() - 2);
                // The seam is one more place in the tile: it may be as bent as any other, and a quarter
                // more, since the roughest of 510 columns is itself a matter of chance.
                let roughest = inside.iter().copied().fold(0.0, f64::max);
                for bend in seam {
                    assert!(
                        *bend <= 1.25 * roughest,
                        "seed {seed}, channel {channel}: {bend} against {roughest}"
                    );
                }
            }
        }
    }
}

#[test]
fn means_are_what_the_recipe_asks_for() {
    let text = "[clouds]\nsize = 256\n[clouds.photo]\nmean = 0.3\n[clouds.noise]\nmean = 0.12\n[clouds.detail]\nmean = 0.7\n";
    for (text, means) in [("", [0.37, 0.22, 0.5]), (text, [0.3, 0.12, 0.7])] {
        let image = clouds(text, 1);
        for (channel, mean) in means.into_iter().enumerate() {
            let (found, _) = image.mean_and_spread(channel);
            assert!(
                (found - mean).abs() < 1.0 / 512.0,
                "channel {channel}: {found}"
            );
            assert!(image.channel(channel).all(|v| (0.0..=1.0).contains(&v)));
            let most = image.channel(channel).fold(0.0, f32::max);
            assert!(most > 0.98, "channel {channel} reaches only {most}");
        }
    }
}

#[test]
fn photo_and_noise_are_smooth_at_the_texel() {
    let image = clouds("", 1);
    let n = image.width;
    for channel in 0..2 {
        let at = |x: u32, y: u32| image.texel(x % n, y % n)[channel];
        let texels = (0..n * n).map(|i| (i % n, i / n));
        let mut steps: Vec<f32> = texels
            .flat_map(|(x, y)| [at(x + 1, y), at(x, y + 1)].map(|v| (v - at(x, y)).abs()))
            .collect();
        steps.sort_by(f32::total_cmp);
        // The runtime multiplies contrast by up to five and magnifies at least threefold: a step of 0.1
        // then spreads half of the range over three pixels, the steepest edge that still looks soft. It
        // is for the odd place: one step in a thousand may pass half of that.
        assert!(
            steps[steps.len() - 1] < 0.1,
            "channel {channel}: {}",
            steps[steps.len() - 1]
        );
        let rare = steps[steps.len() - 1 - steps.len() / 1000];
        assert!(rare < 0.055, "channel {channel}: {rare}");
    }
}

#[test]
fn the_gradient_runs_from_nothing_to_all_without_a_visible_step() {
    for power in [1.0, 1.5, 2.0] {
        let image = clouds(&format!("[clouds.gradient]\npower = {power}\n"), 1);
        let rows: Vec<f32> = (0..image.height).map(|y| image.texel(0, y)[3]).collect();
        assert_eq!((rows[0], rows[rows.len() - 1]), (0.0, 1.0));
        let bytes: Vec<i32> = rows.iter().map(|v| (v * 255.0 + 0.5) as i32).collect();
        // Quantised rows stand still or go up by one.
        assert!(
            bytes.windows(2).all(|w| (0..=1).contains(&(w[1] - w[0]))),
            "power {power}"
        );
        assert!((0..image.width).all(|x| image.texel(x, 200)[3] == rows[200]));
    }
}

#[test]
fn every_size_makes_a_texture() {
    for size in [64, 128, 1024] {
        let image = clouds(&format!("[clouds]\nsize = {size}\n"), 5);
        assert_eq!((image.width, image.height, image.channels), (size, size, 4));
        assert!(image.texels.iter().all(|v| (0.0..=1.0).contains(v)));
    }
}
