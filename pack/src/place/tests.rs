use super::*;

fn place(path: &Path) -> Place {
    Place::of(path).unwrap()
}

#[test]
fn ways_to_one_place_are_one_place() {
    let desk = tempfile::tempdir().unwrap();
    let at = |path: &str| place(&desk.path().join(path));
    fs::create_dir_all(desk.path().join("a/b")).unwrap();
    fs::write(desk.path().join("a/file"), "").unwrap();
    for way in ["a", "./a", "a/", "a/b/..", "b/../a", "./a/./b/../../a"] {
        assert!(at(way).is_same(&at("a")), "{way}");
    }
    assert!(!at("a").is_same(&at("a/b")) && at("a/b").is_within(&at("a")));
    assert!(!at("a").is_within(&at("a/b")) && !at("ab").is_within(&at("a")));
    // What is not there yet, in folders that are and in folders that are not.
    for way in ["new/pack", "a/../new/pack", "new/./x/../pack"] {
        assert!(at(way).is_same(&at("new/pack")), "{way}");
    }
    assert!(at("new/pack/x").is_within(&at("new")) && !at("new").is_within(&at("new/pack")));
    assert!(!at("new/pack").is_same(&at("a/pack")));
    assert!(!at("a/file").is_same(&at("a/other")));
}

#[cfg(unix)]
#[test]
fn links_are_followed_to_what_is_there_and_to_what_is_not() {
    use std::os::unix::fs::symlink;
    let desk = tempfile::tempdir().unwrap();
    let path = |name: &str| desk.path().join(name);
    let at = |name: &str| place(&path(name));
    fs::create_dir(path("real")).unwrap();
    fs::write(path("real/photo"), "").unwrap();
    symlink("real", path("link")).unwrap();
    symlink(path("link/later"), path("dangling")).unwrap();
    symlink("round", path("round")).unwrap();
    fs::hard_link(path("real/photo"), path("twin")).unwrap();
    assert!(at("link").is_same(&at("real")) && at("link/new").is_within(&at("real")));
    assert!(at("link/..").is_same(&place(desk.path())));
    assert!(at("dangling").is_same(&at("real/later")));
    assert_eq!(
        at("dangling/x").path(),
        fs::canonicalize(path("real")).unwrap().join("later/x")
    );
    assert!(at("twin").is_same(&at("real/photo")));
    assert!(Place::of(&path("round")).is_err());
}

#[test]
fn case_counts_where_the_file_system_says_so() {
    let desk = tempfile::tempdir().unwrap();
    fs::create_dir(desk.path().join("a")).unwrap();
    let is_one = desk.path().join("A").exists();
    let at = |name: &str| place(&desk.path().join(name));
    assert_eq!(at("A").is_same(&at("a")), is_one);
    assert_eq!(at("New/Pack").is_same(&at("new/pack")), is_one);
    assert_eq!(ignores_case(desk.path()), is_one);
    assert_eq!(fs::read_dir(desk.path()).unwrap().count(), 1);
    // Where nothing can be tried, names count as one.
    assert!(ignores_case(&desk.path().join("none")));
}

#[test]
fn inputs_and_outputs_lie_apart() {
    let desk = tempfile::tempdir().unwrap();
    let path = |name: &str| desk.path().join(name);
    fs::create_dir(path("pack")).unwrap();
    fs::write(path("pack/pack.json"), "").unwrap();
    fs::write(path("photo.png"), "").unwrap();
    let verify = |inputs: &[&str], outputs: &[&str]| {
        let [inputs, outputs]: [Vec<PathBuf>; 2] =
            [inputs, outputs].map(|names| names.iter().map(|name| path(name)).collect());
        let [inputs, outputs] =
            [&inputs, &outputs].map(|p| p.iter().map(PathBuf::as_path).collect::<Vec<_>>());
        verify_apart(&inputs, &outputs)
    };
    verify(&["pack", "none"], &["sheet.png", "new/a", "new/b"]).unwrap();
    use WriteError::{IntoInput, Nested, OverInput, Twice};
    let over = verify(&["photo.png"], &["./pack/../photo.png"]);
    assert!(matches!(over, Err(OverInput { .. })));
    let holds = verify(&["pack/pack.json"], &["pack"]);
    assert!(matches!(holds, Err(OverInput { .. })));
    let into = verify(&["pack"], &["pack/pack.json"]);
    assert!(matches!(into, Err(IntoInput { .. })));
    let twice = verify(&[], &["new", "pack/../new"]);
    assert!(matches!(twice, Err(Twice { .. })));
    for outputs in [["new", "new/x"], ["new/x", "new"]] {
        let nested = verify(&[], &outputs).unwrap_err();
        let wanted = [path("new/x"), path("new")].map(|p| p.display().to_string());
        assert!(
            matches!(&nested, Nested { file, other } if [file, other] == [&wanted[0], &wanted[1]]),
            "{nested}"
        );
    }
}
