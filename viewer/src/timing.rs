//! How long a render pass takes, and what is left of many such times.

use std::time::Instant;

use crate::gpu::{Gpu, GpuError};
use crate::headless::draw_pass;

/// Times one render pass at a time.
///
/// Every pass is submitted alone and waited for, so no pass overlaps another. Where the adapter has
/// `TIMESTAMP_QUERY` the time is the GPU's own, from the beginning of the pass to its end; elsewhere it
/// is the CPU's, from the submission to the end of the wait, which is longer.
#[derive(Debug)]
pub struct PassTimer {
    queries: Option<Queries>,
}

#[derive(Debug)]
struct Queries {
    set: wgpu::QuerySet,
    resolved: wgpu::Buffer,
    readable: wgpu::Buffer,
    tick_ns: f64,
}

/// Two timestamps of 64 bits.
const QUERY_BYTES: u64 = 16;

impl PassTimer {
    /// A timer for passes on this device.
    pub fn new(gpu: &Gpu) -> PassTimer {
        PassTimer {
            queries: gpu.has_timestamps().then(|| Queries::new(gpu)),
        }
    }

    /// Draws one pass into `view` and returns its time in milliseconds.
    ///
    /// # Errors
    /// [`GpuError::Device`].
    pub fn time_ms(
        &self,
        gpu: &Gpu,
        view: &wgpu::TextureView,
        draw: impl FnOnce(&mut wgpu::RenderPass<'_>),
    ) -> Result<f64, GpuError> {
        let mut encoder = gpu.device.create_command_encoder(&Default::default());
        draw_pass(
            &mut encoder,
            view,
            self.queries.as_ref().map(Queries::writes),
            draw,
        );
        if let Some(queries) = &self.queries {
            queries.resolve(&mut encoder);
        }
        let commands = encoder.finish();
        let start = Instant::now();
        gpu.queue.submit([commands]);
        gpu.wait()?;
        let wall_ms = start.elapsed().as_secs_f64() * 1e3;
        self.queries
            .as_ref()
            .map_or(Ok(wall_ms), |queries| queries.read_ms(gpu))
    }
}

impl Queries {
    fn new(gpu: &Gpu) -> Queries {
        let buffer = |usage| {
            gpu.device.create_buffer(&wgpu::BufferDescriptor {
                label: Some("timestamps"),
                size: QUERY_BYTES,
                usage,
                mapped_at_creation: false,
            })
        };
        Queries {
            set: gpu.device.create_query_set(&wgpu::QuerySetDescriptor {
                label: Some("timestamps"),
                ty: wgpu::QueryType::Timestamp,
                count: 2,
            }),
            resolved: buffer(wgpu::BufferUsages::QUERY_RESOLVE | wgpu::BufferUsages::COPY_SRC),
            readable: buffer(wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::MAP_READ),
            tick_ns: f64::from(gpu.queue.get_timestamp_period()),
        }
    }

    fn writes(&self) -> wgpu::RenderPassTimestampWrites<'_> {
        wgpu::RenderPassTimestampWrites {
            query_set: &self.set,
            beginning_of_pass_write_index: Some(0),
            end_of_pass_write_index: Some(1),
        }
    }

    fn resolve(&self, encoder: &mut wgpu::CommandEncoder) {
        encoder.resolve_query_set(&self.set, 0..2, &self.resolved, 0);
        encoder.copy_buffer_to_buffer(&self.resolved, 0, &self.readable, 0, QUERY_BYTES);
    }

    fn read_ms(&self, gpu: &Gpu) -> Result<f64, GpuError> {
        let ticks: Vec<u64> = bytemuck::pod_collect_to_vec(&gpu.read(&self.readable)?);
        Ok(ticks[1].saturating_sub(ticks[0]) as f64 * self.tick_ns / 1e6)
    }
}

/// The middle of many times, and how far they spread.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Spread {
    /// Half of the times are below.
    pub median: f64,
    /// One in ten is below.
    pub p10: f64,
    /// One in ten is above.
    pub p90: f64,
}

impl Spread {
    /// Of times in any order and any unit. Of no times at all it is not a number.
    ///
    /// Between two times it is interpolated (R. J. Hyndman, Y. Fan, "Sample Quantiles in Statistical
    /// Packages", The American Statistician 50(4), 1996, definition 7).
    pub fn of(times: &[f64]) -> Spread {
        let mut sorted = times.to_vec();
        sorted.sort_by(f64::total_cmp);
        if sorted.is_empty() {
            return Spread {
                median: f64::NAN,
                p10: f64::NAN,
                p90: f64::NAN,
            };
        }
        let quantile = |q: f64| {
            let at = q * (sorted.len() - 1) as f64;
            let (low, high) = (sorted[at.floor() as usize], sorted[at.ceil() as usize]);
            low + (high - low) * at.fract()
        };
        Spread {
            median: quantile(0.5),
            p10: quantile(0.1),
            p90: quantile(0.9),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::Spread;

    #[test]
    fn quantiles_of_a_ramp_lie_on_the_ramp() {
        let times: Vec<f64> = (0..=100).rev().map(f64::from).collect();
        assert_eq!(
            Spread::of(&times),
            Spread {
                median: 50.0,
                p10: 10.0,
                p90: 90.0
            }
        );
    }

    #[test]
    fn one_time_has_no_spread() {
        assert_eq!(
            Spread::of(&[2.5]),
            Spread {
                median: 2.5,
                p10: 2.5,
                p90: 2.5
            }
        );
    }

    #[test]
    fn an_even_count_has_its_median_between_the_middle_two() {
        assert_eq!(Spread::of(&[4.0, 1.0]).median, 2.5);
    }
}
