//! Milliseconds of the passes of a frame that is being shown, without waiting for it.
//!
//! Timestamps of a frame come back some frames later; a frame finds no free slot while three are on their way and is then not timed.
//! For figures that are compared, [`crate::timing`] waits for each frame alone.

use std::sync::mpsc::{Receiver, Sender, channel};

use crate::gpu::Gpu;
use crate::timestamps::{Timestamps, tick_ms, ticks_between};

/// What of a frame is timed, in their order.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Part {
    /// What is drawn before the pass over the screen: maps, shadows, rays.
    OffScreen,
    /// The sky's own pass.
    Sky,
    /// The panel over it.
    Panel,
}

impl Part {
    /// All of them.
    pub const ALL: [Part; 3] = [Part::OffScreen, Part::Sky, Part::Panel];

    /// In a table.
    pub const fn name(self) -> &'static str {
        match self {
            Part::OffScreen => "off screen",
            Part::Sky => "sky",
            Part::Panel => "panel",
        }
    }
}

const QUERIES: u32 = 2 * Part::ALL.len() as u32;
/// Frames on their way.
const SLOTS: usize = 3;

/// Times frames on a device with timestamps.
#[derive(Debug)]
pub struct PassTimes {
    slots: Vec<Slot>,
    arrived: (Sender<usize>, Receiver<usize>),
    between_passes: bool,
    tick_ms: f64,
}

#[derive(Debug)]
struct Slot {
    timestamps: Timestamps,
    is_free: bool,
}

/// A frame that is being recorded, and the slot that its times go into.
#[derive(Clone, Copy, Debug)]
pub struct Timed(usize);

impl PassTimes {
    /// None on a device without timestamps.
    pub fn new(gpu: &Gpu) -> Option<PassTimes> {
        gpu.has_timestamps().then(|| PassTimes {
            slots: (0..SLOTS)
                .map(|_| Slot {
                    timestamps: Timestamps::new(gpu, QUERIES),
                    is_free: true,
                })
                .collect(),
            arrived: channel(),
            between_passes: gpu.has_timestamps_between_passes(),
            tick_ms: tick_ms(gpu),
        })
    }

    /// Begins a frame whose off-screen part is recorded next.
    pub fn begin(&mut self, encoder: &mut wgpu::CommandEncoder) -> Option<Timed> {
        let index = self.slots.iter().position(|slot| slot.is_free)?;
        if self.between_passes {
            encoder.write_timestamp(&self.slots[index].timestamps.set, 0);
        }
        Some(Timed(index))
    }

    /// Ends the off-screen part.
    pub fn off_screen_ends(&self, timed: Timed, encoder: &mut wgpu::CommandEncoder) {
        if self.between_passes {
            encoder.write_timestamp(&self.slots[timed.0].timestamps.set, 1);
        }
    }

    /// Where the pass of a part writes its times.
    pub fn writes(&self, timed: Timed, part: Part) -> wgpu::RenderPassTimestampWrites<'_> {
        let first = 2 * part as u32;
        let timestamps = &self.slots[timed.0].timestamps;
        timestamps.writes(Some(first), Some(first + 1))
    }

    /// Ends a frame, before its encoder is submitted.
    pub fn end(&self, timed: Timed, encoder: &mut wgpu::CommandEncoder) {
        let first = if self.between_passes { 0 } else { 2 };
        self.slots[timed.0].timestamps.resolve(encoder, first);
    }

    /// Asks for the times, after the encoder was submitted.
    pub fn submitted(&mut self, timed: Timed) {
        let slot = &mut self.slots[timed.0];
        slot.is_free = false;
        let sender = self.arrived.0.clone();
        slot.timestamps
            .readable
            .slice(..)
            .map_async(wgpu::MapMode::Read, move |mapped| {
                if mapped.is_ok() {
                    // Nobody waits for it any more once the receiver is gone.
                    sender.send(timed.0).ok();
                }
            });
    }

    /// The times that have come back since, in milliseconds, in the order of [`Part::ALL`]; none for what this device does not tell.
    pub fn arrived(&mut self) -> Vec<[Option<f64>; Part::ALL.len()]> {
        let mut times = Vec::new();
        while let Ok(index) = self.arrived.1.try_recv() {
            let slot = &mut self.slots[index];
            if let Ok(bytes) = slot.timestamps.readable.slice(..).get_mapped_range() {
                times.push(of_ticks(
                    &bytemuck::pod_collect_to_vec(&bytes),
                    self.between_passes,
                    self.tick_ms,
                ));
            }
            slot.timestamps.readable.unmap();
            slot.is_free = true;
        }
        times
    }
}

/// The resolved ticks as times. Without ticks between passes they begin with the sky's.
fn of_ticks(ticks: &[u64], between_passes: bool, tick_ms: f64) -> [Option<f64>; Part::ALL.len()] {
    let skipped = if between_passes { 0 } else { 1 };
    Part::ALL.map(|part| {
        let pair = 2 * (part as usize).checked_sub(skipped)?;
        let (begin, end) = (ticks.get(pair)?, ticks.get(pair + 1)?);
        Some(ticks_between(*begin, *end) * tick_ms)
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::frame::Target;
    use crate::headless::draw_pass;

    #[test]
    fn ticks_become_the_times_of_their_parts() {
        let ticks = [10, 30, 100, 400, 400, 401];
        let all = of_ticks(&ticks, true, 0.5);
        assert_eq!(all, [Some(10.0), Some(150.0), Some(0.5)]);
        let passes_only = of_ticks(&ticks[2..], false, 0.5);
        assert_eq!(passes_only, [None, Some(150.0), Some(0.5)]);
    }

    #[test]
    fn every_frame_s_times_come_back_and_free_their_slot() {
        let gpu = Gpu::open(None).unwrap();
        let Some(mut times) = PassTimes::new(&gpu) else {
            return;
        };
        let target = gpu.target(Target::Srgb8, [64, 64]).unwrap();
        let view = target.create_view(&Default::default());
        let mut came_back = 0;
        for frame in 0..10 {
            let mut encoder = gpu.device.create_command_encoder(&Default::default());
            let timed = times.begin(&mut encoder);
            // Three may be on their way; the next is not timed until one has come back.
            assert_eq!(timed.is_some(), frame % 4 != 3);
            if let Some(timed) = timed {
                times.off_screen_ends(timed, &mut encoder);
                for part in [Part::Sky, Part::Panel] {
                    draw_pass(&mut encoder, &view, Some(times.writes(timed, part)), |_| ());
                }
                times.end(timed, &mut encoder);
            }
            gpu.queue.submit([encoder.finish()]);
            if let Some(timed) = timed {
                times.submitted(timed);
            } else {
                gpu.wait().unwrap();
                came_back += times.arrived().len();
            }
        }
        gpu.wait().unwrap();
        came_back += times.arrived().len();
        assert_eq!(came_back, 8);
    }
}
