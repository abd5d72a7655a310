//! What a check found.

use std::fmt;

use serde::Serialize;

use super::rule::{RULES, Rule, Severity};
use crate::role::Role;
use crate::shown::shown;

/// How a rule came out.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Outcome {
    /// It holds.
    Passed,
    /// It is broken.
    Failed,
    /// It could not be looked at, because something before it is broken.
    Skipped,
}

/// One rule applied to one thing.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Finding {
    /// Id of the rule.
    pub rule: &'static str,
    /// How bad it is when broken.
    pub severity: Severity,
    /// What it was applied to, such as `clouds.noise`.
    pub subject: String,
    /// How it came out.
    pub outcome: Outcome,
    /// The figure that was measured, if there is one.
    pub figure: Option<f64>,
    /// What the figure should be.
    pub expected: String,
    /// What was found, in words; empty where the figure says it all.
    pub note: String,
}

impl Finding {
    /// Whether it is an error: a broken rule that makes the pack unsound.
    pub fn is_error(&self) -> bool {
        self.outcome == Outcome::Failed && self.severity == Severity::Error
    }

    /// The figure as reports print it: a whole number, or four digits after the point, or two digits and a power of ten.
    pub fn figure_text(&self) -> Option<String> {
        self.figure.map(short)
    }
}

impl fmt::Display for Finding {
    /// One line: outcome, rule, subject, figure, expectation, note.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let outcome = match (self.outcome, self.severity) {
            (Outcome::Passed, _) => "ok",
            (Outcome::Skipped, _) => "skipped",
            (Outcome::Failed, Severity::Error) => "ERROR",
            (Outcome::Failed, Severity::Warning) => "warning",
        };
        write!(
            f,
            "{outcome:<8} {:<18} {:<18}",
            self.rule,
            shown(&self.subject)
        )?;
        if let Some(figure) = self.figure_text() {
            write!(f, " {figure:<10}")?;
        }
        if !self.expected.is_empty() {
            write!(f, " expected {}", shown(&self.expected))?;
        }
        if !self.note.is_empty() {
            write!(f, "; {}", shown(&self.note))?;
        }
        Ok(())
    }
}

fn short(figure: f64) -> String {
    if figure == figure.trunc() && figure.abs() < 1e9 {
        format!("{figure}")
    } else if figure.abs() < 1e-3 {
        format!("{figure:.1e}")
    } else {
        format!("{figure:.4}")
    }
}

/// What a check found, rule by rule.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Report {
    /// Every rule with everything that it was applied to, passed or not.
    pub findings: Vec<Finding>,
}

impl Report {
    /// Whether no rule of severity error is broken.
    pub fn is_sound(&self) -> bool {
        !self.findings.iter().any(Finding::is_error)
    }

    /// The broken rules, warnings among them.
    pub fn problems(&self) -> impl Iterator<Item = &Finding> {
        self.findings
            .iter()
            .filter(|f| f.outcome == Outcome::Failed)
    }

    /// How many findings came out so.
    pub fn count(&self, outcome: Outcome) -> usize {
        let findings = self.findings.iter();
        findings.filter(|f| f.outcome == outcome).count()
    }

    /// The report as JSON: `{"sound": bool, "findings": [...]}`. docs/checks.md documents the keys.
    pub fn to_json(&self) -> String {
        let json = serde_json::json!({ "sound": self.is_sound(), "findings": self.findings });
        let mut text = serde_json::to_string_pretty(&json).unwrap_or_default();
        text.push('\n');
        text
    }

    /// Puts the findings into the order of [`RULES`].
    pub(super) fn sort(&mut self) {
        let order = |id: &str| RULES.iter().position(|rule| rule.id == id);
        self.findings.sort_by_key(|finding| order(finding.rule));
    }

    /// Records a figure that should be no more than `most`.
    pub(super) fn at_most(&mut self, rule: Rule, subject: &str, figure: impl Into<f64>, most: f64) {
        self.measure(rule, subject, figure, Bound::AtMost(most));
    }

    /// Records a figure that should be no less than `least`.
    pub(super) fn at_least(
        &mut self,
        rule: Rule,
        subject: &str,
        figure: impl Into<f64>,
        least: f64,
    ) {
        self.measure(rule, subject, figure, Bound::AtLeast(least));
    }

    /// Records a figure that should be within two.
    pub(super) fn within(
        &mut self,
        rule: Rule,
        subject: &str,
        figure: impl Into<f64>,
        [least, most]: [f64; 2],
    ) {
        self.measure(rule, subject, figure, Bound::Within(least, most));
    }

    /// Records a figure and compares it with what it should be.
    pub(super) fn measure(
        &mut self,
        rule: Rule,
        subject: &str,
        figure: impl Into<f64>,
        bound: Bound,
    ) {
        let figure = figure.into();
        let outcome = if bound.holds(figure) {
            Outcome::Passed
        } else {
            Outcome::Failed
        };
        let texts = [bound.to_string(), String::new()];
        self.push(rule, subject, outcome, Some(figure), texts);
    }

    /// Records that something holds, or the error that says why not.
    pub(super) fn verify<T, E: fmt::Display>(
        &mut self,
        rule: Rule,
        subject: &str,
        result: Result<T, E>,
    ) -> Option<T> {
        let (outcome, note) = match &result {
            Ok(_) => (Outcome::Passed, String::new()),
            Err(error) => (Outcome::Failed, error.to_string()),
        };
        self.push(rule, subject, outcome, None, [String::new(), note]);
        result.ok()
    }

    /// Records that a rule could not be looked at.
    pub(super) fn skip(&mut self, rule: Rule, subject: &str, why: &str) {
        let texts = [String::new(), why.to_string()];
        self.push(rule, subject, Outcome::Skipped, None, texts);
    }

    fn push(
        &mut self,
        rule: Rule,
        subject: &str,
        outcome: Outcome,
        figure: Option<f64>,
        [expected, note]: [String; 2],
    ) {
        self.findings.push(Finding {
            rule: rule.id,
            severity: rule.severity,
            subject: subject.to_string(),
            outcome,
            figure,
            expected,
            note,
        });
    }
}

/// What a figure should be.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Bound {
    /// No more than this.
    AtMost(f64),
    /// No less than this.
    AtLeast(f64),
    /// Within these two.
    Within(f64, f64),
}

impl Bound {
    /// Not a number holds no bound.
    fn holds(self, figure: f64) -> bool {
        match self {
            Bound::AtMost(most) => figure <= most,
            Bound::AtLeast(least) => figure >= least,
            Bound::Within(least, most) => (least..=most).contains(&figure),
        }
    }
}

impl fmt::Display for Bound {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Bound::AtMost(most) => write!(f, "at most {}", short(*most)),
            Bound::AtLeast(least) => write!(f, "at least {}", short(*least)),
            Bound::Within(least, most) => write!(f, "{} to {}", short(*least), short(*most)),
        }
    }
}

/// `role.channel`, as reports name a channel.
pub(super) fn subject(role: Role, channel: usize) -> String {
    format!("{}.{}", role.name(), role.spec().channels[channel].name)
}
