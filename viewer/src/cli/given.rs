//! Whether an option was given, and what is said of one that belongs elsewhere.

use clap::ArgMatches;
use clap::parser::ValueSource;

/// Whether an option stands on the command line.
pub fn is_given(given: &ArgMatches, option: &str) -> bool {
    given.value_source(option) == Some(ValueSource::CommandLine)
}

/// Says that an option is for another choice than the one that was made, and what to do.
pub fn belongs(option: &str, owner: &str, chosen: &str, remedy: &str) -> String {
    format!("--{option} belongs to {owner}, and {chosen} does not use it; leave it out or {remedy}")
}
