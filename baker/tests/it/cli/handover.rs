//! `welkin view|render|bench`: handed to `welkin-view`, wherever that is.

use std::fs;
use std::os::unix::fs::PermissionsExt;
use std::path::{Path, PathBuf};
use std::process::Command;

use super::{Desk, Run, run};

/// A copy of the program in a folder of its own, where nothing is beside it and nothing on PATH.
fn alone(desk: &Desk) -> (PathBuf, Command) {
    let folder = desk.path("bin");
    fs::create_dir(&folder).unwrap();
    let program = folder.join("welkin");
    fs::copy(env!("CARGO_BIN_EXE_welkin"), &program).unwrap();
    let mut command = Command::new(&program);
    command.env("PATH", desk.path("path"));
    (folder, command)
}

/// A `welkin-view` that says where it is and what it was told, and exits with 7.
fn fake_view(folder: &Path) {
    fs::create_dir_all(folder).unwrap();
    let path = folder.join("welkin-view");
    fs::write(&path, "#!/bin/sh\nprintf '[%s]' \"$0\" \"$@\"\nexit 7\n").unwrap();
    fs::set_permissions(&path, fs::Permissions::from_mode(0o755)).unwrap();
}

fn said(run: Run, program: &Path, args: &str) {
    assert_eq!(run.code, Some(7), "{run:?}");
    assert_eq!(
        run.stdout,
        format!("[{}]{args}", program.join("welkin-view").display())
    );
}

#[test]
fn without_welkin_view_it_says_what_to_install() {
    let desk = Desk::new();
    let (_, mut command) = alone(&desk);
    run(command.args(["render", "pack"]))
        .failed(1, &["welkin-view is not installed", "cargo install"]);
}

#[test]
fn arguments_and_exit_code_pass_through_unchanged() {
    let desk = Desk::new();
    let (beside, mut command) = alone(&desk);
    fake_view(&beside);
    let args = ["bench", "a pack", "--json", "--help", "-o", "--", "x"];
    said(
        run(command.args(args)),
        &beside,
        "[bench][a pack][--json][--help][-o][--][x]",
    );
}

#[test]
fn view_is_welkin_view_itself() {
    let desk = Desk::new();
    let (beside, mut command) = alone(&desk);
    fake_view(&beside);
    said(run(command.args(["view", "pack"])), &beside, "[pack]");
}

#[test]
fn it_is_found_on_the_path_too() {
    let desk = Desk::new();
    let (_, mut command) = alone(&desk);
    fake_view(&desk.path("path"));
    said(
        run(command.args(["render", "-o", "f.png"])),
        &desk.path("path"),
        "[render][-o][f.png]",
    );
}

#[test]
fn one_that_cannot_be_started_is_told_by_name() {
    let desk = Desk::new();
    let (beside, mut command) = alone(&desk);
    fake_view(&beside);
    fs::set_permissions(
        beside.join("welkin-view"),
        fs::Permissions::from_mode(0o644),
    )
    .unwrap();
    run(command.arg("view")).failed(1, &["welkin-view", "cannot be started"]);
}
