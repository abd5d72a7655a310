//! Sprites stand at their depth: a scene hides those behind it and no others.

use glam::{DVec3, Mat4};
use welkin_runtime::{Camera, DepthConfig, Sky, SkyConfig};
use welkin_tests::gpu;

use super::{field, params, view};

const FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba8Unorm;
const DEPTH: wgpu::TextureFormat = wgpu::TextureFormat::Depth32Float;
const SIZE: [u32; 2] = [64, 48];
/// Near and far plane of an application's projection, in metres.
const PLANES_M: [f32; 2] = [0.5, 20_000.0];

/// The heap is 1800 to 2000 metres before this viewer.
fn viewer() -> Camera {
    view(DVec3::new(2000.0, 1200.0, 2900.0), 0.0, 0.0, SIZE)
}

/// How many pixels show anything before a wall all over the screen, whose depth in clip space is `wall`.
fn shown(reversed: bool, camera: &Camera, wall: f32) -> usize {
    let depth = DepthConfig {
        format: DEPTH,
        reversed,
    };
    let config = SkyConfig {
        target_format: FORMAT,
        depth: Some(depth),
        sample_count: 1,
    };
    let (device, queue) = (&gpu::gpu().device, &gpu::gpu().queue);
    let mut sky = Sky::new(device, queue, config, field::two_clouds()).unwrap();
    let target = gpu::target(FORMAT, SIZE, 1);
    let depth = gpu::target(DEPTH, SIZE, 1);
    gpu::prepare(&mut sky, &params(), camera, 0.0);
    gpu::pass(&target, None, Some((&depth, wall)), |pass| sky.draw(pass));
    let texels = gpu::read(&target);
    texels
        .iter()
        .filter(|t| **t != [1.0, 0.0, 0.0, 1.0])
        .count()
}

#[test]
fn a_wall_hides_the_sprites_behind_it_and_not_those_before_it() {
    // A camera that does not say: the near plane is at a tenth of a metre, the far one infinitely far.
    let standard = |distance: f32| 1.0 - 0.1 / distance;
    let reversed = |distance: f32| 0.1 / distance;
    let [near, far] = PLANES_M;
    let of_matrix = |distance: f32| far / (far - near) * (1.0 - near / distance);
    let own = viewer();
    let projection = glam::camera::rh::proj::directx::perspective(1.05, 4.0 / 3.0, near, far);
    let view = Mat4::from_rotation_translation(own.orientation, own.position_m).inverse();
    let application = Camera::from_matrices(view, projection, SIZE);
    let walls_m = [800.0, 1700.0, 2800.0];
    let all = [
        walls_m.map(|distance| shown(false, &own, standard(distance))),
        walls_m.map(|distance| shown(true, &own, reversed(distance))),
        walls_m.map(|distance| shown(false, &application, of_matrix(distance))),
    ];
    println!("{all:?}");
    for counts in all {
        assert_eq!(counts[0], 0, "the wall is nearer than any sprite");
        assert!(counts[1] > 0 && counts[1] < counts[2], "{counts:?}");
        // The sky is infinitely far behind it.
        assert!(counts[2] < (SIZE[0] * SIZE[1]) as usize);
    }
}
