//! docs/papers.md is true of the code: every file and every name in it that the table names is there.

#![allow(clippy::unwrap_used, reason = "a test may stop where it fails")]

use std::collections::BTreeMap;
use std::path::Path;

/// The papers, as the table calls them, and how few sentences of each would be too few.
const PAPERS: [(&str, usize); 5] = [
    ("Roden", 25),
    ("USC", 20),
    ("Mukhina", 25),
    ("Wang", 40),
    ("Quilez", 15),
];

/// A sentence of a paper.
#[derive(Debug)]
struct Row<'a> {
    paper: &'a str,
    says: &'a str,
    /// Files, each with names in it.
    places: Vec<(&'a str, Vec<&'a str>)>,
    verdict: &'a str,
}

/// The rows of the table.
fn rows(text: &str) -> Result<Vec<Row<'_>>, String> {
    let lines = text.lines().filter(|line| line.starts_with("| "));
    let rows = lines.skip(1).map(row);
    rows.collect()
}

fn row(line: &str) -> Result<Row<'_>, String> {
    let cells: Vec<&str> = line.trim_matches('|').split(" | ").map(str::trim).collect();
    let [paper, says, code, verdict] = cells[..] else {
        return Err(format!("{line}: expected four cells"));
    };
    let mut places: Vec<(&str, Vec<&str>)> = Vec::new();
    for name in code.split('`').skip(1).step_by(2) {
        match places.last_mut() {
            _ if name.contains('/') => places.push((name, Vec::new())),
            Some((_, names)) => names.push(name),
            None => return Err(format!("{says}: `{name}` stands before any file")),
        }
    }
    Ok(Row {
        paper: paper.split(',').next().unwrap_or_default(),
        says,
        places,
        verdict,
    })
}

/// What is wrong with a row; `read` gives the text of a file.
fn faults(row: &Row, read: &dyn Fn(&str) -> Option<String>) -> Vec<String> {
    let mut faults = Vec::new();
    let mut fault = |what: String| faults.push(format!("{}, {:?}: {what}", row.paper, row.says));
    if !PAPERS.iter().any(|(paper, _)| *paper == row.paper) {
        fault("no such paper".to_string());
    }
    let is_built = match row.verdict.split_once(": ") {
        None if row.verdict == "faithful" => true,
        Some(("changed", why)) if !why.trim().is_empty() => true,
        Some(("not built", why)) if !why.trim().is_empty() => false,
        _ => {
            fault(format!(
                "the verdict is {:?}, expected \"faithful\", \"changed: why\" or \"not built: why\"",
                row.verdict
            ));
            true
        }
    };
    if is_built && row.places.is_empty() {
        fault("nothing says where it is".to_string());
    }
    for (file, names) in &row.places {
        let Some(text) = read(file) else {
            fault(format!("there is no file {file}"));
            continue;
        };
        if names.is_empty() {
            fault(format!("{file} stands without a function"));
        }
        for name in names.iter().filter(|name| !declares(&text, name)) {
            fault(format!("{file} has no {name}"));
        }
    }
    faults
}

/// Whether a function, a constant or a type of this name is declared, and not only used.
fn declares(text: &str, name: &str) -> bool {
    let keywords = ["fn", "const", "struct", "enum"];
    keywords.iter().any(|keyword| {
        let declaration = format!("{keyword} {name}");
        text.match_indices(&declaration).any(|(at, found)| {
            let after = text[at + found.len()..].chars().next();
            let before = text[..at].chars().next_back();
            let in_a_word = |c: Option<char>| c.is_some_and(|c| c.is_alphanumeric() || c == '_');
            !in_a_word(after) && !in_a_word(before)
        })
    })
}

fn root() -> &'static Path {
    Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/.."))
}

fn read(file: &str) -> Option<String> {
    std::fs::read_to_string(root().join(file)).ok()
}

#[test]
fn every_file_and_function_of_the_table_is_there() {
    let text = read("docs/papers.md").unwrap();
    let rows = rows(&text).unwrap();
    let faults: Vec<String> = rows.iter().flat_map(|row| faults(row, &read)).collect();
    assert!(faults.is_empty(), "docs/papers.md:\n{}", faults.join("\n"));
    let mut counts: BTreeMap<&str, usize> = BTreeMap::new();
    for row in &rows {
        *counts.entry(row.paper).or_default() += 1;
    }
    for (paper, least) in PAPERS {
        let count = counts.get(paper).copied().unwrap_or(0);
        assert!(count >= least, "{paper}: {count} sentences");
    }
}

#[test]
fn no_sentence_stands_twice() {
    let text = read("docs/papers.md").unwrap();
    let mut said: Vec<&str> = rows(&text).unwrap().iter().map(|row| row.says).collect();
    let count = said.len();
    said.sort_unstable();
    said.dedup();
    assert_eq!(said.len(), count);
}

/// What the test above would say of tables that lie.
#[test]
fn a_table_that_lies_is_told() {
    let read = |file: &str| (file == "a/b.rs").then(|| "pub fn there() { gone(); }".to_string());
    let told = |line: &str| match row(line) {
        Ok(row) => faults(&row, &read).join("; "),
        Err(error) => error,
    };
    let sound = "| Wang, Shading | s | `a/b.rs` `there` | faithful |";
    assert_eq!(told(sound), "");
    assert_eq!(told("| Wang | s | — | not built: why |"), "");
    for (line, expected) in [
        (
            "| Wang | s | `a/b.rs` `gone` | faithful |",
            "a/b.rs has no gone",
        ),
        (
            "| Wang | s | `a/b.rs` `the` | faithful |",
            "a/b.rs has no the",
        ),
        (
            "| Wang | s | `a/c.rs` `there` | faithful |",
            "there is no file a/c.rs",
        ),
        (
            "| Wang | s | `a/b.rs` | faithful |",
            "a/b.rs stands without a function",
        ),
        (
            "| Wang | s | `there` | faithful |",
            "stands before any file",
        ),
        ("| Wang | s | — | faithful |", "nothing says where it is"),
        (
            "| Wang | s | — | not built |",
            "the verdict is \"not built\"",
        ),
        (
            "| Wang | s | `a/b.rs` `there` | changed: |",
            "the verdict is \"changed:\"",
        ),
        (
            "| Harris | s | `a/b.rs` `there` | faithful |",
            "no such paper",
        ),
        ("| Wang | s | faithful |", "expected four cells"),
    ] {
        let found = told(line);
        assert!(found.contains(expected), "{line}: {found}");
    }
}
