//! A legal recipe makes a sound pack: recipes drawn at random over every key, and the default one with many seeds.
//!
//! A recipe is refused when it is resolved, by an error that names key, value and what is expected, or it bakes and
//! passes every rule of `check` whose severity is error.
//!
//! The environment says how many: `make recipes` sets `WELKIN_RECIPES` and `WELKIN_SEEDS`. `WELKIN_FIRST` is the number of the first
//! one; a failure names its own, and the fewest keys that make it. No file is needed, so the test's binary runs anywhere.

#![allow(clippy::unwrap_used, reason = "a test may stop where it fails")]
#![allow(clippy::print_stdout, reason = "a long run tells how far it is")]

mod draw;
mod pictures;

use std::collections::BTreeMap;
use std::ops::ControlFlow;

use rayon::prelude::*;
use welkin_baker::{BakeError, Inputs, Recipe, RecipeError, bake_from};

use draw::Draw;

/// How a recipe came out, if it is as it should be.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Outcome {
    Sound,
    /// By a key of the recipe, when it was resolved.
    Refused,
    /// The field would hold more than a pack may; only making it can tell.
    FieldTooLarge,
}

/// What became of a recipe, or what is wrong about that.
fn outcome(text: &str) -> Result<Outcome, String> {
    let resolved = match Recipe::parse("legal.toml", text).and_then(|recipe| recipe.resolve(None)) {
        Ok(resolved) => resolved,
        Err(RecipeError::Value {
            key,
            expected,
            found,
            ..
        }) if !key.is_empty() && !found.is_empty() && !expected.is_empty() => {
            return Ok(Outcome::Refused);
        }
        Err(error) => return Err(error.to_string()),
    };
    let inputs = Inputs::Memory(pictures::files());
    let pack = match bake_from(&resolved, inputs, &|_| ControlFlow::Continue(())) {
        Ok(pack) => pack,
        Err(BakeError::Field { .. }) => return Ok(Outcome::FieldTooLarge),
        Err(error) => return Err(error.to_string()),
    };
    match welkin_baker::verify(&pack) {
        Ok(_) => Ok(Outcome::Sound),
        Err(error) => Err(error.to_string()),
    }
}

/// The lines that the fault needs: without any of them it is gone, or is another.
fn least(mut lines: Vec<String>) -> Vec<String> {
    let is_fault = |lines: &[String]| outcome(&lines.join("\n")).is_err();
    let mut index = 0;
    while index < lines.len() {
        let mut fewer = lines.clone();
        fewer.remove(index);
        if is_fault(&fewer) {
            lines = fewer;
        } else {
            index += 1;
        }
    }
    lines
}

/// A whole number from the environment.
fn from_environment(name: &str, default: u64) -> u64 {
    let value = std::env::var(name).ok();
    value.map_or(default, |text| {
        text.parse()
            .unwrap_or_else(|_| panic!("{name} is {text}, expected a number"))
    })
}

/// Bakes as many recipes at a time as there are cores; tells of the faults, and counts the rest.
fn all(
    name: &str,
    count: u64,
    recipe: impl Fn(u64) -> Vec<String> + Sync,
) -> BTreeMap<Outcome, usize> {
    let first = from_environment("WELKIN_FIRST", 0);
    let found: Vec<_> = (first..first + count)
        .into_par_iter()
        .map(|number| {
            let outcome = outcome(&recipe(number).join("\n"));
            // At once: a long run may be ended before it is done.
            if let Err(error) = &outcome {
                println!("{number}: {error}");
            }
            (number, outcome)
        })
        .collect();
    let mut counts = BTreeMap::new();
    let mut faults = Vec::new();
    for (number, outcome) in found {
        match outcome {
            Ok(outcome) => *counts.entry(outcome).or_default() += 1,
            Err(error) => faults.push((number, error)),
        }
    }
    println!(
        "{name}: {count} from {first}: {counts:?}, {} faults",
        faults.len()
    );
    let told: Vec<String> = faults
        .par_iter()
        .take(from_environment("WELKIN_FAULTS", 8) as usize)
        .map(|(number, error)| {
            let lines = least(recipe(*number)).join("\n");
            format!("number {number}: {error}\n{lines}\n")
        })
        .collect();
    assert!(
        faults.is_empty(),
        "{} faults\n{}",
        faults.len(),
        told.join("\n")
    );
    counts
}

#[test]
fn random_recipes_are_refused_by_key_or_make_sound_packs() {
    let count = from_environment(
        "WELKIN_RECIPES",
        [500, 60][usize::from(cfg!(debug_assertions))],
    );
    let counts = all("recipes", count, Draw::recipe);
    // A test of refusals alone would say nothing.
    let sound = counts.get(&Outcome::Sound).copied().unwrap_or_default() as u64;
    assert!(3 * sound > count, "{counts:?}");
}

/// The default recipe but for the sizes of its textures.
const SMALL: &str = "\
clouds.size = 64
stars.size = 256
galaxy.size = 32
sky.suns = 16
sun.size = 16
fbm.size = 64
flares.size = 64
layers.size = 64
sprites.size = 128
field.sections = 1";

#[test]
fn the_default_recipe_is_sound_with_any_seed() {
    let count = from_environment(
        "WELKIN_SEEDS",
        [200, 10][usize::from(cfg!(debug_assertions))],
    );
    all("seeds", count, |seed| {
        vec![SMALL.to_string(), format!("seed = {seed}")]
    });
}
