//! Places that cannot be written and disks that are full: a clear error, and nothing lost or left.

use std::fs;
use std::path::Path;
use std::process::Command;

use super::{Desk, Run, SMALL_RECIPE, contents, default_pack, run, welkin};

/// The commands that write, each with a place to write to, whose name ends in .png where that must be.
fn writers(desk: &Desk, place: &Path) -> Vec<Command> {
    let recipe = desk.write("small.toml", SMALL_RECIPE);
    let photograph =
        Path::new(env!("CARGO_MANIFEST_DIR")).join("../assets-src/photos/god-rays-1024.png");
    let inputs = [
        ("bake", recipe.as_path()),
        ("preview", default_pack()),
        ("unpack", default_pack()),
        ("photo", &photograph),
    ];
    let command = |(name, input): (&str, &Path)| {
        let mut command = welkin();
        command.arg(name).arg(input).arg("-o");
        match name {
            "preview" | "photo" => command.arg(place.with_extension("png")),
            _ => command.arg(place),
        };
        command
    };
    inputs.into_iter().map(command).collect()
}

#[test]
fn below_a_file_there_is_no_place_to_write() {
    let desk = Desk::new();
    let file = desk.write("file", "mine");
    for mut command in writers(&desk, &file.join("out")) {
        run(&mut command).failed(1, &["file/out", "cannot be written"]);
    }
    assert_eq!(fs::read(&file).unwrap(), b"mine");
    assert_eq!(desk.names(), ["file", "small.toml"]);
}

#[test]
#[cfg(target_os = "linux")]
fn a_file_system_without_files_of_ours_is_told_by_name() {
    let desk = Desk::new();
    for mut command in writers(&desk, Path::new("/proc/welkin")) {
        run(&mut command).failed(1, &["/proc", "cannot be written"]);
    }
}

#[test]
fn files_are_not_written_over_folders_or_devices() {
    let desk = Desk::new();
    let (folder, device) = (desk.path("folder.png"), desk.path("device.png"));
    fs::create_dir(&folder).unwrap();
    std::os::unix::fs::symlink("/dev/null", &device).unwrap();
    for place in [&folder, &device] {
        for mut command in writers(&desk, place) {
            // An empty folder may become a pack or hold channels.
            let makes_folder = |arg| arg == "bake" || arg == "unpack";
            if command.get_args().any(makes_folder) && *place == folder {
                continue;
            }
            run(&mut command).failed(1, &[".png", "is there and is not a f"]);
        }
    }
    use std::os::unix::fs::FileTypeExt;
    assert!(
        fs::metadata("/dev/null")
            .unwrap()
            .file_type()
            .is_char_device()
    );
    assert!(contents(&folder).is_empty());
    assert_eq!(desk.names(), ["device.png", "folder.png", "small.toml"]);
}

/// Runs a command in a shell that allows files of this many blocks of 512 bytes, as a disk that gets full.
fn with_small_files(blocks: u32, command: &Command) -> Run {
    let script = format!("trap '' XFSZ; ulimit -f {blocks}; exec \"$0\" \"$@\"");
    run(Command::new("sh")
        .args(["-c", &script])
        .arg(command.get_program())
        .args(command.get_args()))
}

#[test]
fn a_write_that_fails_midway_leaves_nothing() {
    let desk = Desk::new();
    for command in writers(&desk, &desk.path("out")) {
        with_small_files(1, &command).failed(1, &["cannot be written", "File too large"]);
        assert_eq!(desk.names(), ["small.toml"], "{command:?}");
    }
}

#[test]
fn a_write_that_fails_midway_keeps_what_was_there() {
    let desk = Desk::new();
    let pack = desk.small_pack();
    let before = contents(&pack);
    let mut bake = welkin();
    bake.arg("bake")
        .arg(desk.path("small.toml"))
        .arg("--force")
        .arg("-o")
        .arg(&pack);
    with_small_files(1, &bake).failed(1, &["cannot be written"]);
    assert_eq!(contents(&pack), before);

    let sheet = desk.write("sheet.png", "older");
    let mut preview = welkin();
    preview
        .arg("preview")
        .arg(default_pack())
        .arg("-o")
        .arg(&sheet);
    with_small_files(8, &preview).failed(1, &["sheet.png", "cannot be written"]);
    assert_eq!(fs::read(&sheet).unwrap(), b"older");
    assert_eq!(desk.names(), ["pack", "sheet.png", "small.toml"]);
}

#[test]
fn a_pack_that_cannot_be_saved_leaves_no_side_folders_either() {
    let desk = Desk::new();
    let recipe = desk.write("small.toml", SMALL_RECIPE);
    let file = desk.write("file", "mine");
    let mut bake = welkin();
    bake.arg("bake")
        .arg(&recipe)
        .arg("-o")
        .arg(file.join("pack"));
    bake.arg("--png")
        .arg(desk.path("png"))
        .arg("--exr")
        .arg(desk.path("exr"));
    run(&mut bake).failed(1, &["file/pack", "cannot be written"]);
    assert_eq!(desk.names(), ["file", "small.toml"]);
}

/// What the shell below says if it may not mount.
const NO_MOUNT: i32 = 77;

/// A disk of 16 kB in a mount namespace of its own, which ends with the shell.
#[test]
#[cfg(target_os = "linux")]
fn a_full_disk_is_told_and_left_as_it_was() {
    let desk = Desk::new();
    let disk = desk.path("disk");
    fs::create_dir(&disk).unwrap();
    let script = format!(
        "mount -t tmpfs -o size=16k tmpfs \"$0\" || exit {NO_MOUNT}; echo mine > \"$0/mine\"; \
         \"$@\"; code=$?; ls -A \"$0\" >&2; exit $code"
    );
    for command in writers(&desk, &disk.join("out")) {
        // The small pack would fit, so the default one is baked.
        let args = command
            .get_args()
            .filter(|arg| !arg.to_string_lossy().ends_with("small.toml"));
        let mut shell = Command::new("unshare");
        shell
            .args(["--map-root-user", "--mount", "sh", "-c", &script])
            .arg(&disk)
            .arg(command.get_program())
            .args(args);
        let Ok(output) = shell.output() else {
            return eprintln!("skipped: there is no program `unshare`");
        };
        let run = Run::from(output);
        if run.code == Some(NO_MOUNT) || run.stderr.contains("unshare") {
            return eprintln!("skipped: this machine lets nobody mount: {}", run.stderr);
        }
        let listing = "\nmine\n";
        assert!(run.stderr.ends_with(listing), "{command:?}: {run:?}");
        assert!(!run.stderr.contains(".welkin-"), "{run:?}");
        run.failed(
            1,
            &[
                "disk/out",
                "cannot be written",
                "No space left",
                "make room",
            ],
        );
    }
}
