//! What the window knows, as plain data: events and the panel change it, drawing reads it.

use std::ops::ControlFlow;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use anyhow::{Result, anyhow};
use welkin_baker::Recipe;
use welkin_controls::{Blend, Keys, Pilot, Preset, Settings};
use welkin_pack::{Pack, shown};
use welkin_viewer::pass_times::Part;
use welkin_viewer::spread::Spread;

use crate::cli::WindowArgs;

/// Seconds from one weather to the next.
const BLEND_S: f32 = 4.0;
/// Frames whose times the panel shows the median of.
const TIMED_FRAMES: usize = 31;
/// Messages that are kept.
const NOTICES: usize = 6;
/// Names that the fields for files begin with.
const SETTINGS_FILE: &str = "sky.toml";
const PICTURE_FILE: &str = "sky.png";

pub struct State {
    pub settings: Settings,
    pub pilot: Pilot,
    pub keys: Keys,
    pub blend: Option<Blend>,
    pub playing: bool,
    pub panel_shown: bool,
    /// Where the panel ends, from the left.
    pub panel_edge_px: f64,
    pub source: PackSource,
    pub baking: Option<(&'static str, f32)>,
    pub notices: Vec<Notice>,
    pub files: Files,
    pub wishes: Vec<Wish>,
    pub times: Times,
    pub adapter: String,
}

/// The pack that is shown.
pub struct PackSource {
    pub pack: Arc<Pack>,
    /// Its folder, if it is in one.
    pub folder: Option<PathBuf>,
    /// Whether the folder has this very pack.
    pub is_saved: bool,
}

/// Names of files, as the person wrote them.
pub struct Files {
    pub settings: String,
    pub picture: String,
    pub pack: String,
}

/// Something that the person should know.
pub struct Notice {
    pub text: String,
    pub is_error: bool,
}

/// Something to be done that needs more than the state.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Wish {
    SaveSettings,
    LoadSettings,
    SavePicture,
    CopyCommand,
    SavePack,
    RestartGraphics,
    ToggleFullscreen,
}

/// Milliseconds of the last frames.
#[derive(Default)]
pub struct Times {
    passes: [Vec<f64>; Part::ALL.len()],
    frames: Vec<f64>,
}

impl State {
    /// The state at the start.
    ///
    /// # Errors
    /// A pack or settings that cannot be read.
    pub fn open(args: &WindowArgs) -> Result<State> {
        let is_to_be_baked =
            args.watch.is_some() && args.pack.as_ref().is_some_and(|p| !p.exists());
        let source = match &args.pack {
            Some(folder) if !is_to_be_baked => PackSource {
                pack: Pack::open(folder)?.into(),
                folder: Some(folder.clone()),
                is_saved: true,
            },
            folder => PackSource {
                pack: usual_pack()?.into(),
                folder: folder.clone(),
                is_saved: false,
            },
        };
        let settings = match &args.settings {
            Some(file) if file.exists() => read_settings(file)?,
            _ => Settings::default(),
        };
        let text = |path: Option<&PathBuf>, defaults: &str| {
            path.map_or_else(|| defaults.to_string(), |path| path.display().to_string())
        };
        Ok(State {
            settings,
            pilot: Pilot::default(),
            keys: Keys::default(),
            blend: None,
            playing: true,
            panel_shown: true,
            panel_edge_px: 0.0,
            files: Files {
                settings: text(args.settings.as_ref(), SETTINGS_FILE),
                picture: PICTURE_FILE.to_string(),
                pack: text(source.folder.as_ref(), "packs/mine"),
            },
            source,
            baking: None,
            notices: Vec::new(),
            wishes: Vec::new(),
            times: Times::default(),
            adapter: String::new(),
        })
    }

    /// Lets `seconds` of the person's time go by.
    pub fn advance(&mut self, seconds: f32) {
        if self.playing {
            self.settings.advance(f64::from(seconds));
        }
        if let Some(blend) = &mut self.blend {
            blend.advance(&mut self.settings, seconds);
        }
        self.blend.take_if(|blend| blend.is_over());
        self.pilot.advance(&mut self.settings, self.keys, seconds);
    }

    /// Whether the next frame differs from this one.
    pub fn moves(&self) -> bool {
        self.playing || self.blend.is_some() || self.keys != Keys::default()
    }

    /// Begins the way to a weather.
    pub fn begin_weather(&mut self, preset: &Preset) {
        match preset.of(&self.settings) {
            Ok(goal) => self.blend = Some(Blend::begin(&mut self.settings, &goal, BLEND_S)),
            Err(error) => self.tell_error(error.to_string()),
        }
    }

    pub fn tell(&mut self, text: String) {
        self.push(text, false);
    }

    pub fn tell_error(&mut self, text: String) {
        self.push(text, true);
    }

    fn push(&mut self, text: String, is_error: bool) {
        let text = shown(&text).into_owned();
        // The same again is said once, and last.
        self.notices.retain(|notice| notice.text != text);
        self.notices.push(Notice { text, is_error });
        let beyond = self.notices.len().saturating_sub(NOTICES);
        self.notices.drain(..beyond);
    }
}

impl Times {
    pub fn push_passes(&mut self, times: [Option<f64>; Part::ALL.len()]) {
        for (kept, time) in self.passes.iter_mut().zip(times) {
            if let Some(time) = time {
                push(kept, time);
            }
        }
    }

    pub fn push_frame(&mut self, ms: f64) {
        push(&mut self.frames, ms);
    }

    /// The median of a pass, if this device tells it.
    pub fn pass_ms(&self, part: Part) -> Option<f64> {
        let times = &self.passes[part as usize];
        (!times.is_empty()).then(|| Spread::of(times).median)
    }

    /// The median from frame to frame.
    pub fn frame_ms(&self) -> Option<f64> {
        (!self.frames.is_empty()).then(|| Spread::of(&self.frames).median)
    }
}

fn push(times: &mut Vec<f64>, time: f64) {
    if times.len() == TIMED_FRAMES {
        times.remove(0);
    }
    times.push(time);
}

/// The pack of the built-in recipe.
fn usual_pack() -> Result<Pack> {
    let resolved = Recipe::default().resolve(None)?;
    Ok(welkin_baker::bake(&resolved, None, &|_| {
        ControlFlow::Continue(())
    })?)
}

/// Settings from a file.
///
/// # Errors
/// With the file's name.
pub fn read_settings(file: &Path) -> Result<Settings> {
    let name = file.display();
    let text = std::fs::read_to_string(file).map_err(|e| {
        anyhow!("{name}: cannot be read: {e}; name a file of settings, or save one there first")
    })?;
    Settings::from_toml(&text)
        .map_err(|e| anyhow!("{name}: is no file of settings: {e}; correct it there"))
}

#[cfg(test)]
mod tests {
    use crate::told::told;

    use super::*;

    fn state() -> State {
        State::open(&WindowArgs::default()).unwrap()
    }

    #[test]
    fn messages_are_said_once_and_the_oldest_go() {
        let mut state = state();
        for number in 0..10 {
            state.tell(number.to_string());
        }
        state.tell_error("9".to_string());
        let texts: Vec<_> = state.notices.iter().map(|n| n.text.as_str()).collect();
        assert_eq!(texts, ["4", "5", "6", "7", "8", "9"]);
        assert!(state.notices[5].is_error);
    }

    #[test]
    fn a_weather_comes_over_seconds_and_then_nothing_moves() {
        let mut state = state();
        state.playing = false;
        assert!(!state.moves());
        state.begin_weather(Preset::named("storm").unwrap());
        state.advance(BLEND_S / 2.0);
        assert!(state.moves() && state.settings.params.weather.rain > 0.1);
        state.advance(BLEND_S);
        assert!(!state.moves());
        assert!(Preset::named("storm").unwrap().is(&state.settings));
    }

    #[test]
    fn settings_of_a_file_are_those_that_were_saved() {
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join("sky.toml");
        let told = |error: anyhow::Error| told(&error);
        assert!(told(read_settings(&file).unwrap_err()).contains("sky.toml: cannot be read"));
        std::fs::write(&file, "cover = 2").unwrap();
        let error = told(read_settings(&file).unwrap_err());
        assert!(
            error.contains("sky.toml") && error.contains("from 0 to 1"),
            "{error}"
        );
        let mut settings = Settings::default();
        settings.params.cover = 0.125;
        std::fs::write(&file, settings.to_toml()).unwrap();
        assert_eq!(read_settings(&file).unwrap(), settings);
    }
}
