//! What is wrong with a file of ranges.

use std::fmt::Display;

use welkin_controls::SettingError;
use welkin_pack::shown;

/// Letters of what was found that are told.
const LONGEST_FOUND: usize = 60;

/// What is wrong with a file of ranges.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum Fault {
    /// It is not TOML; the reason has line and column.
    #[error("no TOML: {}; docs/datasets.md has an example", shown(.0))]
    Syntax(String),
    /// A key has a value that it cannot have.
    #[error("{} is {}, expected {expected}", shown(.key), shown(.found))]
    Value {
        /// Which.
        key: String,
        /// What stands there.
        found: String,
        /// What may.
        expected: String,
    },
    /// There is no such key.
    #[error("there is no key {}, expected {expected}", shown(.key))]
    Unknown {
        /// As it was called.
        key: String,
        /// Those that there are.
        expected: String,
    },
    /// A setting is not known, or out of its range.
    #[error("{}: {error}", shown(.key))]
    Setting {
        /// Where.
        key: String,
        /// Why.
        error: SettingError,
    },
    /// Two keys say the same.
    #[error("{one} and {other} both say {what}; leave one of them out")]
    Both {
        one: String,
        other: String,
        what: &'static str,
    },
}

impl Fault {
    pub fn value(key: &str, found: &impl Display, expected: &str) -> Fault {
        let found = found.to_string();
        let mut letters = found.chars();
        let mut told: String = letters.by_ref().take(LONGEST_FOUND).collect();
        if letters.next().is_some() {
            told += "...";
        }
        Fault::Value {
            key: key.to_string(),
            found: told,
            expected: expected.to_string(),
        }
    }
}
