//! The text of a recipe, with its defaults filled and its ranges checked.
#![no_main]

use welkin_baker::Recipe;

libfuzzer_sys::fuzz_target!(|text: &str| {
    if let Ok(recipe) = Recipe::parse("fuzz.toml", text) {
        drop(recipe.resolve(None));
    }
});
