//! The light on clouds: a low sun from the side, and the dark of a storm, in every method.

use std::f32::consts::TAU;

use glam::Vec3;
use welkin_runtime::internals::geometry::math::luminance;
use welkin_runtime::params::FbmParams;
use welkin_runtime::{Camera, Method, Sky, SkyParams};
use welkin_tests::renderer::Twin;
use welkin_tests::{gpu, pack};

const FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba16Float;
const SIZE: [u32; 2] = [48, 32];
const SECONDS: f64 = 30.0;

/// Without the sun and its flare.
fn params(method: Method) -> SkyParams {
    SkyParams {
        method,
        sun: false,
        flare: 0.0,
        ..SkyParams::default()
    }
}

fn drawn(sky: &mut Sky, params: &SkyParams, view: &Camera) -> Vec<Vec3> {
    gpu::rgb(&gpu::render(sky, FORMAT, params, view, SECONDS))
}

fn mean(values: impl Iterator<Item = f32>) -> f32 {
    let (sum, count) = values.fold((0.0, 0), |(sum, count), value| (sum + value, count + 1));
    sum / count as f32
}

/// Mean luminance of a band of that elevation, all round.
fn band(sky: &mut Sky, params: &SkyParams, elevation_rad: f32) -> f32 {
    mean((0..6).flat_map(|side| {
        let view = Camera::looking(TAU * side as f32 / 6.0, elevation_rad, 0.1, SIZE);
        let pixels = drawn(sky, params, &view);
        pixels.into_iter().map(luminance)
    }))
}

/// Elevations in radians, and the height of the zone of the sphere that each stands for.
const BANDS: [(f32, f32); 5] = [
    (0.05, 0.12),
    (0.25, 0.28),
    (0.60, 0.35),
    (1.05, 0.20),
    (1.50, 0.05),
];

/// The luminance of a storm's sky is at most 0.6 of a fair noon's, and it is darker overhead than in the slit over the horizon.
#[test]
fn a_storm_is_darker_than_noon_and_lighter_at_the_horizon() {
    for method in Method::ALL {
        let mut sky = gpu::sky(pack::default_pack(), FORMAT);
        let storm = SkyParams {
            cover: 0.95,
            density: 0.8,
            upper_layer: 0.0,
            fbm: FbmParams::STORMY,
            ..params(method)
        };
        let mut bands = |params: &SkyParams| BANDS.map(|(at, _)| band(&mut sky, params, at));
        let [noon, storm] = [params(method), storm].map(|params| bands(&params));
        let whole = |bands: [f32; 5]| {
            let weighed = bands.iter().zip(BANDS).map(|(l, (_, height))| l * height);
            weighed.sum::<f32>()
        };
        let ratio = whole(storm) / whole(noon);
        assert!(ratio < 0.6, "{}: {ratio}", method.name());
        let [horizon, .., high, zenith] = storm;
        let zenith = 0.5 * (high + zenith);
        assert!(horizon > 1.1 * zenith, "{}: {storm:?}", method.name());
    }
}

/// The evening at which the sun is 3 degrees high.
fn evening(method: Method) -> SkyParams {
    let noon_rad = pack::default_pack().manifest().noon_elevation_rad;
    let sine = 3.0_f32.to_radians().sin() / noon_rad.sin();
    SkyParams {
        time: 0.75 - sine.asin() / TAU,
        ..params(method)
    }
}

/// A view 15 to 40 degrees high, so far to the right of the sun.
fn beside_the_sun(params: &SkyParams, away_rad: f32) -> Camera {
    let noon_rad = pack::default_pack().manifest().noon_elevation_rad;
    let [east, _, south] = welkin_pack::mapping::sun_direction(params.time, noon_rad);
    let azimuth = east.atan2(-south);
    let view_rad = 25.0_f32.to_radians();
    Camera::looking(azimuth + away_rad, 27.5_f32.to_radians(), view_rad, SIZE)
}

/// Opposite a low sun clouds show the side that it shines on: they are no darker than beside it by more than a fifth, and
/// the warmest of the sky.
#[test]
fn clouds_opposite_a_low_sun_are_lit_and_warm() {
    for method in Method::ALL {
        let mut sky = gpu::sky(pack::default_pack(), FORMAT);
        let cloudy = SkyParams {
            cover: 0.5,
            ..evening(method)
        };
        let clear = SkyParams {
            cover: 0.0,
            upper_layer: 0.0,
            ..cloudy
        };
        // Where the picture differs from a clear sky by a quarter there is a cloud.
        let mut clouds = |away_rad: f32| {
            let view = beside_the_sun(&cloudy, away_rad);
            let [with, without] = [cloudy, clear].map(|params| drawn(&mut sky, &params, &view));
            let pairs = with.into_iter().zip(without);
            let apart =
                |(a, b): &(Vec3, Vec3)| (*a - *b).abs().max_element() > 0.25 * b.max_element();
            let found: Vec<Vec3> = pairs.filter(apart).map(|(cloud, _)| cloud).collect();
            assert!(found.len() > 40, "{}: {}", method.name(), found.len());
            found.iter().sum::<Vec3>() / found.len() as f32
        };
        let [opposite, left, right] = [0.5, 0.25, -0.25].map(|turns: f32| clouds(turns * TAU));
        let abeam = 0.5 * luminance(left + right);
        assert!(
            luminance(opposite) > 0.8 * abeam,
            "{}: {opposite}, {left} and {right} beside the sun",
            method.name()
        );
        assert!(
            opposite.x > 1.3 * opposite.z,
            "{}: {opposite}",
            method.name()
        );
    }
}

/// Before a low sun the middle of a cloud is darker than the edge that lets its light through.
#[test]
fn clouds_before_a_low_sun_are_dark_with_bright_rims() {
    let twin = Twin::new(pack::default_pack());
    for method in Method::DOMES {
        let mut sky = gpu::sky(pack::default_pack(), FORMAT);
        let cloudy = SkyParams {
            // Dense enough that all methods have some that nothing shines through.
            cover: 0.6,
            density: 0.8,
            ..evening(method)
        };
        let view = beside_the_sun(&cloudy, 0.0);
        let picture = drawn(&mut sky, &cloudy, &view);
        let mut frame = twin.frame_without_map(&cloudy, &view, SECONDS);
        frame.map = gpu::read_map(&sky);
        let opacity = frame.opacity();
        // The thinnest and the thickest eighth of the clouds that are there.
        let pixels = picture.iter().zip(&opacity);
        let mut clouds: Vec<(f32, f32)> = pixels
            .filter(|(_, opacity)| opacity.x > 0.2)
            .map(|(colour, opacity)| (opacity.x, luminance(*colour)))
            .collect();
        clouds.sort_by(|a, b| a.0.total_cmp(&b.0));
        let share = clouds.len() / 8;
        assert!(share > 20, "{}: {share}", method.name());
        let of = |clouds: &[(f32, f32)]| mean(clouds.iter().map(|(_, luminance)| *luminance));
        let [rim, middle] = [&clouds[..share], &clouds[clouds.len() - share..]].map(of);
        assert!(middle < 0.8 * rim, "{}: {middle} and {rim}", method.name());
    }
}
