//! A recipe with a photograph put in.

use std::path::Path;

use anyhow::{Result, anyhow};
use toml::{Table, Value};

/// The recipe's text with this file as the photograph of the clouds. Comments are lost.
///
/// # Errors
/// A text that is no recipe.
pub fn with_photo(text: &str, photo: &Path) -> Result<String> {
    let mut recipe: Table = text.parse().map_err(|e: toml::de::Error| {
        anyhow!("the recipe is no TOML: {}; correct it first", e.message())
    })?;
    let file = Value::String(photo.display().to_string());
    put(&mut recipe, &["clouds", "photo", "file"], file);
    Ok(recipe.to_string())
}

/// Puts a value at a path, whose tables are made where there are none.
fn put(table: &mut Table, path: &[&str], value: Value) {
    let [name, rest @ ..] = path else {
        return;
    };
    if rest.is_empty() {
        table.insert(name.to_string(), value);
        return;
    }
    let mut inner = match table.remove(*name) {
        Some(Value::Table(inner)) => inner,
        _ => Table::new(),
    };
    put(&mut inner, rest, value);
    table.insert(name.to_string(), Value::Table(inner));
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_photograph_is_put_in_and_the_rest_stays() {
        let text = "seed = 7\n[clouds]\nsize = 64\n[clouds.photo]\nmean = 0.2\n";
        for text in [text, "seed = 7", ""] {
            let with = with_photo(text, Path::new("/tmp/it's \"it\".png")).unwrap();
            let recipe = welkin_baker::Recipe::parse("test", &with).unwrap();
            let resolved = recipe.resolve(None).unwrap();
            let file = resolved.clouds.photo.file.as_deref();
            assert_eq!(file, Some("/tmp/it's \"it\".png"));
            let before = welkin_baker::Recipe::parse("test", text).unwrap();
            let before = before.resolve(None).unwrap();
            assert_eq!(
                (resolved.seed, resolved.clouds.size),
                (before.seed, before.clouds.size)
            );
            assert_eq!(resolved.clouds.photo.mean, before.clouds.photo.mean);
        }
    }
}
