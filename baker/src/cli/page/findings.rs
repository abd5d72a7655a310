//! Findings as tables: the failed ones first, each beside what it is about.

use std::fmt::Write;

use welkin_baker::REBAKE;
use welkin_pack::Role;
use welkin_pack::check::{Finding, Outcome, RULES, Report, Severity};

use super::text::escaped;

/// What a finding is about.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Of {
    /// The manifest, or all of it.
    Pack,
    /// A texture.
    Role(Role),
    /// The clouds in space.
    Field,
}

impl Of {
    /// Its name on the page.
    pub const fn name(self) -> &'static str {
        match self {
            Of::Pack => "pack",
            Of::Role(role) => role.name(),
            Of::Field => "field",
        }
    }

    /// What a finding is about: its subject says so, or else the first word of its rule.
    fn finding(finding: &Finding) -> Of {
        let (name, _) = subject(finding);
        let rule = finding.rule.split('-').next().unwrap_or_default();
        let is_named = |role: &Role| role.name() == name;
        let by_rule = |role: &Role| role.name().trim_end_matches('s') == rule.trim_end_matches('s');
        let roles = || Role::ALL.into_iter();
        if name == "field" {
            return Of::Field;
        }
        let role = roles().find(is_named).or_else(|| roles().find(by_rule));
        role.map_or(Of::Pack, Of::Role)
    }
}

/// The first word of a finding's subject, and what follows its first point.
fn subject(finding: &Finding) -> (&str, Option<&str>) {
    let word = finding.subject.split(' ').next().unwrap_or_default();
    match word.split_once('.') {
        Some((name, rest)) => (name, Some(rest)),
        None => (word, None),
    }
}

/// The findings about something, failed ones first.
pub fn about(report: &Report, of: Of) -> impl Iterator<Item = &Finding> {
    let of_it = move |f: &&Finding| Of::finding(f) == of;
    let failed = report
        .findings
        .iter()
        .filter(|f| f.outcome == Outcome::Failed);
    let others = report
        .findings
        .iter()
        .filter(|f| f.outcome != Outcome::Failed);
    failed.chain(others).filter(of_it)
}

/// The channel that a finding is about, if it is about one.
pub fn channel(finding: &Finding) -> Option<usize> {
    let Of::Role(role) = Of::finding(finding) else {
        return None;
    };
    let name = subject(finding).1?;
    role.spec().channels.iter().position(|c| c.name == name)
}

/// The class of a finding: `ok`, `skipped`, `warning` or `error`.
fn class(finding: &Finding) -> &'static str {
    match (finding.outcome, finding.severity) {
        (Outcome::Passed, _) => "ok",
        (Outcome::Skipped, _) => "skipped",
        (Outcome::Failed, Severity::Warning) => "warning",
        (Outcome::Failed, Severity::Error) => "error",
    }
}

/// The worst class of some findings.
pub fn worst<'a>(findings: impl Iterator<Item = &'a Finding>) -> &'static str {
    let classes = ["ok", "skipped", "warning", "error"];
    let rank = |class: &str| classes.iter().position(|c| *c == class).unwrap_or(0);
    classes[findings.map(|f| rank(class(f))).max().unwrap_or(0)]
}

/// Every finding that failed, with a link to its evidence; nothing if none did.
pub fn failed(report: &Report) -> String {
    let mut rows = String::new();
    let warnings = |f: &&Finding| f.severity == Severity::Warning;
    let errors = report.problems().filter(|f| !warnings(f));
    for finding in errors.chain(report.problems().filter(warnings)) {
        let of = Of::finding(finding);
        let anchor = match (of, channel(finding)) {
            (Of::Role(role), Some(channel)) => {
                format!("{}-{}", role.name(), role.spec().channels[channel].name)
            }
            _ => of.name().to_string(),
        };
        let link = format!("<a href=\"#{anchor}\">{}</a>", escaped(&finding.subject));
        rows += &row(finding, &link);
    }
    match rows.as_str() {
        "" => String::new(),
        _ => format!(
            "<section id=\"failed\">\n<h2>What failed</h2>\n<table>\n{rows}</table>\n</section>\n"
        ),
    }
}

/// A table of findings; nothing if there are none. The name of a channel, which stands above the table, is left out.
pub fn table<'a>(findings: impl Iterator<Item = &'a Finding>) -> String {
    let subject = |f: &'a Finding| match channel(f) {
        Some(_) => f.subject.split_once(' ').map_or("", |(_, rest)| rest),
        None => f.subject.as_str(),
    };
    let rows: String = findings.map(|f| row(f, &escaped(subject(f)))).collect();
    match rows.as_str() {
        "" => rows,
        _ => format!("<table>\n{rows}</table>\n"),
    }
}

fn row(finding: &Finding, subject: &str) -> String {
    let class = class(finding);
    let asks = RULES
        .iter()
        .chain([&REBAKE])
        .find(|rule| rule.id == finding.rule);
    let asks = asks.map_or("", |rule| rule.asks);
    let figure = finding.figure_text().unwrap_or_default();
    let mut html = format!(
        "<tr class=\"{class}\"><td class=\"mark\">{class}</td><td class=\"rule\"><code title=\"{}\">{}</code></td><td class=\"subject\">{subject}</td>\
         <td class=\"figure\">{figure}</td><td class=\"expected\">{}</td></tr>\n",
        escaped(asks),
        escaped(finding.rule),
        escaped(&finding.expected),
    );
    let mut explain = Vec::new();
    if finding.outcome == Outcome::Failed && !asks.is_empty() {
        explain.push(format!("<em>{}</em>", escaped(asks)));
    }
    if !finding.note.is_empty() {
        explain.push(escaped(&finding.note));
    }
    if !explain.is_empty() {
        // Into a string, which takes everything.
        let _ = writeln!(
            html,
            "<tr class=\"{class} note\"><td></td><td colspan=\"4\">{}</td></tr>",
            explain.join(" ")
        );
    }
    html
}
