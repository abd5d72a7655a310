//! `welkin-view bench`: milliseconds of a frame, of each method and of the reference passes, in one run.
//!
//! The frames take turns, one after another, so that a change of the GPU's clock meets all of them alike.
//! Each sky is prepared anew for each of its frames, a sixtieth of a second after the last, so that nothing
//! off screen is left from the frame before. docs/json.md tells what `--json` prints.

mod mukhina;
mod report;
pub mod scene;

use std::io::{ErrorKind, Write};
use std::time::Instant;

use anyhow::{Result, anyhow};
use welkin_pack::Pack;
use welkin_runtime::Sky;
use welkin_viewer::frame::Target;
use welkin_viewer::gpu::{Gpu, GpuError};
use welkin_viewer::headless::new_sky;
use welkin_viewer::reference::ReferencePass;
use welkin_viewer::timing::FrameTimer;

use crate::cli::{BenchArgs, Protocol};
use report::{FOUR_SAMPLES, Report, Row, Times};
use scene::{Scene, scenes, scenes_of_sprites};

/// Frames before the first that counts: shaders get compiled, clocks get up.
const WARM_UP_FRAMES: u32 = 10;

/// Seconds of the animation from one frame of a row to its next.
const FRAME_S: f64 = 1.0 / 60.0;

/// Name and entry point of the reference passes.
const REFERENCES: [(&str, &str); 2] =
    [("one sample", "one_sample"), (FOUR_SAMPLES, "four_samples")];

pub fn run(args: &BenchArgs) -> Result<()> {
    let pack = Pack::open(&args.pack)?;
    let gpu = Gpu::open()?;
    let text = match args.protocol {
        None => print(args, &report(&gpu, &pack, args)?, Report::table),
        Some(Protocol::Mukhina) => print(
            args,
            &mukhina::report(&gpu, &pack, args.frames())?,
            mukhina::Report::table,
        ),
    }?;
    let mut stdout = std::io::stdout().lock();
    match stdout
        .write_all(text.as_bytes())
        .and_then(|()| stdout.flush())
    {
        // Whoever read the pipe has seen enough.
        Err(e) if e.kind() == ErrorKind::BrokenPipe => Ok(()),
        written => written.map_err(|e| {
            anyhow!("standard output: cannot be written: {e}; make room where it goes")
        }),
    }
}

/// What is drawn for a row of the table.
enum Subject {
    /// A sky of its own, so that no other row's frame lies between two of its own.
    Sky(Box<Sky>, Box<Scene>),
    Reference(ReferencePass),
}

/// A report as the options want it.
fn print<R: serde::Serialize>(
    args: &BenchArgs,
    report: &R,
    table: fn(&R) -> String,
) -> Result<String> {
    Ok(if args.json {
        serde_json::to_string_pretty(report)? + "\n"
    } else {
        table(report)
    })
}

fn report(gpu: &Gpu, pack: &Pack, args: &BenchArgs) -> Result<Report, GpuError> {
    let scenes = match args.scene {
        Some(of) => scenes_of_sprites(of, args.ring).into(),
        None => {
            let of = |method| scenes(method, args.ring);
            args.methods().into_iter().flat_map(of).collect()
        }
    };
    Ok(Report {
        adapter: gpu.adapter.clone(),
        clock: clock(gpu),
        size: args.size(),
        frames: args.frames(),
        warm_up_frames: WARM_UP_FRAMES,
        passes: measure(gpu, pack, scenes, args.size(), args.frames())?,
    })
}

/// Whose clock it is: docs/json.md.
fn clock(gpu: &Gpu) -> &'static str {
    if gpu.has_timestamps() { "gpu" } else { "cpu" }
}

/// The rows of these scenes and of the reference passes.
fn measure(
    gpu: &Gpu,
    pack: &Pack,
    scenes: Vec<Scene>,
    size: [u32; 2],
    frames: u32,
) -> Result<Vec<Row>, GpuError> {
    let mut subjects = subjects(gpu, pack, scenes)?;
    let target = gpu.target(Target::Srgb8, size)?;
    let view = target.create_view(&Default::default());
    let timer = FrameTimer::new(gpu)?;
    let mut times = vec![Times::default(); subjects.len()];
    for frame in 0..WARM_UP_FRAMES + frames {
        for ((_, subject), times) in subjects.iter_mut().zip(&mut times) {
            let time = time(gpu, &timer, &view, subject, frame)?;
            if frame >= WARM_UP_FRAMES {
                times.push(time);
            }
        }
    }
    let rows = subjects.into_iter().zip(&times);
    Ok(report::with_ratios(
        rows.map(|((name, subject), times)| row(name, &subject, times))
            .collect(),
    ))
}

fn subjects(
    gpu: &Gpu,
    pack: &Pack,
    scenes: Vec<Scene>,
) -> Result<Vec<(String, Subject)>, GpuError> {
    let skies = scenes.into_iter().map(|scene| {
        let sky = new_sky(gpu, pack, Target::Srgb8.texture_format())?;
        Ok((scene.name(), Subject::Sky(Box::new(sky), Box::new(scene))))
    });
    let references = REFERENCES.into_iter().map(|(name, entry_point)| {
        let format = Target::Srgb8.texture_format();
        let pass = ReferencePass::new(gpu, pack, format, entry_point)?;
        Ok((name.to_string(), Subject::Reference(pass)))
    });
    skies.chain(references).collect()
}

/// Milliseconds of [`Sky::prepare`] on the CPU, of the passes off screen and of the pass on the screen.
fn time(
    gpu: &Gpu,
    timer: &FrameTimer,
    view: &wgpu::TextureView,
    subject: &mut Subject,
    frame: u32,
) -> Result<[f64; 3], GpuError> {
    let mut encoder = timer.begin(gpu);
    let start = Instant::now();
    if let Subject::Sky(sky, scene) = subject {
        let size = [view.texture().width(), view.texture().height()];
        let (params, camera) = (scene.params(frame), scene.camera(size, frame));
        let seconds = f64::from(frame) * FRAME_S;
        sky.prepare(&gpu.queue, &mut encoder, &params, &camera, seconds);
    }
    let prepare_ms = start.elapsed().as_secs_f64() * 1e3;
    let time = timer.end(gpu, encoder, view, |pass| match subject {
        Subject::Sky(sky, _) => sky.draw(pass),
        Subject::Reference(reference) => reference.draw(pass),
    })?;
    Ok([prepare_ms, time.map_ms, time.dome_ms])
}

fn row(name: String, subject: &Subject, times: &Times) -> Row {
    match subject {
        Subject::Sky(sky, scene) => {
            let method = scene.method();
            let row = Row::of_sky(name, method.name(), sky.memory_bytes(method), times);
            row.with_sprites(sky.sprites_drawn())
        }
        Subject::Reference(_) => Row::of_reference(name, times),
    }
}
