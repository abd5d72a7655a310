//! Layers of clouds: normals, ranks, tiling, and the character of each kind.

use std::sync::OnceLock;

use crate::common::{bake_for, images};
use welkin_pack::{Image, LayerKind, LayerTexel, Role};

/// The layers of a recipe.
fn layers(text: &str, seed: u64) -> Vec<Image> {
    let (_, sources) = bake_for(&[Role::Layers], text, Some(seed));
    images(&sources, Role::Layers).to_vec()
}

/// The default layers by three seeds, made once for all tests.
fn by_seeds() -> &'static [Vec<Image>] {
    static LAYERS: OnceLock<Vec<Vec<Image>>> = OnceLock::new();
    LAYERS.get_or_init(|| (1..=3).map(|seed| layers("", seed)).collect())
}

fn texel(image: &Image, x: u32, y: u32) -> LayerTexel {
    let t = image.texel(x % image.width, y % image.height);
    LayerTexel {
        normal_xy: [2.0 * t[0] - 1.0, 2.0 * t[1] - 1.0],
        density: t[2],
        rank: t[3],
    }
}

fn places(image: &Image) -> impl Iterator<Item = (u32, u32)> + use<> {
    let (width, height) = (image.width, image.height);
    (0..height).flat_map(move |y| (0..width).map(move |x| (x, y)))
}

/// Slopes of the surface that has these normals, and central differences of the density, along u and v.
fn slopes_and_differences(image: &Image) -> Vec<[f32; 2]> {
    let (w, h) = (image.width, image.height);
    let at = |x, y| texel(image, x, y).density;
    places(image)
        .flat_map(|(x, y)| {
            let [nx, ny, nz] = texel(image, x, y).normal();
            let along_u = 0.5 * (at(x + 1, y) - at(x + w - 1, y));
            let along_v = 0.5 * (at(x, y + 1) - at(x, y + h - 1));
            [[-nx / nz, along_u], [-ny / nz, along_v]]
        })
        .collect()
}

#[test]
fn normals_are_those_of_the_density_with_the_relief_of_the_recipe() {
    for (text, reliefs) in [
        ("", [0.6, 0.8, 0.3]),
        (
            "[layers]\nsize = 128\n[layers.cirrus]\nrelief = 2\n[layers.cumulus]\nrelief = 0.1\n",
            [0.6, 0.1, 2.0],
        ),
    ] {
        for (image, relief) in layers(text, 3).iter().zip(reliefs) {
            let pairs = slopes_and_differences(image);
            let square = |i: usize| pairs.iter().map(|p| f64::from(p[i] * p[i])).sum::<f64>();
            let texels = f64::from(image.width * image.height);
            assert!(((square(0) / texels).sqrt() / relief - 1.0).abs() < 1e-3);
            let height = (square(0) / square(1)).sqrt() as f32;
            for [slope, difference] in pairs {
                // Components have errors of 1e-7, and so the slope of that times the slope of `n / sqrt(1 - n^2)`, which is
                // `(1 + s^2)^1.5`; the density has such errors too.
                let steep = 1.0 + slope * slope;
                let slack = 1e-6 * (steep * libm::sqrtf(steep) + height);
                assert!((slope - height * difference).abs() < slack);
            }
        }
    }
}

#[test]
fn ranks_cut_exactly_the_share_that_they_say() {
    for seed in [1, 2] {
        for image in layers("[layers]\nsize = 128\n", seed) {
            let mut ordered: Vec<LayerTexel> =
                places(&image).map(|(x, y)| texel(&image, x, y)).collect();
            ordered.sort_by(|a, b| a.density.total_cmp(&b.density));
            assert!(
                ordered
                    .windows(2)
                    .all(|pair| pair[0].rank <= pair[1].rank || pair[0].density == pair[1].density)
            );
            for oktas in 0..=8 {
                let cover = oktas as f32 / 8.0;
                let covered = ordered.iter().filter(|t| t.rank > 1.0 - cover).count();
                // At cover 1 the lowest rank, 0, is not above 0: a 256th of the texels.
                let expected = (ordered.len() * oktas / 8).min(ordered.len() / 256 * 255);
                assert_eq!(covered, expected, "{oktas} oktas");
            }
        }
    }
}

#[test]
fn density_reaches_from_0_to_1_and_is_cut_off_nowhere() {
    for (seed, layers) in (1..).zip(by_seeds()) {
        for image in layers {
            // The ends were scaled to 0 and 1, to seven digits, and the tip of a hill may have texels beside it that
            // are as near; where a channel is clipped there are hundreds.
            for end in [0.0, 1.0] {
                let near = image.channel(2).filter(|d| (d - end).abs() < 1e-6);
                assert!((1..10).contains(&near.count()), "seed {seed}");
            }
        }
    }
}

/// The mean square difference of the density between places so far apart, over twice its variance: 0 for the same,
/// about 1 for places that have nothing in common.
fn variogram(image: &Image, dx: u32, dy: u32) -> f64 {
    let (_, spread) = image.mean_and_spread(2);
    let squares = places(image).map(|(x, y)| {
        let d = texel(image, x, y).density - texel(image, x + dx, y + dy).density;
        f64::from(d * d)
    });
    let mean = squares.sum::<f64>() / f64::from(image.width * image.height);
    mean / (2.0 * f64::from(spread * spread))
}

/// The first distance, in texels, at which the density has lost half of what it has in common.
fn reach(image: &Image, direction: [u32; 2]) -> u32 {
    let [dx, dy] = direction;
    let far = |d: &u32| variogram(image, d * dx, d * dy) > 0.5;
    (1..image.width / 2).find(far).unwrap_or(image.width / 2)
}

#[test]
fn each_kind_has_the_shape_of_its_name() {
    for (seed, layers) in (1..).zip(by_seeds()) {
        let [sheet, heaps, fibres] = LayerKind::ALL.map(|kind| &layers[kind as usize]);
        // Lumps and heaps are round, and heaps the larger.
        let [lumps_u, lumps_v] = [[1, 0], [0, 1]].map(|d| reach(sheet, d));
        let [heaps_u, heaps_v] = [[1, 0], [0, 1]].map(|d| reach(heaps, d));
        for (u, v) in [(lumps_u, lumps_v), (heaps_u, heaps_v)] {
            assert!(u.max(v) < 2 * u.min(v), "seed {seed}: {u} by {v}");
        }
        assert!(heaps_u + heaps_v > lumps_u + lumps_v, "seed {seed}");
        // Twelve across 256 texels are 21 texels apart: half way down before the next, and not at the texel.
        assert!((3..21).contains(&lumps_u), "seed {seed}: {lumps_u}");
        // Fibres are several times longer than wide: so many times steeper across.
        let stretch = (variogram(fibres, 0, 1) / variogram(fibres, 1, 0)).sqrt();
        assert!(stretch > 3.0, "seed {seed}: {stretch}");
    }
}

/// How many separate pieces of at least `least` texels the densest share `cover` has, the tile wrapped around.
fn pieces(image: &Image, cover: f32, least: usize) -> usize {
    let (width, height) = (image.width as usize, image.height as usize);
    let mut open: Vec<bool> = image.channel(3).map(|rank| rank > 1.0 - cover).collect();
    let mut count = 0;
    for start in 0..open.len() {
        let (mut found, mut stack) = (0, vec![start]);
        while let Some(i) = stack.pop() {
            if !std::mem::replace(&mut open[i], false) {
                continue;
            }
            found += 1;
            let (x, y) = (i % width, i / width);
            stack.push(y * width + (x + 1) % width);
            stack.push(y * width + (x + width - 1) % width);
            stack.push((y + 1) % height * width + x);
            stack.push((y + height - 1) % height * width + x);
        }
        count += usize::from(found >= least);
    }
    count
}

#[test]
fn cumulus_are_separate_heaps_and_gaps_between_them_join() {
    for (seed, layers) in (1..).zip(by_seeds()) {
        let heaps = &layers[LayerKind::Cumulus as usize];
        // 36 cells have a heap each, of which neighbours may grow together and small ones be missing.
        let found = pieces(heaps, 0.3, 30);
        assert!((12..=60).contains(&found), "seed {seed}: {found}");
        let mut clear = heaps.clone();
        clear
            .texels
            .chunks_exact_mut(4)
            .for_each(|t| t[3] = 1.0 - t[3]);
        // The clear sky at cover 0.3, in one piece but for holes.
        let gaps = pieces(&clear, 0.7, 100);
        assert!(gaps <= 3, "seed {seed}: {gaps}");
    }
}

#[test]
fn sizes_and_settings_at_their_limits_make_layers() {
    for text in [
        "[layers]\nsize = 64\n",
        "[layers]\nsize = 512\n",
        "[layers.stratocumulus]\ncells = 32\noctaves = 8\ngain = 1\n",
        "[layers.stratocumulus]\ncells = 2\noctaves = 1\n",
        "[layers.cumulus]\ncells = 16\noctaves = 8\ngain = 1\n",
        "[layers.cumulus]\ncells = 2\noctaves = 8\ngain = 0\n",
        "[layers.cirrus]\ncells = 10\noctaves = 8\ngain = 1\n",
        "[layers.cirrus]\ncells = 2\noctaves = 8\ngain = 1\n",
    ] {
        for image in layers(text, 1) {
            let (_, spread) = image.mean_and_spread(2);
            assert!((0.04..0.4).contains(&spread), "{text}: {spread}");
        }
    }
}
