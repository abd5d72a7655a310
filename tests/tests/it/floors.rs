//! The runtime's files import from lower floors only, and in no circle: runtime/floors.txt says which room is on which floor.

#![allow(clippy::unwrap_used, reason = "a test may stop where it fails")]

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::Path;

/// What a room's name is looked up in.
const FLOORS: &str = include_str!("../../../runtime/floors.txt");

/// Texts of files by their module's path, such as `clouds::lit`; the crate's root is empty.
type Files = BTreeMap<String, String>;

#[test]
fn imports_lead_downwards_and_in_no_circle() {
    let mut files = Files::new();
    let source = Path::new(env!("CARGO_MANIFEST_DIR")).join("../runtime/src");
    read(&source, "", &mut files);
    assert!(files.len() > 50, "{}", files.len());
    let faults = faults(&files, FLOORS);
    assert!(faults.is_empty(), "{faults:#?}");
}

#[test]
fn planted_circles_and_upward_imports_are_found() {
    let floors = "# from the ground up\nlow also_low\nhigh";
    let found = |pairs: &[(&str, &str)]| {
        let owned = pairs.iter().map(|(m, t)| (m.to_string(), t.to_string()));
        faults(&owned.collect(), floors)
    };
    let low = ("low", "pub fn f() {}");
    assert!(found(&[low, ("high", "use crate::low::f;")]).is_empty());
    assert!(found(&[low, ("also_low", "use crate::low;")]).is_empty());
    // Comments and tests may look anywhere.
    let free = "// use crate::high;\n#[cfg(test)]\nmod tests {\n    use crate::high;\n}\n";
    assert!(found(&[("low", free), ("high", "use crate::low;")]).is_empty());
    let up = found(&[("low", "use crate::high::g;"), ("high", "")]);
    assert_eq!(up, ["low imports high, which is on a higher floor"]);
    let inline = found(&[("low", "fn f() { crate::high::g() }"), ("high", "")]);
    assert_eq!(inline, up);
    let circle = found(&[
        ("low", "mod a; mod b;"),
        ("low::a", "use super::{b::{B, C}};"),
        ("low::b", "use crate::low::a::A;"),
    ]);
    assert_eq!(circle, ["low::a, low::b import each other"]);
    let root = found(&[("low", "use crate::{Sky};")]);
    assert_eq!(root, ["low imports from the crate's root"]);
    let lost = found(&[("attic", "")]);
    assert_eq!(lost, ["attic is on no floor"]);
}

fn read(folder: &Path, module: &str, files: &mut Files) {
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        let name = path.file_stem().unwrap().to_str().unwrap();
        let inner = match (module, name) {
            (_, "mod") => module.to_string(),
            ("", "lib") => String::new(),
            ("", _) => name.to_string(),
            _ => format!("{module}::{name}"),
        };
        if path.is_dir() {
            read(&path, &inner, files);
        } else if path.extension().is_some_and(|e| e == "rs") {
            files.insert(inner, fs::read_to_string(&path).unwrap());
        }
    }
}

/// Every import that goes up, and every set of files that import each other.
fn faults(files: &Files, floors: &str) -> Vec<String> {
    let rooms: Vec<Vec<&str>> = floors
        .lines()
        .filter(|line| !line.starts_with('#'))
        .map(|line| line.split_whitespace().collect())
        .collect();
    let floor = |module: &str| {
        let room = module.split("::").next().unwrap();
        rooms.iter().position(|floor| floor.contains(&room))
    };
    let mut imports = BTreeMap::new();
    let mut faults = Vec::new();
    for (module, text) in files.iter().filter(|(module, _)| !module.is_empty()) {
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
    // Who imports nothing that is left can be in no circle.
    while let Some(free) = imports
        .iter()
        .find(|(_, targets)| !targets.iter().any(|t| imports.contains_key(t.as_str())))
        .map(|(module, _)| *module)
    {
        imports.remove(free);
    }
    if !imports.is_empty() {
        let round: Vec<&str> = imports.into_keys().collect();
        faults.push(format!("{} import each other", round.join(", ")));
    }
    faults
}

/// The modules that a file imports, but for itself.
fn imported(module: &str, text: &str, files: &Files) -> BTreeSet<String> {
    let product = text.split("#[cfg(test)]\nmod ").next().unwrap();
    let code: String = product
        .lines()
        .map(|line| line.split("//").next().unwrap().trim())
        .collect::<Vec<_>>()
        .join(" ");
    let mut paths = Vec::new();
    for statement in code.split("use ").skip(1) {
        expand("", statement.split(';').next().unwrap(), &mut paths);
    }
    for start in ["crate::", "super::"] {
        for (at, _) in code.match_indices(start) {
            let is_path = |c: char| c.is_alphanumeric() || "_:".contains(c);
            let end = code[at..].find(|c| !is_path(c)).unwrap_or(code.len() - at);
            paths.push(code[at..at + end].to_string());
        }
    }
    let found = paths.iter().filter_map(|path| resolve(module, path, files));
    found.filter(|target| target != module).collect()
}

/// The paths of a `use` tree.
fn expand(before: &str, tree: &str, paths: &mut Vec<String>) {
    let Some((head, rest)) = tree.split_once('{') else {
        paths.push(format!("{before}{}", tree.trim()));
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
    // A name of the crate's root; `crate::` alone is the beginning of a tree.
    (path.starts_with("crate::") && path != "crate::").then(String::new)
}
