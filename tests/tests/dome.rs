//! The papers' dome mesh and the analytic dome are the same dome.

use glam::{Vec2, Vec3};
use welkin_runtime::dome::{self, Mesh, Vertex};
use welkin_runtime::{Camera, Sky, SkyConfig, SkyParams};
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
fn worst_uv_error(step_deg: f32) -> f32 {
    let mut worst = 0.0_f32;
    for triangle in triangles(&dome::mesh(step_deg)) {
        let position = triangle
            .iter()
            .map(|v| Vec3::from(v.position))
            .sum::<Vec3>()
            / 3.0;
        let uv = triangle.iter().map(|v| Vec2::from(v.uv)).sum::<Vec2>() / 3.0;
        let hit = dome::intersect(position.normalize()).position;
        worst = worst.max(uv.distance(Vec2::new(hit.x, hit.z)));
    }
    worst
}

#[test]
fn coordinates_of_the_mesh_converge_to_the_analytic_ones_with_the_square_of_the_step() {
    let errors = [10.0, 5.0, 2.5].map(worst_uv_error);
    println!("worst error in heights of the layer: {errors:?}");
    for pair in errors.windows(2) {
        let ratio = pair[0] / pair[1];
        // 4 in the limit; terms of third order move it by the step over the curvature, some 10 %.
        assert!((3.4..4.6).contains(&ratio), "{errors:?}");
    }
}

/// What each pixel may differ by: a fiftieth of what separates it from its neighbours, and a step.
///
/// The shader is the same, the direction is not: a rasteriser snaps vertices to 1/256 of a pixel and
/// interpolates from corners that lie far outside the screen in 32 bits, and both together stay below a
/// fiftieth of a pixel. The step is that of 8-bit filtering, 1/255 times what clouds make of it (2.3 at this cover
/// and density, times a white of 1.3).
fn local_contrast(picture: &[Vec3]) -> Vec<Vec3> {
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
    (0..picture.len())
        .map(|i| around(i) * 0.02 + Vec3::splat(2.3 * 1.3 / 255.0))
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
    let gpu = gpu::gpu();
    let mut screen = gpu::sky(pack::default_pack(), format);
    let mut mesh = Sky::with_dome_mesh(&gpu.device, &gpu.queue, config, pack::default_pack(), 10.0)
        .expect("a sky");
    for (time, elevation) in [(0.4, 45.0_f32), (0.0, 45.0), (0.74, 90.0)] {
        // The dome ends at the horizon, so the camera looks well over it.
        let camera = Camera::looking(1.0, elevation.to_radians(), 1.0, SIZE);
        let params = SkyParams {
            time,
            flare: 0.0,
            ..SkyParams::default()
        };
        let expected = gpu::rgb(&gpu::render(&mut screen, format, &params, &camera, 9.0));
        let actual = gpu::rgb(&gpu::render(&mut mesh, format, &params, &camera, 9.0));
        let contrast = local_contrast(&expected);
        let shifted: Vec<Vec3> = expected
            .iter()
            .zip(&actual)
            .zip(&contrast)
            .map(|((e, a), c)| (*a - *e) / *c)
            .collect();
        let difference = compare::difference(&vec![Vec3::ZERO; expected.len()], &shifted, |_| 1.0);
        if difference.worst > 1.0 {
            let picture = compare::save(&format!("dome_{time}"), &expected, &actual, SIZE);
            panic!("time {time}: {difference:?}; see {}", picture.display());
        }
    }
}
