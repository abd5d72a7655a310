//! The settings in JavaScript: texts by name, as links hold them. See `welkin-controls`.

use wasm_bindgen::prelude::*;
use welkin_controls::{Blend, KEYS, Key, Keys, PRESETS, Pilot, Preset, Settings};
use welkin_pack::LayerKind;
use welkin_runtime::Method;
use welkin_runtime::params::MAX_LAYERS;

use crate::engine::{Engine, error};

/// Every setting with its words, its range and the methods that look at it, the methods, the presets, and what layers may be, as JSON.
#[wasm_bindgen]
pub fn controls() -> String {
    let method =
        |m: Method| serde_json::json!({ "name": m.name(), "title": m.title(), "paper": m.paper() });
    serde_json::json!({
        "keys": KEYS,
        "methods": Method::ALL.map(method),
        "presets": PRESETS,
        "layers": { "kinds": LayerKind::ALL.map(LayerKind::name), "most": MAX_LAYERS },
    })
    .to_string()
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

    /// Every setting: names and texts, one after another.
    pub fn all(&self) -> Vec<String> {
        let pair = |key: &Key| [key.name.to_string(), key.text(&self.settings)];
        KEYS.iter().flat_map(pair).collect()
    }

    /// The names of the settings that the sky looks at, with these settings.
    pub fn applies(&self) -> Vec<String> {
        let keys = KEYS.iter().filter(|key| key.applies(&self.settings));
        keys.map(|key| key.name.to_string()).collect()
    }

    /// Gives a setting its usual value, or all of them.
    ///
    /// # Errors
    /// If there is no such setting.
    pub fn reset(&mut self, name: Option<String>) -> Result<(), JsError> {
        let defaults = Settings::default();
        match name {
            Some(name) => self.settings.set(&name, &defaults.get(&name)?)?,
            None => (self.settings, self.blend) = (defaults, None),
        }
        Ok(())
    }

    /// The options of `welkin-view render` that draw this picture.
    pub fn options(&self) -> Vec<String> {
        self.settings.options()
    }

    /// The name of the preset whose settings these are.
    pub fn weather(&self) -> Option<String> {
        let preset = PRESETS.iter().find(|preset| preset.is(&self.settings))?;
        Some(preset.name.to_string())
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

    /// Lets so many seconds go by: the way to a preset and, if `time` says so, the animation and the day.
    pub fn advance(&mut self, seconds: f64, time: bool) {
        if let Some(blend) = &mut self.blend {
            blend.advance(&mut self.settings, seconds as f32);
            if blend.is_over() {
                self.blend = None;
            }
        }
        if time {
            self.settings.advance(seconds);
        }
    }

    /// Turns the view as a drag by so many pixels on a picture of this height.
    pub fn drag(&mut self, right_px: f32, down_px: f32, height_px: f32) {
        Pilot::drag(&mut self.settings.view, [right_px, down_px], height_px);
    }

    /// Turns of a wheel away from the person: a narrower view.
    pub fn zoom(&mut self, notches: f32) {
        Pilot::zoom(&mut self.settings.view, notches);
    }

    /// Moves the view as keys that are held for so many seconds, each -1, 0 or 1: turn right and up, fly forward, right and up.
    pub fn pilot(&mut self, turn: &[f32], fly: &[f32], haste: bool, seconds: f32) {
        let (&[turn_right, turn_up], &[forward, right, up]) = (turn, fly) else {
            return;
        };
        let keys = Keys {
            turn_right,
            turn_up,
            forward,
            right,
            up,
            haste,
        };
        let pilot = Pilot {
            flying: true,
            ..Pilot::default()
        };
        pilot.advance(&mut self.settings, keys, seconds);
    }
}
