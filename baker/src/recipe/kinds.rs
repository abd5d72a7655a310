//! What is said where a recipe has something else than the table or the list that belongs there.

use std::ops::Range;

use toml::Spanned;
use toml::de::{DeTable, DeValue, Error};

/// The longest text of a value that a message quotes, in characters.
const LONGEST: usize = 60;

/// A value of a wrong kind.
pub(super) struct WrongKind {
    pub key: String,
    pub found: String,
    pub expected: String,
}

/// The value that an error of the parser is about, if it is of a wrong kind.
pub(super) fn wrong_kind(text: &str, error: &Error) -> Option<WrongKind> {
    let message = error.message();
    // Dates come as tables of a single key, whose name says so.
    let expected = match message.split_once(", expected ") {
        _ if message.contains("$__toml_private_datetime") => "a table",
        Some((_, expected)) => expected,
        None => return None,
    };
    let at = error.span()?;
    let recipe = DeTable::parse(text).ok()?;
    let (key, value) = in_table("", recipe.get_ref(), &at)?;
    let found = match value {
        DeValue::Table(_) => "a table".to_string(),
        DeValue::Array(_) => "a list".to_string(),
        _ => text.get(at)?.chars().take(LONGEST).collect(),
    };
    let expected = match expected {
        "a table" if key.ends_with(']') => "a table".to_string(),
        "a table" => format!("a table, which begins with `[{key}]`"),
        "a sequence" if matches!(value, DeValue::Table(_)) => {
            format!("a list of tables, which each begin with `[[{key}]]`")
        }
        "a sequence" => "a list".to_string(),
        _ => return None,
    };
    Some(WrongKind {
        key,
        found,
        expected,
    })
}

/// The value at a place of the text, and its full key.
fn in_table<'a>(
    above: &str,
    table: &'a DeTable<'a>,
    at: &Range<usize>,
) -> Option<(String, &'a DeValue<'a>)> {
    let dot = if above.is_empty() { "" } else { "." };
    let mut entries = table.iter();
    entries.find_map(|(key, value)| in_value(format!("{above}{dot}{}", key.get_ref()), value, at))
}

fn in_value<'a>(
    key: String,
    value: &'a Spanned<DeValue<'a>>,
    at: &Range<usize>,
) -> Option<(String, &'a DeValue<'a>)> {
    match value.get_ref() {
        found if value.span() == *at => Some((key, found)),
        DeValue::Table(table) => in_table(&key, table, at),
        DeValue::Array(list) => {
            let mut entries = list.iter().enumerate();
            entries.find_map(|(index, value)| in_value(format!("{key}[{index}]"), value, at))
        }
        _ => None,
    }
}
