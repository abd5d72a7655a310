//! `welkin-view [PACK]`: the window with the sliders.
//!
//! One direction of flow: events change the [`State`], the panel shows and changes it too and leaves wishes there, the app carries
//! the wishes out, [`graphics::Graphics`] draws. Baking and watching have a thread each and send what they have to the event loop.

mod app;
mod bake;
mod command;
mod dropped;
mod graphics;
mod keyboard;
mod libraries;
mod panel;
mod recipe;
mod shot;
mod state;
mod wake;
mod watch;
mod wishes;

use anyhow::{Result, anyhow};
use winit::event_loop::EventLoop;

use crate::cli::WindowArgs;
use app::App;
use state::State;
use wake::Wake;

/// Opens the window and stays until it is closed.
///
/// # Errors
/// A pack or settings that cannot be read, no display, no adapter.
pub fn run(args: &WindowArgs) -> Result<()> {
    let state = State::open(args)?;
    if let Some(error) = libraries::missing() {
        return Err(error);
    }
    let event_loop = EventLoop::<Wake>::with_user_event()
        .build()
        .map_err(|error| no_display(&error))?;
    let mut app = App::new(args, state, event_loop.create_proxy());
    event_loop
        .run_app(&mut app)
        .map_err(|e| anyhow!("the window ended: {e}; start it again"))?;
    app.failure.map_or(Ok(()), Err)
}

fn no_display(reason: &dyn std::error::Error) -> anyhow::Error {
    if let Some(error) = libraries::named(&format!("{reason} {reason:?}")) {
        return error;
    }
    anyhow!(
        "there is no display to open a window on ({reason}); start it in a desktop session, or draw without a window: \
         `welkin-view render PACK -o FRAME.png`"
    )
}
