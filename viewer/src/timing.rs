//! How long a frame takes: what it draws off screen, and its pass over the screen.

use std::time::Instant;

use crate::frame::Target;
use crate::gpu::{Gpu, GpuError};
use crate::headless::draw_pass;
use crate::timestamps::{Timestamps, tick_ms, ticks_between};

/// Times one frame at a time, between [`FrameTimer::begin`] and [`FrameTimer::end`].
///
/// Every frame is submitted alone and waited for, so no frame overlaps another. Where the adapter has
/// `TIMESTAMP_QUERY` the times are the GPU's own; elsewhere they are the CPU's, from a submission to the
/// end of the wait, which is longer. What is uploaded before a frame is in neither of the GPU's times.
#[derive(Debug)]
pub struct FrameTimer {
    clock: Clock,
}

/// The time of a frame, in milliseconds.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FrameTime {
    /// What was recorded before the pass: the passes off screen.
    pub map_ms: f64,
    /// The pass over the screen.
    pub dome_ms: f64,
}

#[derive(Debug)]
enum Clock {
    /// Timestamps of the GPU, between passes too.
    Encoder(Timestamps),
    /// Timestamps of passes only: passes that draw nothing, into one pixel, mark what is between them.
    Passes(Timestamps, wgpu::TextureView),
    /// No timestamps: what is off screen is submitted by itself.
    Cpu,
}

impl FrameTimer {
    /// A timer for frames on this device, by the best clock that it has.
    ///
    /// # Errors
    /// [`GpuError::FrameSize`], on a device that cannot draw into one pixel.
    pub fn new(gpu: &Gpu) -> Result<FrameTimer, GpuError> {
        let clock = if gpu.has_timestamps_between_passes() {
            Clock::Encoder(Timestamps::new(gpu, COUNT))
        } else if gpu.has_timestamps() {
            Clock::Passes(Timestamps::new(gpu, COUNT), marker(gpu)?)
        } else {
            Clock::Cpu
        };
        Ok(FrameTimer { clock })
    }

    /// Begins a frame: what is recorded into this encoder is its off-screen part.
    pub fn begin(&self, gpu: &Gpu) -> wgpu::CommandEncoder {
        let mut encoder = gpu.device.create_command_encoder(&Default::default());
        match &self.clock {
            Clock::Encoder(timestamps) => encoder.write_timestamp(&timestamps.set, MAP_BEGINS),
            Clock::Passes(timestamps, marker) => {
                let writes = timestamps.writes(None, Some(MAP_BEGINS));
                draw_pass(&mut encoder, marker, Some(writes), |_| ());
            }
            Clock::Cpu => {}
        }
        encoder
    }

    /// Ends a frame by one pass into `view`, waits for it and tells its time.
    ///
    /// # Errors
    /// [`GpuError::Device`].
    pub fn end(
        &self,
        gpu: &Gpu,
        mut encoder: wgpu::CommandEncoder,
        view: &wgpu::TextureView,
        draw: impl FnOnce(&mut wgpu::RenderPass<'_>),
    ) -> Result<FrameTime, GpuError> {
        let timestamps = match &self.clock {
            Clock::Encoder(timestamps) => {
                encoder.write_timestamp(&timestamps.set, MAP_ENDS);
                timestamps
            }
            Clock::Passes(timestamps, marker) => {
                let writes = timestamps.writes(Some(MAP_ENDS), None);
                draw_pass(&mut encoder, marker, Some(writes), |_| ());
                timestamps
            }
            Clock::Cpu => return cpu_time(gpu, encoder, view, draw),
        };
        let writes = timestamps.writes(Some(DOME_BEGINS), Some(DOME_ENDS));
        draw_pass(&mut encoder, view, Some(writes), draw);
        timestamps.resolve(&mut encoder, MAP_BEGINS);
        gpu.queue.submit([encoder.finish()]);
        read(gpu, timestamps)
    }
}

/// The two parts of a frame, submitted one after the other.
fn cpu_time(
    gpu: &Gpu,
    map: wgpu::CommandEncoder,
    view: &wgpu::TextureView,
    draw: impl FnOnce(&mut wgpu::RenderPass<'_>),
) -> Result<FrameTime, GpuError> {
    let mut dome = gpu.device.create_command_encoder(&Default::default());
    draw_pass(&mut dome, view, None, draw);
    let submitted = |encoder: wgpu::CommandEncoder| -> Result<f64, GpuError> {
        let commands = encoder.finish();
        let start = Instant::now();
        gpu.queue.submit([commands]);
        gpu.wait()?;
        Ok(start.elapsed().as_secs_f64() * 1e3)
    };
    Ok(FrameTime {
        map_ms: submitted(map)?,
        dome_ms: submitted(dome)?,
    })
}

/// What passes that only mark a moment draw into.
fn marker(gpu: &Gpu) -> Result<wgpu::TextureView, GpuError> {
    let pixel = gpu.target(Target::Srgb8, [1, 1])?;
    Ok(pixel.create_view(&Default::default()))
}

/// The timestamps of a frame, in their order.
const MAP_BEGINS: u32 = 0;
const MAP_ENDS: u32 = 1;
const DOME_BEGINS: u32 = 2;
const DOME_ENDS: u32 = 3;
const COUNT: u32 = 4;

fn read(gpu: &Gpu, timestamps: &Timestamps) -> Result<FrameTime, GpuError> {
    let ticks: Vec<u64> = bytemuck::pod_collect_to_vec(&gpu.read(&timestamps.readable)?);
    let ms = |begins: u32, ends: u32| {
        ticks_between(ticks[begins as usize], ticks[ends as usize]) * tick_ms(gpu)
    };
    Ok(FrameTime {
        map_ms: ms(MAP_BEGINS, MAP_ENDS),
        dome_ms: ms(DOME_BEGINS, DOME_ENDS),
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::reference::full_screen_pipeline;

    /// Work that takes its time: a chain of a thousand sines a pixel.
    const SLOW: &str = "
        @vertex fn corner(@builtin(vertex_index) i: u32) -> @builtin(position) vec4f {
            return vec4f(f32(i & 1u) * 4.0 - 1.0, f32(i >> 1u) * 4.0 - 1.0, 0.0, 1.0);
        }
        @fragment fn slow(@builtin(position) p: vec4f) -> @location(0) vec4f {
            var v = p.x;
            for (var i = 0; i < 1000; i++) { v = sin(v + p.y); }
            return vec4f(v);
        }";

    /// Least times of three frames with the slow pass off screen, on screen, or on neither: the least, since
    /// a busy machine lengthens single ones.
    fn time(gpu: &Gpu, timer: &FrameTimer, [map, dome]: [bool; 2]) -> FrameTime {
        let format = Target::Srgb8.texture_format();
        let slow = full_screen_pipeline(gpu, SLOW, format, "slow");
        let target = gpu.target(Target::Srgb8, [256, 256]).unwrap();
        let view = target.create_view(&Default::default());
        let draw = |wanted: bool, pass: &mut wgpu::RenderPass<'_>| {
            if wanted {
                pass.set_pipeline(&slow);
                pass.draw(0..3, 0..1);
            }
        };
        let frames = [0; 3].map(|_| {
            let mut encoder = timer.begin(gpu);
            draw_pass(&mut encoder, &view, None, |pass| draw(map, pass));
            timer
                .end(gpu, encoder, &view, |pass| draw(dome, pass))
                .unwrap()
        });
        let least =
            |part: fn(&FrameTime) -> f64| frames.iter().map(part).fold(f64::INFINITY, f64::min);
        FrameTime {
            map_ms: least(|t| t.map_ms),
            dome_ms: least(|t| t.dome_ms),
        }
    }

    #[test]
    fn timestamps_give_each_part_of_a_frame_its_own_time() {
        let gpu = Gpu::open(None).unwrap();
        let mut clocks = Vec::new();
        if gpu.has_timestamps() {
            clocks.push(Clock::Passes(
                Timestamps::new(&gpu, COUNT),
                marker(&gpu).unwrap(),
            ));
        }
        if gpu.has_timestamps_between_passes() {
            clocks.push(Clock::Encoder(Timestamps::new(&gpu, COUNT)));
        }
        for clock in clocks {
            let timer = FrameTimer { clock };
            let off_screen = time(&gpu, &timer, [true, false]);
            let on_screen = time(&gpu, &timer, [false, true]);
            // 65 million sines against one clear of the target: ten times as long on any device.
            let told = format!("{:?}: {off_screen:?} {on_screen:?}", timer.clock);
            assert!(off_screen.map_ms > 2.0 * off_screen.dome_ms, "{told}");
            assert!(on_screen.dome_ms > 2.0 * on_screen.map_ms, "{told}");
        }
    }

    #[test]
    fn without_timestamps_the_wall_clock_serves() {
        let gpu = Gpu::open(None).unwrap();
        let time = time(&gpu, &FrameTimer { clock: Clock::Cpu }, [true, true]);
        assert!(time.map_ms > 0.0 && time.dome_ms > 0.0, "{time:?}");
    }
}
