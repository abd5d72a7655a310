//! `welkin-view bench`: milliseconds a pass, of the sky and of the reference passes, in one run.
//!
//! The passes take turns, one after another in every frame, so that a change of the GPU's clock meets
//! all of them alike. The camera looks up far enough that sky fills the whole frame.
//!
//! `--json` prints one object: `adapter` and `clock` (`gpu` or `cpu`) say what was measured by what;
//! `size` is the width and height in pixels, `frames` how often each pass was timed, after
//! `warm_up_frames`; `passes` lists `name`, `median_ms`, `p10_ms`, `p90_ms` and `ratio`, the median over
//! that of the pass of four samples.

use std::io::{ErrorKind, Write};

use anyhow::{Context, Result};
use serde::Serialize;
use welkin_pack::Pack;
use welkin_runtime::{Camera, Sky, SkyParams};
use welkin_viewer::frame::Target;
use welkin_viewer::gpu::Gpu;
use welkin_viewer::headless::new_sky;
use welkin_viewer::reference::ReferencePass;
use welkin_viewer::timing::{PassTimer, Spread};

use crate::cli::BenchArgs;

/// Frames before the first that counts: shaders get compiled, clocks get up.
const WARM_UP_FRAMES: u32 = 10;

/// With this the lower edge of the frame is 20 degrees above the horizon at its middle, and above it
/// everywhere, however wide the frame is.
const CAMERA_ELEVATION_DEG: f32 = 50.0;
const CAMERA_FOV_DEG: f32 = 60.0;

/// The pass that ratios are told of.
const YARDSTICK: &str = "four samples";

/// Name, time of day, sunset, and azimuth of the view in degrees: towards the sun, so that it is paid for.
const SKIES: [(&str, f32, f32, f32); 3] = [
    ("sky, noon", 0.5, 0.0, 180.0),
    ("sky, sunset", 0.74, 1.0, 270.0),
    ("sky, night", 0.0, 0.0, 180.0),
];

/// Name and entry point of the reference passes.
const REFERENCES: [(&str, &str); 2] = [("one sample", "one_sample"), (YARDSTICK, "four_samples")];

pub fn run(args: &BenchArgs) -> Result<()> {
    let pack = Pack::open(&args.pack)?;
    let gpu = Gpu::open()?;
    let report = measure(&gpu, &pack, args)?;
    let text = if args.json {
        serde_json::to_string_pretty(&report)? + "\n"
    } else {
        report.table()
    };
    let mut stdout = std::io::stdout().lock();
    match stdout
        .write_all(text.as_bytes())
        .and_then(|()| stdout.flush())
    {
        // Whoever read the pipe has seen enough.
        Err(e) if e.kind() == ErrorKind::BrokenPipe => Ok(()),
        written => written.context("standard output cannot be written; make room where it goes"),
    }
}

#[derive(Debug, Serialize)]
struct Report {
    adapter: String,
    clock: &'static str,
    size: [u32; 2],
    frames: u32,
    warm_up_frames: u32,
    passes: Vec<PassTime>,
}

#[derive(Debug, Serialize)]
struct PassTime {
    name: &'static str,
    median_ms: f64,
    p10_ms: f64,
    p90_ms: f64,
    ratio: f64,
}

enum Pass {
    Sky(Box<Sky>),
    Reference(ReferencePass),
}

fn measure(gpu: &Gpu, pack: &Pack, args: &BenchArgs) -> Result<Report> {
    let passes = passes(gpu, pack, args.size)?;
    let view = gpu
        .target(Target::Srgb8, args.size)?
        .create_view(&Default::default());
    let timer = PassTimer::new(gpu);
    let mut times_ms = vec![Vec::new(); passes.len()];
    for frame in 0..WARM_UP_FRAMES + args.frames {
        for ((_, pass), times) in passes.iter().zip(&mut times_ms) {
            let time = timer.time_ms(gpu, &view, |render_pass| match pass {
                Pass::Sky(sky) => sky.draw(render_pass),
                Pass::Reference(reference) => reference.draw(render_pass),
            })?;
            if frame >= WARM_UP_FRAMES {
                times.push(time);
            }
        }
    }
    let names = passes.iter().map(|(name, _)| *name);
    Ok(Report {
        adapter: gpu.adapter.clone(),
        clock: if gpu.has_timestamps() { "gpu" } else { "cpu" },
        size: args.size,
        frames: args.frames,
        warm_up_frames: WARM_UP_FRAMES,
        passes: pass_times(
            &names
                .zip(times_ms.iter().map(|t| Spread::of(t)))
                .collect::<Vec<_>>(),
        ),
    })
}

/// Every sky has its own uniforms, so nothing is uploaded between the passes.
fn passes(gpu: &Gpu, pack: &Pack, size: [u32; 2]) -> Result<Vec<(&'static str, Pass)>> {
    let mut passes = Vec::new();
    for (name, time, sunset, azimuth_deg) in SKIES {
        let mut sky = new_sky(gpu, pack, Target::Srgb8)?;
        let camera = Camera::looking(
            azimuth_deg.to_radians(),
            CAMERA_ELEVATION_DEG.to_radians(),
            CAMERA_FOV_DEG.to_radians(),
            size,
        );
        sky.prepare(
            &gpu.queue,
            &SkyParams {
                time,
                sunset,
                ..SkyParams::default()
            },
            &camera,
            0.0,
        );
        passes.push((name, Pass::Sky(Box::new(sky))));
    }
    for (name, entry_point) in REFERENCES {
        let format = Target::Srgb8.texture_format();
        passes.push((
            name,
            Pass::Reference(ReferencePass::new(gpu, pack, format, entry_point)?),
        ));
    }
    Ok(passes)
}

fn pass_times(spreads: &[(&'static str, Spread)]) -> Vec<PassTime> {
    let yardstick = spreads.iter().find(|(name, _)| *name == YARDSTICK);
    let yardstick_ms = yardstick.map_or(f64::NAN, |(_, spread)| spread.median);
    let pass_time = |&(name, s): &(&'static str, Spread)| PassTime {
        name,
        median_ms: s.median,
        p10_ms: s.p10,
        p90_ms: s.p90,
        ratio: s.median / yardstick_ms,
    };
    spreads.iter().map(pass_time).collect()
}

impl Report {
    fn table(&self) -> String {
        let clock = match self.clock {
            "gpu" => "GPU time by timestamp queries",
            _ => "CPU wall time with the wait for the GPU, since it has no timestamp queries",
        };
        let mut text = format!(
            "{}\n{}x{} pixels, sky fills the frame (looking up {CAMERA_ELEVATION_DEG} degrees), \
             {} frames after {} to warm up\n{clock}, in milliseconds\n\n\
             {:<14}{:>10}{:>10}{:>10}{:>18}\n",
            self.adapter,
            self.size[0],
            self.size[1],
            self.frames,
            self.warm_up_frames,
            "pass",
            "median",
            "p10",
            "p90",
            "of four samples",
        );
        for pass in &self.passes {
            text += &format!(
                "{:<14}{:>10.3}{:>10.3}{:>10.3}{:>17.2}x\n",
                pass.name, pass.median_ms, pass.p10_ms, pass.p90_ms, pass.ratio
            );
        }
        text
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn spread(median: f64) -> Spread {
        Spread {
            median,
            p10: median,
            p90: median,
        }
    }

    #[test]
    fn ratios_are_told_of_the_four_sample_pass() {
        let times = pass_times(&[("sky, noon", spread(3.0)), (YARDSTICK, spread(2.0))]);
        assert_eq!([times[0].ratio, times[1].ratio], [1.5, 1.0]);
    }

    #[test]
    fn sky_fills_the_frame_of_the_benchmark_however_wide_it_is() {
        let half = (CAMERA_FOV_DEG / 2.0).to_radians().tan();
        let (sin, cos) = CAMERA_ELEVATION_DEG.to_radians().sin_cos();
        for aspect in [1.0, 4.0 / 3.0, 16.0 / 9.0, 4.0] {
            // The lowest direction is a lower corner: forward - up * half + right * half * aspect.
            let length = (1.0 + half * half * (1.0 + aspect * aspect)).sqrt();
            assert!((sin - half * cos) / length > 0.0, "aspect {aspect}");
        }
    }
}
