//! Settings as a TOML document: a key a setting, all of them, so that a file means the same when what is usual changes.

use toml::{Table, Value};
use welkin_pack::shown;
use welkin_runtime::params::Input;

use crate::keys::{KEYS, Key, SettingError};
use crate::settings::Settings;

/// Why a document is no settings.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum TomlError {
    /// It is not TOML; the reason has line and column, and quotes what is there through [`shown`].
    #[error("no TOML: {}", shown(.0))]
    Syntax(String),
    /// A key has a value of a kind that no setting has.
    #[error("{} is {found}, expected a number, true or false, or text", shown(.key))]
    Kind {
        /// Name of the key.
        key: String,
        /// What it is.
        found: &'static str,
    },
    /// A key is unknown, or its value out of range.
    #[error(transparent)]
    Setting(#[from] SettingError),
}

impl Settings {
    /// All settings as a document. [`Settings::from_toml`] gives them back.
    pub fn to_toml(&self) -> String {
        let mut text = String::from("# Settings of a sky, for welkin-view.\n");
        let mut group = None;
        for key in KEYS {
            if group != Some(key.group) {
                text += "\n";
                group = Some(key.group);
            }
            text += &format!("# {}\n{} = {}\n", key.help, key.name, value(key, self));
        }
        text
    }

    /// The settings of a document; those that it does not name are the usual ones.
    ///
    /// # Errors
    /// See [`TomlError`].
    pub fn from_toml(text: &str) -> Result<Settings, TomlError> {
        let table: Table = text
            .parse()
            .map_err(|e| TomlError::Syntax(reason(text, &e)))?;
        let pairs = table
            .iter()
            .map(|(name, value)| Ok((name.as_str(), plain(name, value)?)))
            .collect::<Result<Vec<_>, TomlError>>()?;
        let pairs = pairs.iter().map(|(name, text)| (*name, text.as_str()));
        Ok(Settings::from_pairs(pairs)?)
    }
}

/// Where and why a text is no TOML, on one line.
fn reason(text: &str, error: &toml::de::Error) -> String {
    let at = error.span().map_or(0, |span| span.start);
    let before = text.get(..at).unwrap_or(text);
    let line_start = before.rfind('\n').map_or(0, |i| i + 1);
    let (line, column) = (
        before.matches('\n').count() + 1,
        before[line_start..].chars().count() + 1,
    );
    format!("line {line}, column {column}: {}", error.message())
}

/// A value as TOML has it.
fn value(key: &Key, settings: &Settings) -> String {
    let text = key.text(settings);
    match key.input {
        Input::Slider { .. } | Input::Switch => text,
        _ => Value::String(text).to_string(),
    }
}

/// A value as [`Settings::set`] takes it.
fn plain(key: &str, value: &Value) -> Result<String, TomlError> {
    match value {
        Value::String(text) => Ok(text.clone()),
        Value::Integer(number) => Ok(number.to_string()),
        Value::Float(number) => Ok(number.to_string()),
        Value::Boolean(on) => Ok(on.to_string()),
        other => Err(TomlError::Kind {
            key: key.to_string(),
            found: other.type_str(),
        }),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_key_is_in_the_document_with_its_meaning() {
        let text = Settings::default().to_toml();
        for key in KEYS {
            assert!(text.contains(&format!("\n# {}\n{} = ", key.help, key.name)));
        }
        assert_eq!(Settings::from_toml(&text), Ok(Settings::default()));
    }

    #[test]
    fn what_is_wrong_is_told() {
        let told = |text: &str| Settings::from_toml(text).unwrap_err().to_string();
        assert!(told("cover = ").starts_with("no TOML: "));
        assert!(told("\ncover = \n").contains("line 2, column 9"));
        assert!(!told("\ncover = \n").contains('\n'));
        assert_eq!(
            told("\"a\\u001bb\" = [1]"),
            r"a\u{1b}b is array, expected a number, true or false, or text"
        );
        assert_eq!(
            told("cover = [1]"),
            "cover is array, expected a number, true or false, or text"
        );
        assert_eq!(
            told("cover = 3"),
            "cover is \"3\", expected a number from 0 to 1"
        );
        assert!(told("clouds = 3").starts_with("there is no setting \"clouds\""));
    }
}
