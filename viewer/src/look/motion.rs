//! How a method's sky moves.

use anyhow::{Result, ensure};
use welkin_pack::{Pack, interrupt};
use welkin_runtime::Method;
use welkin_viewer::export::display::encoded_luminance;
use welkin_viewer::frame::Target;
use welkin_viewer::gpu::Gpu;
use welkin_viewer::headless::{Stage, View};
use welkin_viewer::motion::{change, pop};
use welkin_viewer::structure::remaining;

use super::scene;

/// Frames a second that are compared with each other.
const FPS: u32 = 30;
/// The most that the largest change between frames may be of the median one.
const MOST_POP: f32 = 2.0;

/// What was found.
#[derive(Clone, Copy, Debug)]
pub struct Motion {
    /// For so many seconds.
    seconds: u32,
    /// The largest change between two frames, in medians.
    pop: f32,
    /// The second of it.
    at_s: f32,
    /// How much the zenith at last is like that at first, moved.
    remaining: f32,
}

impl Motion {
    /// Draws a sky as an application does, frame after frame, each with what the one before has left.
    pub fn of(gpu: &Gpu, pack: &Pack, method: Method, seconds: u32) -> Result<Motion> {
        // What a display would round away, and dither, is a change too.
        let mut stage = Stage::new(gpu, pack, Target::Linear)?;
        let mut changes = Vec::new();
        let mut last: Option<Vec<f32>> = None;
        for number in 0..=seconds * FPS {
            ensure!(!interrupt::requested(), "interrupted: nothing is written");
            let view = View {
                seconds: f64::from(number) / f64::from(FPS),
                ..scene::moving(method)
            };
            let picture = encoded_luminance(&stage.draw(&view)?, &view.params);
            changes.extend(last.iter().map(|last| change(last, &picture)));
            last = Some(picture);
        }
        let pop = pop(&changes);
        let mut stage = Stage::new(gpu, pack, Target::Srgb8)?;
        let mut zenith = |seconds| {
            stage.reset_history();
            stage.draw(&View {
                seconds,
                ..scene::zenith(method)
            })
        };
        Ok(Motion {
            seconds,
            pop: pop.map_or(f32::INFINITY, |pop| pop.ratio),
            at_s: pop.map_or(0.0, |pop| (pop.index + 1) as f32 / FPS as f32),
            remaining: remaining(&zenith(0.0)?, &zenith(f64::from(seconds))?),
        })
    }

    /// What is beyond the bounds.
    pub fn problem(&self, method: Method) -> Option<String> {
        // Not a number is beyond.
        let sound = self.pop <= MOST_POP;
        (!sound).then(|| {
            format!(
                "{}: the picture changes {:.2} times as much as usual at {:.2} s, expected at most {MOST_POP}",
                method.name(),
                self.pop,
                self.at_s
            )
        })
    }

    /// The numbers of the table.
    pub fn columns(&self) -> String {
        format!("{:5.2} {:5.2}", self.pop, self.remaining)
    }

    /// For a person.
    pub fn sentence(&self) -> String {
        format!(
            "In {} seconds the largest change between frames is {:.2} times the median one (at {:.2} s); shapes overhead are then {:.2} like those at first, moved.",
            self.seconds, self.pop, self.at_s, self.remaining
        )
    }
}
