//! A GPU without a window: chooses an adapter, opens a device, reads its buffers.
//!
//! The device is opened with the limits of WebGL2 and the adapter's texture sizes, so that whatever
//! is drawn here can be drawn in a browser too. `WGPU_BACKEND` (such as `vulkan` or `gl`) and
//! `WGPU_ADAPTER_NAME` (a part of a name) choose among several adapters, as in many programs built on wgpu.

use crate::adapters::{self, choose};
use crate::frame::Target;
pub use crate::gpu_error::GpuError;
use crate::wanted::Wanted;

/// An opened adapter.
#[derive(Debug)]
pub struct Gpu {
    /// Name of the adapter, and the programming interface behind it.
    pub adapter: String,
    /// The device.
    pub device: wgpu::Device,
    /// Its queue.
    pub queue: wgpu::Queue,
}

impl Gpu {
    /// Opens the adapter that is wanted, or that the environment names, or the fastest one.
    ///
    /// # Errors
    /// [`GpuError::NoAdapter`], [`GpuError::NoSuchName`], [`GpuError::NoSuchAdapter`], [`GpuError::NoDevice`].
    pub fn open(wanted: Option<&Wanted>) -> Result<Gpu, GpuError> {
        pollster::block_on(async {
            let adapter = adapters::without_display(wanted).await?;
            open_device(&adapter).await
        })
    }

    /// The same of those that can draw to the surface.
    ///
    /// # Errors
    /// As [`Gpu::open`].
    pub fn open_for(
        instance: &wgpu::Instance,
        surface: &wgpu::Surface<'_>,
        wanted: Option<&Wanted>,
    ) -> Result<(Gpu, wgpu::Adapter), GpuError> {
        pollster::block_on(async {
            let adapter = choose(instance, Some(surface), wanted).await?;
            Ok((open_device(&adapter).await?, adapter))
        })
    }

    /// Whether passes can be timed on the GPU itself.
    pub fn has_timestamps(&self) -> bool {
        self.device
            .features()
            .contains(wgpu::Features::TIMESTAMP_QUERY)
    }

    /// Whether a moment between two passes can be told on the GPU too.
    pub fn has_timestamps_between_passes(&self) -> bool {
        self.device.features().contains(
            wgpu::Features::TIMESTAMP_QUERY | wgpu::Features::TIMESTAMP_QUERY_INSIDE_ENCODERS,
        )
    }

    /// That a frame of this size can be drawn and read back.
    ///
    /// # Errors
    /// [`GpuError::FrameSize`].
    pub fn verify_size(&self, target: Target, [width, height]: [u32; 2]) -> Result<(), GpuError> {
        let limits = self.device.limits();
        let max_side = limits.max_texture_dimension_2d;
        // All of it has to fit into the buffer that it is read back through, rows padded.
        let max_pixels = limits.max_buffer_size / u64::from(target.bytes_per_pixel());
        let bytes = || u64::from(target.padded_row(width)) * u64::from(height);
        let fits = [width, height]
            .iter()
            .all(|side| (1..=max_side).contains(side));
        if fits && bytes() <= limits.max_buffer_size {
            return Ok(());
        }
        Err(GpuError::FrameSize {
            width,
            height,
            max_side,
            max_pixels,
            adapter: self.adapter.clone(),
        })
    }

    /// A texture to draw into and to read back.
    ///
    /// # Errors
    /// [`GpuError::FrameSize`].
    pub fn target(&self, target: Target, size: [u32; 2]) -> Result<wgpu::Texture, GpuError> {
        self.verify_size(target, size)?;
        let [width, height] = size;
        Ok(self.device.create_texture(&wgpu::TextureDescriptor {
            label: Some("frame"),
            size: wgpu::Extent3d {
                width,
                height,
                depth_or_array_layers: 1,
            },
            mip_level_count: 1,
            sample_count: 1,
            dimension: wgpu::TextureDimension::D2,
            format: target.texture_format(),
            usage: wgpu::TextureUsages::RENDER_ATTACHMENT | wgpu::TextureUsages::COPY_SRC,
            view_formats: &[],
        }))
    }

    /// Waits until everything that was submitted is done.
    ///
    /// # Errors
    /// [`GpuError::Device`].
    pub fn wait(&self) -> Result<(), GpuError> {
        let poll = self.device.poll(wgpu::PollType::wait_indefinitely());
        poll.map(|_| ()).map_err(|e| self.failed(e))
    }

    /// Bytes of a buffer that was made with [`wgpu::BufferUsages::MAP_READ`], once the GPU has filled it.
    ///
    /// # Errors
    /// [`GpuError::Device`].
    pub fn read(&self, buffer: &wgpu::Buffer) -> Result<Vec<u8>, GpuError> {
        let (sender, receiver) = std::sync::mpsc::channel();
        // The receiver outlives the callback; a send that fails would show below as a missing answer.
        buffer
            .slice(..)
            .map_async(wgpu::MapMode::Read, move |mapped| drop(sender.send(mapped)));
        self.wait()?;
        // Another thread that waits for this device may be the one that calls back, a moment later.
        let mapped = receiver.recv().map_err(|e| self.failed(e))?;
        mapped.map_err(|e| self.failed(e))?;
        let bytes = buffer
            .slice(..)
            .get_mapped_range()
            .map_err(|e| self.failed(e))?
            .to_vec();
        buffer.unmap();
        Ok(bytes)
    }

    fn failed(&self, reason: impl ToString) -> GpuError {
        GpuError::Device {
            adapter: self.adapter.clone(),
            reason: reason.to_string(),
        }
    }
}

async fn open_device(adapter: &wgpu::Adapter) -> Result<Gpu, GpuError> {
    let info = adapter.get_info();
    let timestamps =
        wgpu::Features::TIMESTAMP_QUERY | wgpu::Features::TIMESTAMP_QUERY_INSIDE_ENCODERS;
    let name = format!("{} ({})", info.name, info.backend);
    let descriptor = wgpu::DeviceDescriptor {
        label: Some("welkin-view"),
        required_features: adapter.features() & timestamps,
        required_limits: wgpu::Limits::downlevel_webgl2_defaults()
            .using_resolution(adapter.limits()),
        ..Default::default()
    };
    match adapter.request_device(&descriptor).await {
        Ok((device, queue)) => Ok(Gpu {
            adapter: name,
            device,
            queue,
        }),
        Err(e) => Err(GpuError::NoDevice {
            adapter: name,
            reason: e.to_string(),
        }),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn frames_that_the_device_cannot_hold_are_refused() {
        let gpu = Gpu::open(None).unwrap();
        let side = gpu.device.limits().max_texture_dimension_2d;
        for size in [
            [0, 1],
            [1, 0],
            [side + 1, 1],
            [1, u32::MAX],
            [u32::MAX, u32::MAX],
        ] {
            let error = gpu.target(Target::Linear, size).unwrap_err();
            assert!(
                matches!(error, GpuError::FrameSize { .. }),
                "{size:?}: {error}"
            );
        }
        assert!(gpu.target(Target::Srgb8, [side, 1]).is_ok());
    }
}
