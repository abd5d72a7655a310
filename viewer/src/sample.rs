//! `welkin-view sample`: jobs drawn from ranges, the same on every machine.

mod draw;
mod fault;
mod ranges;
mod spread;
mod stream;
#[cfg(test)]
mod tests;

use std::fmt::Write;
use std::fs;

use anyhow::{Context, Result};
use welkin_pack::place::verify_apart;
use welkin_pack::whole::{sweep_beside, write_file};

use self::ranges::Ranges;
use crate::cli::SampleArgs;
use crate::job::Job;
use crate::told::{print, tell_leftovers};

/// Lines that are printed at once.
const PRINTED: u64 = 1000;

pub fn run(args: &SampleArgs) -> Result<()> {
    let file = args.ranges.display().to_string();
    let is_printed = args.output.as_os_str() == "-";
    if !is_printed {
        verify_apart(&[&args.ranges], &[&args.output])?;
    }
    let text = fs::read_to_string(&args.ranges)
        .with_context(|| format!("{file}: cannot be read; name a TOML file of ranges"))?;
    let text = text.trim_start_matches('\u{feff}');
    let ranges = Ranges::parse(text).with_context(|| file.clone())?;
    let mut lines = String::new();
    for number in 0..u64::from(args.count) {
        let line = draw::line(&ranges, args.seed, number)?;
        // What goes together only by chance, such as oktas and a cover, shows here.
        Job::parse(&line, number).with_context(|| format!("{file}: makes the job {line}"))?;
        writeln!(lines, "{line}")?;
        if is_printed && (number + 1).is_multiple_of(PRINTED) {
            print(&lines)?;
            lines.clear();
        }
    }
    if is_printed {
        return print(&lines);
    }
    tell_leftovers(&sweep_beside(&args.output));
    Ok(write_file(&args.output, lines.as_bytes(), &|| false)?)
}
