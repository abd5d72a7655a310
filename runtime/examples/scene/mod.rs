//! What the examples share: a pack, a device without a window, textures to draw into, and a scene under the sky.

// Each example uses a part of it.
#![allow(dead_code, unused_imports)]

mod hills;
mod tone;

use std::error::Error;
use std::ops::ControlFlow;
use std::path::PathBuf;

pub use hills::Hills;

pub use tone::Tone;
use welkin_pack::Pack;
use welkin_runtime::{DepthConfig, SkyConfig, wgpu};

pub type Result<T> = std::result::Result<T, Box<dyn Error>>;

/// Scene and sky are drawn as linear radiance.
pub const RADIANCE: wgpu::TextureFormat = wgpu::TextureFormat::Rgba16Float;
pub const DEPTH: wgpu::TextureFormat = wgpu::TextureFormat::Depth32Float;

/// Scene and sky in one pass: a float target gets radiance, 1 the white of a sunlit cloud at noon, the sun's disc thousands of that. Depth is reversed.
pub fn radiance_config(sample_count: u32) -> SkyConfig {
    SkyConfig {
        target_format: RADIANCE,
        depth: Some(DepthConfig {
            format: DEPTH,
            reversed: true,
        }),
        sample_count,
    }
}

/// The default pack, baked here in a second. A program that ships would read one from its files: `Pack::open("packs/default")`.
pub fn pack() -> Result<Pack> {
    let recipe = welkin_baker::Recipe::default().resolve(None)?;
    Ok(welkin_baker::bake(&recipe, None, &|_| {
        ControlFlow::Continue(())
    })?)
}

/// The device of the default adapter.
pub fn device() -> Result<(wgpu::Device, wgpu::Queue)> {
    let instance =
        wgpu::Instance::new(wgpu::InstanceDescriptor::new_without_display_handle_from_env());
    let adapter = pollster::block_on(instance.request_adapter(&Default::default()))?;
    open(&adapter)
}

/// A device of an adapter. Ask for the limits that your own passes need: Welkin needs no more than these, those of WebGL2.
pub fn open(adapter: &wgpu::Adapter) -> Result<(wgpu::Device, wgpu::Queue)> {
    let limits = wgpu::Limits::downlevel_webgl2_defaults().using_resolution(adapter.limits());
    Ok(pollster::block_on(adapter.request_device(
        &wgpu::DeviceDescriptor {
            required_limits: limits,
            ..Default::default()
        },
    ))?)
}

/// A texture to draw into, and its view.
pub fn target(
    device: &wgpu::Device,
    format: wgpu::TextureFormat,
    [width, height]: [u32; 2],
    sample_count: u32,
) -> (wgpu::Texture, wgpu::TextureView) {
    let usage = match sample_count {
        1 => wgpu::TextureUsages::TEXTURE_BINDING | wgpu::TextureUsages::COPY_SRC,
        _ => wgpu::TextureUsages::empty(),
    };
    let texture = device.create_texture(&wgpu::TextureDescriptor {
        label: Some("example"),
        size: wgpu::Extent3d {
            width,
            height,
            depth_or_array_layers: 1,
        },
        mip_level_count: 1,
        sample_count,
        dimension: wgpu::TextureDimension::D2,
        format,
        usage: usage | wgpu::TextureUsages::RENDER_ATTACHMENT,
        view_formats: &[],
    });
    let view = texture.create_view(&Default::default());
    (texture, view)
}

/// An attachment that is cleared to black; with more samples than one they end in `resolved`.
pub fn colour<'a>(
    view: &'a wgpu::TextureView,
    resolved: Option<&'a wgpu::TextureView>,
) -> Option<wgpu::RenderPassColorAttachment<'a>> {
    Some(wgpu::RenderPassColorAttachment {
        view,
        depth_slice: None,
        resolve_target: resolved,
        ops: wgpu::Operations {
            load: wgpu::LoadOp::Clear(wgpu::Color::BLACK),
            store: wgpu::StoreOp::Store,
        },
    })
}

/// A depth attachment that is cleared to what is infinitely far where depth is reversed: 0.
pub fn far(view: &wgpu::TextureView) -> Option<wgpu::RenderPassDepthStencilAttachment<'_>> {
    Some(wgpu::RenderPassDepthStencilAttachment {
        view,
        depth_ops: Some(wgpu::Operations {
            load: wgpu::LoadOp::Clear(0.0),
            store: wgpu::StoreOp::Discard,
        }),
        stencil_ops: None,
    })
}

/// Writes an `Rgba8UnormSrgb` texture as a PNG: into the file that the command line names, or else a name of its own.
pub fn save(
    device: &wgpu::Device,
    queue: &wgpu::Queue,
    texture: &wgpu::Texture,
    name: &str,
) -> Result<()> {
    let (width, height) = (texture.width(), texture.height());
    let row = (width * 4).next_multiple_of(wgpu::COPY_BYTES_PER_ROW_ALIGNMENT);
    let buffer = device.create_buffer(&wgpu::BufferDescriptor {
        label: Some("read back"),
        size: u64::from(row * height),
        usage: wgpu::BufferUsages::MAP_READ | wgpu::BufferUsages::COPY_DST,
        mapped_at_creation: false,
    });
    let mut encoder = device.create_command_encoder(&Default::default());
    let layout = wgpu::TexelCopyBufferLayout {
        offset: 0,
        bytes_per_row: Some(row),
        rows_per_image: None,
    };
    let copy = wgpu::TexelCopyBufferInfo {
        buffer: &buffer,
        layout,
    };
    encoder.copy_texture_to_buffer(texture.as_image_copy(), copy, texture.size());
    queue.submit([encoder.finish()]);
    buffer.map_async(wgpu::MapMode::Read, .., |_| ());
    device.poll(wgpu::PollType::wait_indefinitely())?;
    let bytes = buffer.get_mapped_range(..)?;
    let rows = bytes.chunks(row as usize);
    let pixels: Vec<u8> = rows
        .flat_map(|r| r[..4 * width as usize].to_vec())
        .collect();
    let file = std::env::args_os()
        .nth(1)
        .map_or_else(|| name.into(), PathBuf::from);
    image::save_buffer(&file, &pixels, width, height, image::ColorType::Rgba8)?;
    Ok(())
}
