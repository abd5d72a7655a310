//! Rows of figures: skies and reference passes that take turns.

use std::time::Instant;

use welkin_pack::Pack;
use welkin_runtime::Sky;
use welkin_viewer::frame::Target;
use welkin_viewer::gpu::{Gpu, GpuError};
use welkin_viewer::headless::new_sky;
use welkin_viewer::reference::ReferencePass;
use welkin_viewer::timing::FrameTimer;

use super::report::{FOUR_SAMPLES, Row, Times, with_ratios};
use super::scene::Scene;

/// Frames before the first that counts: shaders get compiled, clocks get up.
pub(super) const WARM_UP_FRAMES: u32 = 10;

/// Seconds of the animation from one frame of a row to its next.
const FRAME_S: f64 = 1.0 / 60.0;

/// Name and entry point of the reference passes.
const REFERENCES: [(&str, &str); 2] =
    [("one sample", "one_sample"), (FOUR_SAMPLES, "four_samples")];

/// What is drawn for a row of the table.
enum Subject {
    /// A sky of its own, so that no other row's frame lies between two of its own.
    Sky(Box<Sky>, Box<Scene>),
    Reference(ReferencePass),
}

/// Whose clock it is: docs/json.md.
pub(super) fn clock(gpu: &Gpu) -> &'static str {
    if gpu.has_timestamps() { "gpu" } else { "cpu" }
}

/// The rows of these scenes and of the reference passes.
pub(super) fn measure(
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
    Ok(with_ratios(
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
