//! What a comparison finds.

use welkin_pack::check::{Finding, Outcome, Rule, Severity};

/// The rule of [`rebake`](crate::rebake())'s findings.
pub const REBAKE: Rule = Rule {
    id: "rebake",
    severity: Severity::Error,
    asks: "Baking the recipe of the manifest anew gives the same manifest, texels and clouds.",
};

pub(super) fn finding(
    subject: &str,
    outcome: Outcome,
    figure: Option<f64>,
    note: String,
) -> Finding {
    let expected = match figure {
        Some(_) => "0 differences".to_string(),
        None => String::new(),
    };
    Finding {
        rule: REBAKE.id,
        severity: REBAKE.severity,
        subject: subject.to_string(),
        outcome,
        figure,
        expected,
        note,
    }
}

/// A finding that counts differences; `first` tells where the first is.
pub(super) fn counted(subject: &str, differences: usize, first: Option<String>) -> Finding {
    let outcome = match differences {
        0 => Outcome::Passed,
        _ => Outcome::Failed,
    };
    let note = first.unwrap_or_default();
    finding(subject, outcome, Some(differences as f64), note)
}

pub(super) fn skipped(subject: &str, why: &str) -> Finding {
    finding(subject, Outcome::Skipped, None, why.to_string())
}
