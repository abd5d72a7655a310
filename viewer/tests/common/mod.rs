//! What the tests of the program share: packs, and how to run it.

// Each test program uses its own share of these.
#![allow(dead_code, clippy::unwrap_used)]

use std::collections::BTreeMap;
use std::fs;
use std::ops::ControlFlow;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};
use std::sync::OnceLock;

use welkin_baker::Recipe;
use welkin_pack::Overwrite;

/// Small textures: what is tested here is the program, not the beauty of its pictures.
pub const RECIPE: &str = "[clouds]\nsize = 64\n[stars]\nsize = 64\ncount = 50\n[galaxy]\nsize = 32\n\
     [fbm]\nsize = 128\n[flares]\nsize = 64\n[layers]\nsize = 64\n\
     [sprites]\nsize = 128\n";

/// A pack, baked once for all tests.
pub fn pack() -> &'static Path {
    static PACK: OnceLock<PathBuf> = OnceLock::new();
    PACK.get_or_init(|| bake("pack", RECIPE, None))
}

/// Bakes a recipe into a folder of this test program; its pictures are in `base`.
pub fn bake(name: &str, recipe: &str, base: Option<&Path>) -> PathBuf {
    let name = format!("view-{}-{name}", env!("CARGO_CRATE_NAME"));
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
    let resolved = Recipe::parse("small", recipe)
        .and_then(|r| r.resolve(None))
        .unwrap();
    let pack = welkin_baker::bake(&resolved, base, &|_| ControlFlow::Continue(())).unwrap();
    pack.save(&folder, Overwrite::Replace, &|| false).unwrap();
    folder
}

/// The program with these words.
pub fn view(args: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_welkin-view"));
    command.args(args);
    command
}

/// What it does.
pub fn run(mut command: Command) -> Output {
    command.output().expect("the program starts")
}

/// `welkin-view render` of [`pack`] into this place.
pub fn render_to(output: &Path, words: &[&str]) -> Command {
    let mut command = view(&["render"]);
    command.arg(pack()).arg("-o").arg(output).args(words);
    command
}

/// That it succeeds, with nothing on standard output; what it says on standard error.
pub fn done(command: Command) -> String {
    let output = run(command);
    let stderr = String::from_utf8_lossy(&output.stderr).into_owned();
    assert!(output.status.success(), "{stderr}");
    assert!(output.stdout.is_empty());
    stderr
}

/// That it failed as it should, and says all of these.
pub fn failed(output: &Output, code: i32, parts: &[&str]) {
    let stderr = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(code), "{stderr}");
    assert!(
        stderr.contains("error: ") && !stderr.contains("panicked"),
        "{stderr}"
    );
    for part in parts {
        assert!(stderr.contains(part), "no {part:?} in {stderr}");
    }
}

/// The bytes of a small frame of [`pack`].
pub fn render(file: &Path, args: &[&str]) -> Vec<u8> {
    render_of(pack(), file, args)
}

/// The bytes of a small frame of a pack.
pub fn render_of(pack: &Path, file: &Path, args: &[&str]) -> Vec<u8> {
    let mut command = view(&["render", "--size", "70x40"]);
    command.arg(pack).arg("-o").arg(file).args(args);
    let output = run(command);
    let stderr = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{args:?}: {stderr}");
    assert!(output.stdout.is_empty());
    std::fs::read(file).unwrap()
}

/// Names and bytes of the files in a folder.
pub fn files(folder: &Path) -> BTreeMap<String, Vec<u8>> {
    let entries = fs::read_dir(folder)
        .unwrap()
        .map(|entry| entry.unwrap().path());
    entries
        .map(|path| {
            let name = path.file_name().unwrap().to_str().unwrap().to_string();
            (name, fs::read(path).unwrap())
        })
        .collect()
}
