//! A scene and its sky as linear radiance, and a tone curve of one's own over both: `cargo run --release --example offscreen_hdr -- hills.png`.

mod scene;

use welkin_runtime::glam::camera::rh::{proj::directx as projection, view};
use welkin_runtime::glam::{Mat4, Vec3};
use welkin_runtime::{Camera, Method, Sky, SkyParams, wgpu};

const SIZE_PX: [u32; 2] = [1280, 720];

fn main() -> scene::Result<()> {
    let (device, queue) = scene::device()?;
    let config = scene::radiance_config(1);
    let mut sky = Sky::new(&device, &queue, config, &scene::pack()?)?;
    let params = SkyParams {
        method: Method::Lit,
        time: 0.33,
        cover: 0.45,
        shadow_extent_m: 16_000.0,
        ..SkyParams::default()
    };

    let eye = Vec3::new(0.0, 40.0, 0.0);
    let way = Vec3::new(-0.2, 0.14, -1.0);
    let from_world: Mat4 = view::look_to_mat4(eye, way.normalize(), Vec3::Y);
    let aspect = SIZE_PX[0] as f32 / SIZE_PX[1] as f32;
    let lens = projection::perspective_infinite_reverse(0.9, aspect, 0.1);
    let camera = Camera::from_matrices(from_world, lens, SIZE_PX);

    let (_, radiance) = scene::target(&device, scene::RADIANCE, SIZE_PX, 1);
    let (_, depth) = scene::target(&device, scene::DEPTH, SIZE_PX, 1);
    let (picture, shown) = scene::target(&device, wgpu::TextureFormat::Rgba8UnormSrgb, SIZE_PX, 1);
    let hills = scene::Hills::new(&device, &config);
    let tone = scene::Tone::new(&device, picture.format());

    let mut encoder = device.create_command_encoder(&Default::default());
    sky.prepare(&queue, &mut encoder, &params, &camera, 30.0);
    let light = sky.light(&params, 30.0);
    let seen = hills.view(&device, lens * from_world, eye, &light, sky.shadow());
    let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
        color_attachments: &[scene::colour(&radiance, None)],
        depth_stencil_attachment: scene::far(&depth),
        ..Default::default()
    });
    hills.draw(&mut pass, &seen);
    // Behind all that is drawn: what the scene covers costs the sky nothing.
    sky.draw(&mut pass);
    drop(pass);
    // What a camera would choose for this sky; a program would let it follow slowly.
    tone.draw(&device, &mut encoder, &radiance, &shown, light.exposure);
    queue.submit([encoder.finish()]);
    scene::save(&device, &queue, &picture, "hills.png")
}
