//! The program `welkin`, run as its users run it: exit codes, messages, and what is left on the disk.
#![cfg(unix)]
// The lint's exception for tests does not reach their helpers.
#![allow(clippy::unwrap_used)]

mod bake;
mod check;
mod disk;
mod field;
mod handover;
mod interrupt;
mod look;
mod photograph;
mod places;
mod recipe;
mod streams;

use std::collections::BTreeMap;
use std::io::ErrorKind;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};
use std::sync::OnceLock;
use std::time::Duration;

/// The recipe of tests that need some pack and not a beautiful one.
const SMALL_RECIPE: &str = "name = \"small\"\n[clouds]\nsize = 64\n[stars]\nsize = 64\ncount = 20\n\
    [galaxy]\nsize = 32\n[sky]\nsuns = 16\n[sun]\nsize = 16\n\
    [fbm]\nsize = 64\ncells = 16\n[flares]\nsize = 64\n[layers]\nsize = 64\n[sprites]\nsize = 128\n";

/// `welkin`, to be given arguments.
fn welkin() -> Command {
    Command::new(env!("CARGO_BIN_EXE_welkin"))
}

/// How a run ended.
#[derive(Debug)]
struct Run {
    code: Option<i32>,
    stdout: String,
    stderr: String,
}

/// A program that a test has just written may still be open for writing in a child that another test's thread is about to
/// start: such a one is tried again.
fn run(command: &mut Command) -> Run {
    loop {
        match command.output() {
            Err(busy) if busy.kind() == ErrorKind::ExecutableFileBusy => {
                std::thread::sleep(Duration::from_millis(10));
            }
            started => return Run::from(started.expect("the program starts")),
        }
    }
}

impl From<Output> for Run {
    fn from(output: Output) -> Run {
        let text = |bytes: &[u8]| String::from_utf8_lossy(bytes).into_owned();
        Run {
            code: output.status.code(),
            stdout: text(&output.stdout),
            stderr: text(&output.stderr),
        }
    }
}

impl Run {
    /// It did what it should, with this on standard output.
    fn done(self) -> String {
        assert_eq!(self.code, Some(0), "{self:?}");
        self.stdout
    }

    /// It failed with one clean line on standard error, which has all of these in it.
    fn failed(self, code: i32, parts: &[&str]) {
        assert_eq!(self.code, Some(code), "{self:?}");
        assert_eq!(self.stdout, "", "{self:?}");
        assert!(
            self.stderr.starts_with("error: ") && !self.stderr.contains("panicked"),
            "{self:?}"
        );
        for part in parts {
            assert!(self.stderr.contains(part), "no {part:?} in {}", self.stderr);
        }
    }
}

/// A folder that goes away at the end of a test.
struct Desk(tempfile::TempDir);

impl Desk {
    fn new() -> Desk {
        Desk(tempfile::tempdir().expect("a temporary folder"))
    }

    fn path(&self, name: &str) -> PathBuf {
        self.0.path().join(name)
    }

    fn write(&self, name: &str, bytes: impl AsRef<[u8]>) -> PathBuf {
        let path = self.path(name);
        std::fs::write(&path, bytes).expect("a test file");
        path
    }

    /// Names of everything that lies here, hidden files too.
    fn names(&self) -> Vec<String> {
        let entries = std::fs::read_dir(self.0.path()).expect("a folder");
        let names = entries.map(|entry| entry.expect("an entry").file_name());
        let mut names: Vec<_> = names.map(|n| n.to_string_lossy().into_owned()).collect();
        names.sort();
        names
    }

    /// A small pack here.
    fn small_pack(&self) -> PathBuf {
        let (recipe, pack) = (self.write("small.toml", SMALL_RECIPE), self.path("pack"));
        run(welkin().arg("bake").args([&recipe, Path::new("-o"), &pack])).done();
        pack
    }
}

/// Bytes of every file of a folder by name; folders in it have none.
fn contents(folder: &Path) -> BTreeMap<String, Vec<u8>> {
    let entries = std::fs::read_dir(folder).expect("a folder");
    let paths = entries.map(|entry| entry.expect("an entry").path());
    let name = |path: &Path| {
        path.file_name()
            .expect("a name")
            .to_string_lossy()
            .into_owned()
    };
    paths
        .map(|path| (name(&path), std::fs::read(&path).unwrap_or_default()))
        .collect()
}

/// The default pack, baked once for all tests that only read it.
fn default_pack() -> &'static Path {
    static PACK: OnceLock<PathBuf> = OnceLock::new();
    PACK.get_or_init(|| {
        let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("welkin-default");
        run(welkin().args(["bake", "--force", "-o"]).arg(&folder)).done();
        folder
    })
}
