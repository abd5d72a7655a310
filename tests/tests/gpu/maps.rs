//! Each off-screen pass alone: what a device draws into the map is what the twin computes.

use welkin_pack::{Image, LayerKind, Pack};
use welkin_runtime::params::{LitLayer, LitParams, OctaveParams};
use welkin_runtime::{Camera, Method, SkyParams};
use welkin_tests::renderer::Twin;
use welkin_tests::{gpu, lit_map, map, pack};

const FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba8Unorm;

fn camera() -> Camera {
    Camera::looking(0.0, 0.5, 1.0, [64, 48])
}

/// Largest and mean distance of each channel, in bytes.
fn apart(a: &Image, b: &Image) -> ([f32; 4], [f32; 4]) {
    let (mut worst, mut sum) = ([0.0_f32; 4], [0.0_f64; 4]);
    for (a, b) in a.texels.chunks_exact(4).zip(b.texels.chunks_exact(4)) {
        for channel in 0..4 {
            // Targets of 8 bits hold nothing beyond 0 and 1.
            let off = (a[channel] - b[channel].clamp(0.0, 1.0)).abs() * 255.0;
            worst[channel] = worst[channel].max(off);
            sum[channel] += f64::from(off);
        }
    }
    let texels = a.texels.len() as f64 / 4.0;
    (worst, sum.map(|sum| (sum / texels) as f32))
}

/// Level 0 of every layer is the twin's, and every other level the mean of the one above it.
fn assert_maps_agree(pack: &Pack, cases: &[(SkyParams, f64)]) {
    let twin = Twin::new(pack);
    let mut sky = gpu::sky(pack, FORMAT);
    for (params, seconds) in cases {
        gpu::prepare(&mut sky, params, &camera(), *seconds);
        let frame = twin.frame_without_map(params, &camera(), *seconds);
        let found = gpu::read_map(&sky);
        let expected = frame.top_of_map();
        assert!(found.len() >= expected.len(), "the method draws its map");
        let layers = expected.into_iter().zip(found).zip(frame.map_allowance());
        for (layer, ((expected, found), allowance)) in layers.enumerate() {
            let what = format!("{params:?} at {seconds} s, layer {layer}");
            assert_agree(&what, &expected, found.levels(), allowance);
        }
    }
}

fn assert_agree(
    what: &str,
    expected: &Image,
    levels: &[Image],
    (most, mean): ([f32; 4], [f32; 4]),
) {
    let (worst, found) = apart(&levels[0], expected);
    for channel in 0..4 {
        assert!(
            worst[channel] <= most[channel] && found[channel] <= mean[channel],
            "{what}: channel {channel} is off by {worst:?} of {most:?}, on average by {found:?} of {mean:?}"
        );
    }
    assert_levels(what, levels);
}

/// Every level but the first is the mean of the one above it.
fn assert_levels(what: &str, levels: &[Image]) {
    let top = levels[0].clone();
    assert_eq!(levels.len(), map::with_levels(top).levels().len());
    for (index, pair) in levels.windows(2).enumerate() {
        let (worst, _) = apart(&pair[1], &map::halved(&pair[0]));
        // Rounding to bytes is off by a half, and a float's last digits decide where it is just that.
        assert!(
            worst.iter().all(|&off| off < 0.501),
            "{what}, below level {index}: {worst:?}"
        );
    }
}

fn octaves(octaves: OctaveParams, seconds: f64) -> (SkyParams, f64) {
    let params = SkyParams {
        method: Method::Octaves,
        octaves,
        ..SkyParams::default()
    };
    (params, seconds)
}

#[test]
fn octaves_in_any_number() {
    let defaults = OctaveParams::default();
    let cases: Vec<_> = (1..=8)
        .map(|count| octaves(OctaveParams { count, ..defaults }, 7.0 * f64::from(count)))
        .collect();
    assert_maps_agree(pack::default_pack(), &cases);
}

#[test]
fn octaves_at_any_moment_cover_and_sharpness() {
    let defaults = OctaveParams::default();
    let mut cases = Vec::new();
    for seconds in [0.0, 29.9, 59.999, 60.0, 1e6, -5.0] {
        cases.push(octaves(defaults, seconds));
    }
    for sharpness in [0.0, 0.1] {
        cases.push(octaves(
            OctaveParams {
                sharpness,
                ..defaults
            },
            3.0,
        ));
    }
    for cover in [0.0, 0.2, 0.9, 1.0] {
        let (params, seconds) = octaves(defaults, 44.0);
        cases.push((
            SkyParams {
                cover,
                density: cover,
                time: 0.3,
                ..params
            },
            seconds,
        ));
    }
    assert_maps_agree(pack::default_pack(), &cases);
}

fn fbm(cover: f32, time: f32, seconds: f64) -> (SkyParams, f64) {
    let params = SkyParams {
        method: Method::Fbm,
        cover,
        time,
        ..SkyParams::default()
    };
    (params, seconds)
}

#[test]
fn fbm_at_any_moment_cover_and_place_of_the_sun() {
    let mut cases = vec![fbm(0.0, 0.5, 1.0), fbm(1.0, 0.5, 1.0)];
    for time in [0.26, 0.4, 0.5, 0.6, 0.74, 0.0] {
        cases.push(fbm(0.55, time, 100.0 * f64::from(time)));
    }
    for seconds in [0.0, 600.0, 1e6, -60.0] {
        cases.push(fbm(0.5, 0.45, seconds));
    }
    assert_maps_agree(pack::default_pack(), &cases);
}

#[test]
fn fbm_of_one_octave_and_of_eight() {
    assert_maps_agree(&pack::with_octaves(1), &[fbm(0.5, 0.4, 30.0)]);
    let cases = [fbm(0.5, 0.4, 30.0), fbm(0.7, 0.6, 1e6)];
    assert_maps_agree(&pack::with_octaves(8), &cases);
}

#[test]
fn packed_for_any_place_of_the_sun_and_height() {
    let mut cases = Vec::new();
    for (time, height) in [(0.26, 0.7), (0.4, 0.0), (0.5, 0.7), (0.6, 1.0), (0.0, 0.5)] {
        let params = SkyParams {
            time,
            height,
            ..SkyParams::default()
        };
        cases.push((params, 12.0));
    }
    assert_maps_agree(pack::default_pack(), &cases);
}

fn lit(layers: &[LitLayer]) -> SkyParams {
    SkyParams {
        method: Method::Lit,
        lit: LitParams::with_layers(layers),
        ..SkyParams::default()
    }
}

/// As [`assert_maps_agree`], but each texel is held to what the reads that made it may be off by.
fn assert_layers_agree(cases: &[(SkyParams, f64)]) {
    let pack = pack::default_pack();
    let (twin, kinds) = (Twin::new(pack), lit_map::kinds(pack));
    let mut sky = gpu::sky(pack, FORMAT);
    for (params, seconds) in cases {
        gpu::prepare(&mut sky, params, &camera(), *seconds);
        let frame = twin.frame_without_map(params, &camera(), *seconds);
        let bounds = lit_map::bounds(&frame.uniforms.lit, &kinds, &frame.photo(), params.shading);
        let layers = frame.top_of_map().into_iter().zip(bounds);
        let found = gpu::read_map(&sky);
        for (index, ((expected, bounds), found)) in layers.zip(&found).enumerate() {
            let what = format!("{params:?} at {seconds} s, layer {index}");
            let (mut worst, mut sum) = (0.0_f32, 0.0);
            let texels = expected.texels.iter().zip(&found.levels()[0].texels);
            for ((expected, found), bound) in texels.zip(&bounds.texels) {
                let off = (expected.clamp(0.0, 1.0) - found).abs() * 255.0 / bound;
                worst = worst.max(off);
                sum += off;
            }
            let mean = sum / bounds.texels.len() as f32;
            // Rounding is off by a quarter of its step on average.
            assert!(
                worst <= 1.0 && mean <= 0.25,
                "{what}: {worst} of what may be, {mean} on average"
            );
            assert_levels(&what, found.levels());
        }
    }
}

#[test]
fn lit_of_every_kind_in_any_light() {
    let mut cases = Vec::new();
    for (kind, time) in LayerKind::ALL.into_iter().zip([0.27, 0.5, 0.64]) {
        let day = lit(&[LitLayer::of(kind, 1.0)]);
        cases.push((SkyParams { time, ..day }, 12.0));
        // The moon.
        cases.push((SkyParams { time: 0.95, ..day }, -5.0));
    }
    assert_layers_agree(&cases);
}

#[test]
fn lit_in_any_number_at_any_moment_cover_and_exponent() {
    let kinds = LayerKind::ALL.map(|kind| LitLayer::of(kind, 0.5));
    let (three, six) = (lit(&kinds), lit(&kinds.repeat(2)));
    let mut cases = vec![(six, 1e6)];
    for (cover, m) in [(0.05, 0.5), (0.9, 3.0), (1.0, 16.0)] {
        let mut params = SkyParams {
            cover,
            density: cover,
            time: 0.4,
            ..three
        };
        params.lit.m = m;
        cases.push((params, 1e3 * f64::from(cover)));
    }
    assert_layers_agree(&cases);
}
