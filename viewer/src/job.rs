//! A job: what one picture is of, as one JSON object on one line.

use std::collections::BTreeMap;
use std::path::PathBuf;

use serde_json::{Map, Value, json};
use welkin_controls::{KEYS, SettingError, Settings};
use welkin_pack::shown;
use welkin_runtime::params::Input;
use welkin_viewer::headless::View;
use welkin_viewer::save::Format;

use crate::cli::{MAX_SIDE, Shot, equirect_width, sides, stray_on_map, verify_side};

/// Keys of a job.
const JOB_KEYS: [&str; 10] = [
    "name", "pack", "seed", "weather", "size", "equirect", "cubemap", "format", "oktas", "settings",
];

/// Letters of a name: with what is added for labels it fits into the 100 bytes that a tar archive has for one.
const LONGEST_NAME: usize = 80;

/// The size of a picture whose job does not say it: that of `render`.
const USUAL_SIZE: [u32; 2] = [1600, 1200];

/// Letters of the word for its weather.
const LONGEST_WEATHER: usize = 80;

/// Letters of what was found that are told.
const LONGEST_FOUND: usize = 60;

/// What is wrong with a line.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum Fault {
    /// It is not JSON.
    #[error("is no JSON object: {}; expected one such as {{\"name\": \"a\", \"settings\": {{\"cover\": 0.5}}}}", shown(.0))]
    Syntax(String),
    /// A setting stands beside the settings.
    #[error("\"{0}\" is a setting, expected it in \"settings\"")]
    Misplaced(&'static str),
    /// A key is not known.
    #[error("there is no key \"{}\" of a job, expected {}", shown(.0), JOB_KEYS.join(", "))]
    Unknown(String),
    /// A key has a value that it cannot have.
    #[error("{key} is {}, expected {expected}", shown(.found))]
    Value {
        /// Which.
        key: String,
        /// What stands there.
        found: String,
        /// What may.
        expected: String,
    },
    /// A setting is not known, or out of its range.
    #[error("settings: {0}")]
    Setting(#[from] SettingError),
    /// Two keys exclude each other.
    #[error("has {one} and {other}; leave one of them out: {why}")]
    Both {
        one: String,
        other: String,
        why: String,
    },
}

/// What one picture is of.
#[derive(Clone, Debug, PartialEq)]
pub struct Job {
    /// The stem of its files' names.
    pub name: String,
    /// Folder of its pack, if it is not that of the command line.
    pub pack: Option<PathBuf>,
    /// A number of the user's, handed on.
    pub seed: Option<u64>,
    /// A word of the user's for its weather, handed on.
    pub weather: Option<String>,
    /// All that the sky depends on, and where one looks.
    pub settings: Settings,
    /// Eighths of cloud that the cover is to be found for.
    pub oktas: Option<f32>,
    /// What becomes of it.
    pub shot: Shot,
    /// What is in the middle of a panorama.
    pub azimuth_deg: f32,
    /// Pixels of a frame.
    pub size: [u32; 2],
}

impl Job {
    /// Reads a line; `number` names the job if it has no name.
    pub fn parse(text: &str, number: u64) -> Result<Job, Fault> {
        let job: Map<String, Value> =
            serde_json::from_str(text).map_err(|e| Fault::Syntax(e.to_string()))?;
        if let Some(key) = job.keys().find(|key| !JOB_KEYS.contains(&key.as_str())) {
            let setting = KEYS.iter().find(|setting| setting.name == key);
            return Err(match setting {
                Some(setting) => Fault::Misplaced(setting.name),
                None => Fault::Unknown(key.clone()),
            });
        }
        let given = match job.get("settings") {
            None => Map::new(),
            Some(Value::Object(given)) => given.clone(),
            Some(other) => return Err(fault("settings", other, "an object of settings")),
        };
        let settings = settings(&given)?;
        let number_of = |key: &str| job.get(key).map(|value| (value, value.as_u64()));
        let shot = shot(&job)?;
        let name = match job.get("name") {
            None => format!("{number:06}"),
            Some(Value::String(name)) if is_name(name) => name.clone(),
            Some(other) => {
                let expected = format!(
                    "1 to {LONGEST_NAME} of the letters a to z and A to Z, digits, - and _, not beginning with -"
                );
                return Err(fault("name", other, &expected));
            }
        };
        let oktas = match job.get("oktas") {
            None => None,
            Some(value) => match value.as_f64() {
                Some(oktas) if (0.0..=8.0).contains(&oktas) => Some(oktas as f32),
                _ => return Err(fault("oktas", value, "a number from 0 to 8")),
            },
        };
        if oktas.is_some() && given.contains_key("cover") {
            return Err(Fault::Both {
                one: "oktas".into(),
                other: "the setting cover".into(),
                why: "the cover is found by the oktas".into(),
            });
        }
        let seed = match number_of("seed") {
            None => None,
            Some((_, Some(seed))) => Some(seed),
            Some((found, None)) => {
                return Err(fault("seed", found, "a whole number from 0 to 2^64 - 1"));
            }
        };
        let is_map = !matches!(shot, Shot::Frame(_));
        let size = match job.get("size") {
            None => USUAL_SIZE,
            Some(value) => size(value)?,
        };
        if is_map {
            let is_given = |key: &str| given.contains_key(key) || job.contains_key(key);
            let (rain, flare) = (settings.params.weather.rain, settings.params.flare);
            let map = map_name(shot);
            if let Some((key, why)) = stray_on_map(map == "cubemap", is_given, rain, flare) {
                return Err(Fault::Both {
                    one: map.into(),
                    other: key.into(),
                    why: why.into(),
                });
            }
        }
        let azimuth_deg = match given.contains_key("azimuth") {
            true => settings.view.azimuth_deg,
            false => 0.0,
        };
        let pack = match job.get("pack") {
            None => None,
            Some(Value::String(pack)) if !pack.is_empty() => Some(PathBuf::from(pack)),
            Some(other) => return Err(fault("pack", other, "the folder of a pack")),
        };
        let weather = match job.get("weather") {
            None => None,
            Some(Value::String(word)) if word.chars().count() <= LONGEST_WEATHER => {
                Some(word.clone())
            }
            Some(other) => {
                let expected = format!("a word for it, of at most {LONGEST_WEATHER} letters");
                return Err(fault("weather", other, &expected));
            }
        };
        Ok(Job {
            name,
            pack,
            seed,
            weather,
            settings,
            oktas,
            shot,
            azimuth_deg,
            size,
        })
    }

    /// What is looked at.
    pub fn view(&self) -> View {
        View {
            params: self.settings.frame_params(),
            camera: self.settings.camera(self.size),
            seconds: self.settings.at_s,
        }
    }

    /// The name of its picture's file.
    pub fn file(&self) -> String {
        format!("{}.{}", self.name, self.shot.extension())
    }

    /// The key that says how large it is, and what it says.
    pub fn size_told(&self) -> (&'static str, Value) {
        match self.shot {
            Shot::Frame(_) => ("size", json!(self.size)),
            Shot::Equirect(width, _) => ("equirect", json!(width)),
            Shot::Ktx2(side) | Shot::Faces(side, _) => ("cubemap", json!(side)),
        }
    }
}

/// The settings that are not the usual ones, as a job has them.
pub fn settings_told(settings: &Settings) -> BTreeMap<String, Value> {
    let told = settings.changes().into_iter().map(|(name, text)| {
        let key = KEYS.iter().find(|key| key.name == name);
        let is_plain =
            key.is_some_and(|key| matches!(key.input, Input::Slider { .. } | Input::Switch));
        let plain = serde_json::from_str(&text).ok().filter(|_| is_plain);
        (name.to_string(), plain.unwrap_or(Value::String(text)))
    });
    told.collect()
}

fn settings(given: &Map<String, Value>) -> Result<Settings, Fault> {
    let mut pairs = Vec::new();
    for (name, value) in given {
        let text = match value {
            Value::String(text) => text.clone(),
            Value::Number(_) | Value::Bool(_) => value.to_string(),
            other => {
                let key = format!("settings.{}", shown(name));
                return Err(fault(&key, other, "a number, true or false, or text"));
            }
        };
        pairs.push((name.as_str(), text));
    }
    let pairs = pairs.iter().map(|(name, text)| (*name, text.as_str()));
    Ok(Settings::from_pairs(pairs)?)
}

/// What becomes of a job.
fn shot(job: &Map<String, Value>) -> Result<Shot, Fault> {
    let (equirect, cubemap) = (job.get("equirect"), job.get("cubemap"));
    if equirect.is_some() && cubemap.is_some() {
        return Err(Fault::Both {
            one: "equirect".into(),
            other: "cubemap".into(),
            why: "a picture is one or the other".into(),
        });
    }
    let named = |usual: Format| match job.get("format") {
        None => Ok(usual),
        Some(value) => {
            let of_name = |format: &Format| value.as_str() == Some(format.extension());
            let found = Format::ALL.into_iter().find(of_name);
            found.ok_or_else(|| fault("format", value, "png, exr or hdr, or ktx2 with cubemap"))
        }
    };
    match (equirect, cubemap) {
        (Some(width), _) => {
            let text = width.to_string();
            let width = equirect_width(&text).map_err(|e| told("equirect", width, e))?;
            Ok(Shot::Equirect(width, named(Format::Exr)?))
        }
        (None, Some(side)) => {
            let found =
                verify_side(&side.to_string()).map_err(|_| fault("cubemap", side, &sides()))?;
            match job.get("format") {
                None => Ok(Shot::Ktx2(found)),
                Some(Value::String(format)) if format == "ktx2" => Ok(Shot::Ktx2(found)),
                Some(other) => Err(fault(
                    "format",
                    other,
                    "ktx2 with cubemap; or take equirect",
                )),
            }
        }
        (None, None) => Ok(Shot::Frame(named(Format::Png)?)),
    }
}

fn map_name(shot: Shot) -> &'static str {
    match shot {
        Shot::Frame(_) | Shot::Equirect(..) => "equirect",
        Shot::Ktx2(_) | Shot::Faces(..) => "cubemap",
    }
}

/// Two sides in pixels.
fn size(value: &Value) -> Result<[u32; 2], Fault> {
    let side = |side: &Value| {
        let side = u32::try_from(side.as_u64()?).ok()?;
        (1..=MAX_SIDE).contains(&side).then_some(side)
    };
    let sides = value.as_array().map(|sides| sides.iter().map(side));
    match sides.map(Iterator::collect::<Option<Vec<u32>>>) {
        Some(Some(sides)) if sides.len() == 2 => Ok([sides[0], sides[1]]),
        _ => {
            let expected =
                format!("width and height, each from 1 to {MAX_SIDE}, such as [1280, 720]");
            Err(fault("size", value, &expected))
        }
    }
}

/// Whether a text can be the stem of a file everywhere, and the key of a sample: they end at the first dot.
fn is_name(name: &str) -> bool {
    let is_letter = |c: char| c.is_ascii_alphanumeric() || "-_".contains(c);
    (1..=LONGEST_NAME).contains(&name.len())
        && name.chars().all(is_letter)
        && !name.starts_with('-')
}

fn fault(key: &str, found: &Value, expected: &str) -> Fault {
    let mut found = found.to_string();
    if found.chars().count() > LONGEST_FOUND {
        found = found.chars().take(LONGEST_FOUND).collect::<String>() + "...";
    }
    Fault::Value {
        key: key.to_string(),
        found,
        expected: expected.to_string(),
    }
}

/// The same with what an option says that it expected.
fn told(key: &str, found: &Value, expected: String) -> Fault {
    fault(key, found, expected.trim_start_matches("expected "))
}

#[cfg(test)]
mod tests;
