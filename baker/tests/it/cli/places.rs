//! Where outputs go: never over what is read, each to a place of its own, and never over what somebody else has put there.

use std::fs;
use std::io::Write;
use std::os::unix::fs::symlink;
use std::path::Path;
use std::process::{Command, Stdio};

use welkin_pack::Pack;

use super::{Desk, Run, SMALL_RECIPE, contents, run, welkin};

/// Runs `welkin` in the desk's folder.
fn here(desk: &Desk, args: &[&str]) -> Run {
    run(welkin().args(args).current_dir(desk.path("")))
}

fn god_rays() -> Vec<u8> {
    let file = "../assets-src/photos/god-rays-1024.png";
    fs::read(Path::new(env!("CARGO_MANIFEST_DIR")).join(file)).unwrap()
}

/// Everything below a folder, by path.
fn tree(folder: &Path) -> Vec<(String, Vec<u8>)> {
    let entries = fs::read_dir(folder).unwrap().map(|e| e.unwrap().path());
    let mut all: Vec<_> = entries
        .flat_map(|path| {
            let below = if path.is_dir() && !path.is_symlink() {
                tree(&path)
            } else {
                Vec::new()
            };
            let bytes = fs::read(&path).unwrap_or_default();
            below
                .into_iter()
                .chain([(path.display().to_string(), bytes)])
        })
        .collect();
    all.sort();
    all
}

/// That the command is refused for this reason, and changes nothing.
fn refused(desk: &Desk, args: &[&str], reason: &str) {
    let before = tree(&desk.path(""));
    here(desk, args).failed(1, &[reason]);
    assert!(tree(&desk.path("")) == before, "{args:?}");
}

#[test]
fn nothing_is_written_over_what_is_read() {
    let desk = Desk::new();
    desk.small_pack();
    desk.write("a.png", god_rays());
    fs::hard_link(desk.path("a.png"), desk.path("twin.png")).unwrap();
    symlink("a.png", desk.path("link.png")).unwrap();
    symlink("pack", desk.path("way")).unwrap();
    fs::copy(desk.path("small.toml"), desk.path("pack/recipe.toml")).unwrap();
    let over = "which is read";
    for output in ["a.png", "./pack/../a.png", "link.png", "twin.png"] {
        refused(&desk, &["photo", "a.png", "-o", output], over);
        refused(&desk, &["photo", "link.png", "-o", output], over);
    }
    for output in ["pack/sheet.png", "way/sheet.png", "pack/new/sheet.png"] {
        refused(&desk, &["preview", "pack", "-o", output], over);
        refused(&desk, &["preview", "way", "-o", output], over);
    }
    refused(
        &desk,
        &["preview", "pack", "-o", "pack/pack.json"],
        "ends in .png",
    );
    for output in ["pack", "way/x", "."] {
        refused(&desk, &["unpack", "pack", "-o", output], over);
    }
    for output in ["pack", "way", "."] {
        let args = ["bake", "pack/recipe.toml", "--force", "-o", output];
        refused(&desk, &args, over);
        let args = [
            "bake",
            "pack/recipe.toml",
            "-o",
            "new",
            "--exr",
            output,
            "--force",
        ];
        refused(&desk, &args, over);
    }
    // What a recipe names is read too.
    fs::create_dir(desk.path("channels")).unwrap();
    desk.write("channels/clouds.photo.png", god_rays());
    desk.write(
        "photo.toml",
        SMALL_RECIPE.to_string() + "[clouds.photo]\nfile = \"channels/clouds.photo.png\"\n",
    );
    let args = [
        "bake",
        "photo.toml",
        "-o",
        "new",
        "--png",
        "channels",
        "--force",
    ];
    refused(&desk, &args, over);
}

#[test]
fn every_output_has_a_place_of_its_own() {
    let desk = Desk::new();
    desk.write("small.toml", SMALL_RECIPE);
    fs::create_dir(desk.path("real")).unwrap();
    symlink("real", desk.path("way")).unwrap();
    for (pack, png, reason) in [
        ("a", "./a", "named twice"),
        ("a", "real/../a", "named twice"),
        ("real/a", "way/a", "named twice"),
        ("real", "way", "named twice"),
        ("p/x", "p", "lies in p"),
        ("p", "p/x", "lies in p"),
        ("way/x", "real", "lies in real"),
    ] {
        let args = ["bake", "small.toml", "-o", pack, "--png", png, "--force"];
        refused(&desk, &args, reason);
        refused(&desk, &args[..6], reason);
    }
    let args = [
        "bake",
        "small.toml",
        "-o",
        "p",
        "--png",
        "q",
        "--exr",
        "q/../q",
    ];
    refused(&desk, &args, "named twice");
    here(&desk, &["bake", "small.toml", "-o", "a", "--png", "ab"]).done();
}

#[test]
fn the_name_of_a_picture_says_png() {
    let desk = Desk::new();
    desk.small_pack();
    desk.write("a.png", god_rays());
    for output in ["t.jpg", "t.tif", "t.exr", "t", "png", ".png", "t.png.txt"] {
        for input in [["photo", "a.png"], ["preview", "pack"]] {
            refused(&desk, &[input[0], input[1], "-o", output], "ends in .png");
        }
    }
    here(&desk, &["preview", "pack", "-o", "t.PNG"]).done();
}

#[test]
fn a_folder_with_some_pack_json_is_no_pack() {
    let desk = Desk::new();
    fs::create_dir(desk.path("app")).unwrap();
    desk.write("app/pack.json", "{}");
    desk.write("small.toml", SMALL_RECIPE);
    let args = ["bake", "small.toml", "--force", "-o", "app"];
    refused(&desk, &args, "not a pack");
    desk.write("app/recipe.toml", SMALL_RECIPE);
    refused(&desk, &args, "not a pack");
}

#[test]
fn what_lies_in_a_pack_is_named_and_kept() {
    let desk = Desk::new();
    let pack = desk.small_pack();
    desk.write("pack/notes.txt", "mine");
    fs::create_dir(pack.join("inner")).unwrap();
    let args = ["bake", "small.toml", "--force", "-o", "pack"];
    refused(&desk, &args, "inner, notes.txt in it");
}

#[test]
fn force_on_a_link_to_a_pack_replaces_the_pack() {
    let desk = Desk::new();
    let pack = desk.small_pack();
    let before = contents(&pack);
    symlink("pack", desk.path("latest")).unwrap();
    let args = [
        "bake",
        "small.toml",
        "--seed",
        "2",
        "--force",
        "-o",
        "latest",
    ];
    here(&desk, &args).done();
    assert!(
        fs::symlink_metadata(desk.path("latest"))
            .unwrap()
            .is_symlink()
    );
    assert!(contents(&pack) != before);
    assert_eq!(desk.names(), ["latest", "pack", "small.toml"]);
}

#[test]
fn litter_of_systems_stands_in_no_way() {
    let desk = Desk::new();
    desk.write("small.toml", SMALL_RECIPE);
    let litter = [
        ".DS_Store",
        "Thumbs.db",
        "desktop.ini",
        "._pack.json",
        ".nfs00000000000000ab",
    ];
    let places = ["pack", "png", "exr", "channels"];
    let drop_litter = || {
        for place in places {
            fs::create_dir_all(desk.path(place)).unwrap();
            for name in litter {
                desk.write(&format!("{place}/{name}"), "");
            }
        }
    };
    let mut args = vec![
        "bake",
        "small.toml",
        "-o",
        "pack",
        "--png",
        "png",
        "--exr",
        "exr",
    ];
    drop_litter();
    here(&desk, &args).done();
    here(&desk, &["unpack", "pack", "-o", "channels"]).done();
    drop_litter();
    args.push("--force");
    here(&desk, &args).done();
    for place in &places[..3] {
        let names = contents(&desk.path(place));
        assert!(litter.iter().all(|name| !names.contains_key(*name)) && names.len() > 8);
    }
}

#[test]
fn a_folder_that_comes_meanwhile_is_kept() {
    for args in [&[][..], &["--force"]] {
        let desk = Desk::new();
        let photo = desk.path("photo.png");
        assert!(
            Command::new("mkfifo")
                .arg(&photo)
                .status()
                .unwrap()
                .success()
        );
        let recipe = SMALL_RECIPE.to_string() + "[clouds.photo]\nfile = \"photo.png\"\n";
        desk.write("small.toml", recipe);
        let mut bake = welkin();
        bake.args(["bake", "small.toml", "-o", "pack", "--png", "png"]);
        bake.args(args).current_dir(desk.path(""));
        let child = bake.stderr(Stdio::piped()).spawn().unwrap();
        // It opens once the bake reads: then the places have been looked at.
        let mut pipe = fs::File::options().write(true).open(&photo).unwrap();
        fs::create_dir(desk.path("png")).unwrap();
        desk.write("png/letter.txt", "dear");
        pipe.write_all(&god_rays()).unwrap();
        drop(pipe);
        let run = Run::from(child.wait_with_output().unwrap());
        run.failed(
            1,
            &["png: ", "choose another folder", "the pack pack is baked"],
        );
        assert_eq!(contents(&desk.path("png")).len(), 1);
        Pack::open(desk.path("pack")).unwrap();
        assert_eq!(desk.names(), ["pack", "photo.png", "png", "small.toml"]);
    }
}

#[test]
fn of_two_at_once_one_makes_the_folder() {
    let desk = Desk::new();
    desk.small_pack();
    for round in 0..3 {
        let place = desk.path(&format!("channels{round}"));
        let both = [(); 2].map(|()| {
            let mut unpack = welkin();
            unpack
                .arg("unpack")
                .arg(desk.path("pack"))
                .arg("-o")
                .arg(&place);
            unpack.stderr(Stdio::piped()).spawn().unwrap()
        });
        let both = both.map(|child| Run::from(child.wait_with_output().unwrap()));
        let (done, failed): (Vec<_>, Vec<_>) = both.into_iter().partition(|r| r.code == Some(0));
        assert_eq!(done.len(), 1, "{failed:?}");
        failed
            .into_iter()
            .for_each(|run| run.failed(1, &["already exists"]));
    }
}

#[test]
fn the_folder_that_the_command_runs_in_is_not_replaced() {
    let desk = Desk::new();
    let pack = desk.small_pack();
    let before = contents(&pack);
    for place in [".", "../pack"] {
        for force in [&[][..], &["--force"]] {
            let mut bake = welkin();
            bake.args(["bake", "-o", place]).args(force);
            run(bake.current_dir(&pack)).failed(1, &[place, "runs in it"]);
        }
    }
    assert_eq!(contents(&pack), before);
}

#[test]
fn what_a_killed_bake_has_left_is_gone_after_the_next() {
    let desk = Desk::new();
    let pack = desk.small_pack();
    let side = ["--png", "png", "--exr", "exr", "--force"];
    let bake = |recipe: &str| {
        let mut bake = welkin();
        bake.args(["bake", recipe, "-o", "pack"]).args(side);
        bake.current_dir(desk.path(""));
        bake
    };
    run(&mut bake("small.toml")).done();
    let before = contents(&pack);
    desk.write("large.toml", "[clouds]\nsize = 2048\n");
    let mut child = bake("large.toml").stderr(Stdio::null()).spawn().unwrap();
    super::interrupt::wait_until_begun(&desk, &mut child);
    child.kill().unwrap();
    child.wait().unwrap();
    assert!(desk.names().iter().any(|name| name.starts_with(".welkin-")));
    assert!(contents(&pack) == before);
    let run = run(&mut bake("small.toml"));
    assert_eq!(run.stderr.lines().count(), 1, "{run:?}");
    run.done();
    assert_eq!(
        desk.names(),
        ["exr", "large.toml", "pack", "png", "small.toml"]
    );
}

/// The system lets a user exchange another's pack in an open folder, but not remove the files in it.
#[test]
#[cfg(target_os = "linux")]
fn an_old_pack_of_another_user_is_named() {
    use std::os::unix::fs::{MetadataExt, PermissionsExt};
    use std::os::unix::process::CommandExt;
    const NOBODY: u32 = 65534;
    let desk = Desk::new();
    desk.small_pack();
    if fs::metadata(desk.path("pack")).unwrap().uid() != 0 {
        return eprintln!("skipped: only root can be somebody else");
    }
    let open = fs::Permissions::from_mode(0o777);
    fs::set_permissions(desk.path(""), open).unwrap();
    let mut bake = welkin();
    bake.args(["bake", "small.toml", "--seed", "2", "--force", "-o", "pack"]);
    bake.current_dir(desk.path("")).uid(NOBODY).gid(NOBODY);
    let run = match bake.output() {
        Ok(output) => Run::from(output),
        Err(error) => return eprintln!("skipped: nobody may not run the program: {error}"),
    };
    assert!(
        run.stderr.contains("cannot be removed: Permission denied")
            && run.stderr.contains(".welkin-"),
        "{run:?}"
    );
    run.done();
    assert_eq!(fs::metadata(desk.path("pack")).unwrap().uid(), NOBODY);
    // Root may.
    here(&desk, &["bake", "small.toml", "--force", "-o", "pack"]).done();
    assert_eq!(desk.names(), ["pack", "small.toml"]);
}

/// What the shell below says if it may not mount.
const NO_MOUNT: i32 = 77;

/// The file system of containers renames no folder of an image's layers, and exchanges none; in a user's own namespace it may rename
/// none at all. So it is tried both ways.
#[test]
#[cfg(target_os = "linux")]
fn on_an_overlay_folders_of_the_lower_layer_are_replaced() {
    for namespace in [&["--mount"][..], &["--map-root-user", "--mount"]] {
        if let Err(reason) = replace_on_an_overlay(namespace) {
            eprintln!("skipped with {namespace:?}: {reason}");
        }
    }
}

/// An error if this machine does not let it be tried.
#[cfg(target_os = "linux")]
fn replace_on_an_overlay(namespace: &[&str]) -> Result<(), String> {
    let desk = Desk::new();
    for folder in ["disk", "pack", "png"] {
        fs::create_dir(desk.path(folder)).unwrap();
    }
    desk.write("small.toml", SMALL_RECIPE);
    let side = ["--png", "png", "--force"];
    here(
        &desk,
        &[&["bake", "small.toml", "-o", "pack"], &side[..]].concat(),
    )
    .done();
    let script = format!(
        "set -e; mount -t tmpfs tmpfs disk || exit {NO_MOUNT}; cd disk; mkdir lower upper work all; \
         cp -r ../pack ../png ../small.toml lower; \
         mount -t overlay -o lowerdir=lower,upperdir=upper,workdir=work overlay all || exit {NO_MOUNT}; \
         cd all; \"$0\" bake small.toml --seed 3 -o new/pack; \"$0\" \"$@\"; ls -A . new >&2; cp -r pack png new ../../made"
    );
    fs::create_dir(desk.path("made")).unwrap();
    let mut shell = Command::new("unshare");
    shell.args(namespace).args(["sh", "-c", &script]);
    shell.arg(env!("CARGO_BIN_EXE_welkin"));
    shell
        .args(["bake", "small.toml", "--seed", "2", "-o", "pack"])
        .args(side);
    let Ok(output) = shell.current_dir(desk.path("")).output() else {
        return Err("there is no program `unshare`".to_string());
    };
    let run = Run::from(output);
    if run.code == Some(NO_MOUNT) || run.stderr.contains("unshare") {
        return Err(format!("no overlay is mounted here: {}", run.stderr));
    }
    let listing = ".:\nnew\npack\npng\nsmall.toml\n\nnew:\npack\n";
    assert!(run.stderr.ends_with(listing), "{namespace:?}: {run:?}");
    run.done();
    let seed = |name: &str| Pack::open(desk.path(name)).unwrap().manifest().seed;
    assert_eq!(["pack", "made/pack", "made/new/pack"].map(seed), [1, 2, 3]);
    let [old, new] = ["png", "made/png"].map(|name| contents(&desk.path(name)));
    assert!(old.keys().eq(new.keys()) && old != new);
    Ok(())
}
