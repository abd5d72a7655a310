//! A bar on standard error.

use indicatif::{ProgressBar, ProgressStyle};

/// A bar if standard error is a terminal, and nothing elsewhere; without a number of `things` it counts them.
pub fn progress(count: Option<u64>, things: &str) -> ProgressBar {
    let bar = count.map_or_else(ProgressBar::no_length, ProgressBar::new);
    let text = match count {
        Some(_) => format!("{{bar:24}} {{pos}}/{{len}} {things}, {{eta}} left"),
        None => format!("{{pos}} {things}, {{elapsed}}"),
    };
    if let Ok(style) = ProgressStyle::with_template(&text) {
        bar.set_style(style);
    }
    bar
}
