//! Each method that is compiled in draws a sky that changes with its parameters as it should.

use std::ops::ControlFlow;
use std::sync::OnceLock;

use welkin_baker::Recipe;
use welkin_pack::Pack;
use welkin_runtime::params::SkyModel;
use welkin_runtime::{Camera, Method, Sky, SkyConfig, SkyParams, wgpu};

/// Small textures: what is asked here is which way a picture changes.
const RECIPE: &str = "[clouds]\nsize = 64\n[stars]\nsize = 64\ncount = 50\n[galaxy]\nsize = 32\n[fbm]\nsize = 128\n\
     [flares]\nsize = 64\n[layers]\nsize = 64\n[sprites]\nsize = 128\n";

const SIZE: [u32; 2] = [64, 32];

fn pack() -> &'static Pack {
    static PACK: OnceLock<Pack> = OnceLock::new();
    PACK.get_or_init(|| {
        let recipe = Recipe::parse("small", RECIPE).and_then(|r| r.resolve(None));
        welkin_baker::bake(&recipe.unwrap(), None, &|_| ControlFlow::Continue(())).unwrap()
    })
}

fn open() -> (wgpu::Device, wgpu::Queue) {
    let descriptor = wgpu::InstanceDescriptor::new_without_display_handle_from_env();
    let instance = wgpu::Instance::new(descriptor);
    pollster::block_on(async {
        let adapter = instance.request_adapter(&Default::default()).await.unwrap();
        let limits = wgpu::Limits::downlevel_webgl2_defaults().using_resolution(adapter.limits());
        let descriptor = wgpu::DeviceDescriptor {
            required_limits: limits,
            ..Default::default()
        };
        adapter.request_device(&descriptor).await.unwrap()
    })
}

/// The mean red, green and blue of the frames that parameters give, in linear light from 0 to 1, looking north at 40 degrees.
fn means(frames: &[SkyParams]) -> Vec<[f32; 3]> {
    let (device, queue) = open();
    let config = SkyConfig {
        target_format: wgpu::TextureFormat::Rgba8Unorm,
        depth: None,
        sample_count: 1,
    };
    let mut sky = Sky::new(&device, &queue, config, pack()).unwrap();
    let [width, height] = SIZE;
    let size = wgpu::Extent3d {
        width,
        height,
        depth_or_array_layers: 1,
    };
    let target = device.create_texture(&wgpu::TextureDescriptor {
        label: None,
        size,
        mip_level_count: 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format: config.target_format,
        usage: wgpu::TextureUsages::RENDER_ATTACHMENT | wgpu::TextureUsages::COPY_SRC,
        view_formats: &[],
    });
    let view = target.create_view(&Default::default());
    let camera = Camera::looking(0.0, 0.7, 1.0, SIZE);
    let frame = |params: &SkyParams| {
        let buffer = device.create_buffer(&wgpu::BufferDescriptor {
            label: None,
            size: u64::from(4 * width * height),
            usage: wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::MAP_READ,
            mapped_at_creation: false,
        });
        let mut encoder = device.create_command_encoder(&Default::default());
        sky.prepare(&queue, &mut encoder, params, &camera, 10.0);
        {
            let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
                color_attachments: &[Some(wgpu::RenderPassColorAttachment {
                    view: &view,
                    depth_slice: None,
                    resolve_target: None,
                    ops: wgpu::Operations::default(),
                })],
                ..Default::default()
            });
            sky.draw(&mut pass);
        }
        let layout = wgpu::TexelCopyBufferLayout {
            offset: 0,
            // 64 pixels are the 256 bytes that rows go by.
            bytes_per_row: Some(4 * width),
            rows_per_image: None,
        };
        let into = wgpu::TexelCopyBufferInfo {
            buffer: &buffer,
            layout,
        };
        encoder.copy_texture_to_buffer(target.as_image_copy(), into, size);
        queue.submit([encoder.finish()]);
        buffer.slice(..).map_async(wgpu::MapMode::Read, |_| {});
        device.poll(wgpu::PollType::wait_indefinitely()).unwrap();
        let bytes = buffer.slice(..).get_mapped_range().unwrap().to_vec();
        let pixels = bytes.len() as f32 / 4.0;
        [0, 1, 2].map(|i| {
            let channel = bytes.iter().skip(i).step_by(4);
            // The display's encoding, near enough.
            let light = channel.map(|&v| (f32::from(v) / 255.0).powf(2.2));
            light.sum::<f32>() / pixels
        })
    };
    frames.iter().map(frame).collect()
}

#[test]
fn every_method_draws_blue_noons_grey_overcasts_and_dark_nights() {
    let skies = |method| SkyModel::ALL.map(move |sky| (method, sky));
    let domes: Vec<_> = Method::ALL.into_iter().flat_map(skies).collect();
    let frames = domes.iter().flat_map(|&(method, sky)| {
        [(0.5, 0.0), (0.5, 1.0), (0.0, 0.0)].map(|(time, cover)| SkyParams {
            method,
            sky,
            time,
            cover,
            ..SkyParams::default()
        })
    });
    let means = means(&frames.collect::<Vec<_>>());
    for ((method, sky), means) in domes.iter().zip(means.chunks(3)) {
        let [clear, overcast, night] = *means else {
            unreachable!("three frames of each")
        };
        // How far from white: 0 for grey.
        let blueness = |[red, _, blue]: [f32; 3]| blue / red.max(1e-3) - 1.0;
        let name = format!("{} {}", method.name(), sky.name());
        assert!(blueness(clear) > 0.5, "{name}: {clear:?}");
        // Skylight on clouds is bluish too, but white light adds to it.
        let grey = blueness(overcast) < blueness(clear) / 2.0;
        assert!(grey, "{name}: {overcast:?} {clear:?}");
        // Three stops.
        assert!(night[1] < clear[1] / 8.0, "{name}: {night:?} {clear:?}");
    }
}
