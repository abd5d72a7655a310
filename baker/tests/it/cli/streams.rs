//! Standard output: results go there, and what happens when nobody takes them.

use std::fs::File;

use super::{Desk, Run, default_pack, run, welkin};

#[test]
fn a_closed_pipe_is_no_error() {
    for args in [
        &["info"][..],
        &["info", "--json"],
        &["check"],
        &["check", "--json"],
    ] {
        let (reader, writer) = std::io::pipe().unwrap();
        drop(reader);
        let heard = run(welkin().args(args).arg(default_pack()));
        let unheard = Run::from(
            welkin()
                .args(args)
                .arg(default_pack())
                .stdout(writer)
                .output()
                .unwrap(),
        );
        assert_eq!(
            (unheard.code, unheard.stderr.as_str()),
            (heard.code, ""),
            "{args:?}"
        );
    }
}

#[test]
#[cfg(target_os = "linux")]
fn a_full_disk_behind_standard_output_is_an_error() {
    for (command, code) in [("info", 1), ("check", 2)] {
        let full = File::create("/dev/full").unwrap();
        let output = welkin()
            .arg(command)
            .arg(default_pack())
            .stdout(full)
            .output()
            .unwrap();
        Run::from(output).failed(code, &["standard output", "No space left"]);
    }
}

#[test]
fn nothing_but_results_goes_to_standard_output() {
    let desk = Desk::new();
    let recipe = desk.write("small.toml", super::SMALL_RECIPE);
    let run = run(welkin()
        .arg("bake")
        .arg(&recipe)
        .arg("-o")
        .arg(desk.path("pack")));
    assert_eq!(run.stdout, "");
    // There is no terminal here, so there is no progress bar: one line says what was done.
    assert_eq!(run.stderr.lines().count(), 1, "{}", run.stderr);
    assert!(
        !run.stderr.contains('\x1b') && !run.stderr.contains('\r'),
        "{:?}",
        run.stderr
    );
}
