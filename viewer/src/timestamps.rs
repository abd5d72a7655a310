//! Timestamps of the GPU, and the buffers through which they come back.

use crate::gpu::Gpu;

/// Timestamps of one frame.
#[derive(Debug)]
pub(crate) struct Timestamps {
    pub set: wgpu::QuerySet,
    resolved: wgpu::Buffer,
    /// Where they can be read.
    pub readable: wgpu::Buffer,
    count: u32,
}

impl Timestamps {
    pub fn new(gpu: &Gpu, count: u32) -> Timestamps {
        let label = Some("timestamps");
        let buffer = |usage| {
            gpu.device.create_buffer(&wgpu::BufferDescriptor {
                label,
                size: bytes(count),
                usage,
                mapped_at_creation: false,
            })
        };
        Timestamps {
            set: gpu.device.create_query_set(&wgpu::QuerySetDescriptor {
                label,
                ty: wgpu::QueryType::Timestamp,
                count,
            }),
            resolved: buffer(wgpu::BufferUsages::QUERY_RESOLVE | wgpu::BufferUsages::COPY_SRC),
            readable: buffer(wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::MAP_READ),
            count,
        }
    }

    /// Where a pass writes when it begins and when it ends.
    pub fn writes(
        &self,
        beginning: Option<u32>,
        end: Option<u32>,
    ) -> wgpu::RenderPassTimestampWrites<'_> {
        wgpu::RenderPassTimestampWrites {
            query_set: &self.set,
            beginning_of_pass_write_index: beginning,
            end_of_pass_write_index: end,
        }
    }

    /// Makes those from `first` on readable; what was not written may not be resolved.
    pub fn resolve(&self, encoder: &mut wgpu::CommandEncoder, first: u32) {
        encoder.resolve_query_set(&self.set, first..self.count, &self.resolved, 0);
        encoder.copy_buffer_to_buffer(&self.resolved, 0, &self.readable, 0, bytes(self.count));
    }
}

/// Timestamps have 64 bits.
fn bytes(count: u32) -> u64 {
    8 * u64::from(count)
}

/// Milliseconds of a tick.
pub(crate) fn tick_ms(gpu: &Gpu) -> f64 {
    f64::from(gpu.queue.get_timestamp_period()) / 1e6
}

/// Ticks from one timestamp to another.
pub(crate) fn ticks_between(begin: u64, end: u64) -> f64 {
    end.saturating_sub(begin) as f64
}
