//! The event loop's side: events in, wishes carried out, frames asked for.

use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::{Duration, Instant};

use anyhow::{Result, anyhow};
use welkin_controls::Pilot;
use welkin_pack::Pack;
use welkin_viewer::wanted::Wanted;
use winit::application::ApplicationHandler;
use winit::dpi::PhysicalSize;
use winit::event::{ElementState, MouseButton, MouseScrollDelta, WindowEvent};
use winit::event_loop::{ActiveEventLoop, ControlFlow, EventLoopProxy};
use winit::keyboard::ModifiersState;
use winit::window::{Window, WindowId};

use super::bake::{Baker, Job, Text};
use super::dropped::{Dropped, sort};
use super::graphics::Graphics;
use super::state::{State, read_settings};
use super::wake::{Baked, Wake};
use super::{keyboard, panel, watch};
use crate::cli::WindowArgs;
use crate::told::told;

/// The longest step of a frame: after a pause of the machine the sky does not leap.
const LONGEST_STEP_S: f32 = 0.25;
/// Pixels of a touchpad that count as a notch of a wheel.
const NOTCH_PX: f64 = 50.0;

pub struct App {
    /// Why the window ended, if it was not closed.
    pub failure: Option<anyhow::Error>,
    pub(super) state: State,
    pub(super) graphics: Option<Graphics>,
    /// Number of the device that is open: one that was left tells of its end too.
    device: u64,
    /// Kept over a lost device, with what is open and where it is scrolled to.
    ui: egui::Context,
    proxy: EventLoopProxy<Wake>,
    baker: Baker,
    watched: Option<PathBuf>,
    /// Where packs of the watched recipe are written to. A pack that was dropped is only looked at.
    watched_pack: Option<PathBuf>,
    photo: Option<PathBuf>,
    /// The GPU to draw with.
    wanted: Option<Wanted>,
    size_px: [u32; 2],
    last_frame: Instant,
    /// When the panel wants to be drawn again by itself.
    panel_due: Option<Instant>,
    modifiers: ModifiersState,
    /// Nobody sees the window: it asks for no frames, which nothing would hold back.
    is_occluded: bool,
    drag: Option<[f64; 2]>,
    pointer: [f64; 2],
}

impl App {
    pub fn new(args: &WindowArgs, state: State, proxy: EventLoopProxy<Wake>) -> App {
        App {
            failure: None,
            state,
            graphics: None,
            device: 0,
            ui: panel::context(),
            baker: Baker::new(proxy.clone()),
            watched: args.watch.clone(),
            watched_pack: args.watch.as_ref().and(args.pack.clone()),
            photo: None,
            wanted: args.gpu.gpu.clone(),
            size_px: args.window_size,
            last_frame: Instant::now(),
            panel_due: None,
            modifiers: ModifiersState::default(),
            is_occluded: false,
            drag: None,
            pointer: [0.0; 2],
            proxy,
        }
    }

    fn begin(&mut self, event_loop: &ActiveEventLoop) -> Result<()> {
        let [width, height] = self.size_px;
        let attributes = Window::default_attributes()
            .with_title("Welkin")
            .with_inner_size(PhysicalSize::new(width, height));
        let window = event_loop.create_window(attributes).map_err(|e| {
            anyhow!("no window can be opened: {e}; look whether the desktop session is well")
        })?;
        self.open_graphics(event_loop, window.into())?;
        if let Some(recipe) = self.watched.clone() {
            watch::begin(recipe, self.proxy.clone());
            self.bake();
        }
        Ok(())
    }

    fn open_graphics(&mut self, event_loop: &ActiveEventLoop, window: Arc<Window>) -> Result<()> {
        self.device += 1;
        let graphics = Graphics::open(
            window,
            (event_loop.owned_display_handle(), self.wanted.as_ref()),
            &self.state.source.pack,
            self.ui.clone(),
            (self.device, &self.proxy),
        )?;
        self.state.adapter.clone_from(&graphics.gpu.adapter);
        graphics.window.request_redraw();
        self.graphics = Some(graphics);
        Ok(())
    }

    /// Opens the device anew, after the old one is gone: the window and all settings stay.
    fn reopen_graphics(&mut self, event_loop: &ActiveEventLoop, reason: &str) {
        let Some(old) = self.graphics.take() else {
            return;
        };
        let window = old.window.clone();
        drop(old);
        // The panel's textures went with the device: a new context uploads its own, and takes over what is open.
        let ui = panel::context();
        ui.memory_mut(|memory| *memory = self.ui.memory(Clone::clone));
        self.ui = ui;
        match self.open_graphics(event_loop, window) {
            Ok(()) if reason.is_empty() => self
                .state
                .tell_error("the GPU was left and opened again".to_string()),
            Ok(()) => self
                .state
                .tell_error(format!("the GPU was lost ({reason}) and was opened again")),
            Err(error) => self.fail(event_loop, error.context("the GPU was lost")),
        }
    }

    fn fail(&mut self, event_loop: &ActiveEventLoop, error: anyhow::Error) {
        self.failure = Some(error);
        event_loop.exit();
    }

    fn draw(&mut self, event_loop: &ActiveEventLoop) {
        let step = self.last_frame.elapsed();
        self.last_frame = Instant::now();
        self.state.times.push_frame(step.as_secs_f64() * 1e3);
        self.state.advance(step.as_secs_f32().min(LONGEST_STEP_S));
        let Some(graphics) = &mut self.graphics else {
            return;
        };
        let input = graphics.egui.take_egui_input(&graphics.window);
        let output = self.ui.run_ui(input, |ui| panel::show(ui, &mut self.state));
        let delay = output
            .viewport_output
            .values()
            .map(|viewport| viewport.repaint_delay)
            .min();
        self.panel_due = delay
            .filter(|delay| *delay < Duration::from_secs(3600))
            .map(|delay| Instant::now() + delay);
        let drawn = graphics.draw(&self.state.settings, output, &mut self.state.times);
        if let Err(error) = drawn {
            self.reopen_graphics(event_loop, &error.to_string());
        }
        for wish in std::mem::take(&mut self.state.wishes) {
            match self.fulfil(wish) {
                Ok(Some(done)) => self.state.tell(done),
                Ok(None) => {}
                Err(error) => self.state.tell_error(told(&error)),
            }
        }
    }

    /// Bakes the watched recipe, or else the shown pack's own, with the photograph that was dropped.
    fn bake(&mut self) {
        let recipe = match &self.watched {
            Some(file) => Text::File(file.clone()),
            None => Text::Here(self.state.source.pack.manifest().recipe.clone()),
        };
        self.baker.begin(Job {
            recipe,
            photo: self.photo.clone(),
            save_to: self.watched_pack.clone(),
        });
    }

    /// Shows a pack that is new, or keeps the old one and says why.
    fn take(&mut self, baked: Result<Baked, String>) {
        self.state.baking = None;
        match baked {
            Ok(baked) => {
                let is_saved = baked.saved_to.is_some();
                self.show(baked.pack, baked.saved_to, is_saved);
                for warning in baked.warnings {
                    self.state.tell(warning);
                }
            }
            Err(error) => self.state.tell_error(format!("the old sky stays: {error}")),
        }
    }

    fn show(&mut self, pack: Pack, folder: Option<PathBuf>, is_saved: bool) {
        if let Some(graphics) = &mut self.graphics
            && let Err(error) = graphics.show(&pack, &self.state.settings)
        {
            self.state.tell_error(format!("the old sky stays: {error}"));
            return;
        }
        let name = pack.manifest().name.clone();
        let source = &mut self.state.source;
        source.pack = pack.into();
        source.is_saved = is_saved;
        if is_saved {
            source.folder = folder;
        }
        self.state.notices.retain(|notice| !notice.is_error);
        self.state.tell(format!("{name}: shown"));
    }

    fn receive(&mut self, path: &Path) {
        match sort(path) {
            Dropped::Pack(folder) => match Pack::open(&folder) {
                Ok(pack) => {
                    self.photo = None;
                    self.show(pack, Some(folder), true);
                }
                Err(error) => self.state.tell_error(format!("the old sky stays: {error}")),
            },
            Dropped::Photo(file) => {
                self.photo = Some(file);
                self.bake();
            }
            Dropped::Settings(file) => match read_settings(&file) {
                Ok(settings) => (self.state.settings, self.state.blend) = (settings, None),
                Err(error) => self.state.tell_error(told(&error)),
            },
            Dropped::Unknown(text) => self.state.tell_error(text),
        }
    }

    fn is_over_panel(&self) -> bool {
        self.pointer[0] < self.state.panel_edge_px
    }

    /// An event that the panel did not take.
    fn handle(&mut self, event: &WindowEvent, height_px: f32) {
        match event {
            WindowEvent::KeyboardInput { event, .. } => keyboard::key(
                &mut self.state,
                event.physical_key,
                event.state,
                event.repeat,
                self.modifiers.control_key() || self.modifiers.super_key(),
            ),
            WindowEvent::MouseInput { state, button, .. } => {
                if matches!(button, MouseButton::Left | MouseButton::Right) {
                    let is_down = *state == ElementState::Pressed;
                    self.drag = is_down.then_some(self.pointer);
                }
            }
            WindowEvent::CursorMoved { position, .. } => {
                if let Some(from) = &mut self.drag {
                    let moved = [position.x - from[0], position.y - from[1]];
                    *from = [position.x, position.y];
                    let view = &mut self.state.settings.view;
                    Pilot::drag(view, moved.map(|px| px as f32), height_px);
                }
            }
            WindowEvent::MouseWheel { delta, .. } => {
                let notches = match delta {
                    MouseScrollDelta::LineDelta(_, lines) => *lines,
                    MouseScrollDelta::PixelDelta(px) => (px.y / NOTCH_PX) as f32,
                };
                let state = &mut self.state;
                if state.pilot.flying {
                    state.pilot.accelerate(notches);
                } else {
                    Pilot::zoom(&mut state.settings.view, notches);
                }
            }
            WindowEvent::DroppedFile(path) => self.receive(path),
            _ => {}
        }
    }
}

/// Whether an event is of the place that the pointer is at.
fn is_pointed(event: &WindowEvent) -> bool {
    matches!(
        event,
        WindowEvent::MouseInput { .. } | WindowEvent::MouseWheel { .. }
    )
}

impl ApplicationHandler<Wake> for App {
    fn resumed(&mut self, event_loop: &ActiveEventLoop) {
        if self.graphics.is_none()
            && let Err(error) = self.begin(event_loop)
        {
            self.fail(event_loop, error);
        }
    }

    fn user_event(&mut self, event_loop: &ActiveEventLoop, wake: Wake) {
        match wake {
            Wake::Baking(step, share) => self.state.baking = Some((step, share)),
            Wake::Baked(baked) => self.take(*baked),
            Wake::RecipeSaved => self.bake(),
            Wake::DeviceLost(number, reason) if number == self.device => {
                self.reopen_graphics(event_loop, &reason);
            }
            Wake::DeviceLost(..) => {}
            Wake::DeviceError(text) => self.state.tell_error(text),
        }
        if let Some(graphics) = &self.graphics {
            graphics.window.request_redraw();
        }
    }

    fn window_event(&mut self, event_loop: &ActiveEventLoop, _: WindowId, event: WindowEvent) {
        let Some(graphics) = &mut self.graphics else {
            return;
        };
        let response = graphics.egui.on_window_event(&graphics.window, &event);
        if response.repaint {
            graphics.window.request_redraw();
        }
        let height_px = graphics.size_px()[1] as f32;
        match &event {
            WindowEvent::CloseRequested => event_loop.exit(),
            WindowEvent::Resized(size) => graphics.resize((*size).into()),
            WindowEvent::RedrawRequested => self.draw(event_loop),
            WindowEvent::ModifiersChanged(modifiers) => self.modifiers = modifiers.state(),
            WindowEvent::Occluded(is_occluded) => self.is_occluded = *is_occluded,
            // Keys that are let go elsewhere are not told.
            WindowEvent::Focused(false) => self.state.keys = Default::default(),
            _ => {}
        }
        if let WindowEvent::CursorMoved { position, .. } = &event {
            self.pointer = [position.x, position.y];
        }
        // What is let go ends what it began, wherever the pointer is by then.
        let ends = match &event {
            WindowEvent::MouseInput { state, .. } => *state == ElementState::Released,
            WindowEvent::KeyboardInput { event, .. } => event.state == ElementState::Released,
            WindowEvent::CursorMoved { .. } => self.drag.is_some(),
            _ => false,
        };
        let is_of_panel = response.consumed || is_pointed(&event) && self.is_over_panel();
        if !is_of_panel || ends {
            self.handle(&event, height_px);
        }
    }

    fn about_to_wait(&mut self, event_loop: &ActiveEventLoop) {
        let Some(graphics) = &self.graphics else {
            return;
        };
        let is_due = self.panel_due.is_some_and(|due| due <= Instant::now());
        if (self.state.moves() || is_due) && !self.is_occluded {
            graphics.window.request_redraw();
        }
        event_loop.set_control_flow(match self.panel_due {
            Some(due) if !is_due && !self.is_occluded => ControlFlow::WaitUntil(due),
            _ => ControlFlow::Wait,
        });
    }
}
