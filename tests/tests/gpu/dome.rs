//! The papers' dome mesh and the analytic dome are the same dome.

use glam::{Vec2, Vec3};
use welkin_runtime::internals::clouds::lit;
use welkin_runtime::internals::geometry::dome;
use welkin_runtime::internals::geometry::dome::{Mesh, Vertex};
use welkin_runtime::{Camera, Method, Sky, SkyConfig, SkyParams};
use welkin_tests::renderer::Twin;
use welkin_tests::{compare, gpu, pack};

/// The triangles of a strip that have an area.
fn triangles(mesh: &Mesh) -> Vec<[Vertex; 3]> {
    let corners = |w: &[u16]| [w[0], w[1], w[2]].map(|i| mesh.vertices[usize::from(i)]);
    mesh.indices
        .windows(3)
        .filter(|w| w[0] != w[1] && w[1] != w[2] && w[0] != w[2])
        .map(corners)
        .collect()
}

/// The largest distance between interpolated and analytic coordinates, in the middle of every triangle.
fn worst_uv_error(mesh: &Mesh, intersect: impl Fn(Vec3) -> Vec3) -> f32 {
    let mut worst = 0.0_f32;
    for triangle in triangles(mesh) {
        let position = triangle
            .iter()
            .map(|v| Vec3::from(v.position))
            .sum::<Vec3>()
            / 3.0;
        let uv = triangle.iter().map(|v| Vec2::from(v.uv)).sum::<Vec2>() / 3.0;
        let hit = intersect(position.normalize());
        worst = worst.max(uv.distance(Vec2::new(hit.x, hit.z)));
    }
    worst
}

#[test]
fn coordinates_of_the_mesh_converge_to_the_analytic_ones_with_the_square_of_the_step() {
    let errors = [10.0, 5.0, 2.5].map(|step_deg| {
        worst_uv_error(&dome::mesh(step_deg), |towards| {
            dome::intersect(towards).position
        })
    });
    println!("worst error in heights of the layer: {errors:?}");
    for pair in errors.windows(2) {
        let ratio = pair[0] / pair[1];
        // 4 in the limit; terms of third order move it by the step over the curvature, some 10 %.
        assert!((3.4..4.6).contains(&ratio), "{errors:?}");
    }
}

#[test]
fn so_do_those_of_the_oblate_dome() {
    for flattening in [0.2, 0.5, 1.0] {
        let errors = [4.0, 2.0, 1.0].map(|step_deg| {
            worst_uv_error(&lit::mesh(flattening, step_deg), |towards| {
                lit::intersect(flattening, towards).position
            })
        });
        println!("flattening {flattening}: worst error in heights of the dome: {errors:?}");
        for (pair, step_deg) in errors.windows(2).zip([4.0_f32, 2.0]) {
            let ratio = pair[0] / pair[1];
            // 4 in the limit. Coordinates bend within an angle of the flattening above the rim, so terms of third order
            // are as much of those of second order as the step is of that angle.
            let third = step_deg.to_radians() / flattening;
            let bounds = 4.0 / (1.0 + third)..4.0 * (1.0 + third);
            assert!(
                bounds.contains(&ratio),
                "flattening {flattening}: {errors:?}"
            );
        }
    }
}

/// What each pixel may differ by: a fiftieth of what separates it from its neighbours, what a step of 8-bit filtering is
/// worth, and half floats.
///
/// The shader is the same, the direction is not: a rasteriser snaps vertices to 1/256 of a pixel and
/// interpolates from corners that lie far outside the screen in 32 bits, and both together stay below a
/// fiftieth of a pixel. In 8 bits a read may then come out a step farther.
fn allowed(picture: &[Vec3], worth: &[Vec3]) -> Vec<Vec3> {
    let [width, height] = SIZE.map(|n| n as usize);
    let at = |x: usize, y: usize| picture[y.min(height - 1) * width + x.min(width - 1)];
    let around = |i: usize| {
        let (x, y) = (i % width, i / width);
        let near = [
            (x + 1, y),
            (x.saturating_sub(1), y),
            (x, y + 1),
            (x, y.saturating_sub(1)),
        ];
        near.map(|(x, y)| (at(x, y) - picture[i]).abs())
            .into_iter()
            .fold(Vec3::ZERO, Vec3::max)
    };
    let halves = |i: usize| picture[i] / 1024.0 + Vec3::splat(1e-6);
    (0..picture.len())
        .map(|i| around(i) * 0.02 + worth[i] + halves(i))
        .collect()
}

const SIZE: [u32; 2] = [96, 72];

#[test]
fn the_mesh_draws_the_same_picture_as_the_triangle_over_the_screen() {
    let format = wgpu::TextureFormat::Rgba16Float;
    let config = SkyConfig {
        target_format: format,
        depth: None,
        sample_count: 1,
    };
    let (gpu, pack) = (gpu::gpu(), pack::default_pack());
    let twin = Twin::new(pack);
    let mut screen = gpu::sky(pack, format);
    let mut mesh = Sky::with_dome_mesh(&gpu.device, &gpu.queue, config, pack, 10.0).expect("a sky");
    let views = [(0.4, 45.0_f32), (0.0, 45.0), (0.74, 90.0)];
    let cases = Method::DOMES
        .into_iter()
        .flat_map(|method| views.map(|(time, elevation)| (method, time, elevation)));
    for (method, time, elevation) in cases {
        // The dome ends at the horizon, so the camera looks well over it.
        let camera = Camera::looking(1.0, elevation.to_radians(), 1.0, SIZE);
        let params = SkyParams {
            method,
            time,
            flare: 0.0,
            ..SkyParams::default()
        };
        let expected = gpu::rgb(&gpu::render(&mut screen, format, &params, &camera, 9.0));
        let actual = gpu::rgb(&gpu::render(&mut mesh, format, &params, &camera, 9.0));
        let mut frame = twin.frame_without_map(&params, &camera, 9.0);
        frame.map = gpu::read_map(&screen);
        let behind = frame.behind();
        let steps = frame.filter_steps();
        let worth = frame.worth_of_reads(&steps, |frame| frame.clouds_over(&behind));
        let bounds = allowed(&expected, &worth);
        let scaled = |picture: &[Vec3]| -> Vec<Vec3> {
            picture.iter().zip(&bounds).map(|(p, b)| *p / *b).collect()
        };
        let difference = compare::difference(&scaled(&expected), &scaled(&actual), |_| 1.0);
        println!("{} at {time}: {difference:?}", method.name());
        if difference.worst > 1.0 {
            let file = format!("dome_{}_{time}", method.name());
            let picture = compare::save(&file, &expected, &actual, SIZE);
            panic!("time {time}: {difference:?}; see {}", picture.display());
        }
    }
}
