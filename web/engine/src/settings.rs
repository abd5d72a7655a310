//! The settings in JavaScript: texts by name, as links hold them. See `welkin-controls`.

use wasm_bindgen::prelude::*;
use welkin_controls::{Blend, KEYS, PRESETS, Pilot, Preset, Settings};

use crate::engine::{Engine, error};

/// Every setting with its words, its range and the methods that look at it, as JSON: a list.
#[wasm_bindgen]
pub fn controls() -> Result<String, JsError> {
    Ok(serde_json::to_string(KEYS)?)
}

/// The presets, as JSON: a list.
#[wasm_bindgen]
pub fn presets() -> Result<String, JsError> {
    Ok(serde_json::to_string(&PRESETS)?)
}

#[wasm_bindgen]
impl Engine {
    /// Gives settings their values: names and texts, one after another. All of them or, if one is wrong, none.
    ///
    /// # Errors
    /// If there is no such setting, or the text is not one of its values.
    pub fn set(&mut self, pairs: Vec<String>) -> Result<(), JsError> {
        let pairs = pairs.chunks_exact(2);
        let pairs = pairs.map(|pair| (pair[0].as_str(), pair[1].as_str()));
        Ok(self.settings.set_pairs(pairs)?)
    }

    /// The text of a setting.
    ///
    /// # Errors
    /// If there is no such setting.
    pub fn get(&self, name: &str) -> Result<String, JsError> {
        Ok(self.settings.get(name)?)
    }

    /// The settings that are not the usual ones: names and texts, one after another.
    pub fn changes(&self) -> Vec<String> {
        let pairs = self.settings.changes().into_iter();
        pairs
            .flat_map(|(name, text)| [name.to_string(), text])
            .collect()
    }

    /// The names of the settings that the sky looks at, with these settings.
    pub fn applicable(&self) -> Vec<String> {
        let keys = KEYS.iter().filter(|key| key.applies(&self.settings));
        keys.map(|key| key.name.to_string()).collect()
    }

    /// Gives every setting its usual value. The moment stays.
    pub fn reset(&mut self) {
        self.blend = None;
        self.settings = Settings {
            at_s: self.settings.at_s,
            ..Settings::default()
        };
    }

    /// Begins the way to a preset that takes so many seconds, 0 for at once.
    ///
    /// # Errors
    /// If there is no such preset.
    pub fn preset(&mut self, name: &str, seconds: f32) -> Result<(), JsError> {
        let preset =
            Preset::named(name).ok_or_else(|| error(format!("there is no preset \"{name}\"")))?;
        let goal = preset.of(&self.settings)?;
        let blend = Blend::begin(&mut self.settings, &goal, seconds);
        self.blend = (!blend.is_over()).then_some(blend);
        Ok(())
    }

    /// Whether the way to a preset goes on.
    pub fn blending(&self) -> bool {
        self.blend.is_some()
    }

    /// Lets so many seconds go by: the animation, the day, the way to a preset.
    pub fn advance(&mut self, seconds: f64) {
        if let Some(blend) = &mut self.blend {
            blend.advance(&mut self.settings, seconds as f32);
            if blend.is_over() {
                self.blend = None;
            }
        }
        self.settings.advance(seconds);
    }

    /// The moment of the animation, in seconds.
    #[wasm_bindgen(getter)]
    pub fn at(&self) -> f64 {
        self.settings.at_s
    }

    /// Sets the moment, 0 to 1e9 seconds.
    #[wasm_bindgen(setter)]
    pub fn set_at(&mut self, seconds: f64) {
        if seconds.is_finite() {
            self.settings.at_s = seconds.clamp(0.0, 1e9);
        }
    }

    /// Turns the view as a drag by so many pixels on a picture of this height.
    pub fn drag(&mut self, right_px: f32, down_px: f32, height_px: f32) {
        Pilot::drag(&mut self.settings.view, [right_px, down_px], height_px);
    }

    /// Zooms by steps of a wheel, in for positive ones.
    pub fn zoom(&mut self, steps: f32) {
        Pilot::zoom(&mut self.settings.view, steps);
    }
}
