//! Files import from lower floors only, in no circle and never from their crate's root: floors.txt of each crate says which room is on which floor.

#![allow(clippy::unwrap_used, reason = "a test may stop where it fails")]

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::Path;

const WORKSPACE: &str = include_str!("../../../Cargo.toml");

/// Texts of files by their module's path, such as `clouds::lit`; the crate's root is empty.
type Files = BTreeMap<String, String>;

#[test]
fn imports_lead_downwards_and_in_no_circle() {
    let mut found = BTreeSet::new();
    for name in crates() {
        let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("..").join(name);
        let mut files = Files::new();
        read(&folder.join("src"), "", &mut files);
        let floors = fs::read_to_string(folder.join("floors.txt")).expect(name);
        let faults = faults(&files, &floors).into_iter();
        found.extend(faults.map(|fault| format!("{name}: {fault}")));
    }
    assert!(found.is_empty(), "{found:#?}");
}

#[test]
fn the_walk_finds_the_files() {
    for (name, least) in [("runtime", 50), ("pack", 60), ("baker", 100)] {
        let source = Path::new(env!("CARGO_MANIFEST_DIR")).join("..").join(name);
        let mut files = Files::new();
        read(&source.join("src"), "", &mut files);
        assert!(files.len() > least, "{name}: {}", files.len());
    }
    assert!(crates().contains(&"web/glue"), "{:?}", crates());
}

#[test]
fn planted_circles_and_upward_imports_are_found() {
    let floors = "# from the ground up\nlow also_low\nhigh";
    let found = |pairs: &[(&str, &str)]| {
        let mut files = Files::from(["low", "also_low", "high"].map(|m| (m.into(), "".into())));
        files.extend(pairs.iter().map(|(m, t)| (m.to_string(), t.to_string())));
        faults(&files, floors)
    };
    let low = ("low", "pub fn f() {}");
    assert!(found(&[low, ("high", "use crate::low::f;")]).is_empty());
    assert!(found(&[low, ("also_low", "use crate::low;")]).is_empty());
    // Comments and tests may look anywhere.
    let free = "// use crate::high;\n#[cfg(test)]\nmod tests {\n    use crate::high;\n}\n";
    assert!(found(&[("low", free), ("high", "use crate::low;")]).is_empty());
    let apart = [
        ("low", "#[cfg(test)]\n#[cfg(unix)]\nmod tests;\n"),
        ("low::tests", "use crate::high;"),
    ];
    assert!(found(&apart).is_empty());
    let up = found(&[("low", "use crate::high::g;")]);
    assert_eq!(up, ["low imports high, which is on a higher floor"]);
    let inline = found(&[("low", "fn f() { crate::high::g() }")]);
    assert_eq!(inline, up);
    let below_tests = found(&[("low", "#[cfg(test)]\nmod tests;\n\nuse crate::high::g;")]);
    assert_eq!(below_tests, up);
    let siblings = "use super::{\n    b::{B, C},\n};";
    let circle = found(&[
        ("low", "mod a; mod b; use a::A;"),
        ("low::a", siblings),
        ("low::b", "use crate::low::{a::A};"),
        ("high", "use crate::low::a::A;"),
    ]);
    assert_eq!(circle, ["low::a, low::b import each other"]);
    let parent = found(&[
        ("low", "mod a; fn f() { a::g() }"),
        ("low::a", "use super::h;"),
    ]);
    assert_eq!(parent, ["low, low::a import each other"]);
    let through_a_module = found(&[
        ("low", "use crate::also_low; fn f() { also_low::a::g() }"),
        ("also_low::a", "use crate::low::f;"),
    ]);
    assert_eq!(through_a_module, ["also_low::a, low import each other"]);
    let root = found(&[("low", "use crate::{Sky};")]);
    assert_eq!(root, ["low imports from the crate's root"]);
    let lost = found(&[("attic", "")]);
    assert_eq!(lost, ["attic is on no floor"]);
    let missing = faults(&Files::from([("low".into(), "".into())]), "low\ncellar");
    assert_eq!(missing, ["cellar is on a floor, but there is no such room"]);
}

/// The folders of the workspace's crates.
fn crates() -> Vec<&'static str> {
    let line = WORKSPACE.lines().find(|line| line.starts_with("members"));
    line.unwrap().split('"').skip(1).step_by(2).collect()
}

fn read(folder: &Path, module: &str, files: &mut Files) {
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        let name = path.file_stem().unwrap().to_str().unwrap();
        let inner = match (module, name) {
            (_, "mod") => module.to_string(),
            ("", "lib" | "main") => String::new(),
            ("", _) => name.to_string(),
            _ => format!("{module}::{name}"),
        };
        if path.is_dir() {
            read(&path, &inner, files);
        } else if path.extension().is_some_and(|e| e == "rs") {
            let text = fs::read_to_string(&path).unwrap();
            files.entry(inner).or_default().push_str(&text);
        }
    }
}

/// Every import that goes up, and every set of files that import each other.
fn faults(files: &Files, floors: &str) -> Vec<String> {
    let tests = test_modules(files);
    let is_test = |module: &str| {
        let is_in = |test: &String| module == test || module.starts_with(&format!("{test}::"));
        tests.iter().any(is_in)
    };
    let rooms: Vec<Vec<&str>> = floors
        .lines()
        .filter(|line| !line.starts_with('#'))
        .map(|line| line.split_whitespace().collect())
        .collect();
    let room = |module: &str| module.split("::").next().unwrap().to_string();
    let floor = |module: &str| {
        let room = room(module);
        rooms.iter().position(|floor| floor.contains(&&*room))
    };
    let mut imports = BTreeMap::new();
    let mut faults = Vec::new();
    let there: BTreeSet<String> = files.keys().map(|module| room(module)).collect();
    for missing in rooms
        .iter()
        .flatten()
        .filter(|room| !there.contains(**room))
    {
        faults.push(format!(
            "{missing} is on a floor, but there is no such room"
        ));
    }
    for (module, text) in files {
        if module.is_empty() || is_test(module) {
            continue;
        }
        let targets = imported(module, text, files);
        let Some(own) = floor(module) else {
            faults.push(format!("{module} is on no floor"));
            continue;
        };
        for target in &targets {
            if target.is_empty() {
                faults.push(format!("{module} imports from the crate's root"));
            } else if floor(target).is_none_or(|other| other > own) {
                faults.push(format!(
                    "{module} imports {target}, which is on a higher floor"
                ));
            }
        }
        imports.insert(module.as_str(), targets);
    }
    let circles = circles(&imports).into_iter();
    faults.extend(circles.map(|circle| format!("{} import each other", circle.join(", "))));
    faults
}

/// Sets of modules each of which leads to every other.
fn circles<'a>(imports: &BTreeMap<&'a str, BTreeSet<String>>) -> Vec<Vec<&'a str>> {
    let reached = |from: &str| {
        let mut reached = BTreeSet::new();
        let mut next = vec![from];
        while let Some(module) = next.pop() {
            let targets = imports.get(module).into_iter().flatten();
            next.extend(targets.filter_map(|t| reached.insert(t.as_str()).then_some(t.as_str())));
        }
        reached
    };
    let all: BTreeMap<&str, BTreeSet<&str>> = imports.keys().map(|m| (*m, reached(m))).collect();
    let circle = |module: &&'a str| {
        let both =
            |other: &&&'a str| all[*module].contains(**other) && all[**other].contains(*module);
        imports.keys().filter(both).copied().collect::<Vec<_>>()
    };
    let circles: BTreeSet<Vec<&str>> = imports.keys().map(circle).collect();
    circles
        .into_iter()
        .filter(|circle| !circle.is_empty())
        .collect()
}

/// Modules in files of their own that are compiled for tests alone.
fn test_modules(files: &Files) -> BTreeSet<String> {
    let mut tests = BTreeSet::new();
    for (module, text) in files {
        for (declaration, _) in test_declarations(text) {
            if let Some(name) = declaration.strip_suffix(';') {
                tests.insert(
                    format!("{module}::{name}")
                        .trim_start_matches(':')
                        .to_string(),
                );
            }
        }
    }
    tests
}

/// What stands after `mod` under `#[cfg(test)]`, and where the attribute is.
fn test_declarations(text: &str) -> impl Iterator<Item = (&str, usize)> {
    let starts = text.match_indices("#[cfg(").map(|(at, _)| at);
    let starts = starts.filter(|at| {
        let condition = &text[at + "#[cfg(".len()..];
        condition.starts_with("test)") || condition.starts_with("all(test,")
    });
    starts.filter_map(|at| {
        let mut lines = text[at..].lines().map(str::trim);
        let line = lines.find(|line| !line.starts_with("#["))?;
        let (visibility, name) = line.split_once("mod ")?;
        (visibility.is_empty() || visibility.starts_with("pub")).then_some((name, at))
    })
}

/// The modules that a file imports, but for itself.
fn imported(module: &str, text: &str, files: &Files) -> BTreeSet<String> {
    let tests = test_declarations(text).find(|(declaration, _)| declaration.ends_with('{'));
    let product = tests.map_or(text, |(_, at)| &text[..at]);
    let code: String = product
        .lines()
        .map(|line| line.split("//").next().unwrap().trim())
        .collect::<Vec<_>>()
        .join(" ");
    let mut paths = Vec::new();
    for statement in code.split("use ").skip(1) {
        expand("", statement.split(';').next().unwrap(), &mut paths);
    }
    let names = module_names(module, &paths, files);
    let is_path = |c: char| c.is_alphanumeric() || "_:".contains(c);
    for path in code.replace("::<", "<").split(|c| !is_path(c)) {
        match path.split_once("::") {
            // The beginning of a tree.
            _ if path.ends_with("::") => {}
            Some(("crate" | "super", _)) => paths.push(path.to_string()),
            Some((first, rest)) => {
                let inside = names
                    .get(first)
                    .map(|name| format!("crate::{name}::{rest}"));
                paths.extend(inside);
            }
            None => {}
        }
    }
    let found = paths.iter().filter_map(|path| resolve(module, path, files));
    found.filter(|target| target != module).collect()
}

/// The modules by the names that a file has for them: those in it and those that it imports.
fn module_names(module: &str, paths: &[String], files: &Files) -> BTreeMap<String, String> {
    let inner = |path: &String| {
        path.strip_prefix(module)?
            .strip_prefix("::")
            .map(String::from)
    };
    let own = files
        .keys()
        .filter_map(|path| Some((inner(path)?, path.clone())));
    let mut names: BTreeMap<_, _> = own.filter(|(name, _)| !name.contains("::")).collect();
    for path in paths {
        let (whole, alias) = path.split_once(" as ").unwrap_or((path, ""));
        let last = whole
            .trim_end_matches("::self")
            .rsplit("::")
            .next()
            .unwrap();
        let target = resolve(module, whole, files).unwrap_or_default();
        if target.rsplit("::").next() == Some(last) {
            let name = if alias.is_empty() { last } else { alias };
            names.insert(name.to_string(), target);
        }
    }
    names
}

/// The paths of a `use` tree.
fn expand(before: &str, tree: &str, paths: &mut Vec<String>) {
    let Some((head, rest)) = tree.split_once('{') else {
        if !tree.trim().is_empty() {
            paths.push(format!("{before}{}", tree.trim()));
        }
        return;
    };
    let before = format!("{before}{}", head.trim());
    let (mut depth, mut item) = (0, String::new());
    for c in rest.chars() {
        match c {
            '{' => depth += 1,
            '}' if depth == 0 => break,
            '}' => depth -= 1,
            ',' if depth == 0 => {
                expand(&before, &std::mem::take(&mut item), paths);
                continue;
            }
            _ => {}
        }
        item.push(c);
    }
    expand(&before, &item, paths);
}

/// The file that a path leads to, if it is in this crate.
fn resolve(module: &str, path: &str, files: &Files) -> Option<String> {
    let path = path.split(" as ").next()?;
    let mut base: Vec<&str> = module.split("::").collect();
    let mut parts: Vec<&str> = path.split("::").map(str::trim).collect();
    match parts[0] {
        "crate" => base.clear(),
        "super" => {}
        "self" => {}
        first => {
            let child = format!("{module}::{first}");
            files.contains_key(&child).then_some(())?;
        }
    }
    while let Some(first @ ("crate" | "super" | "self")) = parts.first().copied() {
        if first == "super" {
            base.pop();
        }
        parts.remove(0);
    }
    base.extend(parts.into_iter().filter(|part| !part.is_empty()));
    while !base.is_empty() {
        let target = base.join("::");
        if files.contains_key(&target) {
            return Some(target);
        }
        base.pop();
    }
    // A name of the crate's root.
    path.starts_with("crate::").then(String::new)
}
