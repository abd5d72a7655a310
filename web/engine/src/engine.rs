//! The class that JavaScript holds: a canvas, the sky of a pack, and the settings it is drawn with.

use wasm_bindgen::prelude::*;
use wasm_bindgen_futures::future_to_promise;
use web_sys::HtmlCanvasElement;
use welkin_pack::Pack;
use welkin_runtime::{Camera, Method, Sky, SkyConfig, SkyParams};

use crate::canvas::Canvas;
use crate::files;
use crate::trouble::Trouble;

/// A sky on a canvas.
#[wasm_bindgen]
pub struct Engine {
    canvas: Canvas,
    trouble: Trouble,
    sky: Option<Sky>,
    params: SkyParams,
    look_deg: [f32; 2],
}

#[wasm_bindgen]
impl Engine {
    /// Opens a canvas with the backend `auto`, `webgpu` or `webgl2`.
    ///
    /// # Errors
    /// With a message for people, if there is no such adapter.
    pub async fn open(canvas: HtmlCanvasElement, backend: String) -> Result<Engine, JsError> {
        let canvas = Canvas::open(canvas, &backend).await.map_err(error)?;
        Ok(Engine {
            trouble: Trouble::watch(&canvas.device),
            canvas,
            sky: None,
            params: SkyParams::default(),
            look_deg: [100.0, 28.0],
        })
    }

    /// A promise of the reason why the device was lost; it stays open as long as it is not.
    pub fn lost(&self) -> js_sys::Promise {
        let lost = self.trouble.clone().lost();
        future_to_promise(async { Ok(JsValue::from(lost.await)) })
    }

    /// Tells that the canvas lost its WebGL context, which no device tells.
    #[wasm_bindgen(js_name = contextLost)]
    pub fn context_lost(&self) {
        self.trouble.lose("the browser took the WebGL context back");
    }

    /// Loads a pack from a map of file names to `Uint8Array`s; `place` stands before the names in errors. Until all of it is
    /// known to be sound, the sky stays as it is.
    ///
    /// # Errors
    /// Those of the pack's reader and of the runtime.
    pub fn load(&mut self, place: &str, map: &js_sys::Map) -> Result<(), JsError> {
        let files = files::from_map(map);
        let pack = Pack::from_memory(place, &files)?;
        let config = SkyConfig {
            target_format: self.canvas.format(),
            depth: None,
            sample_count: 1,
        };
        self.sky = Some(Sky::new(
            &self.canvas.device,
            &self.canvas.queue,
            config,
            &pack,
        )?);
        Ok(())
    }

    /// Sets one setting.
    ///
    /// # Errors
    /// If there is no such key, or the text is not one of its values.
    pub fn set(&mut self, key: &str, text: &str) -> Result<(), JsError> {
        let number = || {
            text.parse::<f32>()
                .map_err(|e| error(format!("{key}: {e}")))
        };
        match key {
            "cover" => self.params.cover = number()?,
            "time" => self.params.time = number()?,
            "azimuth" => self.look_deg[0] = number()?,
            "elevation" => self.look_deg[1] = number()?,
            "method" => {
                let method = Method::ALL.into_iter().find(|m| m.name() == text);
                self.params.method = method.ok_or_else(|| error(format!("no method {text}")))?;
            }
            _ => return Err(error(format!("no setting {key}"))),
        }
        Ok(())
    }

    /// Gives the canvas so many pixels.
    pub fn resize(&mut self, width: u32, height: u32) {
        if self.canvas.size() != [width, height] {
            self.canvas.resize([width, height]);
        }
    }

    /// Draws the sky at a moment, in seconds from the start of the animation.
    ///
    /// # Errors
    /// If the device is lost, or told an error since the last frame.
    pub fn draw(&mut self, seconds: f64) -> Result<(), JsError> {
        if let Some(message) = self.trouble.take() {
            return Err(error(message));
        }
        let Some(sky) = &mut self.sky else {
            return Ok(());
        };
        let Some((texture, view)) = self.canvas.next().map_err(error)? else {
            return Ok(());
        };
        let [azimuth, elevation] = self.look_deg.map(f32::to_radians);
        let camera = Camera::looking(azimuth, elevation, 60_f32.to_radians(), self.canvas.size());
        let mut encoder = self
            .canvas
            .device
            .create_command_encoder(&Default::default());
        sky.prepare(
            &self.canvas.queue,
            &mut encoder,
            &self.params,
            &camera,
            seconds,
        );
        let colour = wgpu::RenderPassColorAttachment {
            view: &view,
            depth_slice: None,
            resolve_target: None,
            ops: wgpu::Operations {
                load: wgpu::LoadOp::Clear(wgpu::Color::BLACK),
                store: wgpu::StoreOp::Store,
            },
        };
        sky.draw(&mut encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            color_attachments: &[Some(colour)],
            ..Default::default()
        }));
        self.canvas.queue.submit([encoder.finish()]);
        self.canvas.queue.present(texture);
        Ok(())
    }

    /// What draws, as JSON.
    pub fn info(&self) -> String {
        let adapter = &self.canvas.adapter;
        serde_json::json!({
            "backend": self.canvas.backend.name(),
            "adapter": adapter.name,
            "driver": adapter.driver_info,
            "maxSide": self.canvas.max_side(),
        })
        .to_string()
    }
}

fn error(message: String) -> JsError {
    JsError::new(&message)
}
