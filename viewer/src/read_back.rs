//! Textures on their way from the GPU: copied after what was drawn, fetched when they are there.

use std::sync::mpsc::{Receiver, channel};

use crate::frame::padded;
use crate::gpu::{Gpu, GpuError};

/// Texels that were drawn, in a buffer that the CPU reads once the GPU has filled it.
#[derive(Debug)]
pub(crate) struct Texels {
    buffer: wgpu::Buffer,
    submitted: wgpu::SubmissionIndex,
    mapped: Receiver<Result<(), wgpu::BufferAsyncError>>,
    size: [u32; 2],
    /// Bytes of a row, without what pads it in the buffer.
    row: u32,
    /// Names the device in errors.
    adapter: String,
}

impl Texels {
    /// Submits what was recorded, and after it a copy of a texture.
    pub fn copied(
        gpu: &Gpu,
        mut encoder: wgpu::CommandEncoder,
        texture: &wgpu::Texture,
        bytes_per_texel: u32,
    ) -> Texels {
        let row = texture.width() * bytes_per_texel;
        let buffer = gpu.device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("read back"),
            size: u64::from(padded(row)) * u64::from(texture.height()),
            usage: wgpu::BufferUsages::MAP_READ | wgpu::BufferUsages::COPY_DST,
            mapped_at_creation: false,
        });
        let layout = wgpu::TexelCopyBufferLayout {
            offset: 0,
            bytes_per_row: Some(padded(row)),
            rows_per_image: None,
        };
        encoder.copy_texture_to_buffer(
            texture.as_image_copy(),
            wgpu::TexelCopyBufferInfo {
                buffer: &buffer,
                layout,
            },
            texture.size(),
        );
        let submitted = gpu.queue.submit([encoder.finish()]);
        let (sender, mapped) = channel();
        // Nobody waits any more for what was given up; a send that fails would show as a missing answer.
        buffer
            .slice(..)
            .map_async(wgpu::MapMode::Read, move |done| drop(sender.send(done)));
        Texels {
            buffer,
            submitted,
            mapped,
            size: [texture.width(), texture.height()],
            row,
            adapter: gpu.adapter.clone(),
        }
    }

    /// Texels a row, and rows.
    pub fn size(&self) -> [u32; 2] {
        self.size
    }

    /// Waits until they are there; what was submitted later may go on.
    ///
    /// # Errors
    /// [`GpuError::Device`].
    pub fn wait(&self, gpu: &Gpu) -> Result<(), GpuError> {
        let poll = gpu.device.poll(wgpu::PollType::Wait {
            submission_index: Some(self.submitted.clone()),
            timeout: None,
        });
        poll.map_err(|e| self.failed(e))?;
        // Another thread that waits for this device may be the one that calls back, a moment later.
        let mapped = self.mapped.recv().map_err(|e| self.failed(e))?;
        mapped.map_err(|e| self.failed(e))
    }

    /// The texels, row by row, without padding, once they are there.
    ///
    /// # Errors
    /// [`GpuError::Device`].
    pub fn bytes(&self) -> Result<Vec<u8>, GpuError> {
        let mapped = self.buffer.slice(..).get_mapped_range();
        let mapped = mapped.map_err(|e| self.failed(e))?;
        let mut packed = Vec::with_capacity(self.row as usize * self.size[1] as usize);
        for row in mapped.chunks_exact(padded(self.row) as usize) {
            packed.extend_from_slice(&row[..self.row as usize]);
        }
        Ok(packed)
    }

    fn failed(&self, reason: impl ToString) -> GpuError {
        GpuError::Device {
            adapter: self.adapter.clone(),
            reason: reason.to_string(),
        }
    }
}
