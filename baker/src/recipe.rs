//! The recipe as it is written: TOML with every key optional and unknown keys refused.
//!
//! Scalars are kept as whatever TOML value stands there, with its place in the text; `resolve.rs`
//! checks types and ranges together, so that both kinds of mistake are told in one form.

mod kinds;
pub(crate) mod tables;

use std::ops::Range;

use crate::error::RecipeError;

use kinds::WrongKind;
use tables::Tables;

/// The recipe that is used when none is given; it spells out every default.
pub const DEFAULT_RECIPE: &str =
    include_str!(concat!(env!("WELKIN_ASSETS"), "/recipes/default.toml"));

/// The name that errors give the built-in recipe.
const BUILT_IN: &str = "built-in recipe";

/// A parsed recipe: known keys only, nothing checked yet.
#[derive(Clone, Debug)]
pub struct Recipe {
    pub(crate) file: String,
    pub(crate) text: String,
    pub(crate) tables: Tables,
}

impl Recipe {
    /// Parses TOML. `file` names the text in errors.
    ///
    /// Line ends become line feeds and a byte order mark is left out, so that a recipe from Windows makes the same pack.
    ///
    /// # Errors
    /// [`RecipeError::Syntax`] where the text is not TOML or has a key that no recipe has; [`RecipeError::Value`] where
    /// something else stands for a table or a list.
    pub fn parse(file: &str, text: &str) -> Result<Recipe, RecipeError> {
        let text = normalised(text);
        let of_kind = |wrong: WrongKind| {
            let (line, column) = line_and_column(&text, wrong.at);
            RecipeError::Value {
                file: file.to_string(),
                line,
                column,
                key: wrong.key,
                found: wrong.found,
                expected: wrong.expected,
            }
        };
        let tables = toml::from_str(&text).map_err(|e: toml::de::Error| {
            let wrong = kinds::list_for_table(&text).or_else(|| kinds::wrong_kind(&text, &e));
            if let Some(wrong) = wrong {
                return of_kind(wrong);
            }
            let (line, column) = line_and_column(&text, e.span().unwrap_or(0..0));
            RecipeError::Syntax {
                file: file.to_string(),
                line,
                column,
                message: e.message().to_string(),
            }
        })?;
        if let Some(wrong) = kinds::list_for_table(&text) {
            return Err(of_kind(wrong));
        }
        Ok(Recipe {
            file: file.to_string(),
            text,
            tables,
        })
    }
}

impl Default for Recipe {
    /// The built-in recipe, [`DEFAULT_RECIPE`].
    fn default() -> Recipe {
        // A test parses it, so the other branch is never taken; it would mean the same defaults.
        Recipe::parse(BUILT_IN, DEFAULT_RECIPE).unwrap_or(Recipe {
            file: BUILT_IN.to_string(),
            text: DEFAULT_RECIPE.to_string(),
            tables: Tables::default(),
        })
    }
}

/// The text with line feeds alone, and without a byte order mark: what editors on Windows add is not part of a recipe.
fn normalised(text: &str) -> String {
    let text = text.strip_prefix('\u{feff}').unwrap_or(text);
    text.replace("\r\n", "\n")
}

/// Line and column, both from 1 and in characters, of the start of a byte range.
pub(crate) fn line_and_column(text: &str, span: Range<usize>) -> (usize, usize) {
    let before = text.get(..span.start).unwrap_or(text);
    let line_start = before.rfind('\n').map_or(0, |i| i + 1);
    (
        before.matches('\n').count() + 1,
        before[line_start..].chars().count() + 1,
    )
}
