//! The options of many skies.

use std::path::PathBuf;

use clap::builder::PathBufValueParser;
use clap::{ArgMatches, Args, ValueEnum};
use welkin_runtime::params::whole_within;

use super::given::is_given;

#[derive(Debug, Args)]
#[command(next_help_heading = "Many skies in one process")]
pub struct JobsArgs {
    /// Draw a picture for each line of a file, a JSON object with its name, settings, camera or map, into the folder that --output names,
    /// with an index of them; `-` reads the lines from standard input. Pictures that are there are kept if their line is the same
    #[arg(long, value_name = "JOBS.jsonl|-", group = super::export::SEQUENCE, value_parser = PathBufValueParser::new(), allow_hyphen_values = true)]
    pub jobs: Option<PathBuf>,
    /// What to tell of each picture beside it, some of opacity, mask, sun, oktas and light between commas
    #[arg(
        long,
        value_name = "LABEL,...",
        requires = "jobs",
        value_enum,
        value_delimiter = ','
    )]
    pub labels: Vec<Label>,
    /// Put pictures and labels into tar files of N jobs each, as WebDataset reads them: skies-000000.tar and so on
    #[arg(long, value_name = "N", requires = "jobs", value_parser = tar, allow_hyphen_values = true)]
    pub tar: Option<u32>,
    /// Replace files of --jobs that other lines or other programs have made
    #[arg(long, requires = "jobs")]
    pub force: bool,
}

/// Jobs that a tar file may have.
const MOST_IN_TAR: u32 = 100_000;

fn tar(text: &str) -> Result<u32, String> {
    whole_within(text, 1..=MOST_IN_TAR)
}

/// What is told of a picture beside it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, ValueEnum)]
pub enum Label {
    /// Opacity of the clouds at every pixel, as NAME.opacity.png
    Opacity,
    /// What counts as cloud, as NAME.mask.png
    Mask,
    /// Where sun and moon are, and whether they are seen
    Sun,
    /// Eighths of the sky that clouds cover, as asked for and as drawn
    Oktas,
    /// The light of the sky on a scene
    Light,
}

impl Label {
    /// What the command line calls it.
    pub fn name(self) -> String {
        let value = self.to_possible_value();
        value.map_or_else(String::new, |value| value.get_name().to_string())
    }
}

/// The options that go with jobs, which say all else themselves.
const BESIDE: [&str; 8] = [
    "tar", "pack", "output", "jobs", "labels", "force", "shard", "gpu",
];

impl JobsArgs {
    /// The labels in one order, each once.
    pub fn labels(&self) -> Vec<Label> {
        let mut labels = self.labels.clone();
        labels.sort();
        labels.dedup();
        labels
    }

    /// An option that no job would look at is a mistake, and told.
    ///
    /// # Errors
    /// Which option it is, and what to do.
    pub fn refuse_others(&self, given: &ArgMatches) -> Result<(), String> {
        // Groups have the names of their structs, or are not of the command line.
        let is_option =
            |id: &&str| !id.starts_with(char::is_uppercase) && *id != super::export::SEQUENCE;
        let mut ids = given.ids().map(clap::Id::as_str).filter(is_option);
        match ids.find(|id| is_given(given, id) && !BESIDE.contains(id)) {
            None => Ok(()),
            Some(id) => Err(format!(
                "--{} does not go with --jobs, whose lines say what is drawn; leave it out and write it into the lines",
                id.replace('_', "-")
            )),
        }
    }
}
