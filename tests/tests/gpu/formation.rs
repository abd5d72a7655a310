//! What changes a map beside its motion, new states of octaves and a sun that moves on, never makes it jump.

use welkin_pack::{LayerKind, Role};
use welkin_runtime::internals::clouds::fbm::pack::SHADE_BYTES;
use welkin_runtime::internals::clouds::lit::map::WEIGHTS;
use welkin_runtime::internals::clouds::octaves::map::NOISE_SIDE;
use welkin_runtime::internals::pack_data::PackData;
use welkin_runtime::params::{LitLayer, LitParams};
use welkin_runtime::{Camera, Method, Sky, SkyParams};
use welkin_tests::lit_map::even;
use welkin_tests::octaves_map::{most_change, most_change_of_amount};
use welkin_tests::photo::Photo;
use welkin_tests::texture::Texture;
use welkin_tests::{gpu, lit_map, pack};

const FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba8Unorm;

/// One frame of a film.
const FRAME_S: f64 = 1.0 / 30.0;

fn view() -> Camera {
    Camera::looking(0.0, 0.5, 1.0, [16, 16])
}

fn facts() -> PackData {
    PackData::new(pack::default_pack()).expect("the pack has every role")
}

fn octaves() -> SkyParams {
    SkyParams {
        method: Method::Octaves,
        ..SkyParams::default()
    }
}

/// The share of an interval that a frame takes.
fn frame_share(params: &SkyParams) -> f32 {
    FRAME_S as f32 / params.octaves.formation_interval_s
}

fn farthest(a: &[f32], b: &[f32]) -> f32 {
    a.iter()
        .zip(b)
        .map(|(a, b)| (a - b).abs())
        .fold(0.0, f32::max)
}

#[test]
fn octaves_form_anew_without_a_jump_in_any_frame_of_three_intervals() {
    let (facts, params) = (facts(), octaves());
    let cells = (NOISE_SIDE * NOISE_SIDE) as usize;
    let mut before = facts.octave_states(&params, 0.0);
    let most = most_change(&before, frame_share(&params));
    let mut seen = vec![0.0_f32; most.len()];
    for frame in 1..=(3.0 * 60.0 / FRAME_S) as u32 {
        let after = facts.octave_states(&params, f64::from(frame) * FRAME_S);
        let pairs = before.chunks_exact(cells).zip(after.chunks_exact(cells));
        for (octave, (a, b)) in pairs.enumerate() {
            let change = farthest(a, b);
            assert!(
                change <= most[octave],
                "frame {frame}, octave {octave}: {change}, at most {}",
                most[octave]
            );
            seen[octave] = seen[octave].max(change);
        }
        before = after;
    }
    println!("octaves change by at most {seen:?} of {most:?} a frame");
    // The bound is no empty one: near its middle an interval comes close to it.
    assert!(
        seen.iter()
            .zip(&most)
            .all(|(seen, most)| *seen > 0.5 * most),
        "{seen:?} of {most:?}"
    );
}

/// One channel of level 0 of the map, in bytes.
fn bytes(sky: &Sky, channel: usize) -> Vec<f32> {
    let texels = gpu::read(sky.cloud_map().expect("the method has a map"));
    texels.iter().map(|texel| texel[channel] * 255.0).collect()
}

#[test]
fn the_map_of_octaves_changes_by_what_its_states_do() {
    let (facts, params) = (facts(), octaves());
    let mut sky = gpu::sky(pack::default_pack(), FORMAT);
    // Every octave begins its intervals at another moment: those within a minute, and the first frame of all.
    let golden = 0.618_033_988_749_894_9_f64;
    let turns = (0..4).map(|octave| (f64::from(octave) * golden).fract());
    for boundary in turns.map(|turn| 60.0 * (1.0 - turn)).chain([0.0, 6e5]) {
        let mut map = |seconds: f64| {
            gpu::prepare(&mut sky, &params, &view(), seconds);
            bytes(&sky, 0)
        };
        let (before, after) = (map(boundary - FRAME_S / 2.0), map(boundary + FRAME_S / 2.0));
        let states = facts.octave_states(&params, boundary);
        // Both maps are rounded to the nearest byte.
        let most = (most_change_of_amount(&states, frame_share(&params)) * 255.0).ceil();
        let change = farthest(&before, &after).round();
        println!("at {boundary:.3} s: {change} bytes of {most}");
        assert!(
            change <= most,
            "at {boundary} s: {change} bytes, at most {most}"
        );
    }
}

fn layer(kind: LayerKind) -> SkyParams {
    SkyParams {
        method: Method::Lit,
        speed: 0.0,
        lit: LitParams::with_layers(&[LitLayer::of(kind, 1.0)]),
        ..SkyParams::default()
    }
}

/// Channels of the map: amount of cloud, opacity, shade.
const LIT_CHANNELS: [usize; 3] = [1, 2, 3];

#[test]
fn the_map_of_layers_changes_by_what_its_second_read_does() {
    let (facts, kinds) = (facts(), lit_map::kinds(pack::default_pack()));
    let clouds = Texture::new(pack::default_pack(), Role::Clouds);
    let mut sky = gpu::sky(pack::default_pack(), FORMAT);
    for kind in LayerKind::ALL {
        let params = layer(kind);
        for seconds in [0.0, 100.0, 239.99, 1e6] {
            let moments = [seconds, seconds + FRAME_S];
            let [from, to] = moments.map(|t| facts.uniforms(&params, &view(), t, 0.0).lit);
            let photo = Photo {
                clouds: &clouds,
                uniforms: facts.uniforms(&params, &view(), seconds, 0.0).photo,
            };
            let most = lit_map::most_change(&from, &to, &kinds, &photo, params.shading)[0];
            let [before, after] = moments.map(|t| {
                gpu::prepare(&mut sky, &params, &view(), t);
                LIT_CHANNELS.map(|channel| bytes(&sky, channel))
            });
            for (i, channel) in LIT_CHANNELS.into_iter().enumerate() {
                // Both maps are rounded to the nearest byte.
                let bound = (most[channel] * 255.0).ceil();
                let change = farthest(&before[i], &after[i]).round();
                println!("{kind:?} at {seconds} s, channel {channel}: {change} bytes of {bound}");
                assert!(
                    change <= bound,
                    "{kind:?} at {seconds} s, channel {channel}: {change} bytes, at most {bound}"
                );
            }
        }
    }
}

fn correlation(a: &[f32], b: &[f32]) -> f32 {
    let mean = |v: &[f32]| v.iter().sum::<f32>() / v.len() as f32;
    let (mean_a, mean_b) = (mean(a), mean(b));
    let product = |a: &[f32], mean_a: f32, b: &[f32], mean_b: f32| -> f32 {
        let pairs = a.iter().zip(b);
        pairs.map(|(a, b)| (a - mean_a) * (b - mean_b)).sum()
    };
    let squares = product(a, mean_a, a, mean_a) * product(b, mean_b, b, mean_b);
    product(a, mean_a, b, mean_b) / squares.sqrt()
}

/// Places of a tile that have nothing to do with each other: lumps of stratocumulus are a twelfth of the tile.
const PLACES: f32 = 144.0;

/// In still air: what was cloud dissolves, as much forms elsewhere.
#[test]
fn layers_form_and_dissolve_where_they_stand() {
    let mut sky = gpu::sky(pack::default_pack(), FORMAT);
    let cover = 0.3;
    let params = SkyParams {
        cover,
        ..layer(LayerKind::Stratocumulus)
    };
    let interval_s = f64::from(params.lit.formation_interval_s);
    let mut amounts = |intervals: f64| {
        gpu::prepare(&mut sky, &params, &view(), intervals * interval_s);
        bytes(&sky, 1)
    };
    let start = amounts(0.0);
    let mut last = 1.0;
    for intervals in [0.1, 0.3, 1.0] {
        let now = correlation(&start, &amounts(intervals));
        println!("after {intervals} intervals: {now:.3}");
        assert!(
            now < last,
            "after {intervals} intervals: {now}, {last} before"
        );
        last = now;
    }
    // The second read then has nothing to do with what it was: of the variances the first's is left. Two fields correlate by chance
    // by 1 / sqrt n, and the blends by (2 a b + b^2) / (a^2 + b^2) of that.
    let [a, b] = WEIGHTS;
    let both = a * a + b * b;
    let (mut correlations, mut shares, mut dissolved) = (0.0, 0.0, 0.0);
    let count = 8;
    for i in 1..=count {
        let now = amounts(2.0 * f64::from(i));
        let cloud = |amount: f32| amount > 255.0 * (1.0 - cover);
        let pairs = start.iter().zip(&now);
        let gone = pairs.filter(|(a, b)| cloud(**a) && !cloud(**b)).count() as f32;
        shares += now.iter().filter(|a| cloud(**a)).count() as f32 / now.len() as f32;
        dissolved += gone / now.len() as f32 / cover;
        correlations += correlation(&start, &now);
    }
    let mean = |sum: f32| sum / count as f32;
    let chance = 5.0 / (PLACES * count as f32).sqrt();
    let (correlation, share, dissolved) = (mean(correlations), mean(shares), mean(dissolved));
    println!(
        "later: correlation {correlation:.3}, share {share:.3}, {dissolved:.3} of it dissolved"
    );
    let bound = chance * (2.0 * a * b + b * b) / both;
    assert!((correlation - a * a / both).abs() < bound, "{correlation}");
    assert!(
        (share - cover).abs() < chance * (cover * (1.0 - cover)).sqrt(),
        "{share}"
    );
}

/// Mean distance of two maps, in bytes.
fn mean_apart(a: &[f32], b: &[f32]) -> f32 {
    a.iter().zip(b).map(|(a, b)| (a - b).abs()).sum::<f32>() / a.len() as f32
}

/// What two blends of even numbers are apart on average if only the smaller part of them is another, in bytes.
fn lit_apart() -> f32 {
    let count = 40;
    let place = |i: usize| (i as f32 + 0.5) / count as f32;
    let [larger, smaller] = WEIGHTS;
    let blend = |i: usize, j: usize| even(larger * place(i) + smaller * place(j));
    let triples =
        (0..count * count * count).map(|i| [i % count, i / count % count, i / count / count]);
    let apart =
        triples.map(|[first, before, after]| (blend(first, before) - blend(first, after)).abs());
    255.0 * apart.sum::<f32>() / (count * count * count) as f32
}

/// The other way round: a minute is another sky, a day long interval hardly another one.
#[test]
fn the_formation_interval_says_how_fast() {
    let mut sky = gpu::sky(pack::default_pack(), FORMAT);
    let mut apart = |params: &SkyParams, channel: usize| {
        let [a, b] = [10.0, 70.0].map(|seconds| {
            gpu::prepare(&mut sky, params, &view(), seconds);
            bytes(&sky, channel)
        });
        mean_apart(&a, &b)
    };
    let mut octaves = |formation_interval_s: f32| {
        // The photo's shapes stay.
        let mut params = SkyParams {
            photo: 0.0,
            ..octaves()
        };
        params.octaves.formation_interval_s = formation_interval_s;
        apart(&params, 0)
    };
    // After three intervals states are independent: two numbers, evenly distributed over 255 bytes, are 85 apart on
    // average. A map has some 235 independent places (see cover.rs), so 15 is three deviations of 60 / sqrt 235 and more.
    let (fast, slow) = (octaves(20.0), octaves(86_400.0));
    println!(
        "a minute changes the octaves by {fast:.1} bytes, with a day long interval by {slow:.2}"
    );
    assert!((70.0..100.0).contains(&fast), "{fast}");
    assert!(slow < 1.0, "{slow}");
    let mut lit = |formation_interval_s: f32| {
        let mut params = SkyParams {
            photo: 0.0,
            ..layer(LayerKind::Stratocumulus)
        };
        params.lit.formation_interval_s = formation_interval_s;
        apart(&params, 1)
    };
    let (fast, slow, expected) = (lit(20.0), lit(86_400.0), lit_apart());
    println!(
        "the layers by {fast:.1} bytes of {expected:.1}, with a day long interval by {slow:.2}"
    );
    // Distances that spread as much as they are, at so many places.
    let bound = 3.0 * expected / PLACES.sqrt();
    assert!(
        (fast - expected).abs() < bound,
        "{fast}, expected {expected}"
    );
    assert!(slow < 1.0, "{slow}");
}

/// Times of day, next to each other as 32-bit numbers can be, between which octaves are packed anew.
fn repacks(facts: &PackData, from: f32, to: f32) -> Vec<[f32; 2]> {
    let step = |time: f32| {
        let params = SkyParams {
            time,
            ..SkyParams::default()
        };
        facts.uniforms(&params, &view(), 0.0, 0.0).fbm.sun_step
    };
    let mut found = Vec::new();
    let steps = 400;
    for i in 0..steps {
        let at = |i: i32| from + (to - from) * i as f32 / steps as f32;
        let (mut low, mut high) = (at(i), at(i + 1));
        if step(low) == step(high) {
            continue;
        }
        while high.to_bits() - low.to_bits() > 1 {
            let middle = f32::from_bits((low.to_bits() + high.to_bits()) / 2);
            if step(middle) == step(low) {
                low = middle;
            } else {
                high = middle;
            }
        }
        found.push([low, high]);
    }
    found
}

/// What the runtime promises: a sun that enters another cell changes the shade by few steps of a byte.
#[test]
fn a_sun_that_moves_on_does_not_change_the_shade_by_more_than_is_promised() {
    let facts = facts();
    let mut sky = gpu::sky(pack::default_pack(), FORMAT);
    let moments = repacks(&facts, 0.255, 0.745);
    assert!(moments.len() > 300, "{} times a day", moments.len());
    let (mut worst, mut beyond_two) = ((0.0_f32, 0.0), 0.0_f32);
    for [before, after] in moments.into_iter().step_by(7) {
        let mut map = |time: f32| {
            let params = SkyParams {
                method: Method::Fbm,
                time,
                ..SkyParams::default()
            };
            gpu::prepare(&mut sky, &params, &view(), 12.0);
            [0, 1, 3].map(|channel| bytes(&sky, channel))
        };
        let ([shade, sum, cover], [new_shade, new_sum, new_cover]) = (map(before), map(after));
        assert!(
            sum == new_sum && cover == new_cover,
            "only the shade follows the sun"
        );
        let change = farthest(&shade, &new_shade).round();
        if change > worst.0 {
            worst = (change, before);
        }
        let many = shade
            .iter()
            .zip(&new_shade)
            .filter(|(a, b)| (*a - *b).abs() > 2.5)
            .count();
        beyond_two = beyond_two.max(many as f32 / shade.len() as f32);
    }
    let (change, time) = worst;
    println!(
        "re-packing changes the shade by at most {change} bytes, at time {time}; {beyond_two} of a map by more than 2"
    );
    assert!(change <= SHADE_BYTES, "{change} bytes at time {time}");
    assert!(
        beyond_two < 0.01,
        "{beyond_two} of a map changes by more than 2 bytes"
    );
}
