//! Ctrl-C and SIGTERM in the middle of the work: exit code 130, and nothing is left behind.

use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::thread::sleep;
use std::time::Duration;

use super::{Desk, Run, SMALL_RECIPE, contents, run, welkin};

fn start(command: &mut Command) -> Child {
    command
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .expect("the program starts")
}

fn signal_after(child: Child, delay: Duration, signal: &str) -> Run {
    sleep(delay);
    // It may have finished; then there is nobody to signal, and its exit code tells.
    let kill = format!("kill -{signal} {} 2>/dev/null", child.id());
    Command::new("sh")
        .args(["-c", &kill])
        .status()
        .expect("a shell");
    Run::from(child.wait_with_output().expect("it ends"))
}

/// Its temporary folders for side files show that the bake has begun.
pub fn wait_until_begun(desk: &Desk, child: &mut Child) {
    while !desk.names().iter().any(|name| name.starts_with(".welkin-")) {
        assert!(child.try_wait().unwrap().is_none(), "ended before it began");
        sleep(Duration::from_millis(2));
    }
}

#[test]
fn a_bake_that_is_interrupted_leaves_nothing_and_says_130() {
    for signal in ["INT", "TERM"] {
        let desk = Desk::new();
        // 2048 texels a side take seconds, so the signal comes long before the end.
        let recipe = desk.write("large.toml", "[clouds]\nsize = 2048\n");
        let mut bake = welkin();
        bake.arg("bake")
            .arg(&recipe)
            .arg("-o")
            .arg(desk.path("made/pack"));
        bake.arg("--png")
            .arg(desk.path("png"))
            .arg("--exr")
            .arg(desk.path("exr"));
        let mut child = start(&mut bake);
        wait_until_begun(&desk, &mut child);
        let run = signal_after(child, Duration::from_millis(20), signal);
        assert_eq!(run.code, Some(130), "{signal}: {run:?}");
        assert!(
            run.stderr.contains("interrupted") && !run.stderr.contains("error"),
            "{run:?}"
        );
        assert_eq!(desk.names(), ["large.toml"], "{signal}");
    }
}

#[test]
fn whenever_the_signal_comes_the_pack_is_whole_or_not_there() {
    let desk = Desk::new();
    let recipe = desk.write("small.toml", SMALL_RECIPE);
    let pack = desk.path("pack");
    let bake = |pack: &Path, force: bool| {
        let mut bake = welkin();
        bake.arg("bake")
            .arg(&recipe)
            .arg("-o")
            .arg(pack)
            .args(force.then_some("--force"));
        bake
    };
    run(&mut bake(&pack, false)).done();
    let whole = contents(&pack);
    for step in 0..24 {
        let delay = Duration::from_millis(step * 5);
        let new = desk.path("new");
        let fresh = signal_after(start(&mut bake(&new, false)), delay, "INT");
        let replaced = signal_after(start(&mut bake(&pack, true)), delay, "INT");
        for run in [&fresh, &replaced] {
            // No code: the signal came before the program had begun to listen.
            assert!(matches!(run.code, Some(0 | 130) | None), "{run:?}");
        }
        assert_eq!(new.exists(), fresh.code == Some(0), "{fresh:?}");
        if new.exists() {
            assert!(contents(&new) == whole, "step {step}");
            std::fs::remove_dir_all(&new).unwrap();
        }
        assert!(contents(&pack) == whole, "step {step}");
        assert_eq!(desk.names(), ["pack", "small.toml"], "step {step}");
    }
}

#[test]
fn a_pipe_that_gives_nothing_is_left_alone() {
    let desk = Desk::new();
    let pipe = desk.path("pipe");
    let made = Command::new("mkfifo").arg(&pipe).status();
    assert!(made.unwrap().success());
    desk.write("photo.toml", "[clouds.photo]\nfile = \"pipe\"\n");
    std::fs::create_dir(desk.path("p")).unwrap();
    std::os::unix::fs::symlink(&pipe, desk.path("p/pack.json")).unwrap();
    let before = desk.names();
    for args in [
        &["photo", "pipe", "-o", "tile.png"][..],
        &["photo", "/dev/stdin", "-o", "tile.png"],
        &["bake", "pipe", "-o", "new/pack"],
        &["bake", "photo.toml", "-o", "new/pack", "--png", "png"],
        &["preview", "p", "-o", "sheet.png"],
        &["unpack", "p", "-o", "channels"],
    ] {
        let mut command = welkin();
        command.args(args).current_dir(desk.path(""));
        let mut child = start(command.stdin(Stdio::piped()));
        // It opens once there is a reader, who then waits for us.
        let writer = (args[1] != "/dev/stdin").then(|| {
            let opened = std::fs::File::options().write(true).open(&pipe);
            opened.unwrap()
        });
        let stdin = child.stdin.take();
        let run = signal_after(child, Duration::from_millis(200), "INT");
        drop((writer, stdin));
        assert_eq!(run.code, Some(130), "{args:?}: {run:?}");
        assert_eq!(desk.names(), before, "{args:?}");
    }
}
