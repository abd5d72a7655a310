//! Links of the documentation lead somewhere: to a file of the repository, and to a heading in it.

use std::fs;
use std::path::{Path, PathBuf};

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..")
}

/// Every page: those at the top, in docs/, and of each crate.
fn pages() -> Vec<PathBuf> {
    let root = root();
    let mut folders = vec![root.clone(), root.join("docs"), root.join("docs/engines")];
    for name in [
        "pack",
        "baker",
        "runtime",
        "controls",
        "viewer",
        "bevy_welkin",
    ] {
        folders.push(root.join(name));
    }
    let files = folders.iter().flat_map(|folder| {
        let entries = fs::read_dir(folder).expect("the folder is there");
        entries.map(|entry| entry.expect("it can be read").path())
    });
    files
        .filter(|file| file.extension().is_some_and(|end| end == "md"))
        .collect()
}

/// The targets of a page's links and pictures, but for those in blocks of code.
fn targets(text: &str) -> Vec<String> {
    let mut found = Vec::new();
    let mut is_code = false;
    for line in text.lines() {
        is_code ^= line.starts_with("```");
        if is_code {
            continue;
        }
        for rest in line.split("](").skip(1) {
            found.extend(rest.split_once(')').map(|(target, _)| target.to_string()));
        }
    }
    found
}

/// The anchors of a page's headings, as forges make them.
fn anchors(text: &str) -> Vec<String> {
    let headings = text.lines().filter(|line| line.starts_with('#'));
    let anchor = |heading: &str| {
        let words = heading.trim_start_matches('#').trim().to_lowercase();
        let kept = words
            .chars()
            .filter(|c| c.is_alphanumeric() || matches!(c, ' ' | '-' | '_'));
        kept.map(|c| if c == ' ' { '-' } else { c }).collect()
    };
    headings.map(anchor).collect()
}

#[test]
fn every_link_leads_to_a_file_and_a_heading() {
    let mut count = 0;
    for page in pages() {
        let text = fs::read_to_string(&page).expect("the page can be read");
        for target in targets(&text) {
            if target.contains("://") {
                continue;
            }
            count += 1;
            let (file, anchor) = target.split_once('#').unwrap_or((&target, ""));
            let path = match file {
                "" => page.clone(),
                _ => page.with_file_name("").join(file),
            };
            assert!(path.exists(), "{}: {target}", page.display());
            if !anchor.is_empty() {
                let headings = anchors(&fs::read_to_string(&path).expect("it is a page"));
                let has = headings.iter().any(|heading| heading == anchor);
                assert!(has, "{}: {target}", page.display());
            }
        }
    }
    assert!(count > 100, "{count}");
}

#[test]
fn a_link_in_code_is_none_and_anchors_are_those_of_forges() {
    let text = "see [a](b.md#c) and ![d](e.png)\n```\nf[0](g)\n```\n## What it costs, `here`\n";
    assert_eq!(targets(text), ["b.md#c", "e.png"]);
    assert_eq!(anchors(text), ["what-it-costs-here"]);
}
