use std::path::{Path, PathBuf};

use super::put::{move_files, replace_by_copying, replace_in_two_steps};
use super::*;

fn ours(name: &str) -> bool {
    ["a", "b", "c"].contains(&name)
}

const OURS: Option<IsOurs> = Some(ours);

fn never() -> bool {
    false
}

/// A folder `sky` of two files with this text, begun.
fn begun(place: &Path, text: &str, ours: Option<IsOurs>) -> Folder {
    let folder = Folder::begin(place, ours).unwrap();
    folder.add("a", text.as_bytes()).unwrap();
    folder.add("b", text.as_bytes()).unwrap();
    folder
}

fn names(folder: &Path) -> Vec<String> {
    let entries = fs::read_dir(folder).unwrap();
    let mut names: Vec<_> = entries
        .map(|e| e.unwrap().file_name().to_string_lossy().into_owned())
        .collect();
    names.sort();
    names
}

fn text(file: &Path) -> String {
    fs::read_to_string(file).unwrap()
}

/// A temporary folder, and a place in it.
fn desk() -> (tempfile::TempDir, PathBuf) {
    let desk = tempfile::tempdir().unwrap();
    let place = desk.path().join("sky");
    (desk, place)
}

#[test]
fn a_folder_is_made_and_one_of_ours_is_replaced_whole() {
    let (desk, place) = desk();
    begun(&place, "old", None).publish().unwrap();
    fs::write(place.join("c"), "older").unwrap();
    assert_eq!(begun(&place, "new", OURS).publish().unwrap(), []);
    assert_eq!(
        (names(&place), text(&place.join("a"))),
        (vec!["a".into(), "b".into()], "new".into())
    );
    assert_eq!(names(desk.path()), ["sky"]);
}

#[test]
fn what_is_not_ours_stays() {
    let (desk, place) = desk();
    fs::create_dir(&place).unwrap();
    fs::write(place.join("letter"), "dear").unwrap();
    let error = Folder::begin(&place, OURS).unwrap_err().to_string();
    assert!(
        error.contains("letter in it is none of the files"),
        "{error}"
    );
    assert!(matches!(
        Folder::begin(&place, None),
        Err(WriteError::Exists { .. })
    ));
    fs::rename(place.join("letter"), place.join("a")).unwrap();
    assert!(matches!(
        Folder::begin(&place, None),
        Err(WriteError::Exists { .. })
    ));
    // A folder of a name of ours is none of our files.
    fs::remove_file(place.join("a")).unwrap();
    fs::create_dir(place.join("a")).unwrap();
    assert!(matches!(
        Folder::begin(&place, OURS),
        Err(WriteError::NotOurs { .. })
    ));
    let file = desk.path().join("file");
    fs::write(&file, "old").unwrap();
    assert!(matches!(
        Folder::begin(&file, OURS),
        Err(WriteError::NotAFolder { .. })
    ));
    assert!(matches!(
        Folder::begin(&desk.path().join("none/sky"), OURS),
        Err(WriteError::Failed { .. })
    ));
    assert_eq!(text(&file), "old");
    assert_eq!(names(desk.path()), ["file", "sky"]);
}

#[test]
fn what_comes_meanwhile_stays() {
    for (ours, name) in [(None, "a"), (OURS, "letter")] {
        for was_there in [false, true] {
            let (desk, place) = desk();
            if was_there {
                fs::create_dir(&place).unwrap();
            }
            let folder = begun(&place, "new", ours);
            fs::create_dir_all(&place).unwrap();
            fs::write(place.join(name), "mine").unwrap();
            let error = folder.publish().unwrap_err();
            assert!(
                matches!(
                    error,
                    WriteError::Exists { .. } | WriteError::NotOurs { .. }
                ),
                "{error}"
            );
            assert_eq!(
                (names(&place), text(&place.join(name))),
                (vec![name.into()], "mine".into())
            );
            assert_eq!(names(desk.path()), ["sky"]);
        }
    }
    let (_desk, place) = desk();
    let folder = begun(&place, "new", OURS);
    fs::write(&place, "mine").unwrap();
    assert!(matches!(
        folder.publish(),
        Err(WriteError::NotAFolder { .. })
    ));
    assert_eq!(text(&place), "mine");
}

#[test]
fn of_many_at_once_one_makes_the_folder() {
    for was_there in [false, true] {
        let (desk, place) = desk();
        if was_there {
            fs::create_dir(&place).unwrap();
        }
        let folders: Vec<_> = (0..8)
            .map(|i| begun(&place, &i.to_string(), None))
            .collect();
        let done: Vec<bool> = std::thread::scope(|scope| {
            let threads: Vec<_> = folders
                .into_iter()
                .map(|folder| scope.spawn(|| folder.publish().is_ok()))
                .collect();
            threads.into_iter().map(|t| t.join().unwrap()).collect()
        });
        assert_eq!(done.iter().filter(|done| **done).count(), 1);
        let winner = done.iter().position(|done| *done).unwrap().to_string();
        assert_eq!(
            [text(&place.join("a")), text(&place.join("b"))],
            [winner.clone(), winner]
        );
        assert_eq!(names(desk.path()), ["sky"]);
    }
}

#[test]
#[cfg(target_os = "linux")]
fn a_folder_that_is_replaced_is_never_missing() {
    use std::sync::atomic::{AtomicBool, Ordering};
    let (_desk, place) = desk();
    begun(&place, "old", None).publish().unwrap();
    let is_over = AtomicBool::new(false);
    std::thread::scope(|scope| {
        let seen = scope.spawn(|| {
            let mut is_there = true;
            while !is_over.load(Ordering::Relaxed) {
                is_there &= fs::symlink_metadata(&place).is_ok();
            }
            is_there
        });
        for round in 0..200 {
            begun(&place, &round.to_string(), OURS).publish().unwrap();
        }
        is_over.store(true, Ordering::Relaxed);
        assert!(seen.join().unwrap());
    });
}

#[test]
fn litter_stands_in_no_way() {
    for litter in [
        ".DS_Store",
        "Thumbs.db",
        "desktop.ini",
        "Desktop.ini",
        "._a",
        ".nfs0000000000000001",
    ] {
        for ours in [None, OURS] {
            let (desk, place) = desk();
            fs::create_dir(&place).unwrap();
            fs::write(place.join(litter), "").unwrap();
            begun(&place, "new", ours).publish().unwrap();
            assert_eq!(names(&place), ["a", "b"]);
            fs::write(place.join(litter), "").unwrap();
            assert!(others_in(&place, self::ours).unwrap().is_empty());
            begun(&place, "newer", OURS).publish().unwrap();
            assert_eq!(names(&place), ["a", "b"]);
            assert_eq!(names(desk.path()), ["sky"]);
        }
        let (_desk, place) = desk();
        fs::create_dir_all(place.join(litter)).unwrap();
        assert!(Folder::begin(&place, OURS).is_err(), "a folder {litter}");
    }
}

#[test]
fn without_an_exchange_a_folder_is_replaced_all_the_same_or_kept() {
    let ways = [replace_in_two_steps, replace_by_copying];
    for replace in ways {
        for fails in [false, true] {
            let (desk, place) = desk();
            begun(&place, "old", None).publish().unwrap();
            let new = begun(&place, "new", OURS);
            let verify = |old: &Path| {
                assert_eq!(text(&old.join("b")), "old");
                if fails {
                    Err(WriteError::Cancelled)
                } else {
                    Ok(())
                }
            };
            assert_eq!(replace(&place, &new.temporary, &verify).is_err(), fails);
            drop(new);
            let wanted = if fails { "old" } else { "new" };
            assert_eq!(
                [text(&place.join("a")), text(&place.join("b"))],
                [wanted, wanted]
            );
            assert_eq!(names(desk.path()), ["sky"]);
        }
    }
}

#[test]
fn a_copy_that_cannot_take_the_place_is_put_back() {
    let (desk, place) = desk();
    begun(&place, "old", None).publish().unwrap();
    let new = begun(&place, "new", OURS);
    // Something comes after the copy was looked at, so that the folder is not empty when its turn comes.
    let verify = |_: &Path| {
        fs::write(place.join("letter"), "mine").unwrap();
        Ok(())
    };
    assert!(replace_by_copying(&place, &new.temporary, &verify).is_err());
    drop(new);
    assert_eq!(names(&place), ["a", "b", "letter"]);
    assert_eq!(text(&place.join("a")), "old");
    assert_eq!(names(desk.path()), ["sky"]);
}

#[test]
fn files_are_moved_all_or_none() {
    let (desk, place) = desk();
    begun(&place, "new", None).publish().unwrap();
    let to = desk.path().join("to");
    fs::create_dir(&to).unwrap();
    for name in ["a", "b"] {
        fs::write(to.join(name), "mine").unwrap();
        assert!(move_files(&place, &to).is_err());
        assert_eq!(
            (names(&place), names(&to)),
            (vec!["a".into(), "b".into()], vec![name.into()])
        );
        assert_eq!(
            [text(&place.join(name)), text(&to.join(name))],
            ["new", "mine"]
        );
        fs::remove_file(to.join(name)).unwrap();
    }
    move_files(&place, &to).unwrap();
    assert_eq!(
        (names(desk.path()), names(&to)),
        (vec!["to".into()], vec!["a".into(), "b".into()])
    );
}

#[test]
fn what_a_killed_run_has_left_is_swept_and_what_a_living_one_has_is_not() {
    let (desk, place) = desk();
    let living = begun(&place, "new", None);
    let at = |name: &str| desk.path().join(name);
    // A lock that nobody holds, as after a kill, with what was made under its name.
    for (index, kinds) in [&[""][..], &["", ".copy"], &[".old"], &[]]
        .iter()
        .enumerate()
    {
        fs::write(at(&format!(".welkin-dead0{index}.lock")), "sky").unwrap();
        for kind in *kinds {
            let folder = at(&format!(".welkin-dead0{index}{kind}"));
            fs::create_dir(&folder).unwrap();
            fs::write(folder.join("a"), "").unwrap();
        }
    }
    fs::write(at(".welkin-dead10"), "a file in the making").unwrap();
    fs::write(at(".welkin-dead10.lock"), "").unwrap();
    fs::write(at(".welkin-notes"), "somebody's").unwrap();
    fs::write(at(".welkin-a.b.lock"), "somebody's").unwrap();
    assert_eq!(sweep(desk.path()), []);
    let stem = living.temporary.new_path().to_path_buf();
    let lock = stem.with_extension("lock");
    let mine = [&stem, &lock].map(|p| p.file_name().unwrap().to_str().unwrap().to_string());
    let mut wanted = [
        &mine[..],
        &[".welkin-a.b.lock".into(), ".welkin-notes".into()],
    ]
    .concat();
    wanted.sort();
    assert_eq!(names(desk.path()), wanted);
    living.publish().unwrap();
    assert_eq!(
        names(desk.path()),
        [".welkin-a.b.lock", ".welkin-notes", "sky"]
    );
}

#[test]
fn what_must_not_be_swept_is_told() {
    let (desk, place) = desk();
    let at = |name: &str| desk.path().join(name);
    // Of a run that was killed between two renames: the only copy of an old folder.
    fs::write(at(".welkin-killed.lock"), place.display().to_string()).unwrap();
    fs::create_dir(at(".welkin-killed")).unwrap();
    fs::create_dir(at(".welkin-killed.old")).unwrap();
    // Of a version that had no locks.
    fs::create_dir(at(".welkin-older0")).unwrap();
    let before = names(desk.path());
    let told = begun(&place, "new", None).publish().unwrap();
    assert_eq!(
        told.iter().map(|l| l.path.clone()).collect::<Vec<_>>(),
        [at(".welkin-killed.old"), at(".welkin-older0")]
    );
    assert!(
        told[0]
            .to_string()
            .contains("sky when a run that replaced it was stopped"),
        "{told:?}"
    );
    // Once it is moved back, the rest is no longer needed.
    fs::rename(at(".welkin-killed.old"), at("back")).unwrap();
    assert_eq!(sweep(desk.path()).len(), 1);
    assert_eq!(names(desk.path()), [".welkin-older0", "back", "sky"]);
    assert!(before.len() == 4);
}

#[test]
fn a_file_is_replaced_whole_and_errors_name_it() {
    let (desk, file) = desk();
    write_file(&file, b"old", &never).unwrap();
    write_file(&file, b"new", &never).unwrap();
    assert_eq!(text(&file), "new");
    assert!(matches!(
        write_file(&file, b"newer", &|| true),
        Err(WriteError::Cancelled)
    ));
    assert!(matches!(
        write_file(desk.path(), b"", &never),
        Err(WriteError::NotAFile { .. })
    ));
    let below = file.join("below");
    let error = write_file(&below, b"", &never).unwrap_err().to_string();
    assert!(
        error.starts_with(&format!("{}: cannot be written", below.display())),
        "{error}"
    );
    assert_eq!(
        (names(desk.path()), text(&file)),
        (vec!["sky".into()], "new".into())
    );
}

#[test]
fn files_that_belong_together_are_written_together() {
    let (desk, sky) = desk();
    let light = desk.path().join("light");
    write_files(&[(&sky, b"old"), (&light, b"old")], &never).unwrap();
    write_files(&[(&sky, b"new"), (&light, b"new")], &never).unwrap();
    let nowhere = light.join("below");
    for second in [&nowhere, desk.path()] {
        assert!(write_files(&[(&sky, b"newer"), (second, b"newer")], &never).is_err());
    }
    assert!(write_files(&[(&sky, b"newer"), (&light, b"newer")], &|| true).is_err());
    assert_eq!([&sky, &light].map(|file| text(file)), ["new", "new"]);
    assert_eq!(names(desk.path()), ["light", "sky"]);
}

#[cfg(unix)]
#[test]
fn a_link_to_a_file_stays_a_link() {
    let (desk, file) = desk();
    let link = desk.path().join("link");
    std::os::unix::fs::symlink("sky", &link).unwrap();
    for text in ["old", "new"] {
        write_file(&link, text.as_bytes(), &never).unwrap();
        assert_eq!(self::text(&file), text);
    }
    assert!(fs::symlink_metadata(&link).unwrap().is_symlink());
    assert!(matches!(
        write_file(Path::new("/dev/null"), b"", &never),
        Err(WriteError::NotAFile { .. })
    ));
}

#[test]
fn a_folder_that_the_program_runs_in_is_not_replaced() {
    // Tests run in the folder of their crate.
    let here = std::env::current_dir().unwrap();
    for place in [
        Path::new("."),
        &here,
        here.parent().unwrap(),
        Path::new("src/.."),
    ] {
        let verified = verify_folder(place, None);
        assert!(
            matches!(verified, Err(WriteError::InUse { .. })),
            "{}: {verified:?}",
            place.display()
        );
    }
}
