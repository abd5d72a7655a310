//! Clouds change their shapes, and never jump.

use glam::{Vec2, Vec3Swizzles, Vec4Swizzles};
use welkin_runtime::internals::frame::Uniforms;
use welkin_runtime::internals::pack_data::PackData;
use welkin_runtime::{Camera, Method, Sky, SkyParams};
use welkin_tests::film::Film;
use welkin_tests::renderer::{Frame, Twin};
use welkin_tests::{camera, dome, gpu, lit, lit_map, octaves_map, pack};

const FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba16Float;
const SIZE: [u32; 2] = [96, 72];

/// One frame of a film.
const FRAME_S: f64 = 1.0 / 30.0;

fn view() -> Camera {
    Camera::looking(2.0, 0.8, 1.0, SIZE)
}

fn params(method: Method) -> SkyParams {
    SkyParams {
        method,
        sun: false,
        flare: 0.0,
        ..SkyParams::default()
    }
}

fn correlation(a: &[f32], b: &[f32]) -> f64 {
    let mean = |v: &[f32]| v.iter().map(|&x| f64::from(x)).sum::<f64>() / v.len() as f64;
    let (mean_a, mean_b) = (mean(a), mean(b));
    let (mut ab, mut aa, mut bb) = (0.0, 0.0, 0.0);
    for (&a, &b) in a.iter().zip(b) {
        let (a, b) = (f64::from(a) - mean_a, f64::from(b) - mean_b);
        ab += a * b;
        aa += a * a;
        bb += b * b;
    }
    ab / (aa * bb).sqrt()
}

#[test]
fn frames_a_minute_apart_are_different_skies() {
    let mut film = Film::new();
    for method in Method::DOMES {
        let frames: Vec<Vec<f32>> = (0..=30)
            .map(|i| film.alpha(&params(method), &view(), 20.0 * f64::from(i)))
            .collect();
        let pairs = frames.iter().zip(&frames[3..]);
        let found: Vec<f64> = pairs.map(|(a, b)| correlation(a, b)).collect();
        let most = found.iter().fold(f64::MIN, |most, &c| most.max(c));
        println!("{}: at most {most:.3} of {found:.2?}", method.name());
        assert!(most < 0.9, "{}: {most}", method.name());
    }
}

/// A channel of a level of the map, with its side.
fn map_channel(sky: &Sky, level: u32, channel: usize) -> (Vec<f32>, usize) {
    let map = sky.cloud_map().expect("the method has a map");
    let texels = gpu::read_level(map, level, 0);
    let values = texels.iter().map(|texel| texel[channel]).collect();
    (values, (map.width() >> level) as usize)
}

/// A tiling image moved by whole texels.
fn shifted(image: &[f32], side: usize, [dx, dy]: [usize; 2]) -> Vec<f32> {
    let row = |y: usize| &image[(y + dy) % side * side..][..side];
    let moved = (0..side).map(|y| [&row(y)[dx..], &row(y)[..dx]].concat());
    moved.collect::<Vec<_>>().concat()
}

/// The best correlation of two tiling images over all shifts: at 64 texels a side first, then around the best at 256.
fn best_correlation(skies: [&Sky; 2], channel: usize) -> f64 {
    let at = |wanted: usize| {
        skies.map(|sky| {
            let side = sky.cloud_map().map_or(0, wgpu::Texture::width) as usize;
            map_channel(sky, (side / wanted).ilog2(), channel)
        })
    };
    let best = |wanted: usize, shifts: &mut dyn Iterator<Item = [usize; 2]>| {
        let [(a, side), (b, _)] = at(wanted);
        let each = shifts.map(|shift| (correlation(&a, &shifted(&b, side, shift)), shift));
        each.max_by(|a, b| a.0.total_cmp(&b.0))
            .expect("there are shifts")
    };
    let mut coarse = (0..64).flat_map(|dy| (0..64).map(move |dx| [dx, dy]));
    let (_, [dx, dy]) = best(64, &mut coarse);
    let near = |d: usize| (d * 4 + 252..d * 4 + 261).map(|d| d % 256);
    let mut fine = near(dy).flat_map(|y| near(dx).map(move |x| [x, y]));
    best(256, &mut fine).0
}

/// With the scrolling taken out there is still change within an interval: the maps do not merely move.
#[test]
fn shapes_change_however_the_map_is_shifted() {
    let lit_s = f64::from(SkyParams::default().lit.formation_interval_s);
    for (method, channel, interval_s) in [
        (Method::Octaves, 1, 60.0),
        (Method::Fbm, 3, 60.0),
        (Method::Lit, 2, lit_s),
    ] {
        let mut skies = [0, 1].map(|_| gpu::sky(pack::default_pack(), FORMAT));
        for start in [0.0, 190.0, 380.0] {
            for (sky, seconds) in skies.iter_mut().zip([start, start + interval_s]) {
                gpu::prepare(sky, &params(method), &view(), seconds);
            }
            let found = best_correlation([&skies[0], &skies[1]], channel);
            println!(
                "{} from {start} s: best of all shifts {found:.3}",
                method.name()
            );
            assert!(found < 0.9, "{} from {start} s: {found}", method.name());
        }
    }
}

/// Offsets that go on with the wind and are kept within a tile, of textures that are read a second time at another scale.
fn offsets(method: Method, uniforms: &Uniforms) -> Vec<f32> {
    match method {
        Method::Packed | Method::Sprites => {
            let packed = &uniforms.packed;
            [packed.photo_offset, packed.noise_offset]
                .map(|offset| offset.to_array())
                .concat()
        }
        Method::Octaves => uniforms.octaves.low.offset.to_array().to_vec(),
        Method::Fbm => uniforms.fbm.offsets[0].to_array().to_vec(),
        Method::Lit => uniforms.lit.layers[0].offset.to_array().to_vec(),
    }
}

/// The first moments at which an offset is taken back by a tile.
fn wraps(facts: &PackData, params: &SkyParams) -> Vec<f64> {
    let at = |seconds: f64| {
        let uniforms = facts.uniforms(params, &view(), seconds, 0.0);
        offsets(params.method, &uniforms)
    };
    let wrap = |index: usize| {
        let jumps = |from: f64, to: f64| (at(to)[index] - at(from)[index]).abs() > 0.5;
        let step = 2.0;
        let from = (0..500)
            .map(|i| f64::from(i) * step)
            .find(|t| jumps(*t, t + step))?;
        let halved = |[low, high]: [f64; 2]| {
            let middle = 0.5 * (low + high);
            if jumps(low, middle) {
                [low, middle]
            } else {
                [middle, high]
            }
        };
        let [low, high] = (0..20).fold([from, from + step], |bounds, _| halved(bounds));
        Some(0.5 * (low + high))
    };
    let count = at(0.0).len();
    (0..count).filter_map(wrap).collect()
}

/// The farthest that anything in the layer moves from one moment to another, in heights of the layer.
fn way(method: Method, from: &Uniforms, to: &Uniforms) -> f32 {
    let apart = |a: Vec2, b: Vec2| ((b - a) - (b - a).round()).length();
    match method {
        Method::Packed | Method::Sprites => {
            let (a, b) = (&from.packed, &to.packed);
            let photo = apart(a.photo_offset, b.photo_offset) / a.photo_scale;
            let noise = apart(a.noise_offset, b.noise_offset) / a.noise_rotation.length();
            photo.max(noise)
        }
        Method::Octaves => {
            let dome = |uniforms: &Uniforms| {
                let octaves = uniforms.octaves;
                [octaves.low, octaves.middle, octaves.high]
            };
            let domes = dome(from).into_iter().zip(dome(to));
            domes
                .map(|(a, b)| {
                    // The shorter axis is the one along which a step of uv is most.
                    let [east, south] = [a.east_axis, a.south_axis].map(Vec2::length);
                    apart(a.offset, b.offset) / east.min(south)
                })
                .fold(0.0, f32::max)
        }
        Method::Fbm => {
            let pairs = from.fbm.offsets.iter().zip(&to.fbm.offsets);
            pairs
                .map(|(a, b)| apart(a.xy(), b.xy()).max(apart(a.zw(), b.zw())))
                .fold(0.0, f32::max)
                / from.fbm.east_axis.length()
        }
        Method::Lit => {
            let pairs = from.lit.layers.iter().zip(&to.lit.layers);
            let layers = pairs.take(from.lit.count as usize);
            layers
                .map(|(a, b)| apart(a.offset, b.offset) / a.east_axis.length())
                .fold(0.0, f32::max)
        }
    }
}

/// The least distance of two neighbouring pixels on the layer, in its heights.
fn finest_pixel(method: Method, uniforms: &Uniforms) -> f32 {
    let plane = |x: u32, y: u32| {
        let pixel = glam::Vec2::new(x as f32 + 0.5, y as f32 + 0.5);
        let direction = camera::ray_of(&uniforms.camera, pixel).normalize();
        match method {
            Method::Lit => direction.xz() * lit::distance(&uniforms.lit, direction),
            _ => dome::intersect(direction).plane,
        }
    };
    let [width, height] = SIZE;
    (1..height)
        .flat_map(|y| (1..width).map(move |x| (x, y)))
        .map(|(x, y)| {
            let here = plane(x, y);
            here.distance(plane(x - 1, y))
                .min(here.distance(plane(x, y - 1)))
        })
        .fold(f32::MAX, f32::min)
}

/// The largest change from a pixel to its neighbours.
fn steepest(alpha: &[f32]) -> f32 {
    let width = SIZE[0] as usize;
    (width..alpha.len())
        .filter(|i| i % width > 0)
        .map(|i| (alpha[i] - alpha[i - 1]).hypot(alpha[i] - alpha[i - width]))
        .fold(0.0, f32::max)
}

/// What reads may change by from one frame to the next beside their motion: two steps of 8-bit filtering, which may be
/// off one way in one frame and the other way in the next, and what octaves and layers form anew.
fn change_of_reads(facts: &PackData, params: &SkyParams, frame: &Frame, seconds: f64) -> Vec<f32> {
    let formed = match params.method {
        Method::Packed | Method::Fbm | Method::Sprites => Vec::new(),
        Method::Octaves => {
            let share = FRAME_S as f32 / params.octaves.formation_interval_s;
            let states = facts.octave_states(params, seconds);
            let amount = octaves_map::most_change_of_amount(&states, share);
            vec![
                octaves_map::slopes(&frame.uniforms.octaves, frame.shading)
                    .map(|slope| slope * amount),
            ]
        }
        Method::Lit => lit_formed(facts, params, frame, seconds),
    };
    let formed = frame.in_order_of_reads(&formed);
    let steps = frame.filter_steps();
    let pairs = formed.iter().zip(&steps);
    pairs.map(|(formed, step)| 2.0 * step + formed).collect()
}

/// By how much the channels of each layer of the map may change: the second read goes on.
fn lit_formed(facts: &PackData, params: &SkyParams, frame: &Frame, seconds: f64) -> Vec<[f32; 4]> {
    let after = facts.uniforms(params, &view(), seconds + FRAME_S, 0.0).lit;
    lit_map::most_change(
        &frame.uniforms.lit,
        &after,
        &lit_map::kinds(pack::default_pack()),
        &frame.photo(),
        params.shading,
    )
}

/// No pixel changes by more from frame to frame than what moves over it and forms in it.
///
/// That is the steepest slope of the picture times the way in pixels: twice, since a pixel's difference is the mean of a
/// slope that may be all in half of it, and octaves that move apart may add their slopes. And what a change of each read
/// is worth in opacity. Some of the moments are the ends of intervals of the first two octaves, others those at which
/// offsets are taken back by a tile.
#[test]
fn nothing_jumps_from_frame_to_frame() {
    let facts = PackData::new(pack::default_pack()).expect("the pack has every role");
    let (mut film, twin) = (Film::new(), Twin::new(pack::default_pack()));
    for method in Method::DOMES {
        for speed in [0.1, 1.0] {
            let params = SkyParams {
                speed,
                ..params(method)
            };
            let mut ends = vec![0.0, 1e5];
            match speed {
                1.0 => ends.extend(wraps(&facts, &params)),
                _ if method == Method::Octaves => ends.extend([60.0, 22.918]),
                _ => {}
            }
            for seconds in ends.into_iter().map(|end| end - FRAME_S / 2.0) {
                let uniforms =
                    [seconds, seconds + FRAME_S].map(|t| facts.uniforms(&params, &view(), t, 0.0));
                let pixels =
                    way(method, &uniforms[0], &uniforms[1]) / finest_pixel(method, &uniforms[0]);
                let [before, after] =
                    [seconds, seconds + FRAME_S].map(|t| film.alpha(&params, &view(), t));
                let mut frame = twin.frame(&params, &view(), seconds);
                let reads = change_of_reads(&facts, &params, &frame, seconds);
                let reads = frame.worth_of_reads(&reads, Frame::opacity);
                let moved = 2.0 * steepest(&before) * pixels;
                let case = format!("{} at speed {speed}, {seconds} s", method.name());
                let mut closest = 0.0_f32;
                for ((a, b), reads) in before.iter().zip(&after).zip(&reads) {
                    // Two half floats of at most 2, off by 2^-11 of it, make an opacity.
                    let (change, bound) = ((a - b).abs(), moved + reads.x + 4.0 / 1024.0);
                    assert!(change < bound, "{case}: {change}, expected {bound}");
                    closest = closest.max(change / bound);
                }
                println!("{case}: {pixels:.4} pixels on, {closest:.2} of what may be");
            }
        }
    }
}
