//! One frame of the sky into a PNG, without a window: `cargo run --release --example headless -- sky.png`.

mod scene;

use welkin_runtime::{Camera, Method, Sky, SkyConfig, SkyParams, wgpu};

const SIZE_PX: [u32; 2] = [1280, 720];

fn main() -> scene::Result<()> {
    let (device, queue) = scene::device()?;
    // A target that is not a float gets a tonemapped picture; the hardware encodes it as sRGB.
    let config = SkyConfig {
        target_format: wgpu::TextureFormat::Rgba8UnormSrgb,
        depth: None,
        sample_count: 1,
    };
    let mut sky = Sky::new(&device, &queue, config, &scene::pack()?)?;
    let params = SkyParams {
        method: Method::Lit,
        time: 0.752,
        cover: 0.55,
        ..SkyParams::default()
    };
    let camera = Camera::looking(270_f32.to_radians(), 19_f32.to_radians(), 1.05, SIZE_PX);

    let (texture, view) = scene::target(&device, config.target_format, SIZE_PX, 1);
    let mut encoder = device.create_command_encoder(&Default::default());
    sky.prepare(&queue, &mut encoder, &params, &camera, 30.0);
    let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
        color_attachments: &[scene::colour(&view, None)],
        ..Default::default()
    });
    sky.draw(&mut pass);
    drop(pass);
    queue.submit([encoder.finish()]);
    scene::save(&device, &queue, &texture, "sky.png")
}
