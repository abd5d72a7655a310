//! Frames without a window: draws one into a texture and reads it back.

use welkin_pack::Pack;
use welkin_runtime::{Camera, Sky, SkyConfig, SkyParams};

use crate::frame::{Frame, Target};
use crate::gpu::{Gpu, GpuError};

/// What to look at: the sky's parameters, the camera and the moment.
#[derive(Clone, Debug)]
pub struct View {
    /// Parameters of the sky.
    pub params: SkyParams,
    /// Camera, with the size of the frame.
    pub camera: Camera,
    /// Time since the start of the animation, in seconds.
    pub seconds: f64,
}

/// Draws one frame of a pack's sky.
///
/// # Errors
/// See [`GpuError`].
pub fn render(gpu: &Gpu, pack: &Pack, target: Target, view: &View) -> Result<Frame, GpuError> {
    let texture = gpu.target(target, view.camera.viewport_px)?;
    let mut sky = new_sky(gpu, pack, target)?;
    let mut encoder = gpu.device.create_command_encoder(&Default::default());
    sky.prepare(
        &gpu.queue,
        &mut encoder,
        &view.params,
        &view.camera,
        view.seconds,
    );
    draw_pass(
        &mut encoder,
        &texture.create_view(&Default::default()),
        None,
        |pass| sky.draw(pass),
    );
    gpu.queue.submit([encoder.finish()]);
    read_back(gpu, &texture, target)
}

/// A sky that draws into a target of [`Gpu::target`].
///
/// # Errors
/// [`GpuError::Sky`].
pub fn new_sky(gpu: &Gpu, pack: &Pack, target: Target) -> Result<Sky, GpuError> {
    let config = SkyConfig {
        target_format: target.texture_format(),
        depth: None,
        sample_count: 1,
    };
    Ok(Sky::new(&gpu.device, &gpu.queue, config, pack)?)
}

/// Records one render pass that clears `view` and draws.
pub fn draw_pass(
    encoder: &mut wgpu::CommandEncoder,
    view: &wgpu::TextureView,
    timestamp_writes: Option<wgpu::RenderPassTimestampWrites<'_>>,
    draw: impl FnOnce(&mut wgpu::RenderPass<'_>),
) {
    let colour = wgpu::RenderPassColorAttachment {
        view,
        depth_slice: None,
        resolve_target: None,
        ops: wgpu::Operations {
            load: wgpu::LoadOp::Clear(wgpu::Color::BLACK),
            store: wgpu::StoreOp::Store,
        },
    };
    draw(&mut encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
        color_attachments: &[Some(colour)],
        timestamp_writes,
        ..Default::default()
    }));
}

/// Copies a texture of [`Gpu::target`] to the CPU, without the padding that rows have in a buffer.
fn read_back(gpu: &Gpu, texture: &wgpu::Texture, target: Target) -> Result<Frame, GpuError> {
    let (width, height) = (texture.width(), texture.height());
    let row = (width * target.bytes_per_pixel()) as usize;
    let padded_row = target.padded_row(width);
    let buffer = gpu.device.create_buffer(&wgpu::BufferDescriptor {
        label: Some("read back"),
        size: u64::from(padded_row) * u64::from(height),
        usage: wgpu::BufferUsages::MAP_READ | wgpu::BufferUsages::COPY_DST,
        mapped_at_creation: false,
    });
    let layout = wgpu::TexelCopyBufferLayout {
        offset: 0,
        bytes_per_row: Some(padded_row),
        rows_per_image: None,
    };
    let mut encoder = gpu.device.create_command_encoder(&Default::default());
    encoder.copy_texture_to_buffer(
        texture.as_image_copy(),
        wgpu::TexelCopyBufferInfo {
            buffer: &buffer,
            layout,
        },
        texture.size(),
    );
    gpu.queue.submit([encoder.finish()]);
    let padded = gpu.read(&buffer)?;
    let rows = padded.chunks_exact(padded_row as usize);
    let bytes: Vec<u8> = rows.flat_map(|r| &r[..row]).copied().collect();
    Ok(Frame {
        width,
        height,
        pixels: target.pixels(&bytes),
    })
}

#[cfg(test)]
mod tests {
    use half::f16;

    use super::*;
    use crate::frame::Pixels;
    use crate::reference::full_screen_pipeline;

    /// Writes the place of every pixel as its colour.
    const PLACES: &str = "
        @vertex fn corner(@builtin(vertex_index) i: u32) -> @builtin(position) vec4f {
            return vec4f(f32(i & 1u) * 4.0 - 1.0, f32(i >> 1u) * 4.0 - 1.0, 0.0, 1.0);
        }
        @fragment fn place(@builtin(position) p: vec4f) -> @location(0) vec4f {
            return vec4f(floor(p.xy), 0.5, 1.0);
        }";

    #[test]
    fn every_pixel_comes_back_in_its_place_however_rows_are_padded() {
        let gpu = Gpu::open().unwrap();
        let pipeline = full_screen_pipeline(&gpu, PLACES, Target::Linear.texture_format(), "place");
        // Rows of 256 bytes need no padding, others do.
        for [width, height] in [[32, 5], [33, 4], [1, 1], [3, 70]] {
            let texture = gpu.target(Target::Linear, [width, height]).unwrap();
            let mut encoder = gpu.device.create_command_encoder(&Default::default());
            draw_pass(
                &mut encoder,
                &texture.create_view(&Default::default()),
                None,
                |pass| {
                    pass.set_pipeline(&pipeline);
                    pass.draw(0..3, 0..1);
                },
            );
            gpu.queue.submit([encoder.finish()]);
            let frame = read_back(&gpu, &texture, Target::Linear).unwrap();
            let place =
                |i: u32| [(i % width) as f32, (i / width) as f32, 0.5, 1.0].map(f16::from_f32);
            let expected = (0..width * height).map(place).collect();
            assert_eq!(
                frame,
                Frame {
                    width,
                    height,
                    pixels: Pixels::Linear(expected)
                }
            );
        }
    }
}
