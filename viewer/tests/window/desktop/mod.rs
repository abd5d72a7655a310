//! A display of a test's own, the program on it, and what is to be seen there.

#![allow(clippy::unwrap_used)]

mod drop;
mod screen;

use std::io::{BufRead, BufReader};
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

pub use screen::Screen;

/// Size of the display and of the window.
pub const SIZE_PX: [u32; 2] = [960, 600];
/// The panel ends here, from the left.
pub const PANEL_PX: u32 = 332;

/// Far longer than anything takes on a machine that works.
const PATIENCE: Duration = Duration::from_secs(120);

/// Waits until something is so.
pub fn eventually(what: &str, mut is_so: impl FnMut() -> bool) {
    let start = Instant::now();
    while !is_so() {
        assert!(start.elapsed() < PATIENCE, "in vain: {what}");
        std::thread::sleep(Duration::from_millis(50));
    }
}

/// A display, and a folder for files.
pub struct Desktop {
    server: Child,
    display: String,
    folder: tempfile::TempDir,
}

impl Desktop {
    pub fn new() -> Desktop {
        let folder = tempfile::tempdir().unwrap();
        let [width, height] = SIZE_PX;
        let mut server = Command::new("Xvfb")
            .args(["-displayfd", "1", "-nolisten", "tcp", "-screen", "0"])
            .arg(format!("{width}x{height}x24"))
            .arg("-fbdir")
            .arg(folder.path())
            .stdout(Stdio::piped())
            .stderr(Stdio::null())
            .spawn()
            .expect("Xvfb starts; `make tools` installs it");
        let mut number = String::new();
        let output = server.stdout.take().unwrap();
        BufReader::new(output).read_line(&mut number).unwrap();
        Desktop {
            server,
            display: format!(":{}", number.trim()),
            folder,
        }
    }

    pub fn name(&self) -> &str {
        &self.display
    }

    pub fn file(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    pub fn screen(&self) -> Screen {
        Screen::read(&self.file("Xvfb_screen0"))
    }

    /// The program's window over the whole display, with its settings in `sky.toml`; it has the keyboard.
    pub fn start(&self, words: &[&str]) -> Program<'_> {
        let [width, height] = SIZE_PX;
        let child = Command::new(env!("CARGO_BIN_EXE_welkin-view"))
            .args(words)
            .args(["--settings", "sky.toml", "--window-size"])
            .arg(format!("{width}x{height}"))
            .current_dir(self.folder.path())
            .env("DISPLAY", &self.display)
            .env_remove("WAYLAND_DISPLAY")
            .spawn()
            .unwrap();
        let program = Program {
            desktop: self,
            child,
        };
        let window = program.window();
        program.xdotool(&["windowmove", "--sync", &window, "0", "0"]);
        program.xdotool(&["windowfocus", "--sync", &window]);
        // The server draws the pointer too; in the corner it lies over nothing that is looked at.
        program.go([0, SIZE_PX[1] - 1]);
        program
    }

    /// An example of the runtime, which `cargo build --workspace --examples` makes beside the program.
    pub fn example(&self, name: &str) -> Program<'_> {
        let file = Path::new(env!("CARGO_BIN_EXE_welkin-view")).with_file_name("examples");
        let child = Command::new(file.join(name))
            .env("DISPLAY", &self.display)
            .env_remove("WAYLAND_DISPLAY")
            .spawn()
            .expect("the example starts; `make test-window` builds it");
        Program {
            desktop: self,
            child,
        }
    }

    pub fn clipboard(&self) -> String {
        let mut command = Command::new("xclip");
        command.args(["-o", "-selection", "clipboard"]);
        let output = command.env("DISPLAY", &self.display).output();
        let output = output.expect("xclip starts; `make tools` installs it");
        String::from_utf8(output.stdout).unwrap()
    }
}

impl Drop for Desktop {
    fn drop(&mut self) {
        self.server.kill().ok();
        self.server.wait().ok();
    }
}

/// The program, until it is dropped.
pub struct Program<'a> {
    desktop: &'a Desktop,
    child: Child,
}

impl Program<'_> {
    /// The number of its window, once it shows.
    pub fn window(&self) -> String {
        let found = self.xdotool(&["search", "--sync", "--onlyvisible", "--name", "^Welkin$"]);
        found.lines().next().unwrap().to_string()
    }

    /// Presses a key and lets it go.
    pub fn key(&self, name: &str) {
        self.xdotool(&["key", name]);
    }

    /// Holds a key for a while.
    pub fn hold(&self, name: &str) {
        self.xdotool(&["keydown", name, "sleep", "0.4", "keyup", name]);
    }

    /// Drags from a place to another, in steps as a hand does; `step` waits until a step is seen.
    pub fn drag(&self, from: [u32; 2], to: [u32; 2], step: impl Fn()) {
        let middle = [(from[0] + to[0]) / 2, (from[1] + to[1]) / 2];
        self.go(from);
        step();
        self.xdotool(&["mousedown", "1"]);
        step();
        for at in [middle, to] {
            self.go(at);
            step();
        }
        self.xdotool(&["mouseup", "1"]);
        step();
    }

    /// Puts the pointer there.
    fn go(&self, [x, y]: [u32; 2]) {
        self.xdotool(&["mousemove", &x.to_string(), &y.to_string()]);
    }

    /// Drops a file on the middle of the window, as a file manager does.
    pub fn drop_file(&self, file: &Path) {
        let window = self.window().parse().unwrap();
        drop::file(&self.desktop.display, window, file);
    }

    fn xdotool(&self, words: &[&str]) -> String {
        let mut command = Command::new("xdotool");
        command.args(words).env("DISPLAY", &self.desktop.display);
        let output = command.output();
        let output = output.expect("xdotool starts; `make tools` installs it");
        assert!(output.status.success(), "{words:?}: {output:?}");
        String::from_utf8(output.stdout).unwrap()
    }
}

impl Drop for Program<'_> {
    fn drop(&mut self) {
        let ended_itself = self.child.try_wait().unwrap();
        self.child.kill().ok();
        self.child.wait().ok();
        if !std::thread::panicking() {
            assert!(
                ended_itself.is_none(),
                "it ended by itself: {ended_itself:?}"
            );
        }
    }
}
