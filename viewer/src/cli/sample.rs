//! The options of `welkin-view sample`.

use std::path::PathBuf;

use clap::Args;
use welkin_runtime::params::whole_within;
use welkin_viewer::export::sequence::MOST_FRAMES;

#[derive(Debug, Args)]
pub struct SampleArgs {
    /// TOML file of what to draw from: ranges and choices of settings, weathers, dates, places
    pub ranges: PathBuf,
    /// How many lines
    #[arg(long, value_name = "N", value_parser = count, allow_hyphen_values = true)]
    pub count: u32,
    /// What all numbers follow from; the same on every machine
    #[arg(long, value_name = "S", default_value_t = 1)]
    pub seed: u64,
    /// Jobs for `welkin-view render --jobs`, a file of that name is replaced; `-` is standard output
    #[arg(short, long, value_name = "JOBS.jsonl|-", allow_hyphen_values = true)]
    pub output: PathBuf,
}

fn count(text: &str) -> Result<u32, String> {
    whole_within(text, 1..=MOST_FRAMES)
}
