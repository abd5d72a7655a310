//! Several views of one sky in one submission.

use welkin_runtime::{Axes, Camera, Method, SkyParams};
use welkin_tests::{gpu, pack};

const FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba16Float;
const SIZE: [u32; 2] = [64, 48];

/// A view's parameters, camera and seconds.
type Seen = (SkyParams, Camera, f64);

/// Alike in nothing: hour, cover, place, direction and moment.
fn seen(method: Method) -> [Seen; 2] {
    let mut params = SkyParams {
        method,
        time: 0.03,
        moon: 0.2,
        cover: 0.3,
        ..SkyParams::default()
    };
    params.weather.rays = 1.0;
    let night = (params, Camera::looking(3.0, 0.6, 1.1, SIZE), 40.0);
    params.time = 0.7;
    params.cover = 0.6;
    params.weather.rain = 0.3;
    let mut camera = Camera::looking(4.4, 0.2, 0.8, SIZE);
    camera.position_m = glam::Vec3::new(900.0, 300.0, -2000.0);
    [night, (params, camera, 7.0)]
}

/// Both, side by side in one pass: the sky's own view and another.
fn side_by_side(seen: &[Seen; 2]) -> [Vec<[f32; 4]>; 2] {
    let target = gpu::target(FORMAT, [2 * SIZE[0], SIZE[1]], 1);
    let mut sky = gpu::sky(pack::default_pack(), FORMAT);
    let mut other = sky.view();
    let gpu = gpu::gpu();
    let mut encoder = gpu.device.create_command_encoder(&Default::default());
    let [(params, camera, seconds), (second, from, at)] = seen;
    sky.prepare(&gpu.queue, &mut encoder, params, camera, *seconds);
    other.prepare(&sky, &gpu.queue, &mut encoder, second, from, *at);
    gpu.queue.submit([encoder.finish()]);
    let [width, height] = SIZE.map(|side| side as f32);
    gpu::pass(&target, None, None, |pass| {
        pass.set_viewport(0.0, 0.0, width, height, 0.0, 1.0);
        sky.draw(pass);
        pass.set_viewport(width, 0.0, width, height, 0.0, 1.0);
        other.draw(pass);
    });
    let texels = gpu::read(&target);
    [0, 1].map(|half| {
        let row = |row: &[[f32; 4]]| row[half * SIZE[0] as usize..][..SIZE[0] as usize].to_vec();
        texels.chunks(2 * SIZE[0] as usize).flat_map(row).collect()
    })
}

/// What pixels may be apart: the place of a pixel in a viewport is rounded otherwise, and stars are points.
const CLOSE: f32 = 2e-3;

#[test]
fn two_views_in_one_pass_show_what_each_alone_does() {
    for method in Method::ALL {
        let seen = seen(method);
        let found = side_by_side(&seen);
        for (index, ((params, camera, seconds), found)) in seen.iter().zip(&found).enumerate() {
            let mut alone = gpu::sky(pack::default_pack(), FORMAT);
            let expected = gpu::render(&mut alone, FORMAT, params, camera, *seconds);
            for (pixel, (a, b)) in found.iter().zip(&expected).enumerate() {
                let apart = a.iter().zip(b).map(|(a, b)| (a - b).abs() / (0.1 + b));
                let most = apart.fold(0.0, f32::max);
                assert!(
                    most < CLOSE,
                    "{method:?} {index} pixel {pixel}: {a:?} {b:?}"
                );
            }
        }
        assert_ne!(found[0], found[1], "{method:?}");
    }
}

#[test]
fn another_view_compiles_nothing_anew() {
    let mut sky = gpu::sky(pack::default_pack(), FORMAT);
    let mut other = sky.view();
    for method in Method::ALL {
        let before = sky.pipelines_made();
        let [_, (params, camera, seconds)] = seen(method);
        gpu::prepare(&mut sky, &params, &camera, seconds);
        let made = sky.pipelines_made();
        assert!(made > before, "{method:?}");
        let gpu = gpu::gpu();
        let mut encoder = gpu.device.create_command_encoder(&Default::default());
        other.prepare(&sky, &gpu.queue, &mut encoder, &params, &camera, seconds);
        gpu.queue.submit([encoder.finish()]);
        assert_eq!(sky.pipelines_made(), made, "{method:?}");
    }
}

/// A world with its up along +Z, in centimetres, shows the same sky as that with +Y and metres.
#[test]
fn any_up_shows_the_same_sky() {
    use glam::camera::rh::{proj::directx as projection, view};
    use glam::{Mat4, Vec3};
    let lens = |near| projection::perspective_infinite_reverse(1.0, 4.0 / 3.0, near);
    let axes = Axes::new(Vec3::Z, Vec3::Y, 0.01).expect("axes");
    let eye = Vec3::new(900.0, 1300.0, -2000.0);
    let way = Vec3::new(-0.8, 0.15, 0.6);
    let metres: Mat4 = view::look_to_mat4(eye, way.normalize(), Vec3::Y);
    let of = |v: Vec3| axes.from_sky(v);
    let centimetres: Mat4 = view::look_to_mat4(of(eye) * 100.0, of(way).normalize(), Vec3::Z);
    let one = Camera::from_matrices(metres, lens(0.1), SIZE);
    let other = axes.camera(centimetres, lens(10.0), SIZE);
    for method in [Method::Octaves, Method::Sprites] {
        let [_, (params, _, seconds)] = seen(method);
        let mut sky = gpu::sky(pack::default_pack(), FORMAT);
        let [a, b] = [one, other].map(|camera| {
            sky.reset_history();
            gpu::render(&mut sky, FORMAT, &params, &camera, seconds)
        });
        let apart = a.iter().flatten().zip(b.iter().flatten());
        let mean = apart.map(|(a, b)| (a - b).abs()).sum::<f32>() / (4 * a.len()) as f32;
        assert!(mean < 1e-3, "{method:?}: {mean}");
    }
}
