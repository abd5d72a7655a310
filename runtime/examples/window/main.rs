//! Hills in a window, lit by the sky: `cargo run --release --example window`.
//!
//! Left and right turn the hours, up and down bring clouds, 1 to 5 choose the method, a drag looks around.

mod drawing;
#[path = "../scene/mod.rs"]
mod scene;

use std::time::Instant;

use drawing::Drawing;
use welkin_runtime::{Method, SkyParams};
use winit::application::ApplicationHandler;
use winit::event::{ElementState, MouseButton, WindowEvent};
use winit::event_loop::{ActiveEventLoop, EventLoop};
use winit::keyboard::{Key, NamedKey};
use winit::window::WindowId;

struct App {
    drawing: Option<Drawing>,
    failure: Option<Box<dyn std::error::Error>>,
    params: SkyParams,
    /// Azimuth and elevation, in radians.
    view: [f32; 2],
    is_dragged: bool,
    pointer: [f32; 2],
    start: Instant,
}

impl ApplicationHandler for App {
    fn resumed(&mut self, event_loop: &ActiveEventLoop) {
        match Drawing::new(event_loop) {
            Ok(drawing) => self.drawing = Some(drawing),
            Err(error) => {
                self.failure = Some(error);
                event_loop.exit();
            }
        }
    }

    fn window_event(&mut self, event_loop: &ActiveEventLoop, _: WindowId, event: WindowEvent) {
        let Some(drawing) = &mut self.drawing else {
            return;
        };
        let params = &mut self.params;
        match event {
            WindowEvent::CloseRequested => event_loop.exit(),
            WindowEvent::Resized(size) => drawing.resize(size.into()),
            WindowEvent::MouseInput {
                state,
                button: MouseButton::Left,
                ..
            } => self.is_dragged = state == ElementState::Pressed,
            WindowEvent::CursorMoved { position, .. } => {
                let [x, y] = [position.x, position.y].map(|at| at as f32);
                let [last_x, last_y] = std::mem::replace(&mut self.pointer, [x, y]);
                if self.is_dragged {
                    self.view[0] -= (x - last_x) * 2e-3;
                    self.view[1] = (self.view[1] + (y - last_y) * 2e-3).clamp(-1.5, 1.5);
                }
            }
            WindowEvent::KeyboardInput { event, .. } if event.state.is_pressed() => {
                match event.logical_key.as_ref() {
                    Key::Named(NamedKey::Escape) => event_loop.exit(),
                    Key::Named(NamedKey::ArrowLeft) => {
                        params.time = (params.time - 0.004).rem_euclid(1.0)
                    }
                    Key::Named(NamedKey::ArrowRight) => {
                        params.time = (params.time + 0.004).rem_euclid(1.0)
                    }
                    Key::Named(NamedKey::ArrowUp) => params.cover = (params.cover + 0.02).min(1.0),
                    Key::Named(NamedKey::ArrowDown) => {
                        params.cover = (params.cover - 0.02).max(0.0)
                    }
                    Key::Character(key) => {
                        let number = key.parse::<usize>().unwrap_or(0);
                        if let Some(method) = Method::ALL.get(number.wrapping_sub(1)) {
                            params.method = *method;
                        }
                    }
                    _ => {}
                }
            }
            WindowEvent::RedrawRequested => {
                let seconds = self.start.elapsed().as_secs_f64();
                match drawing.draw(params, self.view, seconds) {
                    Ok(()) => drawing.window.request_redraw(),
                    Err(error) => {
                        self.failure = Some(error);
                        event_loop.exit();
                    }
                }
            }
            _ => {}
        }
    }
}

fn main() -> scene::Result<()> {
    let mut app = App {
        drawing: None,
        failure: None,
        params: SkyParams {
            method: Method::Lit,
            time: 0.33,
            cover: 0.45,
            shadow_extent_m: 16_000.0,
            ..SkyParams::default()
        },
        view: [2.0, 0.15],
        is_dragged: false,
        pointer: [0.0; 2],
        start: Instant::now(),
    };
    EventLoop::new()?.run_app(&mut app)?;
    app.failure.map_or(Ok(()), Err)
}
