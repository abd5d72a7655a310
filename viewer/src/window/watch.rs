//! Sees when a recipe, or a file that it names, is saved.
//!
//! It looks a few times a second: that holds for editors that write a file in place and for those that rename a new one to it, on any
//! file system.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::time::{Duration, SystemTime};

use toml::Value;
use winit::event_loop::EventLoopProxy;

use super::wake::Wake;

const PAUSE: Duration = Duration::from_millis(200);

/// When each file was written, and its length; files that are not there are left out.
type Stamps = BTreeMap<PathBuf, (Option<SystemTime>, u64)>;

/// Watches from a thread that ends with the event loop.
pub fn begin(recipe: PathBuf, proxy: EventLoopProxy<Wake>) {
    std::thread::spawn(move || {
        let mut seen = stamps(&recipe);
        let mut told = seen.clone();
        loop {
            std::thread::sleep(PAUSE);
            let now = stamps(&recipe);
            // A file that is still being written changes from look to look.
            let is_quiet = now == seen;
            seen = now;
            if is_quiet && seen != told {
                told.clone_from(&seen);
                if proxy.send_event(Wake::RecipeSaved).is_err() {
                    return;
                }
            }
        }
    });
}

fn stamps(recipe: &Path) -> Stamps {
    let text = std::fs::read_to_string(recipe).unwrap_or_default();
    let base = recipe.parent().unwrap_or(Path::new("."));
    let mut names = Vec::new();
    if let Ok(table) = text.parse() {
        strings(&Value::Table(table), &mut names);
    }
    let named = names.iter().map(|name| base.join(name));
    let files = named.chain([recipe.to_path_buf()]);
    files
        .filter_map(|file| {
            let metadata = std::fs::metadata(&file).ok().filter(|m| m.is_file())?;
            Some((file, (metadata.modified().ok(), metadata.len())))
        })
        .collect()
}

/// Every text in a value: those that name a file that is there are names of files.
fn strings(value: &Value, found: &mut Vec<String>) {
    match value {
        Value::String(text) => found.push(text.clone()),
        Value::Array(values) => values.iter().for_each(|value| strings(value, found)),
        Value::Table(table) => table.values().for_each(|value| strings(value, found)),
        _ => {}
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_recipe_and_what_it_names_have_stamps() {
        let folder = tempfile::tempdir().unwrap();
        let place = |name: &str| folder.path().join(name);
        let recipe = place("r.toml");
        assert!(stamps(&recipe).is_empty());
        std::fs::write(&recipe, "name = \"a\"\n[clouds.photo]\nfile = \"p.png\"\n").unwrap();
        std::fs::write(place("p.png"), "1").unwrap();
        let before = stamps(&recipe);
        assert_eq!(
            before.keys().collect::<Vec<_>>(),
            [&place("p.png"), &recipe]
        );
        std::fs::write(place("p.png"), "22").unwrap();
        assert_ne!(stamps(&recipe), before);
        // While it is broken, it is still watched.
        std::fs::write(&recipe, "name = ").unwrap();
        assert_eq!(stamps(&recipe).len(), 1);
    }
}
