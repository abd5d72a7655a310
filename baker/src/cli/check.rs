//! `welkin check`: every rule with its figure, and an exit code that scripts can trust.
//!
//! 0: the pack is sound. 1: problems were found. 2: it cannot be read at all, or what was found could not
//! be written. With `--json` the report of `welkin-pack` is printed; docs/checks.md describes it.

use std::process::ExitCode;

use welkin_pack::check::{Outcome, Report, check};

use super::PackArgs;
use super::output;

const SOUND: u8 = 0;
const PROBLEMS: u8 = 1;
const UNREADABLE: u8 = 2;

pub fn run(args: &PackArgs) -> ExitCode {
    let report = match check(&args.pack) {
        Ok(report) => report,
        Err(error) => return output::failure(&error.to_string(), UNREADABLE),
    };
    let text = if args.json {
        report.to_json()
    } else {
        lines(&report)
    };
    if let Err(error) = output::result(&text) {
        return output::failure(&error.to_string(), UNREADABLE);
    }
    ExitCode::from(if report.is_sound() { SOUND } else { PROBLEMS })
}

fn lines(report: &Report) -> String {
    let mut text: String = report
        .findings
        .iter()
        .map(|finding| format!("{finding}\n"))
        .collect();
    let count = |outcome| {
        report
            .findings
            .iter()
            .filter(|f| f.outcome == outcome)
            .count()
    };
    let verdict = if report.is_sound() {
        "sound"
    } else {
        "not sound"
    };
    let (passed, failed, skipped) = (
        count(Outcome::Passed),
        count(Outcome::Failed),
        count(Outcome::Skipped),
    );
    text += &format!("{verdict}: {passed} passed, {failed} failed, {skipped} skipped\n");
    text
}
