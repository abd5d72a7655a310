//! One sky, two cameras in one pass, in a world whose up is +Z; four samples a pixel and reversed depth:
//! `cargo run --release --example two_cameras -- both.png`.

mod scene;

use welkin_runtime::glam::camera::rh::{proj::directx as projection, view};
use welkin_runtime::glam::{Mat4, Vec3};
use welkin_runtime::{Axes, Method, Sky, SkyParams, wgpu};

/// Of each half.
const SIZE_PX: [u32; 2] = [640, 720];
const SAMPLES: u32 = 4;

fn main() -> scene::Result<()> {
    let (device, queue) = scene::device()?;
    let config = scene::radiance_config(SAMPLES);
    let mut sky = Sky::new(&device, &queue, config, &scene::pack()?)?;
    // The sky has a view of its own; each further camera wants another.
    let mut other = sky.view();
    let params = SkyParams {
        method: Method::Octaves,
        time: 0.7,
        cover: 0.5,
        ..SkyParams::default()
    };
    let light = sky.light(&params, 30.0);

    // +X east, +Y north, +Z up: as in Blender. The light that the sky gives is in its own axes: shaders either take normals there, as the hills
    // do, or what is given is turned: `axes.from_sky(light.sun.direction)`.
    let axes = Axes::Z_UP;
    let eye = Vec3::new(0.0, 0.0, 60.0);
    let [width, height] = SIZE_PX.map(|side| side as f32);
    let lens = projection::perspective_infinite_reverse(1.0, width / height, 0.1);
    let looking = |way: Vec3| -> Mat4 { view::look_to_mat4(eye, way.normalize(), Vec3::Z) };
    let views = [Vec3::new(-1.0, -0.1, 0.2), Vec3::new(1.0, 0.3, 0.2)].map(looking);
    let [first, second] = views.map(|from_world| axes.camera(from_world, lens, SIZE_PX));

    let hills = scene::Hills::new(&device, &config);
    let seen = views.map(|from_world| {
        // The hills are made in the sky's axes.
        let clip_from_sky = lens * from_world * axes.matrix().inverse();
        let place = axes.matrix().transform_point3(eye);
        hills.view(&device, clip_from_sky, place, &light, None)
    });

    let whole = [2 * SIZE_PX[0], SIZE_PX[1]];
    let (_, samples) = scene::target(&device, scene::RADIANCE, whole, SAMPLES);
    let (_, radiance) = scene::target(&device, scene::RADIANCE, whole, 1);
    let (_, depth) = scene::target(&device, scene::DEPTH, whole, SAMPLES);
    let (picture, shown) = scene::target(&device, wgpu::TextureFormat::Rgba8UnormSrgb, whole, 1);

    let mut encoder = device.create_command_encoder(&Default::default());
    sky.prepare(&queue, &mut encoder, &params, &first, 30.0);
    other.prepare(&sky, &queue, &mut encoder, &params, &second, 30.0);
    let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
        color_attachments: &[scene::colour(&samples, Some(&radiance))],
        depth_stencil_attachment: scene::far(&depth),
        ..Default::default()
    });
    pass.set_viewport(0.0, 0.0, width, height, 0.0, 1.0);
    hills.draw(&mut pass, &seen[0]);
    sky.draw(&mut pass);
    pass.set_viewport(width, 0.0, width, height, 0.0, 1.0);
    hills.draw(&mut pass, &seen[1]);
    other.draw(&mut pass);
    drop(pass);
    let tone = scene::Tone::new(&device, picture.format());
    tone.draw(&device, &mut encoder, &radiance, &shown, light.exposure);
    queue.submit([encoder.finish()]);
    scene::save(&device, &queue, &picture, "both.png")
}
