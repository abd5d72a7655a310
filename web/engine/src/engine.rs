//! The class that JavaScript holds: a canvas, the sky of a pack, and the settings it is drawn with.

use wasm_bindgen::prelude::*;
use wasm_bindgen_futures::future_to_promise;
use web_sys::HtmlCanvasElement;
use welkin_controls::{Blend, Settings};
use welkin_pack::Pack;
use welkin_runtime::{Sky, SkyConfig};
use welkin_web_glue::from_map;

use crate::canvas::Canvas;
use crate::trouble::Trouble;

/// A sky on a canvas.
#[wasm_bindgen]
pub struct Engine {
    canvas: Canvas,
    trouble: Trouble,
    sky: Option<Sky>,
    pack: String,
    pub(crate) settings: Settings,
    pub(crate) blend: Option<Blend>,
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
            pack: "null".to_string(),
            settings: Settings::default(),
            blend: None,
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
        let files = from_map(map);
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
        let manifest = pack.manifest();
        self.pack = serde_json::json!({
            "name": manifest.name,
            // JavaScript's numbers do not hold every seed.
            "seed": manifest.seed.to_string(),
            "recipe": manifest.recipe,
            "baker": manifest.baker,
            "bytes": pack.files().iter().map(|(_, bytes)| bytes.len()).sum::<usize>(),
        })
        .to_string();
        Ok(())
    }

    /// Gives the canvas so many pixels.
    pub fn resize(&mut self, width: u32, height: u32) {
        if self.canvas.size() != [width, height] {
            self.canvas.resize([width, height]);
        }
    }

    /// Draws the sky at its moment.
    ///
    /// # Errors
    /// If the device is lost, or told an error since the last frame.
    pub fn draw(&mut self) -> Result<(), JsError> {
        if let Some(message) = self.trouble.take() {
            return Err(error(message));
        }
        let Some(sky) = &mut self.sky else {
            return Ok(());
        };
        let Some((texture, view)) = self.canvas.next().map_err(error)? else {
            return Ok(());
        };
        let camera = self.settings.camera(self.canvas.size());
        let mut encoder = self
            .canvas
            .device
            .create_command_encoder(&Default::default());
        sky.prepare(
            &self.canvas.queue,
            &mut encoder,
            &self.settings.frame_params(),
            &camera,
            self.settings.at_s,
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
        let [width, height] = self.canvas.size();
        let method = self.settings.params.method;
        let bytes = self.sky.as_ref().map(|sky| sky.memory_bytes(method));
        serde_json::json!({
            "backend": self.canvas.backend.name(),
            "adapter": adapter.name,
            "driver": adapter.driver_info,
            "width": width,
            "height": height,
            "maxSide": self.canvas.max_side(),
            "methodBytes": bytes,
        })
        .to_string()
    }

    /// What the pack says of itself, as JSON; `null` before there is one.
    pub fn pack(&self) -> String {
        self.pack.clone()
    }

    /// Why the pack cannot draw the method of the settings; nothing if it can.
    pub fn lacks(&self) -> Option<String> {
        let sky = self.sky.as_ref()?;
        let lack = sky.supports(self.settings.params.method).err()?;
        Some(lack.to_string())
    }
}

/// An error for JavaScript.
pub(crate) fn error(message: String) -> JsError {
    JsError::new(&message)
}
