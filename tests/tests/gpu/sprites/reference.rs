//! The light of sprites against a path tracer through the same bodies.

use glam::{DVec3, Vec2, Vec3};
use rayon::prelude::*;
use welkin_pack::field::{Cloud, CloudKind};
use welkin_pack::{Field, Pack};
use welkin_runtime::params::Shading;
use welkin_runtime::{Camera, SkyParams};
use welkin_tests::pack::default_pack;
use welkin_tests::reference::{Chance, Light, Volume};
use welkin_tests::renderer::Twin;
use welkin_tests::{camera, gpu};

use super::{params, view};

const SIZE: [u32; 2] = [64, 48];

/// Pixels of the drawn picture for one of the reference, along a side.
const FINER: u32 = 4;

/// Paths for each pixel.
const PATHS: u32 = 48;

/// What of the light behind a pixel inside the cloud lets through at most.
const OPAQUE: f32 = 0.02;

/// The cumulus with the most sprites of the default pack, alone in its field, in the middle.
fn lone() -> (Pack, Cloud) {
    let field = default_pack().field().unwrap();
    let heaps = field.clouds.iter().filter(|c| c.kind == CloudKind::Cumulus);
    let mut cloud = heaps.max_by_key(|c| c.sprites.len()).unwrap().clone();
    let by = Vec3::new(4000.0, cloud.centre_m[1], 4000.0) - Vec3::from(cloud.centre_m);
    let shift = |place: &mut [f32; 3]| *place = (Vec3::from(*place) + by).to_array();
    shift(&mut cloud.centre_m);
    cloud.groups_m.iter_mut().for_each(shift);
    cloud.boxes.iter_mut().for_each(|b| shift(&mut b.centre_m));
    cloud
        .sprites
        .iter_mut()
        .for_each(|s| shift(&mut s.centre_m));
    cloud.rank = 0.0;
    let mut field = Field {
        sections: 2,
        clouds: vec![cloud],
        hours: field.hours.clone(),
    };
    field.expose();
    let cloud = field.clouds[0].clone();
    (default_pack().clone().with_field(field).unwrap(), cloud)
}

/// Luminance of the reference, and whether the pixel is inside the cloud.
fn traced(
    volume: &Volume,
    light: &Light,
    frame: &Camera,
    rays: impl Fn(Vec2) -> Vec3 + Sync,
) -> Vec<Option<f32>> {
    let place = frame.position_m;
    (0..SIZE[0] * SIZE[1])
        .into_par_iter()
        .map(|i| {
            let corner = Vec2::new((i % SIZE[0]) as f32, (i / SIZE[0]) as f32);
            let ray = rays(corner + 0.5).normalize();
            if volume.transmittance(place, ray, 20.0) > OPAQUE {
                return None;
            }
            let mut chance = Chance::new(u64::from(i) + 1);
            let paths = (0..PATHS).filter_map(|_| volume.path(place, ray, light, &mut chance));
            let (count, sum) = paths.fold((0, 0.0), |(n, sum), l| (n + 1, sum + l));
            (count > 0).then(|| sum / count as f32)
        })
        .collect()
}

/// Luminance of the picture that the device draws, at the size of the reference.
fn drawn(pack: &Pack, params: &SkyParams, frame: &Camera) -> Vec<f32> {
    let format = wgpu::TextureFormat::Rgba16Float;
    let mut sky = gpu::sky(pack, format);
    let large = Camera {
        viewport_px: SIZE.map(|side| FINER * side),
        ..*frame
    };
    let picture = gpu::rgb(&gpu::render(&mut sky, format, params, &large, 0.0));
    let width = FINER * SIZE[0];
    (0..SIZE[0] * SIZE[1])
        .map(|i| {
            let [x, y] = [FINER * (i % SIZE[0]), FINER * (i / SIZE[0])];
            let texels = (0..FINER * FINER).map(|k| {
                let at = (y + k / FINER) * width + x + k % FINER;
                luminance(picture[at as usize])
            });
            texels.sum::<f32>() / (FINER * FINER) as f32
        })
        .collect()
}

fn luminance(colour: Vec3) -> f32 {
    colour.dot(Vec3::new(0.2126, 0.7152, 0.0722))
}

/// The mean of a value's neighbours that are there: noise and the sheet's knobs are nothing that both can have alike.
fn smoothed(picture: &[Option<f32>]) -> Vec<Option<f32>> {
    let [width, height] = SIZE.map(i64::from);
    let at = |x: i64, y: i64| {
        let inside = (0..width).contains(&x) && (0..height).contains(&y);
        inside.then(|| picture[(y * width + x) as usize]).flatten()
    };
    let pixels = (0..height).flat_map(|y| (0..width).map(move |x| (x, y)));
    let mean = |(x, y): (i64, i64)| {
        at(x, y)?;
        let around = (-1..=1).flat_map(|j| (-1..=1).map(move |i| (i, j)));
        let values: Vec<f32> = around.filter_map(|(i, j)| at(x + i, y + j)).collect();
        // Not at the rim, where one has a cloud and the other may not.
        (values.len() == 9).then(|| values.iter().sum::<f32>() / 9.0)
    };
    pixels.map(mean).collect()
}

/// Pearson's correlation.
fn correlation(pairs: &[(usize, f32, f32)]) -> f32 {
    let mean = |value: &dyn Fn(&(usize, f32, f32)) -> f32| {
        pairs.iter().map(value).sum::<f32>() / pairs.len() as f32
    };
    let (a, b) = (mean(&|p| p.1), mean(&|p| p.2));
    let covariance = mean(&|p| (p.1 - a) * (p.2 - b));
    let variances = mean(&|p| (p.1 - a).powi(2)) * mean(&|p| (p.2 - b).powi(2));
    covariance / variances.sqrt()
}

/// Mean of the upper quarter of the pixels over that of the lower quarter.
fn tops_over_bases(pairs: &[(usize, f32, f32)], value: fn(&(usize, f32, f32)) -> f32) -> f32 {
    let mean = |part: &[(usize, f32, f32)]| part.iter().map(value).sum::<f32>() / part.len() as f32;
    let quarter = pairs.len() / 4;
    mean(&pairs[..quarter]) / mean(&pairs[pairs.len() - quarter..])
}

#[test]
fn light_on_sprites_is_that_of_a_path_tracer() {
    let (pack, cloud) = lone();
    let volume = Volume::new(&cloud);
    let twin = Twin::new(&pack);
    let middle = Vec3::from(cloud.centre_m).as_dvec3();
    let views = [
        ("south", DVec3::new(0.0, -100.0, 1900.0), 0.0, 3.0),
        ("west", DVec3::new(-1900.0, 0.0, 0.0), 90.0, 0.0),
        ("below", DVec3::new(900.0, -900.0, 900.0), -45.0, 36.0),
    ];
    let mut missed = Vec::new();
    for (hour, time) in [("noon", 0.5), ("afternoon", 0.68), ("sunset", 0.735)] {
        let params = SkyParams {
            cover: 0.4,
            time,
            shading: Shading::Scattered,
            ..params()
        };
        for (name, from, azimuth, elevation) in views {
            let frame = view(middle + from, azimuth, elevation, SIZE);
            let uniforms = twin.frame(&params, &frame, 0.0).uniforms;
            let own = &uniforms.sprites;
            let [sunlight, sky] = [own.light, own.ambient].map(luminance);
            let light = Light {
                to_sun: own.light_direction,
                sunlight,
                sky,
                // A ground of an albedo of 0.2 under both.
                ground: 0.2 * (sunlight * own.light_direction.y.max(0.0) + sky),
            };
            let traced = traced(&volume, &light, &frame, |pixel| {
                camera::ray_of(&uniforms.camera, pixel)
            });
            let drawn = drawn(&pack, &params, &frame);
            let shown: Vec<Option<f32>> = traced
                .iter()
                .zip(&drawn)
                .map(|(traced, drawn)| traced.map(|_| *drawn))
                .collect();
            let pairs: Vec<(usize, f32, f32)> = smoothed(&traced)
                .into_iter()
                .zip(smoothed(&shown))
                .enumerate()
                .filter_map(|(i, (a, b))| Some((i, a?, b?)))
                .collect();
            let correlation = correlation(&pairs);
            let [expected, found] = [
                tops_over_bases(&pairs, |p| p.1),
                tops_over_bases(&pairs, |p| p.2),
            ];
            println!(
                "{hour} {name}: {} pixels, correlation {correlation:.2}, tops over bases {found:.2}, {expected:.2} traced",
                pairs.len()
            );
            assert!(pairs.len() > 150, "{hour} {name}: {} pixels", pairs.len());
            if correlation < 0.85 || (found / expected - 1.0).abs() > 0.25 {
                missed.push(format!("{hour} {name}"));
            }
        }
    }
    assert!(missed.is_empty(), "{missed:?}");
}
