//! Cover is the share of the sky that clouds take, and no grid shows in them.

use welkin_pack::{Pack, Role};
use welkin_runtime::internals::clouds::fbm::map as fbm_map;
use welkin_runtime::internals::pack_data::PackData;
use welkin_runtime::{Camera, Method, Sky, SkyParams};
use welkin_tests::{gpu, pack};

const FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba8Unorm;

/// Moments with states that have nothing to do with each other: two intervals apart, in all parts of one.
fn moments() -> impl Iterator<Item = f64> {
    (0..16).map(|i| 123.75 * f64::from(i))
}

/// One channel of level 0 of the map of a moment.
fn map(sky: &mut Sky, params: &SkyParams, seconds: f64, channel: usize) -> Vec<f32> {
    let view = Camera::looking(0.0, 0.5, 1.0, [16, 16]);
    gpu::prepare(sky, params, &view, seconds);
    let texels = gpu::read(sky.cloud_map().expect("the method has a map"));
    texels.iter().map(|texel| texel[channel]).collect()
}

fn share(map: &[f32], above: f32) -> f32 {
    map.iter().filter(|v| **v > above).count() as f32 / map.len() as f32
}

#[test]
fn octaves_cover_what_cover_says() {
    let params = SkyParams {
        method: Method::Octaves,
        ..SkyParams::default()
    };
    let mut sky = gpu::sky(pack::default_pack(), FORMAT);
    let maps: Vec<_> = moments()
        .map(|seconds| map(&mut sky, &params, seconds, 0))
        .collect();
    for cover in [0.1_f32, 0.25, 0.5, 0.75, 0.9] {
        let mean = maps.iter().map(|map| share(map, 1.0 - cover)).sum::<f32>() / maps.len() as f32;
        println!("cover {cover}: {mean:.4} of the map");
        // Chance: a spline correlates (315 / 151)^2 = 4.35 cells of the coarsest octave, so a map holds no less than
        // 1024 / 4.35 independent places; five deviations of the mean of 16 maps.
        let chance = 5.0 * (cover * (1.0 - cover) / (16.0 * 1024.0 / 4.35)).sqrt();
        // The sum of few bounded numbers is a little flatter than the normal distribution: by Edgeworth's series its
        // share is off by k (z^3 - 3 z) f(z) / 24, at most 0.023 k, with an excess k of -0.5 at most: the noise's -1.2 times
        // what the filter's weights leave (0.63, in the middle of a cell) times the octaves' (0.6). Half a byte is 0.002.
        let bound = chance + 0.023 * 0.5 + 0.002;
        assert!(
            (mean - cover).abs() < bound,
            "cover {cover}: {mean}, within {bound}"
        );
    }
}

/// How far a sum of octaves is from the normal distribution: skewness and excess of its own octaves, whatever their places.
fn shape(pack: &Pack) -> [f32; 2] {
    let octaves = PackData::new(pack).expect("the pack has every role").fbm;
    let (_, spread) = fbm_map::mean_and_spread(&octaves);
    let texture = pack.texture(Role::Fbm).expect("the pack has octaves");
    let (mut skewness, mut excess) = (0.0, 0.0);
    for (layer, weight) in fbm_map::weights(&octaves)
        .into_iter()
        .take(octaves.count())
        .enumerate()
    {
        let image = texture.image(0, layer as u32);
        let [mean, deviation] = octaves.mean_and_spread[layer];
        let texels = (image.width * image.height) as f32;
        let moment = |power: i32| {
            let parts = image
                .channel(3)
                .map(|v| ((v - mean) / deviation).powi(power));
            parts.sum::<f32>() / texels
        };
        let of_sum = weight * deviation / spread;
        skewness += of_sum.powi(3) * moment(3);
        excess += of_sum.powi(4) * (moment(4) - 3.0);
    }
    [skewness, excess]
}

#[test]
fn fbm_covers_what_cover_says() {
    let mut sky = gpu::sky(pack::default_pack(), FORMAT);
    let [skewness, excess] = shape(pack::default_pack());
    println!("skewness {skewness:.3}, excess {excess:.3}");
    for cover in [0.1_f32, 0.25, 0.5, 0.75] {
        let params = SkyParams {
            method: Method::Fbm,
            cover,
            ..SkyParams::default()
        };
        let shares = moments().map(|seconds| share(&map(&mut sky, &params, seconds, 3), 0.0));
        let mean = shares.sum::<f32>() / 16.0;
        println!("cover {cover}: {mean:.4} of the map");
        // Edgeworth's series, its first terms: skewness (z^2 - 1) f(z) / 6 is at most 0.067 of it, the excess 0.023.
        let distribution = 0.067 * skewness.abs() + 0.023 * excess.abs();
        // The first octave is always all there; the second lies otherwise over it at every moment. Smooth noise
        // correlates 1.81 of its cells (1 over the square of 1 - 2 integral s (1 - s), s = x^2 (3 - 2 x)).
        let chance = 5.0 * (cover * (1.0 - cover) / (16.0 * 256.0 / 1.81)).sqrt();
        let bound = distribution + chance + 0.002;
        assert!(
            (mean - cover).abs() < bound,
            "cover {cover}: {mean}, within {bound}"
        );
    }
}

#[test]
fn lit_covers_what_cover_says() {
    let params = SkyParams {
        method: Method::Lit,
        speed: 0.0,
        ..SkyParams::default()
    };
    let mut sky = gpu::sky(pack::default_pack(), FORMAT);
    // Two intervals apart, as the others' are.
    let every_s = 2.0 * f64::from(params.lit.formation_interval_s);
    let maps: Vec<_> = (0..16)
        .map(|i| map(&mut sky, &params, every_s * f64::from(i), 1))
        .collect();
    for cover in [0.1_f32, 0.25, 0.5, 0.75, 0.9] {
        let mean = maps.iter().map(|map| share(map, 1.0 - cover)).sum::<f32>() / maps.len() as f32;
        println!("cover {cover}: {mean:.4} of the map");
        // Each read alone is even exactly; how they lie over each other is chance. Lumps of stratocumulus are a twelfth of
        // the tile: five deviations of the mean of 16 maps. Half a byte is 0.002.
        let bound = 5.0 * (cover * (1.0 - cover) / (16.0 * 144.0)).sqrt() + 0.002;
        assert!(
            (mean - cover).abs() < bound,
            "cover {cover}: {mean}, within {bound}"
        );
    }
}

/// Mean energy of the wave vectors (k, j) of square images, k from 0 to half the side.
fn energies(maps: &[Vec<f32>], side: usize, j: i32) -> Vec<f64> {
    let turn = |k: f64, x: usize| (-std::f64::consts::TAU * k * x as f64 / side as f64).sin_cos();
    let mut energies = vec![0.0; side / 2 + 1];
    for map in maps {
        let column = |x: usize| {
            (0..side).fold([0.0, 0.0], |[re, im], y| {
                let (sin, cos) = turn(f64::from(j), y);
                let value = f64::from(map[y * side + x]);
                [re + value * cos, im + value * sin]
            })
        };
        let columns: Vec<[f64; 2]> = (0..side).map(column).collect();
        for (k, energy) in energies.iter_mut().enumerate() {
            let [re, im] = columns
                .iter()
                .enumerate()
                .fold([0.0, 0.0], |[re, im], (x, [a, b])| {
                    let (sin, cos) = turn(k as f64, x);
                    [re + a * cos - b * sin, im + a * sin + b * cos]
                });
            *energy += (re * re + im * im) / maps.len() as f64;
        }
    }
    energies
}

fn transposed(map: &[f32], side: usize) -> Vec<f32> {
    (0..side * side)
        .map(|i| map[i % side * side + i / side])
        .collect()
}

/// The wave along the rows that stands out most of its neighbours: wave number, and how many times their energy it has.
fn loudest_wave(maps: &[Vec<f32>], side: usize) -> (usize, f64) {
    // Tiled octaves have waves at multiples of 2, 4 and 8 only: (k, 8) and (k, -8) belong to the same as (k, 0).
    let [along, above, below] = [0, 8, -8].map(|j| energies(maps, side, j));
    // The spline leaves sinc(8/32)^8 of the first octave's energy at the wave number 8, and more of the others'.
    let least = (std::f64::consts::FRAC_PI_4.sin() / std::f64::consts::FRAC_PI_4).powi(8);
    let ratio = |k: usize| along[k] / ((above[k] + below[k]) / 2.0 / least);
    let each = (1..side / 2).map(|k| (k, ratio(k)));
    each.max_by(|a, b| a.1.total_cmp(&b.1))
        .expect("there are waves")
}

/// Energies of 16 maps against those of twice 16: the ratio has the F distribution with 32 and 64 degrees of freedom, and
/// goes beyond 5.5 in one of 256 with a chance of one in a million.
const STANDS_OUT: f64 = 5.5;

/// Nothing repeats along the rows or columns of the map that does not along slanted lines: no grid.
#[test]
fn no_wave_along_an_axis_stands_out_of_the_octaves() {
    // A photo has axes of its own.
    let params = SkyParams {
        method: Method::Octaves,
        photo: 0.0,
        ..SkyParams::default()
    };
    let mut sky = gpu::sky(pack::default_pack(), FORMAT);
    let mut maps: Vec<_> = moments()
        .map(|seconds| map(&mut sky, &params, seconds, 0))
        .collect();
    let side = maps[0].len().isqrt();
    let turned: Vec<_> = maps.iter().map(|map| transposed(map, side)).collect();
    for maps in [&maps, &turned] {
        let (k, times) = loudest_wave(maps, side);
        println!("wave number {k} along an axis has {times:.2} times the energy of its neighbours");
        assert!(times < STANDS_OUT, "wave number {k}: {times}");
    }
    // A grid with the pitch of the coarsest cells would be found, even one of six bytes.
    for map in &mut maps {
        for (i, value) in map.iter_mut().enumerate() {
            *value += if i % side % (side / 32) == 0 {
                6.0 / 255.0
            } else {
                0.0
            };
        }
    }
    let (k, times) = loudest_wave(&maps, side);
    assert!(
        k % 32 == 0 && times > STANDS_OUT,
        "wave number {k}: {times}"
    );
}
